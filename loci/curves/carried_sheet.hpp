// One problem of a new design in one working mode, for the loci of the last design (carried_loci.hpp): which of its
// factors a locus belongs to, and Newton's method for places where factors vanish.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {

/// What a locus is known by in another design.
struct LocusName {
  core::LocusKind kind;
  const std::vector<core::Vanishing>& vanishing;
  const std::string& factor;
};

class CarriedSheet {
 public:
  using Place = std::vector<double>;  ///< one value a coordinate, angles in rad
  using Held = sheet::SheetNewton::Held;

  /// The problem outlives this.
  CarriedSheet(const core::LocusProblem& problem, core::WorkingMode mode);

  const core::LocusProblem& problem() const { return *problem_; }

  /// In the chart; nothing where the place is far from the chart's half turns.
  std::optional<Place> inside(Place place) const;
  Place outside(Place place) const;

  /// The factor of which the places are nearest to zeros, in the median, among those that may be the locus's; those
  /// that are written as its own was come first. -1: there is none. Places are those outside.
  int factor_of(const LocusName& name, const std::vector<Place>& places);

  /// Where the factors vanish together near a place of the chart; nothing where it is not in the box and on the sheet.
  std::optional<Place> moved(Place place, const std::vector<int>& factors, std::span<const Held> held = {});

  /// The place nearest to one of the chart where a squared distance that the construction divides by is least, which is
  /// where it vanishes, of those that hold no roots; nothing where none is near. Factors have no gradient there.
  std::optional<Place> pole_near(const Place& place);

  /// What a place of the chart is held to at the rim of the sheet or the side of the box that is nearest to it.
  std::optional<Held> rim_near(const Place& place, int factor);
  Held side_near(const Place& place) const;

 private:
  const core::AngleChart* chart_of(std::size_t v) const;
  sheet::SheetNewton& newton_for(const std::vector<int>& factors);
  std::vector<int> candidates(const LocusName& name) const;

  const core::LocusProblem* problem_;
  core::WorkingMode mode_;
  std::vector<double> lower_, upper_, sizes_;
  std::map<std::vector<int>, std::unique_ptr<sheet::SheetNewton>> newtons_;  ///< by factors
  std::vector<std::unique_ptr<sheet::SheetNewton>> poles_;                   ///< by denominator
  bool poles_known_ = false;
};

}  // namespace clearloci::loci
