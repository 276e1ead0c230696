#include "analysis/framed.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <regex>
#include <string>

namespace clearloci {
namespace {

using core::Point2;
using core::Rational;
using mechanism::Frame;

/// A free coordinate back in the units of the file: one rounding of the exact value.
double outside(double value, std::size_t coordinate, const std::vector<bool>& angles, const Frame& frame) {
  if (coordinate < angles.size() && angles[coordinate]) return value;
  return core::to_double(frame.from[coordinate] + frame.scale * Rational(value));
}

class Outward {
 public:
  Outward(const mechanism::Mechanism& mechanism, const Frame& frame) : frame_(frame) {
    for (const mechanism::Coordinate& coordinate : mechanism.coordinates) angles_.push_back(coordinate.angle);
    lengths_ = std::none_of(angles_.begin(), angles_.end(), [](bool angle) { return angle; });
  }

  double value(double at, std::size_t coordinate) const { return outside(at, coordinate, angles_, frame_); }
  Point2 place(const Point2& at) const { return {value(at[0], 0), value(at[1], 1)}; }
  void move(core::Polyline& points) const {
    for (Point2& at : points) at = place(at);
  }
  double size(double length) const { return frame_.scale_value() * length; }
  bool lengths() const { return lengths_; }

  core::Polynomial polynomial(const core::Polynomial& p) const {
    core::Polynomial result = p;
    for (std::size_t v = 0; v < angles_.size(); ++v)
      if (!angles_[v]) result = substituted(result, static_cast<int>(v), frame_.from[v]);
    return core::primitive_part(result);
  }

  void move(core::LocusCurve& curve) const {
    if (!curve.implicit.is_zero()) curve.implicit = polynomial(curve.implicit);
    if (!std::holds_alternative<std::monostate>(curve.closed_form))
      curve.closed_form = core::recognise_closed_form(curve.implicit);
    for (core::Arc& arc : curve.arcs) {
      move(arc.points);
      arc.length = lengths_ ? size(arc.length) : length_of(arc.points);
    }
  }

  void move(core::LocusSurface& surface) const {
    if (!surface.implicit.is_zero()) surface.implicit = polynomial(surface.implicit);
    for (core::Point3& at : surface.vertices)
      for (std::size_t i = 0; i < 3; ++i) at[i] = value(at[i], i);
    for (std::size_t i = 0; i < 3; ++i)
      if (!angles_[i]) surface.resolution[i] = size(surface.resolution[i]);
    if (lengths_) surface.deviation = size(surface.deviation);
    surface.area = area_of(surface);
  }

  void move(core::SpaceCurve& curve) const {
    for (core::SpaceArc& arc : curve.arcs) {
      for (core::Point3& at : arc.points)
        for (std::size_t i = 0; i < 3; ++i) at[i] = value(at[i], i);
      arc.length = 0;
      for (std::size_t k = 1; k < arc.points.size(); ++k) {
        const core::Point3 &a = arc.points[k - 1], &b = arc.points[k];
        arc.length += std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
      }
    }
  }

  /// Places in notes are written as "(x, y)".
  std::string note(const std::string& text) const {
    static const std::regex place(R"(\((-?[0-9.]+(?:e[-+]?[0-9]+)?)((?:, -?[0-9.]+(?:e[-+]?[0-9]+)?)+)\))");
    std::string result, rest = text;
    for (std::smatch found; std::regex_search(rest, found, place); rest = found.suffix()) {
      std::vector<double> values = {std::stod(found[1])};
      const std::string others = found[2];
      for (std::size_t at = 0; (at = others.find(", ", at)) != std::string::npos; at += 2)
        values.push_back(std::stod(others.substr(at + 2)));
      std::string moved;
      for (std::size_t i = 0; i < values.size() && i < angles_.size(); ++i) {
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.9g", value(values[i], i));
        moved += (i == 0 ? "" : ", ") + std::string(digits);
      }
      result += found.prefix().str() + (values.size() == angles_.size() ? "(" + moved + ")" : found[0].str());
    }
    return result + rest;
  }

 private:
  /// p with (v - from) / scale in the place of v.
  core::Polynomial substituted(const core::Polynomial& p, int v, const Rational& from) const {
    const int degree = core::degree_in(p, v);
    const core::Polynomial way =
        core::constant_polynomial(p.variables, 1 / frame_.scale) *
        (core::variable_polynomial(p.variables, v) - core::constant_polynomial(p.variables, from));
    core::Polynomial sum = core::constant_polynomial(p.variables, 0);
    for (int power = degree; power >= 0; --power) {
      core::Polynomial coefficient{p.variables, {}};
      for (core::Term term : p.terms) {
        if (term.exponents[static_cast<std::size_t>(v)] != power) continue;
        term.exponents[static_cast<std::size_t>(v)] = 0;
        coefficient.terms.push_back(std::move(term));
      }
      sum = sum * way + coefficient;
    }
    return sum;
  }

  static double length_of(const core::Polyline& points) {
    double sum = 0;
    for (std::size_t k = 1; k < points.size(); ++k)
      sum += std::hypot(points[k][0] - points[k - 1][0], points[k][1] - points[k - 1][1]);
    return sum;
  }

  static double area_of(const core::LocusSurface& surface) {
    double sum = 0;
    for (const auto& [i, j, k] : surface.triangles) {
      const core::Point3 &a = surface.vertices[static_cast<std::size_t>(i)],
                         &b = surface.vertices[static_cast<std::size_t>(j)],
                         &c = surface.vertices[static_cast<std::size_t>(k)];
      const std::array<double, 3> u = {b[0] - a[0], b[1] - a[1], b[2] - a[2]},
                                  v = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
      sum += std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
    }
    return sum;
  }

