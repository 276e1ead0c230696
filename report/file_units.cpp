#include "report/file_units.hpp"

#include <algorithm>
#include <cmath>

#include "core/rational.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using core::Rational;

/// Of the file's unit in one metre, exactly: 1000 for mm.
Rational lengths_per_metre(const core::Units& units) {
  return core::simplest_rational_near(Rational(1 / units.length.size), Rational(1, 1000000));
}

/// Scales what is measured along the map's coordinates.
class Scaling {
 public:
  Scaling(const core::Units& units, const std::vector<bool>& angles)
      : exact_(lengths_per_metre(units)), k_(core::to_double(exact_)), angles_(angles) {}

  bool angle(std::size_t c) const { return c < angles_.size() && angles_[c]; }
  bool lengths_only() const {
    return std::none_of(angles_.begin(), angles_.end(), [](bool angle) { return angle; });
  }
  double factor(std::size_t c) const { return angle(c) ? 1 : k_; }
  double k() const { return k_; }
  const Rational& exact() const { return exact_; }

  template <class Place>
  void place(Place& at) const {
    for (std::size_t c = 0; c < at.size(); ++c) at[c] *= factor(c);
  }
  void line(core::Polyline& points) const {
    for (core::Point2& at : points) place(at);
  }
  double length(double value) const { return lengths_only() ? value * k_ : value; }
  double area(double value) const { return lengths_only() ? value * k_ * k_ : value; }

  void form(core::ClosedForm& form) const {
    if (!lengths_only()) return;
    if (auto* line = std::get_if<core::LineForm>(&form)) line->c *= exact_;
    if (auto* circle = std::get_if<core::CircleForm>(&form)) {
      for (Rational& c : circle->centre) c *= exact_;
      circle->radius_squared *= exact_ * exact_;
      if (circle->radius) *circle->radius *= exact_;
    }
    if (auto* pair = std::get_if<core::CirclePairForm>(&form)) {
      for (core::QuadraticNumber& c : pair->centre) scale(c, exact_);
      scale(pair->radius_squared, exact_ * exact_);
    }
    if (auto* conic = std::get_if<core::ConicForm>(&form)) {
      if (conic->centre) place(*conic->centre);
      if (conic->semi_axes)
        for (double& axis : *conic->semi_axes) axis *= k_;
      conic->coefficients[3] *= exact_;
      conic->coefficients[4] *= exact_;
      conic->coefficients[5] *= exact_ * exact_;
    }
  }

 private:
  static void scale(core::QuadraticNumber& value, const Rational& by) {
    value.rational *= by;
    value.multiple *= by;
  }

  Rational exact_;
  double k_;
  const std::vector<bool>& angles_;
};

}  // namespace

core::LocusMap in_file_units(core::LocusMap map) {
  const std::vector<bool> angles = map.angles;
  map.notes = core::in_file_units(std::move(map.notes), map.units, angles);
  if (!map.units.declared) return map;
  const Scaling scaling(map.units, angles);
  for (std::size_t c = 0; c < map.lower.size(); ++c) {
    if (scaling.angle(c)) continue;
    map.lower[c] *= scaling.exact();
    map.upper[c] *= scaling.exact();
  }
  map.tolerance *= scaling.k();
  for (core::LocusCurve& curve : map.curves) {
    scaling.form(curve.closed_form);
    for (core::Arc& arc : curve.arcs) {
      arc.length = scaling.length(arc.length);
      scaling.line(arc.points);
    }
  }
  for (core::LocusSurface& surface : map.surfaces) {
    surface.area = scaling.area(surface.area);
    surface.deviation = scaling.length(surface.deviation);
    scaling.place(surface.resolution);
    for (core::Point3& at : surface.vertices) scaling.place(at);
  }
  for (core::SpaceCurve& curve : map.space_curves)
    for (core::SpaceArc& arc : curve.arcs) {
      arc.length = scaling.length(arc.length);
      for (core::Point3& at : arc.points) scaling.place(at);
    }
  for (core::IsolatedPoint& point : map.isolated_points) scaling.place(point.at);
  for (core::OpenRegion& region : map.open) {
    scaling.place(region.lower);
    scaling.place(region.upper);
  }
  for (core::WorkspaceRegion& region : map.workspace)
    for (core::Polyline& ring : region.rings) scaling.line(ring);
  for (core::ReachableInterval& interval : map.reachable) {
    interval.from *= scaling.factor(0);
    interval.to *= scaling.factor(0);
  }
  return map;
}

core::Zones in_file_units(core::Zones map) {
  if (!map.loci.units.declared) return map;
  const std::vector<bool> angles = map.loci.angles;
  const Scaling scaling(map.loci.units, angles);
  map.loci = in_file_units(std::move(map.loci));
  for (core::Zone& zone : map.zones) {
    for (double* const size : {&zone.size, &zone.at_least, &zone.at_most}) *size = scaling.area(*size);
    scaling.line(zone.outer);
    for (core::Polyline& hole : zone.holes) scaling.line(hole);
    scaling.place(zone.ball.centre);
    zone.ball.radius = scaling.length(zone.ball.radius);
    for (std::vector<double>* const at : {&zone.lower, &zone.upper, &zone.sample}) scaling.place(*at);
    for (core::ZoneBorder& border : zone.borders) border.length = scaling.length(border.length);
  }
  for (core::PreloadRegion& region : map.preload_regions) region.size = scaling.area(region.size);
  for (core::ZonedMode& mode : map.modes)
    for (double* const size : {&mode.workspace, &mode.outside, &mode.in_doubt}) *size = scaling.area(*size);
  return map;
}

