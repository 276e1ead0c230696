// Which factors of the reactions are to be traced. Private to symbolic/.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/derivation.hpp"
#include "symbolic/shared_curves.hpp"

namespace clearloci::symbolic {

class FactorSelection {
 public:
  explicit FactorSelection(Derivation& d) : d_(d) {}

  /// What is asked for. Required: collect_factors.
  void by_demand();
  /// What a reaction does on a curve of |A| = 0 is told by the orders of its factors there (method.md section 10):
  /// those that may vanish on such a curve are wanted, of the reactions asked for; and of all of them where it may be
  /// that none grows without bound.
  void by_order();

 private:
  std::vector<std::size_t> factors_of(const std::string& joint, core::Quantity quantity) const;
  void want(const std::vector<std::size_t>& list);
  /// f_J = 0 is two equations, or three in space: its curves lie where factors of all of them share a curve.
  void mark_contact_loss(const std::string& joint);
  /// One factor of every component, of which none is of all: they may vanish together at isolated points, over three
  /// coordinates along curves, too. `chosen`: of those before `next`.
  void mark_points(const std::vector<std::vector<std::size_t>>& components, std::size_t next,
                   const std::vector<std::size_t>& chosen);
  /// Components of a vector of constant length, such as a link's, do not vanish together.
  bool never_both(std::size_t i, std::size_t k);
  bool may_share_curve(std::size_t i, std::size_t k);
  /// With one coordinate a curve is a point: what shares none is never zero together.
  bool meet_nowhere(std::size_t i, std::size_t k);
  bool is_heavy(std::size_t factor);
  const ResiduePoly& on_line(std::size_t factor);

  Derivation& d_;
  SharedCurves shared_{d_.geometry};
  std::map<std::pair<std::size_t, std::size_t>, bool> never_both_, may_share_;  ///< by factors
  std::map<std::size_t, ResiduePoly> on_line_;                                  ///< by factor
  std::map<std::size_t, bool> heavy_;
};

}  // namespace clearloci::symbolic
