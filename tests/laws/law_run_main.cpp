// The long run of the law (docs/background/exactness.md):
//     law_run --designs 2000 --state run.state --keep folder
// A run that was stopped goes on with the same command. --first i begins each family with its i-th design, --seed n
// draws others, --family n takes designs of that family alone, --patience s is the CPU time that each question to the
// program may take. --show FAMILY INDEX prints one design with its options, and judges nothing.
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>

#include "tests/laws/law_run.hpp"

namespace {

int usage() {
  std::cerr << "law_run [--designs N] [--family N] [--first N] [--seed N] [--patience SECONDS] [--state FILE]\n"
               "        [--keep FOLDER]\n"
               "law_run --show FAMILY INDEX\n";
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace clearloci::test;
  LawRun law_run;
  law_run.designs = static_cast<int>(law_run.families.size());
  for (int i = 1; i < argc; i += 2) {
    const std::string key = argv[i];
    if (i + 1 == argc) return usage();
    const std::string value = argv[i + 1];
    if (key == "--show" && i + 2 < argc) {
      const LawDesign design = law_design(law_run.seed, all_families.at(std::stoul(value)), std::stoi(argv[i + 2]));
      std::cout << "# " << arguments_of(design) << "\n" << design.text;
      return 0;
    }
    if (key == "--designs")
      law_run.designs = std::stoi(value);
    else if (key == "--family")
      law_run.families = {all_families.at(std::stoul(value))};
    else if (key == "--first")
      law_run.first = std::stoi(value);
    else if (key == "--seed")
      law_run.seed = std::stoi(value);
    else if (key == "--patience")
      law_run.patience = std::stoi(value);
    else if (key == "--state")
      law_run.state = value;
    else if (key == "--keep")
      law_run.keep = value;
    else
      return usage();
  }
  std::cout << "seed " << law_run.seed << ", " << law_run.designs << " designs from " << law_run.first << " on, "
            << law_run.patience << " s of CPU a question" << std::endl;
  const auto judgements = run(law_run);
  std::cout << table_of(judgements);
  for (const Judgement& judgement : judgements)
    if (judgement.outcome == Outcome::contradicted) return 1;
  return 0;
}
