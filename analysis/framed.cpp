#include "analysis/framed.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <regex>
#include <string>
#include <utility>

#include "core/dense_terms.hpp"

namespace clearloci {
namespace {

using core::Point2;
using core::Rational;
using mechanism::Frame;

/// A free coordinate back in the units of the file: one rounding of the exact value.
double outside(double value, std::size_t coordinate, const std::vector<bool>& angles, const Frame& frame) {
  if ((coordinate < angles.size() && angles[coordinate]) || !std::isfinite(value)) return value;
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
  void move(std::vector<double>& pose) const {
    for (std::size_t i = 0; i < pose.size(); ++i) pose[i] = value(pose[i], i);
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
    for (core::LocusSurface::Open& open : surface.open)
      for (core::Point3* const at : {&open.lower, &open.upper})
        for (std::size_t i = 0; i < 3; ++i) (*at)[i] = value((*at)[i], i);
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

  /// Places in notes are written as "(x, y)", boxes as "[x0, x1] x [y0, y1]".
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
        moved += (i == 0 ? "" : ", ") + words(values[i], i);
      }
      result += found.prefix().str() + (values.size() == angles_.size() ? "(" + moved + ")" : found[0].str());
    }
    return with_boxes_moved(result + rest);
  }

 private:
  std::string words(double at, std::size_t coordinate) const {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.9g", value(at, coordinate));
    return digits;
  }

  std::string with_boxes_moved(const std::string& text) const {
    static const std::regex range(R"(\[(-?[0-9.]+(?:e[-+]?[0-9]+)?), (-?[0-9.]+(?:e[-+]?[0-9]+)?)\])");
    std::string result, rest = text;
    std::size_t c = 0;
    for (std::smatch found; std::regex_search(rest, found, range); rest = found.suffix()) {
      c = found.prefix() == " x " ? c + 1 : 0;
      const bool of_box = c > 0 || found.suffix().str().starts_with(" x [");
      result += found.prefix().str();
      result += of_box && c < angles_.size()
                    ? "[" + words(std::stod(found[1]), c) + ", " + words(std::stod(found[2]), c) + "]"
                    : found[0].str();
    }
    return result + rest;
  }

  /// p with (v - from) / scale in the place of v, up to a factor: in whole numbers, for fractions would be reduced at
  /// every step.
  core::Polynomial substituted(const core::Polynomial& p, int v, const Rational& from) const {
    using core::Integer;
    const auto at = static_cast<std::size_t>(v), degree = static_cast<std::size_t>(core::degree_in(p, v));
    // (b v - a) n / d to the power of k, times d to the degree.
    const Integer &a = from.get_num(), &b = from.get_den(), &n = frame_.scale.get_den();
    const Integer d = b * frame_.scale.get_num();
    const core::WholeTerms whole = core::whole_terms(p);
    std::map<std::vector<int>, std::vector<Integer>> rows;  // by the exponents of the other variables
    for (std::size_t i = 0; i < p.terms.size(); ++i) {
      std::vector<int> others = p.terms[i].exponents;
      const auto power = static_cast<std::size_t>(std::exchange(others[at], 0));
      rows.try_emplace(std::move(others), degree + 1).first->second[power] = whole.coefficients[i];
    }
    std::map<std::vector<int>, Integer, std::greater<>> terms;
    for (auto& [others, row] : rows) {
      multiply_by_powers(row.begin(), row.end(), n);
      multiply_by_powers(row.rbegin(), row.rend(), d);
      for (std::size_t i = 0; i < degree; ++i)
        for (std::size_t k = degree; k-- > i;) mpz_submul(row[k].get_mpz_t(), a.get_mpz_t(), row[k + 1].get_mpz_t());
      multiply_by_powers(row.begin(), row.end(), b);
      for (std::size_t power = 0; power <= degree; ++power) {
        if (row[power] == 0) continue;
        std::vector<int> exponents = others;
        exponents[at] = static_cast<int>(power);
        terms.emplace(std::move(exponents), std::move(row[power]));
      }
    }
    core::Polynomial result{p.variables, {}};
    for (auto& [exponents, coefficient] : terms) result.terms.push_back({exponents, Rational(coefficient)});
    return core::primitive_part(result);
  }

