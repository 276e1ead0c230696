#include "analysis/carried.hpp"

#include <utility>

#include "analysis/model.hpp"
#include "analysis/request_limits.hpp"
#include "loci/curves/curves.hpp"
#include "mechanism/written_unit.hpp"

namespace clearloci {
namespace {

/// Places of a map in a frame, to doubles: they are where Newton's method begins.
class Inward {
 public:
  Inward(const mechanism::Mechanism& mechanism, const mechanism::Frame& frame) {
    for (std::size_t v = 0; v < mechanism.coordinates.size(); ++v) {
      const bool angle = mechanism.coordinates[v].angle;
      from_.push_back(angle ? 0 : core::to_double(frame.from[v]));
      scale_.push_back(angle ? 1 : frame.scale_value());
    }
  }

  template <class Place>
  void move(Place& place) const {
    for (std::size_t v = 0; v < from_.size(); ++v) place[v] = (place[v] - from_[v]) / scale_[v];
  }

  void move(core::LocusMap& map) const {
    for (core::LocusCurve& curve : map.curves)
      for (core::Arc& arc : curve.arcs)
        for (core::Point2& at : arc.points) move(at);
    for (core::LocusSurface& surface : map.surfaces)
      for (core::Point3& at : surface.vertices) move(at);
    for (core::IsolatedPoint& point : map.isolated_points) move(point.at);
    for (core::WorkspaceRegion& region : map.workspace)
      for (core::Polyline& ring : region.rings)
        for (core::Point2& at : ring) move(at);
  }

 private:
  std::vector<double> from_, scale_;
};

core::LocusMap carried_inside(const core::LocusMap& last, const mechanism::Mechanism& mechanism,
                              const std::vector<symbolic::DerivedProblem>& derived) {
  std::vector<const core::LocusProblem*> problems;
  for (const symbolic::DerivedProblem& one : derived) problems.push_back(&one.problem);
  core::LocusMap map = loci::carried_loci(problems, last);
  map.mechanism = mechanism.name;
  map.units = mechanism.units;
  map.parameters = mechanism::told_parameters(mechanism);
  name_coordinates(mechanism, map);
  map.notes = {"carried over from another design: nothing of it is proven"};
  return map;
}

}  // namespace

core::LocusMap carried_loci(const core::LocusMap& last, const mechanism::Mechanism& mechanism,
                            const std::optional<Framed>& framed, const std::vector<symbolic::DerivedProblem>& derived) {
  if (last.tower.coordinates.size() != mechanism.coordinates.size())
    return unfinished_map(mechanism, "loci over another number of coordinates are not carried over");
  if (!framed) return carried_inside(last, mechanism, derived);
  core::LocusMap inside = last;
  Inward(mechanism, framed->frame).move(inside);
  name_coordinates(framed->mechanism, inside);
  return from_frame(carried_inside(inside, framed->mechanism, derived), mechanism, framed->frame);
}

LocusMap carry_loci(const LocusMap& last, const Model& model, const LociRequest& request) {
  const Model::Content& content = model.content();
  const mechanism::Mechanism& mechanism = content.mechanism;
  check_request(mechanism, request);
  require_coordinates(mechanism, 1, 3, "loci are traced");
  if (!mechanism.groups.empty()) return unfinished_map(mechanism, "loci over such a closure are not carried over");
  const symbolic::LocusFamily* const family = content.member ? &content.shared->family() : nullptr;
  const std::optional<Framed> scaled = framed(mechanism);
  const auto derived = scaled ? derived_problems(scaled->mechanism, in_frame(request, scaled->frame), family)
                              : derived_problems(mechanism, request, family);
  return carried_loci(last, mechanism, scaled, derived);
}

}  // namespace clearloci
