// Random designs with random tasks, each asked three questions in a process of its own: how long the slow ones take.
//     bench_tail FIRST COUNT LIMIT SEED [FOLDER]
// draws designs FIRST .. FIRST + COUNT - 1 and prints a line of JSON an answer, with the processor time from the texts
// to the answer; a question that takes LIMIT s of it is ended. FOLDER: models and tasks are written there. bench/tail
// makes tables and histograms of it.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <optional>
#include <random>
#include <string>

#include "analysis/verification.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/zones.hpp"
#include "mechanism/read.hpp"
#include "mechanism/read_task.hpp"
#include "tests/laws/lattice_designs.hpp"
#include "tests/laws/task_designs.hpp"

namespace {

namespace core = clearloci::core;
namespace mechanism = clearloci::mechanism;
namespace test = clearloci::test;
using clearloci::Model;

struct Drawn {
  int number = 0, kind = 0;
  bool lattice = false;
  std::string model, task;
};

/// Of the longest equations: those of the law of random designs, behind those that tasks are drawn for.
constexpr std::array long_families = {test::Family::stacked, test::Family::three_rrr};
constexpr int kinds = test::task_design_kinds + static_cast<int>(long_families.size());

std::string model_of(std::mt19937& random, int kind, bool lattice) {
  if (kind < test::task_design_kinds) return test::random_design(random, kind, lattice);
  const test::Family family = long_families.at(static_cast<std::size_t>(kind - test::task_design_kinds));
  const bool weights = random() % 2 == 0;
  return lattice ? test::lattice_design(random, family, weights) : test::generic_design(random, family, weights);
}

/// Nothing where no pose was found within reach, or the texts are refused: a polygon that crosses itself, a mechanism
/// that is singular in every pose.
std::optional<Drawn> draw(int number, unsigned seed) {
  std::mt19937 random(seed + static_cast<unsigned>(number));
  Drawn drawn{number, number % kinds, number / kinds % 2 == 0, {}, {}};
  drawn.model = model_of(random, drawn.kind, drawn.lattice);
  try {
    const mechanism::Mechanism parse_mechanism = mechanism::parse_mechanism(drawn.model, "random.yaml");
    const auto shape = test::random_shape(random, parse_mechanism, drawn.lattice);
    if (!shape) return std::nullopt;
    drawn.task = "format: 1\n" + *shape;
    const core::Task alone = mechanism::parse_task(drawn.task, "task.yaml", parse_mechanism);
    drawn.task += test::random_wishes(random, parse_mechanism, alone.shape, drawn.lattice) + "\n";
  } catch (const core::InputError&) {
    return std::nullopt;
  }
  return drawn;
}

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Question {
  const char* name;
  std::function<std::string(const Drawn&)> answer;
};

const char* certified(const clearloci::LocusMap& map) {
  const auto open = [](const auto& one) { return !one.certified; };
  const bool all = std::none_of(map.curves.begin(), map.curves.end(), open) &&
                   std::none_of(map.isolated_points.begin(), map.isolated_points.end(), open);
  return all ? "certified" : "not certified";
}

const Question questions[] = {
    {"verify",
     [](const Drawn& drawn) {
       const Model model = Model::parse(drawn.model);
       return to_string(clearloci::verify(model, clearloci::parse_task(drawn.task, model)).verdict);
     }},
    {"loci",
     [](const Drawn& drawn) { return std::string(certified(clearloci::trace_loci(Model::parse(drawn.model)))); }},
    {"zones",
     [](const Drawn& drawn) {
       const clearloci::Zones map = clearloci::find_zones(Model::parse(drawn.model));
       const bool all = std::all_of(map.zones.begin(), map.zones.end(), [](const auto& z) { return z.certified; });
       return std::string(all ? certified(map.loci) : "not certified");
     }},
};

void print(const Drawn& drawn, const char* question, double seconds, const std::string& outcome) {
  fmt::print(
      "{{\"design\": {}, \"kind\": {}, \"lattice\": {}, \"question\": \"{}\", \"seconds\": {:.5f}, \"outcome\": "
      "\"{}\"}}\n",
      drawn.number, drawn.kind, drawn.lattice, question, seconds, outcome);
  std::fflush(stdout);
}

/// In a process of its own: what was asked before leaves no trace, and one that does not end can be ended.
void ask(const Drawn& drawn, const Question& question, double limit) {
  const pid_t child = fork();
  if (child == 0) {
    const auto most = static_cast<rlim_t>(limit + 0.999);
    const rlimit seconds{most, most + 1};
    setrlimit(RLIMIT_CPU, &seconds);
    std::string outcome;
    const double start = processor_seconds();
    try {
      outcome = question.answer(drawn);
    } catch (const core::InputError&) {
      outcome = "refused";
    }
    print(drawn, question.name, processor_seconds() - start, outcome);
    std::_Exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  const bool ended = WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
  print(drawn, question.name, limit, ended ? "not done" : "crashed");
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 5) {
    fmt::print(stderr, "bench_tail FIRST COUNT LIMIT SEED [FOLDER]\n");
    return 2;
  }
  const int first = std::atoi(arguments[1]), designs = std::atoi(arguments[2]);
  const double limit = std::atof(arguments[3]);
  const auto seed = static_cast<unsigned>(std::atoi(arguments[4]));
  for (int i = first; i < first + designs; ++i) {
    const std::optional<Drawn> drawn = draw(i, seed);
    if (!drawn) continue;
    if (count > 5) {
      std::ofstream(fmt::format("{}/{}.yaml", arguments[5], i)) << drawn->model;
      std::ofstream(fmt::format("{}/{}_task.yaml", arguments[5], i)) << drawn->task;
    }
    for (const Question& question : questions) ask(*drawn, question, limit);
  }
  return 0;
}