  const Frame& frame_;
  std::vector<bool> angles_;
  bool lengths_ = true;
};

}  // namespace

std::optional<Framed> framed(const mechanism::Mechanism& mechanism) {
  Frame frame = mechanism::frame_of(mechanism);
  if (frame.is_usual()) return std::nullopt;
  std::optional<mechanism::Mechanism> inside = mechanism::in_frame(mechanism, frame);
  if (!inside) return std::nullopt;
  return Framed{std::move(frame), std::move(*inside)};
}

LociRequest in_frame(LociRequest request, const Frame& frame) {
  request.tolerance /= frame.scale_value();
  if (request.min_couple) *request.min_couple /= frame.scale;
  return request;
}

core::Task in_frame(core::Task task, const Frame& frame) {
  const auto place = [&](core::RationalPoint& at) {
    for (std::size_t i = 0; i < 2; ++i) at[i] = (at[i] - frame.from[i]) / frame.scale;
  };
  if (auto* box = std::get_if<core::TaskBox>(&task.shape)) place(box->lower), place(box->upper);
  if (auto* circle = std::get_if<core::TaskCircle>(&task.shape)) place(circle->centre), circle->radius /= frame.scale;
  if (auto* polygon = std::get_if<core::TaskPolygon>(&task.shape))
    std::for_each(polygon->corners.begin(), polygon->corners.end(), place);
  if (auto* path = std::get_if<core::TaskPath>(&task.shape))
    std::for_each(path->points.begin(), path->points.end(), place);
  task.margin /= frame.scale;
  if (task.min_couple) *task.min_couple /= frame.scale;
  return task;
}

core::LocusMap from_frame(core::LocusMap map, const mechanism::Mechanism& mechanism, const Frame& frame) {
  const Outward outward(mechanism, frame);
  for (std::size_t i = 0; i < mechanism.coordinates.size() && i < map.lower.size(); ++i) {
    map.lower[i] = mechanism.coordinates[i].lower;
    map.upper[i] = mechanism.coordinates[i].upper;
  }
  map.tolerance *= frame.scale_value();
  for (std::string& note : map.notes) note = outward.note(note);
  for (core::LocusCurve& curve : map.curves) outward.move(curve);
  for (core::LocusSurface& surface : map.surfaces) outward.move(surface);
  for (core::SpaceCurve& curve : map.space_curves) outward.move(curve);
  for (core::IsolatedPoint& point : map.isolated_points)
    for (std::size_t i = 0; i < point.at.size(); ++i) point.at[i] = outward.value(point.at[i], i);
  for (core::OpenRegion& region : map.open)
    for (std::size_t i = 0; i < region.lower.size(); ++i) {
      region.lower[i] = outward.value(region.lower[i], i);
      region.upper[i] = outward.value(region.upper[i], i);
    }
  for (core::WorkspaceRegion& region : map.workspace)
    for (core::Polyline& ring : region.rings) outward.move(ring);
  for (core::ReachableInterval& interval : map.reachable) {
    interval.from = outward.value(interval.from, 0);
    interval.to = outward.value(interval.to, 0);
  }
  return map;
}

core::ZoneMap from_frame(core::ZoneMap map, const mechanism::Mechanism& mechanism, const Frame& frame) {
  const Outward outward(mechanism, frame);
  map.loci = from_frame(std::move(map.loci), mechanism, frame);
  for (core::ModeArea& area : map.areas) {
    area.workspace = outward.size(outward.size(area.workspace));
    area.in_doubt = outward.size(outward.size(area.in_doubt));
  }
  for (core::Zone& zone : map.zones) {
    zone.area = outward.size(outward.size(zone.area));
    outward.move(zone.outer);
    for (core::Polyline& hole : zone.holes) outward.move(hole);
    zone.inscribed = {outward.place(zone.inscribed.centre), outward.size(zone.inscribed.radius)};
    zone.sample = outward.place(zone.sample);
    for (core::ZoneBorder& border : zone.borders) border.length = outward.size(border.length);
  }
  return map;
}

Verification from_frame(Verification result, const core::Task& task, const mechanism::Mechanism& mechanism,
                        const Frame& frame) {
  const Outward outward(mechanism, frame);
  result.task = task;
  if (result.by) {
    for (Rational& way : *result.by) way *= frame.scale;
    result.task.shape = core::translated(task.shape, *result.by);
  }
  result.margin = outward.size(result.margin);
  if (result.nearest) {
    result.nearest->at = outward.place(result.nearest->at);
    result.nearest->distance = outward.size(result.nearest->distance);
  }
  if (result.witness) {
    result.witness->at = outward.place(result.witness->at);
    result.witness->distance = outward.size(result.witness->distance);
  }
  if (result.open) {
    result.open->lower = outward.place(result.open->lower);
    result.open->upper = outward.place(result.open->upper);
  }
  result.map = from_frame(std::move(result.map), mechanism, frame);
  for (std::string& note : result.notes) note = outward.note(note);
  return result;
}

numeric::ValidationReport from_frame(numeric::ValidationReport report, const mechanism::Mechanism& mechanism,
                                     const Frame& frame) {
  const Outward outward(mechanism, frame);
  const auto move = [&](std::vector<double>& at) {
    for (std::size_t i = 0; i < at.size(); ++i) at[i] = outward.value(at[i], i);
  };
  for (numeric::DisputedEdge& edge : report.disputed_edges) {
    move(edge.from);
    move(edge.to);
  }
  for (numeric::DisputedArc& arc : report.disputed_arcs) move(arc.at);
  return report;
}

}  // namespace clearloci
