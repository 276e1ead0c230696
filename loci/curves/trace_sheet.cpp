#include "loci/curves/trace_sheet.hpp"

#include <algorithm>
#include <memory>
#include <optional>

#include "core/dense_terms.hpp"
#include "core/errors.hpp"
#include "loci/curves/curve_graph.hpp"
#include "loci/curves/tracer.hpp"
#include "loci/search/search.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {
namespace {

/// A claim over the tower without a root, as one over the tower with it.
void put_back(core::SheetClaim& claim, int root) {
  const int variable = 2 + root;
  for (core::StraightLine::Step& step : claim.function.steps)
    if (step.operation == core::StraightLine::Operation::variable && step.first >= variable) ++step.first;
  for (core::CellNode& node : claim.cells)
    if (node.kind == core::CellNode::Kind::graph && node.axis >= variable) ++node.axis;
  for (int& zero : claim.at_zero)
    if (zero >= root) ++zero;
  claim.at_zero.push_back(root);
}

/// What a tracer of a function finds, known or not yet.
std::shared_ptr<const Tracer> found(const core::RootTower& tower, const core::WorkingMode& mode,
                                    const std::vector<core::Rational>& lower, const std::vector<core::Rational>& upper,
                                    const SheetFunction& function, const std::vector<Cutter>& cutters,
                                    const SheetTraceOptions& options) {
  const auto find = [&]() -> std::shared_ptr<const Tracer> {
    auto tracer = std::make_shared<Tracer>(tower, mode, lower, upper, function, options);
    tracer->find(cutters);
    return tracer;
  };
  if (options.searches == nullptr) return find();
  KnownSearches::Key key =
      KnownSearches::key(KnownSearches::Key::Kind::curve, tower, mode, lower, upper, options.special);
  for (const int number :
       {options.most_cells, options.whole_or_nothing ? 1 : 0, options.colour ? 1 : 0, options.certificate ? 1 : 0})
    key.numbers.push_back(number);
  key.numbers.insert(key.numbers.end(), options.closed_form.begin(), options.closed_form.end());
  key.numbers.insert(key.numbers.end(), options.along_side.begin(), options.along_side.end());
  key.polynomials.push_back(function.polynomial);
  for (const Cutter& cutter : cutters) {
    key.numbers.push_back(static_cast<int>(cutter.label));
    key.numbers.push_back(cutter.keep ? 1 : 0);
    key.polynomials.push_back(cutter.sheet.polynomial);
  }
  return options.searches->get<Tracer>(key, find);
}

/// What is traced on the plane below a root where a sheet is the root's rim or a factor of its square; nothing where it
/// is neither.
std::optional<SheetFunction> on_rim_of(const core::RootTower& tower, int root, const core::Polynomial& sheet,
                                       const std::vector<Star>& special) {
  const core::Root& root_of_line = tower.roots[static_cast<std::size_t>(root)];
  if (core::depends_on(sheet, 2 + root)) return std::nullopt;
  for (const core::Rim& rim : root_of_line.rims)
    if (rim.polynomial == sheet) return SheetFunction{rim.polynomial, rim.line};
  if (!root_of_line.rims.empty() && root_of_line.bounds.empty()) return std::nullopt;
  const std::optional<core::Polynomial> rest = exact_quotient(root_of_line.square, sheet);
  if (!rest) return std::nullopt;
  SheetFunction boundary = square_of(tower, root, special);
  // The line is that of the whole square: of the boundary where the rest are denominators.
  if (!without_denominators(*rest, tower).is_constant()) boundary.line = {};
  boundary.polynomial = sheet;
  return boundary;
}

/// Whether a boundary is that of a cut, traced in two: there the square cos(angle) - cos(end) has two zeros side by
/// side, and sin(angle -+ end) one each.
bool has_sides(const core::RootTower& tower, const core::Root& bound, const core::Polynomial& sheet) {
  if (bound.bounds.empty() || bound.rims.empty()) return false;
  const std::optional<core::Polynomial> rest = exact_quotient(bound.square, sheet);
  return rest && without_denominators(*rest, tower).is_constant();
}

/// Where the angle is more than a quarter turn: the other zeros of sin(angle -+ end) are where it is less.
std::optional<SheetFunction> beyond_quarter_turn(const core::RootTower& tower, const core::Root& bound) {
  for (const core::Root& root : tower.roots)
    if (root.is_angle() && root.point == bound.bounds)
      return SheetFunction{core::constant_polynomial(tower.variables(), -1) * root.cosine_and_sine[0]};
  return std::nullopt;
}

/// A sheet that is zero all along a root's rim, divided by the root; nothing where it is not seen to be. With Q = g h,
/// h made of squared distances from points, a g + b s is s (a s + b h) / h.
std::optional<core::Polynomial> without_root(const core::RootTower& tower, int root, const core::Polynomial& sheet) {
  if (!core::depends_on(sheet, 2 + root)) return std::nullopt;
  core::Polynomial free{sheet.variables, {}}, by_root = free;
  for (core::Term term : sheet.terms) {
    int& power = term.exponents[2 + static_cast<std::size_t>(root)];
    core::Polynomial& part = power > 0 ? by_root : free;
    power = std::max(0, power - 1);
    part.terms.push_back(std::move(term));
  }
  if (free.is_zero()) return by_root;
  if (core::depends_on(by_root, 2 + root)) return std::nullopt;
  const core::Polynomial& square = tower.roots[static_cast<std::size_t>(root)].square;
  if (square.is_zero()) return std::nullopt;
  const core::Polynomial rim = without_denominators(square, tower);
  const std::optional<core::Polynomial> rest = exact_quotient(free, rim), points = exact_quotient(square, rim);
  if (!rest || !points || rim.is_constant()) return std::nullopt;
  return without_denominators(*rest * core::variable_polynomial(sheet.variables, 2 + root) + by_root * *points, tower);
}

void append(SheetTrace& all, SheetTrace part) {
  all.arcs.insert(all.arcs.end(), part.arcs.begin(), part.arcs.end());
  all.claims.insert(all.claims.end(), part.claims.begin(), part.claims.end());
  all.isolated_points.insert(all.isolated_points.end(), part.isolated_points.begin(), part.isolated_points.end());
  all.undecided.insert(all.undecided.end(), part.undecided.begin(), part.undecided.end());
  all.certified = all.certified && part.certified;
  all.stopped = all.stopped || part.stopped;
}

/// A curve along which a root is zero: s_j = 0, or a rim.
struct RootCurve {
  int root = 0;
  const core::Polynomial& sheet;
  const std::optional<SheetFunction>& rim;
};

/// On the plane below the root.
SheetTrace trace_boundary(const core::RootTower& tower, const core::WorkingMode& mode,
                          const std::vector<core::Rational>& lower, const std::vector<core::Rational>& upper,
                          const RootCurve& curve, const std::vector<Cutter>& cutters,
                          const SheetTraceOptions& options) {
  const auto j = static_cast<std::size_t>(curve.root);
  const int v = 2 + curve.root;
  core::WorkingMode rest = mode;
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(j));
  std::vector<Cutter> on_boundary;
  for (const Cutter& cutter : cutters) {
    const SheetFunction there = without_variable(cutter.sheet, v);
    if (!there.polynomial.is_constant())
      on_boundary.push_back({there, cutter.label, cutter.keep});
    else if (cutter.keep && (there.polynomial.is_zero() || there.polynomial.terms.front().coefficient < 0))
      return {};  // none of the boundary is wanted
  }
  const core::RootTower below = on_rim(tower, curve.root);
  const SheetFunction boundary = curve.rim ? *curve.rim : square_of(tower, curve.root, options.special);
  SheetTraceOptions there = options;
  there.special = on_rim(options.special, curve.root);
  std::vector<SheetFunction> parts = {boundary};
  const core::Root& root = tower.roots[j];
  // A certificate names the factor itself.
  if (const auto within = beyond_quarter_turn(tower, root);
      curve.rim && within && !options.certificate && has_sides(tower, root, curve.sheet)) {
    parts.clear();
    for (const core::Rim& side : root.rims) parts.push_back({side.polynomial, side.line});
    on_boundary.push_back({without_variable(*within, v), core::ArcEnd::boundary, true});
  }
  SheetTrace all;
  for (const SheetFunction& part : parts)
    append(all, trace_sheet(below, rest, lower, upper, without_variable(part, v), on_boundary, there));
  for (core::SheetClaim& claim : all.claims) put_back(claim, curve.root);
  return all;
}

}  // namespace

