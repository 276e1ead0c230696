// Loci that are drawn alike, and how.
// Private to report/.
#pragma once

#include <string>
#include <vector>

#include "core/locus_map.hpp"
#include "report/theme.hpp"

namespace clearloci::report {

/// Lengths in points.
struct Stroke {
  Colour colour;
  double width = 1;
  std::vector<double> dash;  ///< on, off, ...; empty: solid
  bool round = false;        ///< round caps: dashes of length 0 are dots
};

enum class MarkerShape { circle, square, diamond, triangle };

struct Marker {
  MarkerShape shape = MarkerShape::circle;
  Colour colour;
};

/// Colours of reaction loci, in turn.
Colour palette_colour(int number);

/// Curves of one kind on which the same reactions vanish for the same reason; all direct singularities; the whole
/// workspace boundary.
struct CurveGroup {
  core::LocusKind kind = core::LocusKind::contact_loss;
  bool excited = true;  ///< LocusCurve::excited
  std::vector<core::Vanishing> vanishing;
  std::string reason;           ///< the cause, or the factor where it has no reading
  std::string what;             ///< for the legend: what happens there
  std::string why;              ///< and the reason in words; may be empty
  std::string shared_why = {};  ///< a reason that other groups have too, told by Groups::remarks instead
  Stroke stroke;
  int number = 0;  ///< running number among the groups of reaction loci, which chooses the colour
  std::vector<const core::LocusCurve*> curves;
};

struct PointGroup {
  core::LocusKind kind = core::LocusKind::contact_loss;
  std::vector<core::Vanishing> vanishing;
  std::string label;
  Marker marker;
  std::vector<const core::IsolatedPoint*> points;
};

/// Groups of the whole map, so that a locus looks the same in the pictures of all modes. Gravest kind first.
struct Groups {
  std::vector<CurveGroup> curves;
  std::vector<PointGroup> points;
  std::vector<std::string> remarks = {};  ///< reasons that several groups share, with the ids of their curves
};

/// "the loads do no work in the motion that the joint alone drives", where a reason says so of one of these joints;
/// empty where it does not.
std::string reason_of_any_joint(const std::string& why, const std::vector<core::Vanishing>& vanishing);

/// "c1, c4": the ids of a group's curves; of many the first and the last.
std::string ids_of(const CurveGroup& group);

/// The groups point into `map`, which must outlive them.
Groups group_loci(const core::LocusMap& map);

/// The groups with the members of one mode alone; groups without any are left out.
Groups groups_of_mode(const Groups& groups, const core::WorkingMode& mode);

}  // namespace clearloci::report
