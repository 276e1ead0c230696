#include "loci/curves/curve_arrangement.hpp"

#include <CGAL/Arr_algebraic_segment_traits_2.h>
#include <CGAL/CORE_BigInt.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "core/errors.hpp"
#include "core/parts.hpp"

namespace clearloci::loci {
namespace {

using core::Rational;

using Number = CORE::BigInt;
using Traits = CGAL::Arr_algebraic_segment_traits_2<Number>;
using Kernel = Traits::Algebraic_kernel_d_2;
using Kernel1 = Kernel::Algebraic_kernel_d_1;
using Real = Traits::Algebraic_real_1;
using Bound = Kernel1::Bound;
using Curve = Kernel::Curve_analysis_2;
using StatusLine = Curve::Status_line_1;
using Bivariate = Traits::Polynomial_2;

/// Widths of enclosures: far below the distance at which anything in a mechanism's workspace differs. How far CGAL has
/// refined a root depends on what was asked before; rounding a much finer enclosure to `vertex_bits` makes the result
/// the same from run to run.
constexpr int vertex_bits = 56;
constexpr int fine_bits = 90;
/// What tells that a vertex is outside the box, or on none of its sides.
constexpr int rough_bits = 20;
constexpr int sample_bits = 100;

Rational rational(const Bound& value) {
  Rational result;
  mpq_set(result.get_mpq_t(), value.get_mp());
  return result;
}

Bound bound(const Rational& value) { return Bound(value.get_mpq_t()); }

Number number(const core::Integer& value) { return Number(value.get_mpz_t()); }

Bivariate bivariate(const core::Polynomial& p) {
  std::vector<std::pair<CGAL::Exponent_vector, Number>> terms;
  const core::Polynomial integral = core::primitive_part(p);
  for (const core::Term& term : integral.terms) {
    terms.emplace_back(CGAL::Exponent_vector(term.exponents[0], term.exponents[1]), number(term.coefficient.get_num()));
  }
  return CGAL::Polynomial_traits_d<Bivariate>::Construct_polynomial()(terms.begin(), terms.end());
}

/// variable - value = 0.
core::Polynomial side_of_box(int variable, const Rational& value) {
  return core::primitive_part(core::variable_polynomial(2, variable) - core::constant_polynomial(2, value));
}

struct IsLess {
  bool operator()(const Real& a, const Real& b) const { return CGAL::compare(a, b) == CGAL::SMALLER; }
};

/// The arcs over an interval beside a status line, each by its number: the point of the line from which it leaves, -1
/// for one that comes from infinity. `left`: the interval on the left.
std::vector<int> points_of_arcs(const StatusLine& line, bool left) {
  const auto beside = [left](const std::pair<int, int>& pair) { return left ? pair.first : pair.second; };
  std::vector<int> points(static_cast<std::size_t>(beside(line.number_of_branches_approaching_minus_infinity())), -1);
  for (int j = 0; j < line.number_of_events(); ++j)
    points.insert(points.end(), static_cast<std::size_t>(beside(line.number_of_incident_branches(j))), j);
  points.insert(points.end(), static_cast<std::size_t>(beside(line.number_of_branches_approaching_plus_infinity())),
                -1);
  return points;
}

/// The point enclosed, rounded to a multiple of 2^-vertex_bits.
double rounded(const std::pair<Bound, Bound>& interval) {
  Rational value = (rational(interval.first) + rational(interval.second)) / 2;
  mpq_mul_2exp(value.get_mpq_t(), value.get_mpq_t(), vertex_bits);
  const Rational shifted = value + Rational(1, 2);
  core::Integer whole;
  mpz_fdiv_q(whole.get_mpz_t(), shifted.get_num_mpz_t(), shifted.get_den_mpz_t());
  Rational result(whole);
  mpq_div_2exp(result.get_mpq_t(), result.get_mpq_t(), vertex_bits);
  return core::to_double(result);
}

/// CGAL's algebraic kernel keeps caches and the precision of its intervals for the whole process: two threads in it at
/// a time refine without end, or read what the other has freed. Whatever calls it takes this turn.
[[nodiscard]] std::unique_lock<std::mutex> kernel_turn() {
  static std::mutex one_at_a_time;
  return std::unique_lock(one_at_a_time);
}

}  // namespace

/// The points at which edges end are put together without comparing them across curves: a point of a curve is its x and
/// its number among the curve's points there, counted from below, and points of two curves are one where the analysis
/// of the pair says so. CGAL's sweep is not asked: it builds faces too, which nobody needs, and where a curve has
/// isolated points it may look one up that it does not know when a face is cut in two (Arr_construction_ss_visitor.h:
/// relocate_in_new_face, CGAL 5.5).
struct CurveArrangement::Implementation {
  explicit Implementation(std::vector<core::Polynomial> given) : curves(std::move(given)) {}

