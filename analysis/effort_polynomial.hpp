// A polynomial in the coordinates that keeps between given values at given poses: the law of an effort. Each coordinate
// enters as x - x0, an angle as sin(a - a0), from the middle of the task. Private to analysis/.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/task.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci {

class EffortPolynomial {
 public:
  /// Of a degree, over a box of poses; no effort before it is fitted. `force`: N, else N m.
  EffortPolynomial(const mechanism::Mechanism& mechanism, const std::array<core::RationalPose, 2>& box, int degree,
                   bool force);

  std::size_t terms() const { return powers_.size(); }

  /// As near the middle of what it has to be between at each pose as it can be, relative to half the width (Lawson's
  /// algorithm), with coefficients of few digits. False where it is not between them at some pose.
  bool fit(const std::vector<std::vector<double>>& poses, const std::vector<std::array<double, 2>>& between);

  double at(const std::vector<double>& pose) const;
  /// What it takes over the box, enclosed.
  std::array<double, 2> range() const;
  /// "-6.1 N m + 25 N*(x - 0.05 m)".
  std::string told() const;

 private:
  struct Variable {
    std::string name;
    bool angle = false;
    std::string middle;  ///< decimal; degrees of an angle
    double from = 0;     ///< the same, m or rad
    double lower = 0, upper = 0;
  };

  std::vector<double> monomials(const std::vector<double>& pose) const;
  std::string variable_words(const Variable& variable) const;
  std::string unit_words(const std::vector<int>& powers) const;

  bool force_;
  std::vector<Variable> variables_;
  std::vector<std::size_t> places_;       ///< of each variable, among the coordinates
  std::vector<std::vector<int>> powers_;  ///< of each term, a power a variable; the constant first
  std::vector<std::string> coefficients_;
  std::vector<double> values_;  ///< of them
};

}  // namespace clearloci
