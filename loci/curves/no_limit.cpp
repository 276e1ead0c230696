#include "loci/curves/no_limit.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {
namespace {

using core::LocusFactor;
using core::Rational;
using sheet::SheetFunction;

/// The place of a component of the force, 0 for fx and 1 for fy, that a factor is of; none: of neither or both.
std::optional<std::size_t> component_of(const LocusFactor& factor, const std::string& joint) {
  std::array<bool, 2> is_of{};
  for (const core::Vanishing& v : factor.vanishing)
    for (const std::size_t c : {0, 1})
      is_of[c] = is_of[c] || (v.joint == joint && v.quantity == (c == 0 ? core::Quantity::fx : core::Quantity::fy));
  if (is_of[0] == is_of[1]) return std::nullopt;
  return is_of[0] ? 0 : 1;
}

/// A box around a zero in local coordinates: roots that may vanish there are coordinates of their own.
class Neighbourhood {
 public:
  Neighbourhood(const core::LocusProblem& problem, const core::WorkingMode& mode, const sheet::SheetZero& zero,
                double reach)
      : problem_(problem), mode_(mode) {
    const sheet::SheetProgram roots = program_of({});
    sheet::SheetCell cell(roots, mode);
    const core::Interval around(-reach, reach);
    if (!cell.enter(core::Interval(zero.x) + around, core::Interval(zero.y) + around)) return;
    lifted_ = cell.lifted();
    // The square of such a root varies as much as the coordinates do: these need more room.
    constexpr double more_room = 8, margin = 0.6;
    const core::Interval wide = lifted_.empty() ? around : core::Interval(more_room) * around;
    box_ = {core::Interval(zero.x) + wide, core::Interval(zero.y) + wide};
    for (const int j : lifted_) {
      const core::Interval& root = cell.root(j);
      box_.push_back(root + core::Interval(-margin * root.width(), margin * root.width()));
    }
  }

  /// Whether two functions are proven to have exactly one zero in it; then it is what is left of it around that one.
  bool narrow(const SheetFunction& first, const SheetFunction& second) {
    const sheet::SheetProgram program = program_of({first, second});
    sheet::SheetCell cell(program, mode_);
    const std::optional<Proof> proof = prove(cell);
    if (proof) box_ = proof->box;
    return proof.has_value();
  }

  /// Whether they have one in it at which a third one does not vanish.
  bool has_zero_without(const SheetFunction& first, const SheetFunction& second, const SheetFunction& third) const {
    const sheet::SheetProgram program = program_of({first, second, third});
    sheet::SheetCell cell(program, mode_);
    const std::optional<Proof> proof = prove(cell);
    return proof && cell.enter_local(proof->zero, lifted_) && cell.value(2).sign() != 0;
  }

 private:
  sheet::SheetProgram program_of(const std::vector<SheetFunction>& functions) const {
    return {problem_.tower, functions};
  }

  using Box = std::vector<core::Interval>;
  struct Proof {
    Box box;   ///< in which there is exactly one zero, and without which there is none in the neighbourhood
    Box zero;  ///< which encloses it
  };

  /// Zeros are in the image of what they are in, which may be too wide in one coordinate alone.
  std::optional<Proof> prove(sheet::SheetCell& cell) const {
    constexpr int most_steps = 6;
    Proof proof{box_, {}};
    for (int step = 0; step < most_steps && !proof.box.empty(); ++step) {
      if (!cell.enter_local(proof.box, lifted_)) return std::nullopt;
      cell.differentiate();
      if (cell.rounding_dominates(0) || cell.rounding_dominates(1)) cell.sharpen_middle();
      const sheet::ZeroCount count = sheet::krawczyk(cell, {}, proof.zero);
      if (count == sheet::ZeroCount::unique) return proof;
      if (count == sheet::ZeroCount::none || proof.zero.empty()) return std::nullopt;
      for (std::size_t c = 0; c < proof.box.size(); ++c) proof.box[c] = meet(proof.box[c], proof.zero[c]);
    }
    return std::nullopt;
  }

