// A mechanism whose parameters are left open: each varied parameter, and every expression of varied parameters that is
// no polynomial in them (1/k, cos(alpha)), becomes a free coordinate after the file's own. Equations written for it
// hold for every design at once; docs/background/method.md section 12.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

/// What the equations of an open design are written in.
struct DesignVariable {
  std::string name;
  Expression meaning;  ///< in varied parameters and numbers alone
};

struct OpenDesign {
  Mechanism mechanism;                    ///< coordinates: the file's, then the variables
  std::vector<std::string> varied;        ///< parameters
  std::vector<DesignVariable> variables;  ///< the varied parameters that occur, then expressions in them
  /// Of every joint with a clearance in the file's order: what it is in the varied parameters.
  std::vector<Clearance> clearances;
  std::vector<Expression> lengths;  ///< likewise, of links that vary: no design where one is not above zero

  std::size_t coordinates() const { return mechanism.coordinates.size() - variables.size(); }
};

struct ParameterRange {
  std::string name;
  Rational lower, upper;
};

/// Null: there is none of this name.
const Parameter* parameter_named(const Mechanism& mechanism, const std::string& name);

/// An expression of parameters with the values of those that are not varied put in.
Expression in_varied(const Expression& expression, const Mechanism& mechanism, const std::vector<std::string>& varied);

/// Throws core::InputError where a range is of no parameter, or what a variable changes is not among what designs may
/// differ in: the half length of a guide, the rest of a torsion spring.
OpenDesign open_design(const Mechanism& mechanism, const std::vector<ParameterRange>& ranges);

}  // namespace clearloci::mechanism
