#include "loci/curve_arrangement.hpp"

#include <CGAL/Arr_algebraic_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/CORE_BigInt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>

#include "core/errors.hpp"

namespace clearloci::loci {
namespace {

using core::Rational;

using Number = CORE::BigInt;
using Traits = CGAL::Arr_algebraic_segment_traits_2<Number>;
using Arrangement = CGAL::Arrangement_2<Traits>;
using Kernel = Traits::Algebraic_kernel_d_2;
using Kernel1 = Kernel::Algebraic_kernel_d_1;
using Real = Traits::Algebraic_real_1;
using Bound = Kernel1::Bound;
using Curve = Traits::Curve_2;
using Arc = Traits::X_monotone_curve_2;
using Point = Traits::Point_2;
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

struct CurveArrangement::Implementation {
  explicit Implementation(std::vector<core::Polynomial> given) : curves(std::move(given)) {}

  Bivariate polynomial(std::size_t i) const { return bivariate(curves[i]); }

  std::pair<Bound, Bound> enclose_x(const Point& p, int bits) const {
    return line_kernel.approximate_absolute_1_object()(p.x(), bits);
  }
  std::pair<Bound, Bound> enclose_y(const Point& p, int bits) const {
    return plane_kernel.approximate_absolute_y_2_object()(p.xy(), bits);
  }
  core::Point2 position(const Point& p, int bits = fine_bits) const {
    return {rounded(enclose_x(p, bits)), rounded(enclose_y(p, bits))};
  }

  struct Vertex {
    Arrangement::Vertex_const_handle handle;
    core::Point2 rough{};                 ///< to `rough_error`
    std::optional<core::Point2> at = {};  ///< once it was asked for
  };
  static constexpr double rough_error = 0x1p-18;

