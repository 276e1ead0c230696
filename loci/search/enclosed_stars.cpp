#include "loci/search/enclosed_stars.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::sheet {
namespace {

using core::Rational;

/// A star at the zero of functions 0 and 1 of the program, as an enclosure; what vanishes there is left open.
std::optional<Star> enclosed_star(const SheetZero& zero, const core::RootTower& tower, const Subtower& part,
                                  const SheetProgram& program) {
  constexpr double slack = 4;
  const double radius = slack * std::max(zero.radius, 0x1p-50 * std::max(std::abs(zero.x), std::abs(zero.y)));
  const std::optional<FineZero> fine =
      fine_zero(program, part.mode, {zero.x - radius, zero.x + radius}, {zero.y - radius, zero.y + radius});
  if (!fine) return std::nullopt;
  Star star;
  star.x = fine->x;
  star.y = fine->y;
  Apex apex;
  apex.radius = fine->radius;
  apex.roots.resize(tower.roots.size());
  for (std::size_t j = 0; j < fine->roots.size(); ++j) {
    const Rational lower = fine->roots[j].lower_end(), upper = fine->roots[j].upper_end();
    apex.roots[static_cast<std::size_t>(part.kept[j])] = {(lower + upper) / 2, (upper - lower) / 2, true};
  }
  star.apex = std::move(apex);
  return star;
}

/// The box and a little around it: a star next to the box reaches into it.
struct Surroundings {
  std::vector<Rational> lower, upper;

  Surroundings(const std::vector<Rational>& from, const std::vector<Rational>& to) : lower(from), upper(to) {
    const Rational around(1, 50);
    for (std::size_t c = 0; c < 2; ++c) {
      const Rational margin = around * (to[c] - from[c]);
      lower[c] -= margin;
      upper[c] += margin;
    }
  }
};

/// The rim of a root of a part, as a part itself: the plane below the root.
Subtower below(const Subtower& part, int root) {
  Subtower rim = part;
  rim.tower = on_rim(part.tower, root);
  rim.mode.erase(rim.mode.begin() + root);
  rim.kept.erase(rim.kept.begin() + root);
  return rim;
}

/// The nodes that forms have in common, where part `first` of one of them and the last part vanish; or, where the last
/// part vanishes all along the rim of a root, those on that rim.
class Nodes {
 public:
  /// `rim`: of the tower's roots; -1: none.
  Nodes(const core::RootTower& tower, const core::WorkingMode& mode, const std::vector<const core::NodeForm*>& forms,
        const core::NodeForm& form, std::size_t first, int rim)
      : tower_(tower), forms_(forms), part_(part_of(tower, mode, forms)), rim_(rim) {
    const Subtower whole = part_;
    const auto place = std::find(whole.kept.begin(), whole.kept.end(), rim);
    const int root = static_cast<int>(place - whole.kept.begin());
    if (rim >= 0) part_ = below(whole, root);
    const auto add_function = [&](const SheetFunction& function) {
      functions_.push_back(rim < 0 ? function : without_variable(function, 2 + root));
    };
    const auto add = [&](const core::NodeForm::Part& part) {
      add_function({narrowed(part.sheet, whole), narrowed(part.line, whole)});
    };
    add(form.parts[first]);
    if (rim < 0)
      add(form.parts.back());
    else
      add_function({whole.tower.roots[static_cast<std::size_t>(root)].square,
                    line_of(whole.tower.roots[static_cast<std::size_t>(root)].square)});
    for (const core::NodeForm* other : forms) std::for_each(other->parts.begin(), other->parts.end(), add);
    add_function({core::Polynomial{whole.tower.variables(), {}}, narrowed(form.probes[first], whole)});
  }

  /// The roots along whose rims the last part vanishes; of those that stand on no other root.
  static std::vector<int> rims(const core::RootTower& tower, const core::NodeForm& form) {
    const core::Polynomial& last = form.parts.back().sheet;
    std::vector<int> roots;
    for (int j = 0; j < static_cast<int>(tower.roots.size()); ++j) {
      const core::Root& root = tower.roots[static_cast<std::size_t>(j)];
      if (root.is_angle() || !without_variable(last, 2 + j).is_zero()) continue;
      bool stands = false;
      for (int other = 0; other < static_cast<int>(tower.roots.size()); ++other)
        stands = stands || core::depends_on(root.square, 2 + other);
      if (!stands) roots.push_back(j);
    }
    return roots;
  }