  const core::LocusProblem& problem_;
  const core::WorkingMode& mode_;
  std::vector<int> lifted_;
  Box box_;  ///< empty: out of reach
};

double size_of(const core::LocusProblem& problem) {
  double size = 0;
  for (std::size_t c = 0; c < 2; ++c)
    size = std::max(size, core::to_double(Rational(problem.upper[c] - problem.lower[c])));
  return size;
}

/// Whether a factor of |A| is proven to be zero at a zero of the system: it is of the system itself, or all of them
/// vanish at a rational point.
bool is_zero_there(const core::LocusProblem& problem, const core::WorkingMode& mode, const LocusFactor& singular,
                   const ForceZeros& zeros, const sheet::SheetZero& zero) {
  std::vector<core::Polynomial> functions = {singular.sheet};
  for (const LocusFactor* const function : zeros.system) {
    if (function->sheet == singular.sheet) return true;
    functions.push_back(function->sheet);
  }
  // Of a zero of the program alone nothing tells exactly.
  if (std::any_of(functions.begin(), functions.end(), [](const core::Polynomial& p) { return p.is_zero(); }))
    return false;
  const sheet::Subtower own = sheet::subtower(problem.tower, mode, functions);
  for (core::Polynomial& function : functions) function = sheet::narrowed(function, own);
  const core::Interval around(-zero.radius, zero.radius);
  return sheet::vanish_exactly(own.tower, own.mode, functions,
                               {core::Interval(zero.x) + around, core::Interval(zero.y) + around});
}

/// Factors of |A| that are proven to be zero there.
std::vector<SheetFunction> zero_there(const core::LocusProblem& problem, const core::WorkingMode& mode,
                                      const ForceZeros& zeros, const sheet::SheetZero& zero) {
  std::vector<SheetFunction> list;
  for (const LocusFactor& factor : problem.factors)
    if (factor.role == core::FactorRole::direct_singularity && is_zero_there(problem, mode, factor, zeros, zero))
      list.push_back({factor.sheet, factor.line});
  return list;
}

/// Whether a numerator crosses a factor of |A| that is zero there: that zero is a simple one of both, so that their
/// quotient has more than one limit around.
bool crosses(const core::LocusProblem& problem, const core::WorkingMode& mode, const core::ForceProbe& probe,
             const SheetFunction& singular, const sheet::SheetZero& zero, double reach) {
  const core::Polynomial none{problem.tower.variables(), {}};
  return std::any_of(probe.numerators.begin(), probe.numerators.end(), [&](const core::StraightLine& numerator) {
    return Neighbourhood(problem, mode, zero, reach).narrow(singular, {none, numerator});
  });
}

}  // namespace

NoLimit no_limit(const core::LocusProblem& problem, const core::WorkingMode& mode, const std::string& joint,
                 const ForceZeros& zeros, const sheet::SheetZero& zero) {
  const auto probe = std::find_if(problem.force_probes.begin(), problem.force_probes.end(),
                                  [&](const core::ForceProbe& known) { return known.joint == joint; });
  if (probe == problem.force_probes.end()) return NoLimit::unknown;
  const core::Polynomial none{problem.tower.variables(), {}};
  // Of functions that stand for the components (core::ForcePairs) the whole numerators tell.
  std::vector<std::pair<std::size_t, SheetFunction>> components;
  for (const LocusFactor* const factor : zeros.system)
    if (const std::optional<std::size_t> own = component_of(*factor, joint))
      components.emplace_back(*own, SheetFunction{factor->sheet, factor->line});
  if (components.empty())
    for (const std::size_t c : {0, 1}) components.emplace_back(c, SheetFunction{none, probe->numerators[c]});
  constexpr std::array shares = {1e-9, 1e-7};  // of the box
  const auto reach_of = [&](double share) { return std::max(share * size_of(problem), 16 * zero.radius); };
  for (const double share : shares) {
    if (zeros.third != nullptr) break;
    const Neighbourhood whole(problem, mode, zero, reach_of(share));
    for (const auto& [own, component] : components) {
      Neighbourhood around = whole;
      if (!around.narrow(component, {none, probe->numerators[1 - own]})) continue;
      for (const LocusFactor& singular : problem.factors)
        if (singular.role == core::FactorRole::direct_singularity &&
            around.has_zero_without(component, {singular.sheet, singular.line}, {none, probe->probes[own]}))
          return NoLimit::of_all;
    }
  }
  for (const SheetFunction& singular : zero_there(problem, mode, zeros, zero))
    for (const double share : shares)
      if (crosses(problem, mode, *probe, singular, zero, reach_of(share))) return NoLimit::of_joint;
  return NoLimit::unknown;
}

}  // namespace clearloci::loci
