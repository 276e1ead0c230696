// Points near a traced curve moved onto it, in doubles: by the closed form where there is one, else on the mode's
// sheet, where high degrees lose no digits and branches of other modes do not cross; by the implicit polynomial where
// that finds nothing or there is no sheet, and the degree is low.
#pragma once

#include <map>
#include <memory>
#include <optional>

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

  /// Where the curve that leaves the point `centre` of it first is so far from there, followed along its tangent on the
  /// mode's sheet: also where it touches the workspace boundary, beside which nothing near it can be moved onto it.
  /// `next`: another point of the branch. None where there is no sheet, more branches than one leave, or it is lost.
  std::optional<core::Point2> at_distance(const core::Point2& centre, const core::Point2& next, double radius) const;

  /// The point amid two neighbours on the curve, across their chord; none where it is not found.
  std::optional<core::Point2> between(const core::Point2& a, const core::Point2& b) const;

 private:
  struct OnSheet;
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Between the ends of a chord along it, and no farther across it than `reach`.
bool is_beside_chord(const core::Point2& at, const core::Point2& from, const core::Point2& to, double reach);

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

/// The factor of the problem whose zeros a curve is: the one that owns its polynomial and plays its part, of several
/// the one that it is named for, or that it is named for where no polynomial is computed; null for the workspace
/// boundary, and where several factors name it.
const core::LocusFactor* factor_of(const core::LocusProblem& problem, const core::LocusCurve& curve);

}  // namespace clearloci::loci
