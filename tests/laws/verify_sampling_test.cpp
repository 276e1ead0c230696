// What verify says of a task against dense sampling of all that it speaks of: poses of the task, its boundary and its
// margin, and loads between the ends of a range. A proof is contradicted by no sample, and the witness of a refutation
// fails by reactions that are solved another way. CLEARLOCI_DESIGNS=n in the environment tries n designs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>

#include "core/errors.hpp"
#include "mechanism/read_task.hpp"
#include "report/verification.hpp"
#include "tests/laws/judged.hpp"
#include "tests/laws/task_designs.hpp"
#include "tests/laws/task_oracle.hpp"

namespace clearloci {
namespace {

using core::Verdict;

TEST(VerifySampling, IsNeverContradicted) {
  const char* wanted = std::getenv("CLEARLOCI_DESIGNS");
  const int designs = wanted != nullptr ? std::atoi(wanted) : 70;
  const char* seed = std::getenv("CLEARLOCI_SEED");
  const char* dump = std::getenv("CLEARLOCI_DUMP");  // a folder for the models and tasks
  std::map<Verdict, int> counts;
  std::vector<double> times;
  int refused = 0;
  for (int i = 0; i < designs; ++i) {
    std::mt19937 random((seed != nullptr ? static_cast<unsigned>(std::atoi(seed)) : 20110579U) +
                        static_cast<unsigned>(i));
    const int kind = i % test::task_design_kinds;
    const bool lattice = (i / test::task_design_kinds) % 2 == 0;
    const std::string text = test::random_design(random, kind, lattice);
    std::string demands;
    mechanism::Mechanism mechanism;
    std::optional<core::Task> task;
    std::optional<Verification> result;
    SCOPED_TRACE(fmt::format("design {}\n{}", i, text));
    try {
      mechanism = mechanism::parse_mechanism(text, "random.yaml");
      const auto shape = test::random_shape(random, mechanism, lattice);
      if (!shape) {
        ++refused;
        continue;
      }
      demands = "format: 1\n" + *shape;
      demands +=
          test::random_wishes(random, mechanism, mechanism::parse_task(demands, "task.yaml", mechanism).shape, lattice);
      task = mechanism::parse_task(demands, "task.yaml", mechanism);
      if (dump != nullptr) {
        std::ofstream(fmt::format("{}/{}.yaml", dump, i)) << text;
        std::ofstream(fmt::format("{}/{}_task.yaml", dump, i)) << demands << "\n";
      }
      const auto start = std::chrono::steady_clock::now();
      result = test::decided(mechanism, *task, {});
      times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    } catch (const core::InputError&) {
      ++refused;  // a polygon that crosses itself, a mechanism that is singular in every pose
      continue;
    }
    SCOPED_TRACE(demands);
    ++counts[result->verdict];
    if (wanted != nullptr)
      fmt::print("{} kind {} {} {} {:.2f} s{}\n", i, kind, lattice ? "lattice" : "general", to_string(result->verdict),
                 times.back(), result->witness ? " " + report::witness_words(*result->witness) : "");
    const test::Oracle oracle(mechanism, *task);
    const test::Say say = [](bool holds, const std::string& what) { EXPECT_TRUE(holds) << what; };
    EXPECT_EQ(result->witness.has_value(), result->verdict == Verdict::refuted);
    EXPECT_EQ(result->open.has_value(), result->verdict == Verdict::undecided);
    if (result->verified()) test::hold_verified(random, oracle, *task, *result, 300, say);
    if (result->witness) test::hold_refuted(oracle, *task, *result->witness, say);
  }
  std::sort(times.begin(), times.end());
  if (!times.empty())
    fmt::print(
        "{} verified, {} refuted, {} undecided, {} refused; median {:.3f} s, 9 of 10 in {:.3f} s, longest {:.1f} s\n",
        counts[Verdict::verified], counts[Verdict::refuted], counts[Verdict::undecided], refused,
        times[times.size() / 2], times[times.size() * 9 / 10], times.back());
  EXPECT_GT(counts[Verdict::verified], designs / 10);
  EXPECT_GT(counts[Verdict::refuted], designs / 10);
  EXPECT_LT(5 * counts[Verdict::undecided], designs);
}

}  // namespace
}  // namespace clearloci