  /// The first by 1, the next by the factor, the next by its square.
  template <class Iterator>
  static void multiply_by_powers(Iterator from, Iterator to, const core::Integer& factor) {
    if (factor == 1) return;
    core::Integer power = 1;
    for (; from != to; ++from, power *= factor) *from *= power;
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

std::optional<Framed> framed(const mechanism::Mechanism& mechanism, Scaling scaling, mechanism::Parameters parameters) {
  if (mechanism.frame) return std::nullopt;
  Frame frame = mechanism::frame_of(mechanism);
  if (scaling == Scaling::none) frame.scale = 1;
  if (frame.is_usual()) return std::nullopt;
  std::optional<mechanism::Mechanism> inside = mechanism::in_frame(mechanism, frame, parameters);
  if (!inside) return std::nullopt;
  return Framed{std::move(frame), std::move(*inside)};
}

std::optional<Framed> framed_where_far(const mechanism::Mechanism& mechanism) {
  if (mechanism.frame || !mechanism::is_far(mechanism)) return std::nullopt;
  return framed(mechanism, Scaling::none);
}

void certify(const core::LocusMap& map, const std::optional<Framed>& framed, core::Certificate& certificate) {
  certificate.map = map;
  if (!framed) return;
  std::copy_n(framed->frame.from.begin(), 2, certificate.from.begin());
  certificate.scale = framed->frame.scale;
}

LociRequest in_frame(LociRequest request, const Frame& frame) {
  request.tolerance /= frame.scale_value();
  if (request.min_couple) *request.min_couple /= frame.scale;
  return request;
}

core::Task in_frame(core::Task task, const Frame& frame) {
  task.shape = core::placed(task.shape, frame.from, 1 / frame.scale, {});
  task.margin /= frame.scale;
  if (task.min_couple) *task.min_couple /= frame.scale;
  return task;
}

core::Task in_frame(core::Task task, const core::Certificate& certificate) {
  return in_frame(std::move(task),
                  Frame{.from = {certificate.from.begin(), certificate.from.end()}, .scale = certificate.scale});
}

mechanism::Trajectory in_frame(mechanism::Trajectory trajectory, const Frame& frame) {
  const auto move = [&](std::vector<Rational>& at) {
    for (std::size_t i = 0; i < at.size(); ++i) at[i] -= frame.from[i];
  };
  for (mechanism::Waypoint& waypoint : trajectory.waypoints) move(waypoint.at);
  if (!trajectory.timed) return trajectory;
  std::for_each(trajectory.timed->rows.begin(), trajectory.timed->rows.end(), move);
  using core::Expression;
  for (std::size_t i = 0; i < trajectory.timed->coordinates.size(); ++i) {
    Expression& coordinate = trajectory.timed->coordinates[i];
    coordinate = Expression::apply(Expression::Kind::add, {coordinate, Expression::number(-frame.from[i])});
  }
  return trajectory;
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

core::Zones from_frame(core::Zones map, const mechanism::Mechanism& mechanism, const Frame& frame) {
  const Outward outward(mechanism, frame);
  map.loci = from_frame(std::move(map.loci), mechanism, frame);
  // By cells nothing is scaled.
  const auto size = [&](double length) { return map.by_cells ? length : outward.size(outward.size(length)); };
  for (core::ZonedMode& mode : map.modes)
    for (double* const length : {&mode.workspace, &mode.outside, &mode.in_doubt}) *length = size(*length);
  for (core::Zone& zone : map.zones) {
    for (double* const length : {&zone.size, &zone.at_least, &zone.at_most}) *length = size(*length);
    for (std::vector<double>* const at : {&zone.lower, &zone.upper, &zone.sample, &zone.ball.centre}) outward.move(*at);
    zone.ball.radius = outward.size(zone.ball.radius);
    for (core::ZoneBorder& border : zone.borders) border.length = outward.size(border.length);
    for (core::ZoneEnd& end : zone.ends) {
      end.at = outward.value(end.at, 0);
      if (end.zero) end.zero = outward.value(*end.zero, 0);
    }
    outward.move(zone.outer);
    for (core::Polyline& hole : zone.holes) outward.move(hole);
    for (std::vector<core::Point3>& face : zone.faces)
      for (core::Point3& at : face)
        for (std::size_t i = 0; i < mechanism.coordinates.size(); ++i) at[i] = outward.value(at[i], i);
  }
  return map;
}

Pose from_frame(Pose pose, const mechanism::Mechanism& mechanism, const Frame& frame) {
  const Outward outward(mechanism, frame);
  const auto place = [&](core::PosePoint& point) {
    for (std::size_t i = 0; i < point.at.size(); ++i)
      if (std::isfinite(point.at[i])) point.at[i] = core::to_double(frame.origin[i] + Rational(point.at[i]));
  };
  outward.move(pose.at);
  std::for_each(pose.points.begin(), pose.points.end(), place);
  if (pose.actual)
    for (core::DisplacedLink& link : pose.actual->links) std::for_each(link.points.begin(), link.points.end(), place);
  return pose;
}

Errors from_frame(Errors errors, const mechanism::Mechanism& mechanism, const Frame& frame) {
  const Outward outward(mechanism, frame);
  errors.loci = from_frame(std::move(errors.loci), mechanism, frame);
  for (core::ModeErrors& mode : errors.modes) {
    core::FieldMap& map = mode.map;
    for (std::size_t c = 0; c < map.dimension(); ++c) {
      map.lower[c] = core::to_double(mechanism.coordinates[c].lower);
      map.upper[c] = core::to_double(mechanism.coordinates[c].upper);
      for (double& value : map.axes[c]) value = outward.value(value, c);
    }
    for (core::ErrorEvent& event : mode.events) outward.move(event.point.at);
  }
  return errors;
}

TrajectoryResult from_frame(TrajectoryResult result, const mechanism::Mechanism& mechanism, const Frame& frame) {
  const auto move = [&](const std::string& name, const Rational& by) {
    const auto found = std::find(result.samples.names.begin(), result.samples.names.end(), name);
    if (found == result.samples.names.end()) return;
    for (double& value : result.samples.columns[static_cast<std::size_t>(found - result.samples.names.begin())])
      if (std::isfinite(value)) value = core::to_double(by + Rational(value));
  };
  for (std::size_t i = 0; i < mechanism.coordinates.size(); ++i)
    move("q_" + mechanism.coordinates[i].name, frame.from[i]);
  for (std::size_t i = 0; i < 3; ++i)
    for (const char* const point : {"p", "actual_p"}) move(point + std::string(1, "xyz"[i]), frame.origin[i]);
  return result;
}

void move_from_frame(std::optional<core::TaskWitness>& witness, std::optional<core::OpenTask>& open,
                     const mechanism::Mechanism& mechanism, const Frame& frame) {
  const Outward outward(mechanism, frame);
  if (witness) {
    outward.move(witness->at);
    witness->distance = outward.size(witness->distance);
  }
  if (open) outward.move(open->lower), outward.move(open->upper);
}

Verification from_frame(Verification result, const core::Task& task, const mechanism::Mechanism& mechanism,
                        const Frame& frame) {
  const Outward outward(mechanism, frame);
  core::TaskShape placed = std::exchange(result.task, task).shape;
  if (result.moved_by || result.scaled_by) result.task.shape = core::placed(placed, {}, frame.scale, frame.from);
  if (result.moved_by)
    for (Rational& way : *result.moved_by) way *= frame.scale;
  if (result.margin) result.margin = outward.size(*result.margin);
  if (result.nearest) {
    outward.move(result.nearest->at);
    result.nearest->distance = outward.size(result.nearest->distance);
  }
  move_from_frame(result.witness, result.open, mechanism, frame);
  result.map = from_frame(std::move(result.map), mechanism, frame);
  for (std::string& note : result.notes) note = outward.note(note);
  return result;
}

numeric::ValidationReport from_frame(numeric::ValidationReport report, const mechanism::Mechanism& mechanism,
                                     const Frame& frame) {
  const Outward outward(mechanism, frame);
  for (numeric::DisputedEdge& edge : report.disputed_edges) {
    outward.move(edge.from);
    outward.move(edge.to);
  }
  for (numeric::DisputedArc& arc : report.disputed_arcs) outward.move(arc.at);
  return report;
}

}  // namespace clearloci