core::Sketch in_file_units(core::Sketch sketch, const core::Units& units) {
  if (!units.declared) return sketch;
  const std::vector<bool> none;
  const Scaling scaling(units, none);
  for (core::SketchLink& link : sketch.links)
    for (core::Point2& at : link.points) scaling.place(at);
  for (core::SketchSlide& slide : sketch.slides) {
    scaling.place(slide.from);
    scaling.place(slide.to);
  }
  for (core::SketchJoint& joint : sketch.joints) scaling.place(joint.at);
  for (core::SketchSpring& spring : sketch.springs) {
    scaling.place(spring.from);
    scaling.place(spring.to);
  }
  for (core::SketchLoad& load : sketch.loads) scaling.place(load.at);
  if (sketch.end_effector) scaling.place(sketch.end_effector->at);
  return sketch;
}

ShownUnit unit_of_size(const std::string& si, double most) {
  // From a tenth of the larger unit on, which reads better: 0.2 mm, and 50 µm.
  if (most >= 0.1 || !(most > 0)) return {si, 1};
  if (most >= 1e-4) return {"m" + si, 1e3};
  return most >= 1e-7 ? ShownUnit{"µ" + si, 1e6} : ShownUnit{"n" + si, 1e9};
}

ShownUnit table_unit(const std::string& si, const core::Units& units, double most) {
  return si != "m" || units.declared ? core::told_unit(si, units) : unit_of_size(si, most);
}

std::string place_words(std::span<const double> at, const std::vector<bool>& angles, const core::Units& units,
                        int digits) {
  const ShownUnit length = table_unit("m", units), turn = table_unit("rad", units);
  const bool mixed = std::find(angles.begin(), angles.end(), true) != angles.end();
  double most = 0;
  for (const double value : at) most = std::max(most, std::abs(value));
  std::string words;
  for (std::size_t c = 0; c < at.size(); ++c) {
    const ShownUnit& unit = c < angles.size() && angles[c] ? turn : length;
    words += (c == 0 ? "" : ", ") + engineering_beside(at[c] * unit.per_si, most * unit.per_si, digits);
    if (mixed) words += " " + unit.name;
  }
  return "(" + words + ")" + (mixed ? "" : " " + length.name);
}

core::FieldMap in_file_units(core::FieldMap map, const core::Units& units) {
  if (!units.declared) return map;
  const Scaling scaling(units, map.angles);
  scaling.place(map.lower);
  scaling.place(map.upper);
  for (std::size_t c = 0; c < map.dimension(); ++c)
    for (double& value : map.axes[c]) value *= scaling.factor(c);
  for (core::Field& field : map.fields) {
    const ShownUnit shown = shown_unit(field.unit, units);
    field.unit = shown.name;
    for (double& value : field.values) value *= shown.per_si;
  }
  return map;
}

core::Table in_file_units(core::Table table, const core::Units& units) {
  if (!units.declared) return table;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const ShownUnit shown = shown_unit(table.units[c], units);
    table.units[c] = shown.name;
    for (double& value : table.columns[c]) value *= shown.per_si;
  }
  return table;
}

core::TrajectoryResult in_file_units(core::TrajectoryResult result) {
  if (!result.units.declared) return result;
  const ShownUnit length = shown_unit("m", result.units), force = shown_unit("N", result.units);
  const double per_distance = result.distance_unit == "m" ? length.per_si : 1;
  if (result.distance_unit == "m") result.distance_unit = length.name;
  const auto scale = [](std::vector<double>& values, double factor) {
    for (double& value : values) value *= factor;
  };
  result.length *= per_distance;
  result.min_force *= force.per_si;
  for (core::TrajectoryStage& stage : result.stages) {
    stage.starts_at *= per_distance;
    stage.stops_at *= per_distance;
    if (stage.lost_last) stage.lost_last->distance *= per_distance;
  }
  for (core::ContactLoss& loss : result.losses) {
    loss.distance *= per_distance;
    loss.force *= force.per_si;
    loss.displacement *= length.per_si;
  }
  core::Table& samples = result.samples;
  for (std::size_t c = 0; c < samples.columns.size(); ++c) {
    if (samples.units[c].rfind("rad", 0) == 0) continue;
    const ShownUnit shown = shown_unit(samples.units[c], result.units);
    samples.units[c] = shown.name;
    scale(samples.columns[c], shown.per_si);
  }
  if (result.sweep) {
    scale(result.sweep->distance, per_distance);
    for (std::vector<double>* const values : {&result.sweep->dx, &result.sweep->dy, &result.sweep->dz})
      scale(*values, length.per_si);
  }
  for (core::LossCurve& curve : result.loss_curves)
    for (core::Polyline& line : curve.lines)
      for (core::Point2& point : line) point[0] *= per_distance;
  return result;
}

std::string column_head(const std::string& name, const std::string& si, const core::Units& units) {
  return units.declared ? name + " (" + shown_unit(si, units).name + ")" : name;
}

}  // namespace clearloci::report