  Bivariate polynomial(std::size_t i) const { return bivariate(curves[i]); }

  /// A point of a curve, by its number from below among those of the same x.
  struct Node {
    Real x;
    int curve = 0, number = 0;
  };
  /// What a curve has at one x inside the box.
  struct Column {
    int event = -1;        ///< of the curve's own critical lines
    std::set<int> points;  ///< those at which edges end; of a critical or a vertical line all
    bool all = false;
    int first_node = -1;          ///< then those of the others follow
    std::vector<int> nodes = {};  ///< of every point: -1 where there is none
  };
  using Columns = std::map<Real, Column, IsLess>;

  std::pair<Bound, Bound> enclose_x(const Node& node, int bits) const {
    return line_kernel.approximate_absolute_1_object()(node.x, bits);
  }
  std::pair<Bound, Bound> enclose_y(const Node& node, int bits) const {
    const Kernel::Algebraic_real_2 xy(node.x, analysed[static_cast<std::size_t>(node.curve)], node.number);
    return plane_kernel.approximate_absolute_y_2_object()(xy, bits);
  }
  core::Point2 position(const Node& node, int bits = fine_bits) const {
    return {rounded(enclose_x(node, bits)), rounded(enclose_y(node, bits))};
  }

  struct Vertex {
    Node node;
    core::Point2 rough{};                 ///< to `rough_error`
    std::optional<core::Point2> at = {};  ///< once it was asked for
  };
  static constexpr double rough_error = 0x1p-18;

  const core::Point2& at(Vertex& vertex) const {
    if (!vertex.at) vertex.at = position(vertex.node);
    return *vertex.at;
  }
  bool in_box(Vertex& vertex, double slack) const {
    if (!in_box(vertex.rough, slack + rough_error)) return false;
    return in_box(vertex.rough, slack - rough_error) || in_box(at(vertex), slack);
  }
  bool on_side(Vertex& vertex, double slack) const {
    return on_side(vertex.rough, slack + rough_error) && on_side(at(vertex), slack);
  }

  bool in_box(const core::Point2& p, double slack) const {
    for (std::size_t i = 0; i < 2; ++i) {
      if (p[i] < core::to_double(lower[i]) - slack || p[i] > core::to_double(upper[i]) + slack) return false;
    }
    return true;
  }

  bool on_side(const core::Point2& p, double slack) const {
    for (std::size_t i = 0; i < 2; ++i)
      for (const Rational& side : {lower[i], upper[i]})
        if (std::abs(p[i] - core::to_double(side)) <= slack) return true;
    return false;
  }

  /// An edge between nodes: an arc of a curve by its number among those over an interval; of a vertical line -1.
  struct Piece {
    int curve = 0, arc = -1;
    Node from, to;
  };

