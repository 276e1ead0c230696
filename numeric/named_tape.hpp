// A tape under construction that knows the names of a mechanism. Private to numeric/.
#pragma once

#include <map>
#include <string>

#include "mechanism/mechanism.hpp"
#include "numeric/tape.hpp"

namespace clearloci::numeric {

class NamedTape {
 public:
  /// Inputs: the free coordinates, then the signs of the working mode, then the unknowns of the groups.
  explicit NamedTape(const mechanism::Mechanism& mechanism);

  TapeBuilder& builder() { return builder_; }
  Register compile(const core::Expression& expression);
  /// The input that says on which side a dyad or slider point lies.
  Register sign_of(mechanism::PointIndex point) const { return sign_of_.at(point); }
  int first_unknown() const { return first_unknown_; }

 private:
  TapeBuilder builder_;
  std::map<std::string, Register> names_;
  std::map<mechanism::PointIndex, Register> sign_of_;
  int first_unknown_ = 0;
};

}  // namespace clearloci::numeric