bool reaches(const core::RootTower& tower, const core::WorkingMode& mode, const SheetFunction& sheet, const Star& star,
             const std::array<double, 4>& box) {
  const Subtower part = subtower(tower, mode, {sheet.polynomial});
  const Partition parts = partition(part.tower, box, bases(tower), narrowed({star}, part));
  for (std::size_t i = 0; i < parts.stars.size(); ++i)
    if (parts.stars[i].at_same_place(star)) return found_at_star(part, sheet, parts, static_cast<int>(i), {});
  return false;
}

SheetTrace trace_sheet(const core::RootTower& tower, const core::WorkingMode& mode,
                       const std::vector<core::Rational>& lower, const std::vector<core::Rational>& upper,
                       const SheetFunction& function, const std::vector<Cutter>& cutters,
                       const SheetTraceOptions& options) {
  const core::Polynomial& sheet = function.polynomial;
  core::ensure(!sheet.is_zero(), "a curve's polynomial is not zero");
  if (sheet.is_constant()) return {};
  // s_j = 0 and the factors of Q_j are the workspace boundary: curves of the plane below root j.
  for (std::size_t j = 0; j < tower.roots.size(); ++j) {
    if (tower.roots[j].is_angle()) continue;
    const std::optional<SheetFunction> rim = on_rim_of(tower, static_cast<int>(j), sheet, options.special);
    const std::optional<core::Polynomial> quotient =
        rim ? std::nullopt : without_root(tower, static_cast<int>(j), sheet);
    if (!rim && !quotient) continue;
    SheetTrace all = trace_boundary(tower, mode, lower, upper, {static_cast<int>(j), sheet, rim}, cutters, options);
    if (quotient) append(all, trace_sheet(tower, mode, lower, upper, {*quotient}, cutters, options));
    return all;
  }
  return found(tower, mode, lower, upper, function, cutters, options)->trace(options.tolerance);
}

}  // namespace clearloci::loci::sheet
