// Surfaces that are drawn alike, and their colours.
// Private to report/.
#pragma once

#include <string>
#include <vector>

#include "report/groups.hpp"

namespace clearloci::report {

/// Surfaces of one kind on which the same reactions vanish for the same reason; all direct singularities; the whole
/// workspace boundary.
struct SurfaceGroup {
  core::LocusKind kind = core::LocusKind::contact_loss;
  std::vector<core::Vanishing> vanishing;
  std::string reason;
  std::string what;  ///< for the legend: what happens there
  std::string why;   ///< and the reason in words; may be empty
  Colour colour;
  double opacity = 1;
  bool on_boundary = false;  ///< a reaction's, but all of it is part of the workspace boundary
  std::vector<const core::LocusSurface*> surfaces;
};

/// Of the whole map, so that a locus looks the same in the pictures of all modes. Gravest kind first. The groups point
/// into `map`, which must outlive them.
std::vector<SurfaceGroup> group_surfaces(const core::LocusMap& map);

/// With the members of one mode alone; groups without any are left out.
std::vector<SurfaceGroup> groups_of_mode(const std::vector<SurfaceGroup>& groups, const core::WorkingMode& mode);

/// "s1, s2".
std::string ids_of(const SurfaceGroup& group);

/// Reasons that several groups have, each once: "s1, s2: the loads do no work in the motion that the joint alone
/// drives". Those groups lose their `why`.
std::vector<std::string> tell_shared_reasons(std::vector<SurfaceGroup>& groups);

/// Curves and points over three coordinates on which the same reactions vanish though on no surface.
struct LineGroup {
  core::LocusKind kind = core::LocusKind::contact_loss;
  std::vector<core::Vanishing> vanishing;
  std::string what;  ///< for the legend
  int number = 0;    ///< of its colour: behind those of the surfaces
  Colour colour;
  std::vector<const core::SpaceCurve*> curves;
  std::vector<const core::IsolatedPoint*> points;
};

/// Of the whole map, as group_surfaces, of which `surfaces` are the groups.
std::vector<LineGroup> group_lines(const core::LocusMap& map, const std::vector<SurfaceGroup>& surfaces);

}  // namespace clearloci::report
