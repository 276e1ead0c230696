// A family of designs that differ in the values of parameters: |A| and the numerators are derived and factored once,
// with the parameters as symbols as long as that leaves them short, and take new values. What special values do (a
// factor that splits, vanishes or coincides with another) is seen since the few distinct factors are factored again
// after the values are put in. Private to symbolic/.
#pragma once

#include <optional>

#include "symbolic/determinants.hpp"

namespace clearloci::symbolic {

class Family {
 public:
  /// `member`: any design of the family, whose values do not matter.
  explicit Family(const mechanism::Mechanism& member);

  /// The determinants of the member that `geometry` describes, the same as factored_determinants gives; nothing where
  /// its equations are not these with values put in (an irrational length, another structure), or are too long with
  /// symbols: then they are to be derived from scratch.
  std::optional<FactoredDeterminants> at(const Geometry& geometry) const;

 private:
  Poly substituted(const Poly& p, const Geometry& geometry, const std::vector<std::optional<Poly>>& values) const;

  mechanism::Mechanism mechanism_;
  Geometry geometry_;
  std::vector<std::vector<Poly>> matrix_;  ///< with the right-hand side as last column
  std::optional<FactoredDeterminants> determinants_;
};

}  // namespace clearloci::symbolic
