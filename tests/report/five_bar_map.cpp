#include "tests/report/five_bar_map.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

namespace clearloci::report::fixture {
namespace {

using core::Point2;
using core::Rational;

constexpr double link = 0.5;
constexpr Point2 a1 = {0, 0}, a2 = {0.5, 0};
constexpr int samples = 1440;

double cross(const Point2& o, const Point2& p, const Point2& q) {
  return (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
}
double distance(const Point2& p, const Point2& q) { return std::hypot(p[0] - q[0], p[1] - q[1]); }
bool reachable(const Point2& p) { return distance(p, a1) <= 1 && distance(p, a2) <= 1; }

/// Elbow of the dyad a -> p on its left (+1) or right (-1).
Point2 elbow(const Point2& a, const Point2& p, int side) {
  const double d = distance(a, p), height = std::sqrt(std::max(0.0, link * link - d * d / 4));
  return {(a[0] + p[0]) / 2 - side * height * (p[1] - a[1]) / d, (a[1] + p[1]) / 2 + side * height * (p[0] - a[0]) / d};
}

/// Runs of a curve, given by a parameter in [0, 2 pi), where it exists; a run through 0 is joined.
std::vector<core::Arc> runs(const std::function<std::optional<Point2>(double)>& at, std::array<core::ArcEnd, 2> ends) {
  std::vector<core::Polyline> pieces(1);
  for (int i = 0; i < samples; ++i) {
    const auto point = at(2 * std::numbers::pi * i / samples);
    if (point) {
      pieces.back().push_back(*point);
    } else if (!pieces.back().empty()) {
      pieces.emplace_back();
    }
  }
  std::vector<core::Arc> arcs;
  if (pieces.size() == 1 && pieces[0].size() == static_cast<std::size_t>(samples)) {
    pieces[0].push_back(pieces[0].front());
    arcs.push_back({.closed = true, .length = 0, .points = pieces[0]});
  } else {
    if (pieces.size() > 1 && at(0) && !pieces.back().empty()) {
      pieces.back().insert(pieces.back().end(), pieces[0].begin(), pieces[0].end());
      pieces.erase(pieces.begin());
    }
    for (auto& piece : pieces) {
      if (piece.size() >= 2) arcs.push_back({.closed = false, .ends = ends, .length = 0, .points = piece});
    }
  }
  for (auto& arc : arcs) {
    for (std::size_t i = 1; i < arc.points.size(); ++i) arc.length += distance(arc.points[i - 1], arc.points[i]);
  }
  return arcs;
}

core::Polynomial polynomial(std::vector<core::Term> terms) { return {2, std::move(terms)}; }

/// (x - cx)^2 + (y - cy)^2 = r^2, times 4.
core::LocusCurve circle(const Rational& cx, const Rational& cy, const Rational& radius) {
  core::LocusCurve curve;
  const Rational constant = 4 * (cx * cx + cy * cy - radius * radius);
  std::vector<core::Term> terms = {{{2, 0}, 4}};
  if (cx != 0) terms.push_back({{1, 0}, -8 * cx});
  terms.push_back({{0, 2}, 4});
  if (cy != 0) terms.push_back({{0, 1}, -8 * cy});
  if (constant != 0) terms.push_back({{0, 0}, constant});
  curve.implicit = polynomial(terms);
  curve.closed_form = core::CircleForm{{cx, cy}, radius * radius, radius};
  curve.certified = true;
  return curve;
}

/// The distal link of one leg is vertical: its other end lies `side` above the platform point.
void add_contact_loss(core::LocusMap& map, const core::WorkingMode& mode, int leg, int above) {
  const Point2 base = leg == 1 ? a1 : a2;
  auto curve = circle(leg == 1 ? Rational(0) : Rational(1, 2), Rational(-above, 2), Rational(1, 2));
  curve.kind = core::LocusKind::contact_loss;
  using core::Quantity;
  if (leg == 2) {
    curve.vanishing = {{"A1", Quantity::f}, {"B1", Quantity::f}, {"P", Quantity::f}, {"A1", Quantity::M}};
  } else {
    curve.vanishing = {{"B2", Quantity::f}, {"A2", Quantity::f}, {"A2", Quantity::M}};
  }
  curve.factor = leg == 2 ? "x - xB2" : "x - xB1";
  curve.cause = leg == 2 ? "link PB2 parallel to the load" : "link B1P parallel to the load";
  curve.mode = mode;
  curve.arcs = runs(
      [&](double t) -> std::optional<Point2> {
        const Point2 b = {base[0] + link * std::cos(t), base[1] + link * std::sin(t)};
        const Point2 p = {b[0], b[1] - above * link};
        const bool on_sheet = cross(base, p, b) * mode[leg - 1] > 0;
        return on_sheet && reachable(p) ? std::optional(p) : std::nullopt;
      },
      {core::ArcEnd::boundary, core::ArcEnd::boundary});
  if (!curve.arcs.empty()) map.curves.push_back(std::move(curve));
}

/// B1, P, B2 on a line: P halfway between B1 and B2, which are 2 L apart.
void add_direct_singularity(core::LocusMap& map, const core::WorkingMode& mode) {
  core::LocusCurve curve;
  curve.kind = core::LocusKind::direct_singularity;
  curve.factor = "(x - xB1)*(y - yB2) - (y - yB1)*(x - xB2)";
  curve.cause = "B1, P, B2 aligned";
  curve.implicit = polynomial({{{6, 0}, 16}, {{4, 2}, 48}, {{2, 4}, 48}, {{0, 6}, 16}, {{2, 0}, -1}});
  curve.certified = true;
  curve.mode = mode;
  for (const int branch : {1, -1}) {
    auto arcs = runs(
        [&](double t) -> std::optional<Point2> {
          const Point2 b1 = {link * std::cos(t), link * std::sin(t)};
          const double d = distance(b1, a2), along = (d * d + 1 - link * link) / (2 * d), square = 1 - along * along;
          if (d < 1e-9 || square < 0) return std::nullopt;
          const double ux = (a2[0] - b1[0]) / d, uy = (a2[1] - b1[1]) / d, off = branch * std::sqrt(square);
          const Point2 b2 = {b1[0] + along * ux - off * uy, b1[1] + along * uy + off * ux};
          const Point2 p = {(b1[0] + b2[0]) / 2, (b1[1] + b2[1]) / 2};
          const bool on_sheet = cross(a1, p, b1) * mode[0] > 0 && cross(a2, p, b2) * mode[1] > 0;
          return on_sheet ? std::optional(p) : std::nullopt;
        },
        {core::ArcEnd::boundary, core::ArcEnd::boundary});
    curve.arcs.insert(curve.arcs.end(), arcs.begin(), arcs.end());
  }
  map.curves.push_back(std::move(curve));
}

void add_boundary(core::LocusMap& map, const core::WorkingMode& mode) {
  for (const int leg : {1, 2}) {
    const Point2 base = leg == 1 ? a1 : a2;
    auto curve = circle(leg == 1 ? Rational(0) : Rational(1, 2), 0, 1);
    curve.kind = core::LocusKind::workspace_boundary;
    curve.factor = leg == 1 ? "Q1" : "Q2";
    curve.mode = mode;
    curve.arcs = runs(
        [&](double t) -> std::optional<Point2> {
          const Point2 p = {base[0] + std::cos(t), base[1] + std::sin(t)};
          return distance(p, leg == 1 ? a2 : a1) <= 1 ? std::optional(p) : std::nullopt;
        },
        {core::ArcEnd::crossing, core::ArcEnd::crossing});
    if (leg == 1) {
      core::LocusCurve backlash = curve;
      backlash.kind = core::LocusKind::backlash;
      backlash.vanishing = {{"A1", core::Quantity::M}};
      backlash.factor = "y*xB1 - yB1*x";
      backlash.cause = "A1, B1, P aligned";
      map.curves.push_back(std::move(backlash));
    }
    map.curves.push_back(std::move(curve));
  }
}

void add_workspace(core::LocusMap& map, const core::WorkingMode& mode) {
  core::Polyline ring;
  const double half = std::acos(0.25);
  for (int i = 0; i <= 200; ++i) {
    const double t = -half + 2 * half * i / 200;
    ring.push_back({std::cos(t), std::sin(t)});
  }
  for (int i = 0; i <= 200; ++i) {
    const double t = -half + 2 * half * i / 200;
    ring.push_back({0.5 - std::cos(t), std::sin(t)});
  }
  ring.push_back(ring.front());
  map.workspace.push_back({mode, {ring}});
}

core::LocusMap empty_map() {
  core::LocusMap map;
  map.mechanism = "Planar 5R manipulator";
  map.parameters = {{"L", "1/2"}, {"d", "1/2"}};
  map.tower.coordinates = {"x", "y"};
  for (const char* point : {"B1", "B2"}) {
    map.tower.roots.push_back({.name = point[1] == '1' ? "s1" : "s2", .point = point});
  }
  map.lower = {Rational(-1, 2), -1};
  map.upper = {1, 1};
  map.tolerance = 1e-5;
  map.timing = {{"symbolic", 0.01}, {"elimination", 0.012}, {"tracing", 0.05}};
  return map;
}

void add_mode(core::LocusMap& map, const core::WorkingMode& mode) {
  for (const int leg : {2, 1}) {
    for (const int above : {1, -1}) add_contact_loss(map, mode, leg, above);
  }
  add_direct_singularity(map, mode);
  add_boundary(map, mode);
  add_workspace(map, mode);
}

void number_curves(core::LocusMap& map) {
  for (std::size_t i = 0; i < map.curves.size(); ++i) map.curves[i].id = "c" + std::to_string(i + 1);
}

}  // namespace

core::WorkingMode elbows_out() { return {-1, 1}; }

core::LocusMap five_bar_map() {
  core::LocusMap map = empty_map();
  add_mode(map, elbows_out());
  number_curves(map);
  map.isolated_points = {
      {core::LocusKind::contact_loss, {{"A1", core::Quantity::f}}, {-0.198205, -0.040963}, elbows_out(), true},
      {core::LocusKind::contact_loss, {{"B2", core::Quantity::f}}, {0.091455, 0.211746}, elbows_out(), true}};
  return map;
}

core::LocusMap five_bar_map_in_all_modes() {
  core::LocusMap map = empty_map();
  for (const core::WorkingMode& mode : {core::WorkingMode{-1, 1}, {-1, -1}, {1, 1}, {1, -1}}) add_mode(map, mode);
  number_curves(map);
  return map;
}

core::LocusMap hostile_map() {
  core::LocusMap map = five_bar_map();
  map.mechanism = "5R \"déjà vu\" <b>&amp; 机构, №5\\ ]]>\n";
  map.parameters = {{"λ", "1/3"}};
  for (auto& curve : map.curves) {
    for (auto& vanishing : curve.vanishing) vanishing.joint = "A\"<1>, &" + vanishing.joint;
    if (!curve.cause.empty()) curve.cause += " <\"&',> Ω";
  }
  map.isolated_points[0].vanishing[0].joint = "B,\"<2>";
  map.tower.roots[0].point = "B<1>,\"";

  core::LocusCurve line;
  line.id = "c\"<9>,";
  line.kind = core::LocusKind::component;
  line.vanishing = {{"A1", core::Quantity::fx, 2}};
  line.implicit = polynomial({{{1, 0}, 2}, {{0, 0}, -1}});
  line.closed_form = core::LineForm{2, 0, -1};
  line.mode = elbows_out();
  line.arcs = {{.closed = false,
                .ends = {core::ArcEnd::box, core::ArcEnd::direct_singularity},
                .length = 1.2,
                .points = {{0.5, -0.6}, {0.5, 0.6}}}};
  map.curves.push_back(line);

  core::LocusCurve oval = circle(Rational(1, 4), Rational(1, 3), Rational(1, 10));
  oval.id = "c10";
  oval.kind = core::LocusKind::margin;
  oval.vanishing = {{"A1", core::Quantity::f}};
  oval.cause = "|f_A1| = 5 N";
  oval.closed_form = core::CircleForm{{Rational(1, 4), Rational(1, 3)}, Rational(1, 50), std::nullopt};
  oval.mode = elbows_out();
  oval.arcs = runs(
      [](double t) {
        const double r = std::sqrt(0.02);
        return std::optional(Point2{0.25 + r * std::cos(t), 1 / 3.0 + r * std::sin(t)});
      },
      {});
  map.curves.push_back(oval);

  oval.id = "c11";
  oval.closed_form = core::ConicForm{"ellipse", {1, 0, 4, 0, 0, -1}, Point2{0, 0}, std::array<double, 2>{1, 0.5}, 0};
  map.curves.push_back(oval);
  map.notes = {"M_A2 vanishes in every pose \"<&>\xFF"};
  return map;
}

core::Sketch five_bar_sketch(const core::WorkingMode& mode, double x, double y) {
  const Point2 p = {x, y}, b1 = elbow(a1, p, mode[0]), b2 = elbow(a2, p, mode[1]);
  core::Sketch sketch;
  sketch.links = {{"A1B1", {a1, b1}}, {"B1P", {b1, p}}, {"PB2", {p, b2}}, {"B2A2", {b2, a2}}};
  sketch.joints = {{"A1", a1, true, true}, {"B1", b1}, {"P", p}, {"B2", b2}, {"A2", a2, true, true}};
  sketch.loads = {{p, {0, -100}, 0}};
  return sketch;
}

}  // namespace clearloci::report::fixture
