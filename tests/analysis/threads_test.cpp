// Questions asked from several threads at once are answered as when they are asked alone: the libraries behind them
// share what they keep for the whole process (symbolic/algebra_turn.hpp, loci/curves/curve_arrangement.cpp).
#include <gtest/gtest.h>

#include <sstream>
#include <thread>

#include "clearloci/mechanism.hpp"
#include "clearloci/verify.hpp"
#include "clearloci/zones.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

const std::vector<std::string> names = {"five_bar", "five_bar_generic", "five_bar_horizontal", "prrrp", "three_rpr"};

/// Loci, zones and a verdict in words that tell different answers apart.
std::string answers(const std::string& name) {
  const Model model = Model::read(source_dir() + "/examples/" + name + ".yaml");
  std::ostringstream words;
  words.precision(17);
  const Zones map = find_zones(model);
  for (const LocusCurve& curve : map.loci.curves)
    words << curve.id << " " << to_string(curve.implicit, map.loci.tower.coordinates) << " " << curve.arcs.size()
          << "\n";
  for (const Zone& zone : map.zones) words << zone.id << " " << zone.size << " " << zone.certified << "\n";
  const std::vector<double> at = map.zones.front().sample;
  std::ostringstream task;
  task << "format: 1\npath: [[" << at[0] << ", " << at[1] << "], [" << at[0] + 0.01 << ", " << at[1] << "]]\n";
  words << static_cast<int>(verify(model, parse_task(task.str(), model), {.depth = VerifyDepth::margin}).verdict);
  return words.str();
}

TEST(Threads, AskAtOnceAndAreAnsweredAsAlone) {
  std::vector<std::string> alone;
  for (const std::string& name : names) alone.push_back(answers(name));
  std::vector<std::string> together(4 * names.size());
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t)
    threads.emplace_back([&together, t] {
      for (std::size_t k = 0; k < names.size(); ++k)
        together[t * names.size() + k] = answers(names[(k + t) % names.size()]);
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t k = 0; k < names.size(); ++k)
      EXPECT_EQ(together[t * names.size() + k], alone[(k + t) % names.size()]) << names[(k + t) % names.size()];
}

}  // namespace
}  // namespace clearloci
