// Points near a traced curve moved onto it, in doubles: by the closed form where there is one, else on the mode's
// sheet, where high degrees lose no digits and branches of other modes do not cross; by the implicit polynomial where
// that finds nothing or there is no sheet, and the degree is low.
#pragma once

#include <map>
#include <memory>

#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"

namespace clearloci::loci {

struct CurvePoint {
  core::Point2 at{};
  core::Point2 tangent{};  ///< unit, of either orientation; zero where it is not known
};

class CurveProjection {
 public:
  /// `factor`: whose zeros the curve is; may be null, as for the workspace boundary.
  CurveProjection(const core::LocusProblem& problem, const core::LocusCurve& curve, const core::LocusFactor* factor);
  ~CurveProjection();
  CurveProjection(CurveProjection&&) noexcept;
  CurveProjection& operator=(CurveProjection&&) noexcept;

  /// The point itself, without a tangent, where no curve is found near it.
  CurvePoint operator()(const core::Point2& near) const;

 private:
  struct OnSheet;
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Those of a map's curves, made when they are asked for.
class CurveProjections {
 public:
  /// Both outlive this.
  CurveProjections(const core::LocusProblem& problem, const core::LocusMap& map) : problem_(&problem), map_(&map) {}

  const CurveProjection& of(int curve);

 private:
  const core::LocusProblem* problem_;
  const core::LocusMap* map_;
  std::map<int, CurveProjection> known_;
};

/// The factor of the problem whose zeros a curve is: the one that owns its polynomial and plays its part; null for the
/// workspace boundary.
const core::LocusFactor* factor_of(const core::LocusProblem& problem, const core::LocusCurve& curve);

}  // namespace clearloci::loci