  void build(const std::function<bool()>& interrupted);
  void add_sides();
  bool is_vertical(std::size_t curve) const { return !core::depends_on(curves[curve], 1); }
  bool is_within(const Real& x) const { return !(IsLess()(x, x_range[0]) || IsLess()(x_range[1], x)); }
  void add_events(std::size_t curve);
  void add_verticals();
  void meet(std::size_t a, std::size_t b);
  void number_nodes(std::size_t curve);
  void join_nodes();
  void add_edges_of(std::size_t curve);
  void add_edges_of_verticals();
  void add_edge(Piece piece, int from, int to);
  int vertex_of(int node);
  int node_of(std::size_t curve, const Real& x, int point) const {
    return columns[curve].at(x).nodes[static_cast<std::size_t>(point)];
  }

  /// A point in the interior of an edge.
  PointEnclosure sample(const Piece& piece, int attempt) const;
  bool is_outside(const PointEnclosure& point) const {
    return point.upper[0] < lower[0] || point.lower[0] > upper[0] || point.upper[1] < lower[1] ||
           point.lower[1] > upper[1];
  }

  std::vector<core::Polynomial> curves;
  std::array<Rational, 2> lower, upper;
  double slack = 0;  ///< vertices on the box's sides are known to 2^-vertex_bits
  Kernel plane_kernel;
  Kernel1 line_kernel;
  std::vector<Curve> analysed;
  mutable std::vector<Vertex> vertices;  ///< whose exact places are found out in turn
  std::vector<ArrangementEdge> edges;
  std::vector<ArrangementPoint> points;
  std::vector<Piece> pieces;  ///< of every edge

