#include "loci/sheet/fine_zero.hpp"

#include <algorithm>
#include <array>

#include "loci/numbers/numbers.hpp"

namespace clearloci::loci::sheet {

namespace {

using core::Rational;

// Each step gains about as many digits as slopes in doubles have; some bits of MultiInterval are lost to rounding.
constexpr int most_steps = 12;
constexpr double uncertain_slopes = 0.5;
const Rational fine_enough(1, core::Integer(1) << (MultiInterval::precision * 3 / 4));

/// Values at places whose squares are all proven positive; false where one is not.
class Values {
 public:
  Values(const SheetProgram& program, const core::WorkingMode& mode)
      : program_(&program), mode_(mode), registers_(program.registers<MultiInterval>()) {}

  bool run(const MultiInterval& x, const MultiInterval& y) {
    registers_.set(0, x);
    registers_.set(1, y);
    for (int j = 0; j < program_->roots(); ++j) {
      registers_.run_square(j);
      if (registers_.square(j).sign() <= 0) return false;
      const MultiInterval root = square_root(registers_.square(j));
      registers_.set(2 + j, mode_[static_cast<std::size_t>(j)] > 0 ? root : -root);
    }
    registers_.run_values();
    return true;
  }
  const MultiInterval& value(int function) const { return registers_.value(function); }
  const MultiInterval& root(int j) const { return registers_.root(j); }

 private:
  const SheetProgram* program_;
  const core::WorkingMode& mode_;
  SheetProgram::Registers<MultiInterval> registers_;
};

/// Y ~ F'(m)^-1, and how far Y F'(X) is from 1 at most.
struct Slopes {
  std::array<double, 4> inverse;
  double defect = 1;
};

std::optional<Slopes> slopes_over(const SheetProgram& program, const core::WorkingMode& mode, const Interval& x,
                                  const Interval& y) {
  SheetCell cell(program, mode);
  if (!cell.enter(x, y) || !cell.lifted().empty()) return std::nullopt;
  cell.differentiate();
  Slopes slopes;
  std::array<double, 4> middle;
  std::size_t place = 0;
  for (const int f : {0, 1})
    for (const int c : {0, 1}) middle[place++] = cell.slope(f, c).middle();
  if (!invert(middle, slopes.inverse, 2)) return std::nullopt;
  double worst = 0;
  for (std::size_t row = 0; row < 2; ++row) {
    double sum = 0;
    for (int c = 0; c < 2; ++c) {
      Interval entry = static_cast<int>(row) == c ? -1.0 : 0.0;
      for (int f = 0; f < 2; ++f)
        entry = entry + Interval(slopes.inverse[2 * row + static_cast<std::size_t>(f)]) * cell.slope(f, c);
      sum += entry.magnitude();
    }
    worst = std::max(worst, sum);
  }
  slopes.defect = worst * (1 + 0x1p-50);
  return slopes.defect < uncertain_slopes ? std::optional(slopes) : std::nullopt;
}

Rational magnitude(const MultiInterval& value) {
  return std::max(Rational(abs(value.lower_end())), Rational(abs(value.upper_end())));
}

}  // namespace

std::optional<FineZero> fine_zero(const SheetProgram& program, const core::WorkingMode& mode, const Interval& x,
                                  const Interval& y) {
  for (const core::Root& root : program.tower().roots)
    if (root.is_angle()) return std::nullopt;
  const std::optional<Slopes> slopes = slopes_over(program, mode, x, y);
  if (!slopes) return std::nullopt;
  const std::array<const Interval*, 2> box = {&x, &y};
  std::array<Rational, 2> at = {Rational(x.middle()), Rational(y.middle())};
  Values values(program, mode);
  FineZero zero;
  for (int step = 0; step < most_steps; ++step) {
    if (!values.run(MultiInterval(at[0]), MultiInterval(at[1]))) return std::nullopt;
    Rational longest = 0;
    bool in_box = true;
    std::array<Rational, 2> next;
    for (std::size_t c = 0; c < 2; ++c) {
      const MultiInterval interval = MultiInterval(slopes->inverse[2 * c]) * values.value(0) +
                                     MultiInterval(slopes->inverse[2 * c + 1]) * values.value(1);
      longest = std::max(longest, magnitude(interval));
      next[c] = (MultiInterval(at[c]) - interval).lower_end();
      in_box = in_box && Rational(box[c]->lower()) <= next[c] && next[c] <= Rational(box[c]->upper());
    }
    const Rational radius = longest / (1 - Rational(slopes->defect));
    if (step == 0 || radius < zero.radius) zero = {at[0], at[1], radius, {}};
    if (!in_box || zero.radius < fine_enough) break;
    at = next;
  }
  const auto around = [&](const Rational& value) {
    return MultiInterval(Rational(value - zero.radius), Rational(value + zero.radius));
  };
  if (!values.run(around(zero.x), around(zero.y))) return std::nullopt;
  for (int j = 0; j < program.roots(); ++j) zero.roots.push_back(values.root(j));
  return zero;
}

}  // namespace clearloci::loci::sheet
