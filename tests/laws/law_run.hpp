// Runs designs through the steps of the law, each step in a process of its own with bounds of time and memory, so that
// a crash is an outcome like others. What is done is kept in a state file, a line a design, from which a run goes on.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/laws/design_forms.hpp"

namespace clearloci::test {

/// In the order of their gravity: a design has the gravest of its steps.
enum class Outcome { refused, held, uncertified, late, contradicted };

std::string to_string(Outcome outcome);

struct Judgement {
  Family family = Family::five_bar;
  int index = 0;
  bool lattice = false;
  FormSet forms;
  Outcome outcome = Outcome::held;
  double seconds = 0;               ///< of CPU, in all
  std::vector<std::string> faults;  ///< with their step
  std::vector<std::string> doubts;  ///< what is not certified or late, with its step
  std::map<std::string, long> held;
};

/// `patience`: s of CPU for each question to the program.
Judgement judge(const LawDesign& design, int patience);

struct LawRun {
  int seed = 20261123;
  int first = 0, designs = 0;  ///< a family's first index; over all families
  std::vector<Family> families = {all_families.begin(), all_families.end()};  ///< those that are drawn
  int patience = 20;
  std::string state;  ///< file; empty: none
  std::string keep;   ///< folder of designs that are contradicted, late or not certified; empty: none
};

/// Family after family, index after index. Designs in the state file are not judged again.
std::vector<Judgement> run(const LawRun& run);

/// By family and by form: designs, held, refused, not certified, late, contradicted, and all that was held.
std::string table_of(const std::vector<Judgement>& judgements);

}  // namespace clearloci::test