  // While it is built:
  std::array<Real, 2> x_range;
  std::vector<Columns> columns;  ///< of every curve that is not vertical
  struct Meeting {
    std::array<std::size_t, 2> curves;
    Real x;
    std::array<int, 2> points;
  };
  std::vector<Meeting> meetings;
  std::map<Real, std::size_t, IsLess> verticals;  ///< x, curve
  std::vector<Node> nodes;
  core::Parts<> joined{0};          ///< nodes that are one
  std::vector<int> vertex_of_root;  ///< -2: not looked at yet, -1: outside the box
};

PointEnclosure CurveArrangement::Implementation::sample(const Piece& piece, int attempt) const {
  const int bits = sample_bits << std::min(attempt, 2);
  if (piece.arc < 0) {
    const auto x = enclose_x(piece.from, bits);
    const Rational low = rational(enclose_y(piece.from, bits).second);
    const Rational high = rational(enclose_y(piece.to, bits).first);
    const Rational y = low + (high - low) * Rational(attempt + 3, 2 * attempt + 7);
    return {{rational(x.first), y}, {rational(x.second), y}};
  }
  const auto between = line_kernel.bound_between_1_object();
  Bound x = between(piece.from.x, piece.to.x);
  for (int i = 0; i < attempt; ++i) x = between(piece.from.x, Real(x));
  auto line = analysed[static_cast<std::size_t>(piece.curve)].status_line_at_exact_x(x);
  const auto y = plane_kernel.approximate_absolute_y_2_object()(line.algebraic_real_2(piece.arc), bits);
  return {{rational(x), rational(y.first)}, {rational(x), rational(y.second)}};
}

/// Those of the box that are not among the curves.
void CurveArrangement::Implementation::add_sides() {
  for (std::size_t i = 0; i < 2; ++i) {
    x_range[i] = Real(bound(i == 0 ? lower[0] : upper[0]));
    for (const Rational& value : {lower[i], upper[i]}) {
      const core::Polynomial side = side_of_box(static_cast<int>(i), value);
      if (std::find(curves.begin(), curves.end(), side) == curves.end()) curves.push_back(side);
    }
  }
  slack = 1e-12 * std::max(core::to_double(upper[0] - lower[0]), core::to_double(upper[1] - lower[1]));
}

/// The critical lines of a curve, and its isolated points.
void CurveArrangement::Implementation::add_events(std::size_t curve) {
  const Curve& curve_data = analysed[curve];
  for (int i = 0; i < curve_data.number_of_status_lines_with_event(); ++i) {
    const StatusLine& line = curve_data.status_line_at_event(i);
    const Real x = line.x();
    if (!is_within(x)) continue;
    if (is_vertical(curve)) {
      verticals.emplace(x, curve);
      continue;
    }
    columns[curve][x].event = i;
    for (int j = 0; j < line.number_of_events(); ++j) {
      if (line.number_of_incident_branches(j) != std::pair(0, 0)) continue;
      const Node node{x, static_cast<int>(curve), j};
      const core::Point2 at = position(node);
      if (!in_box(at, 0)) continue;
      const auto along = enclose_x(node, sample_bits), across = enclose_y(node, sample_bits);
      points.push_back(
          {static_cast<int>(curve),
           at,
           {{rational(along.first), rational(across.first)}, {rational(along.second), rational(across.second)}}});
    }
  }
}

void CurveArrangement::Implementation::add_verticals() {
  for (const auto& [x, vertical] : verticals)
    for (std::size_t c = 0; c < curves.size(); ++c)
      if (!is_vertical(c)) columns[c][x].all = true;
}

/// Where two curves meet within the box's range of x; neither is vertical.
void CurveArrangement::Implementation::meet(std::size_t a, std::size_t b) {
  const auto pair = plane_kernel.construct_curve_pair_2_object()(analysed[a], analysed[b]);
  for (int i = 0; i < pair.number_of_status_lines_with_event(); ++i) {
    const Real x = pair.event_x(i);
    if (!is_within(x)) continue;
    const auto& line = pair.status_line_at_event(i);
    if (!line.is_intersection()) continue;
    for (int j = 0; j < line.number_of_events(); ++j) {
      const auto both = line.curves_at_event(j, analysed[a], analysed[b]);
      if (both.first < 0 || both.second < 0) continue;
      columns[a][x].points.insert(both.first);
      columns[b][x].points.insert(both.second);
      meetings.push_back({{a, b}, x, {both.first, both.second}});
    }
  }
}

void CurveArrangement::Implementation::number_nodes(std::size_t curve) {
  for (auto& [x, column] : columns[curve]) {
    // Every own line with a column is known as one: those of pairs have the same x, exactly.
    const StatusLine line =
        column.event >= 0 ? analysed[curve].status_line_at_event(column.event) : analysed[curve].status_line_for_x(x);
    column.nodes.assign(static_cast<std::size_t>(line.number_of_events()), -1);
    for (int j = 0; j < line.number_of_events(); ++j) {
      if (column.event < 0 && !column.all && !column.points.contains(j)) continue;
      column.nodes[static_cast<std::size_t>(j)] = static_cast<int>(nodes.size());
      nodes.push_back({x, static_cast<int>(curve), j});
    }
  }
}

/// Nodes of several curves that are one point; the curve of the lowest degree stands for them.
void CurveArrangement::Implementation::join_nodes() {
  joined = core::Parts(nodes.size());
  vertex_of_root.assign(nodes.size(), -2);
  const auto degree_of = [&](int node) {
    return core::total_degree(curves[static_cast<std::size_t>(nodes[static_cast<std::size_t>(node)].curve)]);
  };
  for (const Meeting& meeting : meetings) {
    const int one = joined.of(node_of(meeting.curves[0], meeting.x, meeting.points[0]));
    const int other = joined.of(node_of(meeting.curves[1], meeting.x, meeting.points[1]));
    const bool keeps_one = degree_of(one) <= degree_of(other);
    joined.join(keeps_one ? one : other, keeps_one ? other : one);
  }
}

/// -1: outside the box.
int CurveArrangement::Implementation::vertex_of(int node) {
  const int root = joined.of(node);
  int& vertex = vertex_of_root[static_cast<std::size_t>(root)];
  if (vertex == -2) {
    Vertex vertex_between{nodes[static_cast<std::size_t>(root)], {}};
    vertex_between.rough = position(vertex_between.node, rough_bits);
    vertex = -1;
    if (in_box(vertex_between, slack)) {
      vertex = static_cast<int>(vertices.size());
      vertices.push_back(std::move(vertex_between));
    }
  }
  return vertex;
}

void CurveArrangement::Implementation::add_edge(Piece piece, int from, int to) {
  const int first = vertex_of(from), last = vertex_of(to);
  if (first < 0 || last < 0) return;
  piece.from = nodes[static_cast<std::size_t>(from)];
  piece.to = nodes[static_cast<std::size_t>(to)];
  // What leaves the box and comes back has both ends in it.
  const auto on_rim = [&](int v) { return on_side(vertices[static_cast<std::size_t>(v)], slack); };
  if (on_rim(first) && on_rim(last) && is_outside(sample(piece, 0))) return;
  edges.push_back({piece.curve, first, last, piece.arc < 0});
  pieces.push_back(std::move(piece));
}

void CurveArrangement::Implementation::add_edges_of(std::size_t curve) {
  std::vector<int> last;  // of every arc over the interval: the node it comes from, -1 where that is elsewhere
  bool first_column = true;
  for (const auto& [x, column] : columns[curve]) {
    const auto end_at = [&](std::size_t arc, int point) {
      const int node = point < 0 ? -1 : column.nodes[static_cast<std::size_t>(point)];
      if (node < 0) return;
      if (!first_column && last[arc] >= 0)
        add_edge({static_cast<int>(curve), static_cast<int>(arc), {}, {}}, last[arc], node);
      last[arc] = node;
    };
    if (column.event < 0) {
      if (first_column) last.assign(column.nodes.size(), -1);
      for (std::size_t arc = 0; arc < column.nodes.size(); ++arc) end_at(arc, static_cast<int>(arc));
    } else {
      const StatusLine& line = analysed[curve].status_line_at_event(column.event);
      if (!first_column) {
        const std::vector<int> arriving = points_of_arcs(line, true);
        for (std::size_t arc = 0; arc < arriving.size(); ++arc) end_at(arc, arriving[arc]);
      }
      last = points_of_arcs(line, false);
      for (int& from : last)
        if (from >= 0) from = column.nodes[static_cast<std::size_t>(from)];
    }
    first_column = false;
  }
}

/// Along every vertical line from point to point of the other curves, in the order of y.
void CurveArrangement::Implementation::add_edges_of_verticals() {
  for (const auto& [x, vertical] : verticals) {
    std::set<int> roots;
    for (std::size_t c = 0; c < curves.size(); ++c) {
      if (is_vertical(c)) continue;
      for (const int node : columns[c].at(x).nodes)
        if (vertex_of(node) >= 0) roots.insert(joined.of(node));
    }
    const auto is_below = [&](int a, int b) {
      for (int bits = rough_bits; a != b; bits *= 2) {  // they are different points
        const auto one = enclose_y(nodes[static_cast<std::size_t>(a)], bits);
        const auto other = enclose_y(nodes[static_cast<std::size_t>(b)], bits);
        if (one.second < other.first) return true;
        if (other.second < one.first) return false;
      }
      return false;
    };
    std::vector<int> ascending(roots.begin(), roots.end());
    std::sort(ascending.begin(), ascending.end(), is_below);
    for (std::size_t i = 1; i < ascending.size(); ++i)
      add_edge({static_cast<int>(vertical), -1, {}, {}}, ascending[i - 1], ascending[i]);
  }
}

void CurveArrangement::Implementation::build(const std::function<bool()>& interrupted) {
  const auto check = [&] {
    if (interrupted && interrupted()) throw core::LimitReached("the time limit ended the exact arrangement");
  };
  add_sides();
  columns.resize(curves.size());
  const auto analyse = plane_kernel.construct_curve_2_object();
  for (std::size_t c = 0; c < curves.size(); ++c) {
    check();
    analysed.push_back(analyse(polynomial(c)));
    add_events(c);
  }
  add_verticals();
  for (std::size_t a = 0; a < curves.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      if (is_vertical(a) || is_vertical(b)) continue;
      check();
      meet(a, b);
    }
  for (std::size_t c = 0; c < curves.size(); ++c) number_nodes(c);
  join_nodes();
  for (std::size_t c = 0; c < curves.size(); ++c) {
    check();
    add_edges_of(c);
  }
  add_edges_of_verticals();
}

CurveArrangement::CurveArrangement(std::vector<core::Polynomial> curves, const std::array<Rational, 2>& lower,
                                   const std::array<Rational, 2>& upper, const std::function<bool()>& interrupted) {
  const auto turn = kernel_turn();
  auto implementation = std::make_unique<Implementation>(std::move(curves));
  implementation->lower = lower;
  implementation->upper = upper;
  implementation->build(interrupted);
  implementation_ = std::move(implementation);
}

CurveArrangement::~CurveArrangement() {
  const auto turn = kernel_turn();
  implementation_.reset();
}

const std::vector<core::Polynomial>& CurveArrangement::curves() const { return implementation_->curves; }
std::size_t CurveArrangement::vertices() const { return implementation_->vertices.size(); }
const std::vector<ArrangementEdge>& CurveArrangement::edges() const { return implementation_->edges; }
const std::vector<ArrangementPoint>& CurveArrangement::isolated_points() const { return implementation_->points; }

std::vector<std::pair<int, int>> CurveArrangement::passed_outside() const {
  const auto turn = kernel_turn();
  Implementation& self = *implementation_;
  std::set<std::pair<int, int>> passed;
  for (const Implementation::Meeting& meeting : self.meetings)
    for (const std::size_t i : {0u, 1u}) {
      const int root = self.joined.of(self.node_of(meeting.curves[i], meeting.x, meeting.points[i]));
      const int vertex = self.vertex_of_root[static_cast<std::size_t>(root)];
      if (vertex >= 0 && self.on_side(self.vertices[static_cast<std::size_t>(vertex)], self.slack))
        passed.emplace(vertex, static_cast<int>(meeting.curves[i]));
    }
  for (const ArrangementEdge& edge : self.edges)
    for (const int vertex : {edge.from, edge.to}) passed.erase({vertex, edge.curve});
  return {passed.begin(), passed.end()};
}

core::Point2 CurveArrangement::at(int vertex) const {
  const auto turn = kernel_turn();
  return implementation_->at(implementation_->vertices[static_cast<std::size_t>(vertex)]);
}

bool CurveArrangement::is_near(int vertex, const core::Point2& point, double distance) const {
  const auto away = [&](const core::Point2& vertex_point) {
    return std::hypot(vertex_point[0] - point[0], vertex_point[1] - point[1]);
  };
  const core::Point2& rough = implementation_->vertices[static_cast<std::size_t>(vertex)].rough;
  return away(rough) < distance + 2 * Implementation::rough_error && away(at(vertex)) < distance;
}

PointEnclosure CurveArrangement::sample(int edge, int attempt) const {
  const auto turn = kernel_turn();
  const auto e = static_cast<std::size_t>(edge);
  return implementation_->sample(implementation_->pieces[e], attempt);
}

double CurveArrangement::y_at(int edge, double x) const {
  const auto turn = kernel_turn();
  const Implementation& self = *implementation_;
  const Implementation::Piece& piece = self.pieces[static_cast<std::size_t>(edge)];
  auto line = self.analysed[static_cast<std::size_t>(piece.curve)].status_line_at_exact_x(bound(Rational(x)));
  return rounded(self.plane_kernel.approximate_absolute_y_2_object()(line.algebraic_real_2(piece.arc), fine_bits));
}

bool CurveArrangement::divides(int divisor, const core::Polynomial& p) const {
  if (p.is_zero()) return true;
  const auto turn = kernel_turn();
  const Bivariate f = implementation_->polynomial(static_cast<std::size_t>(divisor));
  return !CGAL::is_zero(f) && CGAL::total_degree(CGAL::gcd_up_to_constant_factor(f, bivariate(p))) > 0;
}

}  // namespace clearloci::loci