  const core::Point2& at(Vertex& vertex) const {
    if (!vertex.at) vertex.at = position(vertex.handle->point());
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

  void build(const std::function<bool()>& interrupted);
  /// A point in the interior of an edge.
  PointEnclosure sample(const Arc& arc, bool vertical, int attempt) const;
  bool is_outside(const PointEnclosure& point) const {
    return point.upper[0] < lower[0] || point.lower[0] > upper[0] || point.upper[1] < lower[1] ||
           point.lower[1] > upper[1];
  }

  std::vector<core::Polynomial> curves;
  std::array<Rational, 2> lower, upper;
  Kernel plane_kernel;
  Kernel1 line_kernel;
  Traits traits;
  Arrangement arrangement{&traits};
  mutable std::vector<Vertex> vertices;  ///< whose exact places are found out in turn
  std::vector<ArrangementEdge> edges;
  std::vector<ArrangementPoint> points;
  std::vector<Arc> arcs;  ///< of every edge
};

PointEnclosure CurveArrangement::Implementation::sample(const Arc& arc, bool vertical, int attempt) const {
  const int bits = sample_bits << std::min(attempt, 2);
  const Point min = arc.curve_end(CGAL::ARR_MIN_END), max = arc.curve_end(CGAL::ARR_MAX_END);
  if (vertical) {
    const auto x = enclose_x(min, bits);
    const Rational low = rational(enclose_y(min, bits).second);
    const Rational high = rational(enclose_y(max, bits).first);
    const Rational y = low + (high - low) * Rational(attempt + 3, 2 * attempt + 7);
    return {{rational(x.first), y}, {rational(x.second), y}};
  }
  const auto between = line_kernel.bound_between_1_object();
  Bound x = between(min.x(), max.x());
  for (int i = 0; i < attempt; ++i) x = between(min.x(), Real(x));
  auto line = arc.curve().status_line_at_exact_x(x);
  const auto y = plane_kernel.approximate_absolute_y_2_object()(line.algebraic_real_2(arc.arcno()), bits);
  return {{rational(x), rational(y.first)}, {rational(x), rational(y.second)}};
}

void CurveArrangement::Implementation::build(const std::function<bool()>& interrupted) {
  const auto check = [&] {
    if (interrupted && interrupted()) throw core::LimitReached("the time limit ended the exact arrangement");
  };
  for (std::size_t i = 0; i < 2; ++i) {
    for (const Rational& value : {lower[i], upper[i]}) {
      const core::Polynomial side = side_of_box(static_cast<int>(i), value);
      if (std::find(curves.begin(), curves.end(), side) == curves.end()) curves.push_back(side);
    }
  }
  std::vector<Curve> analysed;
  const auto construct = traits.construct_curve_2_object();
  for (std::size_t i = 0; i < curves.size(); ++i) {
    check();
    analysed.push_back(construct(polynomial(i)));
    // Isolated points of a curve may fall on other curves, where the arrangement does not show them as isolated.
    std::vector<boost::variant<Point, Arc>> pieces;
    traits.make_x_monotone_2_object()(analysed.back(), std::back_inserter(pieces));
    for (const auto& piece : pieces) {
      const auto* point = boost::get<Point>(&piece);
      if (point == nullptr) continue;
      const core::Point2 at = position(*point);
      if (!in_box(at, 0)) continue;
      const auto x = enclose_x(*point, sample_bits), y = enclose_y(*point, sample_bits);
      points.push_back({static_cast<int>(i),
                        at,
                        {{rational(x.first), rational(y.first)}, {rational(x.second), rational(y.second)}}});
    }
  }
  check();
  CGAL::insert(arrangement, analysed.begin(), analysed.end());
  check();
  std::map<Curve::Id_type, int> index_of;
  for (std::size_t i = 0; i < analysed.size(); ++i) index_of[analysed[i].id()] = static_cast<int>(i);

  const double size = std::max(core::to_double(upper[0] - lower[0]), core::to_double(upper[1] - lower[1]));
  const double slack = 1e-12 * size;  // vertices on the box's sides are known to 2^-vertex_bits
  std::map<Arrangement::Vertex_const_handle, int> vertex_index;
  const auto vertex = [&](Arrangement::Vertex_const_handle v) {
    const auto [entry, fresh] = vertex_index.try_emplace(v, -1);
    if (fresh) {
      Vertex own{v, position(v->point(), rough_bits)};
      if (in_box(own, slack)) {
        entry->second = static_cast<int>(vertices.size());
        vertices.push_back(std::move(own));
      }
    }
    return entry->second;
  };
  for (auto e = arrangement.edges_begin(); e != arrangement.edges_end(); ++e) {
    if (e->source()->is_at_open_boundary() || e->target()->is_at_open_boundary()) continue;
    const bool forward = e->direction() == CGAL::ARR_LEFT_TO_RIGHT;
    const int from = vertex(forward ? e->source() : e->target());
    const int to = vertex(forward ? e->target() : e->source());
    if (from < 0 || to < 0) continue;
    // What leaves the box and comes back has both ends in it.
    const auto on_rim = [&](int v) { return on_side(vertices[static_cast<std::size_t>(v)], slack); };
    if (on_rim(from) && on_rim(to) && is_outside(sample(e->curve(), e->curve().is_vertical(), 0))) continue;
    edges.push_back({index_of.at(e->curve().curve().id()), from, to, e->curve().is_vertical()});
    arcs.push_back(e->curve());
  }
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

core::Point2 CurveArrangement::at(int vertex) const {
  const auto turn = kernel_turn();
  return implementation_->at(implementation_->vertices[static_cast<std::size_t>(vertex)]);
}

bool CurveArrangement::is_near(int vertex, const core::Point2& point, double distance) const {
  const auto away = [&](const core::Point2& own) { return std::hypot(own[0] - point[0], own[1] - point[1]); };
  const core::Point2& rough = implementation_->vertices[static_cast<std::size_t>(vertex)].rough;
  return away(rough) < distance + 2 * Implementation::rough_error && away(at(vertex)) < distance;
}

PointEnclosure CurveArrangement::sample(int edge, int attempt) const {
  const auto turn = kernel_turn();
  const auto e = static_cast<std::size_t>(edge);
  return implementation_->sample(implementation_->arcs[e], implementation_->edges[e].vertical, attempt);
}

double CurveArrangement::y_at(int edge, double x) const {
  const auto turn = kernel_turn();
  const Implementation& self = *implementation_;
  const Arc& arc = self.arcs[static_cast<std::size_t>(edge)];
  auto line = arc.curve().status_line_at_exact_x(bound(Rational(x)));
  return rounded(self.plane_kernel.approximate_absolute_y_2_object()(line.algebraic_real_2(arc.arcno()), fine_bits));
}

bool CurveArrangement::divides(int divisor, const core::Polynomial& p) const {
  if (p.is_zero()) return true;
  const auto turn = kernel_turn();
  const Bivariate f = implementation_->polynomial(static_cast<std::size_t>(divisor));
  return !CGAL::is_zero(f) && CGAL::total_degree(CGAL::gcd_up_to_constant_factor(f, bivariate(p))) > 0;
}

}  // namespace clearloci::loci
