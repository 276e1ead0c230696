// The long run of the law (docs/background/exactness.md):
//     law_run --designs 2000 --state run.state --keep folder
// A run that was stopped goes on with the same command. --first i begins each family with its i-th design, --seed n
// draws others, --patience s is the CPU time that each question to the program may take. --show FAMILY INDEX prints one
// design with its options, and judges nothing.
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>

#include "tests/laws/law_run.hpp"

int main(int argc, char** argv) {
  using namespace clearloci::test;
  LawRun own;
  own.designs = static_cast<int>(all_families.size());
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string key = argv[i], value = argv[i + 1];
    if (key == "--designs") own.designs = std::stoi(value);
    if (key == "--first") own.first = std::stoi(value);
    if (key == "--seed") own.seed = std::stoi(value);
    if (key == "--patience") own.patience = std::stoi(value);
    if (key == "--state") own.state = value;
    if (key == "--keep") own.keep = value;
    if (key == "--show" && i + 2 < argc) {
      const LawDesign design = law_design(own.seed, all_families.at(std::stoul(value)), std::stoi(argv[i + 2]));
      std::cout << "# " << arguments_of(design) << "\n" << design.text;
      return 0;
    }
  }
  std::cout << "seed " << own.seed << ", " << own.designs << " designs from " << own.first << " on, " << own.patience
            << " s of CPU a question" << std::endl;
  const auto judgements = run(own);
  std::cout << table_of(judgements);
  for (const Judgement& judgement : judgements)
    if (judgement.outcome == Outcome::contradicted) return 1;
  return 0;
}