  void add_to(std::vector<Star>& stars, const Surroundings& box, ZeroOptions options) const {
    if (std::any_of(functions_.begin(), functions_.end(), [](const SheetFunction& f) { return f.line.empty(); }))
      return;
    options.special = narrowed(options.special, part_);
    const ZeroSet found =
        isolated_zeros(part_.tower, part_.mode, functions_[0], functions_[1], box.lower, box.upper, options);
    if (found.zeros.empty()) return;
    const SheetProgram program(part_.tower, functions_);
    for (const SheetZero& zero : found.zeros) {
      if (!zero.inside_workspace || is_known(stars, zero)) continue;
      std::optional<Star> star = enclosed_star(zero, tower_, part_, program);
      if (!star || !all_vanish(program, *star)) continue;
      star->singular = true;
      if (rim_ >= 0 && !put_on_rim(*star)) continue;
      star->room = room_around(program, zero, box);
      for (const core::NodeForm* form : forms_)
        for (const core::NodeForm::Part& part : form->parts) star->apex->vanishing.push_back(part.line);
      stars.push_back(std::move(*star));
    }
  }

 private:
  static core::StraightLine line_of(const core::Polynomial& p) {
    core::StraightLineBuilder builder;
    std::vector<int> variables;
    for (int v = 0; v < p.variables; ++v) variables.push_back(builder.variable(v));
    return builder.line(builder.polynomial(p, variables));
  }

  /// Sheared along the tangent of the rim. False: it is not known well enough.
  bool put_on_rim(Star& star) const {
    std::vector<MultiInterval> at(static_cast<std::size_t>(tower_.variables()), MultiInterval(Rational(0)));
    at[0] = {star.x - star.apex->radius, star.x + star.apex->radius};
    at[1] = {star.y - star.apex->radius, star.y + star.apex->radius};
    const core::Polynomial& square = tower_.roots[static_cast<std::size_t>(rim_)].square;
    const MultiInterval dx = evaluate(core::derivative(square, 0), at), dy = evaluate(core::derivative(square, 1), at);
    const auto size = [](const MultiInterval& d) -> Rational { return abs(Rational(d.lower_end() + d.upper_end())); };
    star.shape = Star::Shape::touch;
    star.along_y = size(dx) > size(dy);
    const MultiInterval &off = star.along_y ? dx : dy, &along = star.along_y ? dy : dx;
    if (off.sign() == 0) return false;
    const MultiInterval slope = -along * inverse(off);
    const Rational lower = slope.lower_end(), upper = slope.upper_end();
    star.slope = (lower + upper) / 2;
    star.apex->slope_radius = (upper - lower) / 2;
    star.roots = {rim_};
    return true;
  }

  static Subtower part_of(const core::RootTower& tower, const core::WorkingMode& mode,
                          const std::vector<const core::NodeForm*>& forms) {
    std::vector<core::Polynomial> all;
    for (const core::NodeForm* form : forms)
      for (const core::NodeForm::Part& part : form->parts) all.push_back(part.sheet);
    return subtower(tower, mode, all);
  }

  /// How far no root gets near zero, to all appearance: next to a workspace boundary what is written around the node is
  /// enclosed badly.
  static double room_around(const SheetProgram& program, const SheetZero& zero, const Surroundings& box) {
    constexpr int directions = 16, most_halvings = 24;
    constexpr double widest = 0.06, least_square = 0.3;
    auto registers = program.registers<double>();
    const auto squares_at = [&](double x, double y) {
      std::vector<double> squares;
      registers.set(0, x);
      registers.set(1, y);
      for (int j = 0; j < program.roots(); ++j) {
        registers.run_square(j);
        squares.push_back(registers.square(j));
        const double root = std::sqrt(std::max(0.0, squares.back()));
        registers.set(2 + j, zero.roots[static_cast<std::size_t>(j)] < 0 ? -root : root);
      }
      return squares;
    };
    const std::vector<double> middle = squares_at(zero.x, zero.y);
    const auto is_clear = [&](double reach) {
      for (int k = 0; k < directions; ++k) {
        const double angle = 2 * std::numbers::pi * k / directions;
        const std::vector<double> squares =
            squares_at(zero.x + reach * std::cos(angle), zero.y + reach * std::sin(angle));
        for (std::size_t j = 0; j < squares.size(); ++j)
          if (!(squares[j] > least_square * middle[j])) return false;
      }
      return true;
    };
    double reach =
        widest * std::max(core::to_double(box.upper[0] - box.lower[0]), core::to_double(box.upper[1] - box.lower[1]));
    for (int k = 0; k < most_halvings && !is_clear(std::numbers::sqrt2 * reach); ++k) reach /= 2;
    return reach;
  }

