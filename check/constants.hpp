// What of a model's expressions is the same all over a task, so that cells need not evaluate it again.
// Private to check/.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/expression.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci::check {

/// Tells which expressions depend on any of some names, coordinates and parameters, or on parameters made of these.
class Varying {
 public:
  Varying(const mechanism::Mechanism& m, std::vector<std::string> names);
  bool operator()(const core::Expression& e) const;

 private:
  std::set<std::string> names_;
};

/// Puts numbers for the largest parts that do not vary of what points and the equations of groups are made of. Those
/// are what mechanism::value_of says.
void fold_constants(mechanism::Mechanism& m, const Varying& varies);

}  // namespace clearloci::check
