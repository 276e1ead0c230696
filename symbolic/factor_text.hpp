// How natural polynomials are written for the user: in the coordinates of the file. Private to symbolic/.
#pragma once

#include <map>
#include <string>

#include "symbolic/geometry.hpp"

namespace clearloci::symbolic {

/// A mechanism in a frame of its own is derived in the coordinates of the frame.
class FactorText {
 public:
  FactorText(const mechanism::Mechanism& mechanism, const Geometry& geometry)
      : mechanism_(mechanism), geometry_(geometry) {}

  /// In the coordinates of the frame, noted with those of the file.
  std::string of(const Poly& p) const;
  std::string in_file(const Poly& p) const;  ///< of a mechanism in a frame
  void note(const std::string& in_frame, std::string in_file) const;
  /// DerivedProblem::in_file
  std::map<std::string, std::string> take() { return std::move(noted_); }

 private:
  const mechanism::Mechanism& mechanism_;
  const Geometry& geometry_;
  mutable std::map<std::string, std::string> noted_;
};

}  // namespace clearloci::symbolic