  static bool is_known(const std::vector<Star>& stars, const SheetZero& zero) {
    return std::any_of(stars.begin(), stars.end(), [&](const Star& other) {
      return std::max(std::abs(core::to_double(other.x) - zero.x), std::abs(core::to_double(other.y) - zero.y)) <=
             2 * zero.radius;
    });
  }

  /// By the probe, which does not vanish there.
  bool all_vanish(const SheetProgram& program, const Star& star) const {
    auto registers = program.registers<MultiInterval>();
    const auto enclosure = [](const Rational& value, const Rational& radius) {
      return MultiInterval(value - radius, value + radius);
    };
    registers.set(0, enclosure(star.x, star.apex->radius));
    registers.set(1, enclosure(star.y, star.apex->radius));
    for (int j = 0; j < program.roots(); ++j) {
      registers.run_square(j);
      const Apex::Value& root = star.apex->roots[static_cast<std::size_t>(part_.kept[static_cast<std::size_t>(j)])];
      registers.set(2 + j, enclosure(root.middle, root.radius));
    }
    registers.run_values();
    const int probe = program.functions() - 1;
    for (int f = 0; f < probe; ++f)
      if (registers.value(f).sign() != 0) return false;
    return registers.value(probe).sign() != 0;
  }

  const core::RootTower& tower_;
  const std::vector<const core::NodeForm*>& forms_;
  Subtower part_;
  int rim_ = -1;
  std::vector<SheetFunction> functions_;  ///< the two that are looked for, all parts, the probe
};

bool is_linear(const core::DyadBase& way) { return core::total_degree(way.x) <= 1 && core::total_degree(way.y) <= 1; }

}  // namespace

std::vector<Star> enclosed_cones(const core::RootTower& tower, const core::WorkingMode& mode,
                                 const std::vector<Rational>& lower, const std::vector<Rational>& upper) {
  const Surroundings box(lower, upper);
  std::vector<Star> stars;
  const auto add = [&](Star star) {
    const bool is_known =
        std::any_of(stars.begin(), stars.end(), [&](const Star& other) { return other.at_same_place(star); });
    if (!is_known) stars.push_back(std::move(star));
  };
  for (const core::DyadBase& base : tower.bases) {
    if (!is_leg(base) && is_linear(base)) continue;  // cones() knows it exactly
    if (std::optional<std::vector<Star>> exact = zeros_of_way(tower, base, box.lower, box.upper)) {
      for (Star& star : *exact) add(std::move(star));
      continue;
    }
    if (is_leg(base)) continue;  // of what vanishes with it nothing is recognised
    const Subtower part = subtower(tower, mode, {base.x, base.y});
    const SheetFunction x = {narrowed(base.x, part), narrowed(base.x_line, part)};
    const SheetFunction y = {narrowed(base.y, part), narrowed(base.y_line, part)};
    const ZeroSet found = isolated_zeros(part.tower, part.mode, x, y, box.lower, box.upper);
    if (found.zeros.empty()) continue;
    const SheetProgram program(part.tower, {x, y});
    for (const SheetZero& zero : found.zeros) {
      if (!zero.inside_workspace) continue;
      std::optional<Star> star = enclosed_star(zero, tower, part, program);
      if (!star) continue;
      star->apex->vanishing = {base.x_line, base.y_line};
      find_roots_of(*star, tower);
      if (!star->roots.empty()) add(std::move(*star));
    }
  }
  return stars;
}

std::vector<Star> enclosed_nodes(const core::RootTower& tower, const core::WorkingMode& mode,
                                 const std::vector<const core::NodeForm*>& forms, const std::vector<Rational>& lower,
                                 const std::vector<Rational>& upper, const ZeroOptions& options) {
  const Surroundings box(lower, upper);
  std::vector<Star> stars;
  for (const core::NodeForm* form : forms)
    for (std::size_t first = 0; first < form->probes.size(); ++first) {
      Nodes(tower, mode, forms, *form, first, -1).add_to(stars, box, options);
      for (const int rim : Nodes::rims(tower, *form))
        Nodes(tower, mode, forms, *form, first, rim).add_to(stars, box, options);
    }
  return stars;
}

}  // namespace clearloci::loci::sheet
