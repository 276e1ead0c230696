#include "loci/curves/star_touch.hpp"

#include <utility>

#include "loci/numbers/numbers.hpp"

namespace clearloci::loci::sheet {
namespace {

using core::Rational;
using core::StraightLine;

/// value + slope h + curve h^2 + ... along one coordinate.
template <class T>
struct Along {
  T value{}, slope{}, curve{};
};

template <class T>
Along<T> times(const Along<T>& a, const Along<T>& b) {
  return {a.value * b.value, a.value * b.slope + a.slope * b.value,
          a.value * b.curve + a.slope * b.slope + a.curve * b.value};
}

/// Nothing: no number, or one that is not known exactly.
std::optional<Surd> number_of(const StraightLine::Step& step, Surd*) {
  if (step.radius() != 0) return std::nullopt;
  return Surd(step.value());
}
std::optional<Interval> number_of(const StraightLine::Step& step, Interval* kind) {
  return enclosed_as(step.value(), step.radius(), kind);
}
std::optional<Surd> reciprocal(const Surd& a) { return a.reciprocal(); }
std::optional<Interval> reciprocal(const Interval& a) {
  if (a.sign() == 0) return std::nullopt;
  return inverse(a);
}
std::optional<Surd> root_of(const Surd& square) {
  const std::optional<Rational> rational = square.rational();
  if (!rational || *rational <= 0) return std::nullopt;
  return Surd::root_of(*rational);
}
std::optional<Interval> root_of(const Interval& square) {
  if (square.sign() <= 0) return std::nullopt;
  return square_root(square);
}

template <class T>
std::optional<Along<T>> run(const StraightLine& line, const std::vector<Along<T>>& variables) {
  using Operation = StraightLine::Operation;
  std::vector<Along<T>> values;
  for (const StraightLine::Step& step : line.steps) {
    const auto operand = [&](int index) -> const Along<T>& { return values[static_cast<std::size_t>(index)]; };
    switch (step.operation) {
      case Operation::constant: {
        const std::optional<T> number = number_of(step, static_cast<T*>(nullptr));
        if (!number) return std::nullopt;
        values.push_back({*number, T(0), T(0)});
        break;
      }
      case Operation::variable:
        values.push_back(variables[static_cast<std::size_t>(step.first)]);
        break;
      case Operation::add: {
        const Along<T>&a = operand(step.first), &b = operand(step.second);
        values.push_back({a.value + b.value, a.slope + b.slope, a.curve + b.curve});
        break;
      }
      case Operation::subtract: {
        const Along<T>&a = operand(step.first), &b = operand(step.second);
        values.push_back({a.value - b.value, a.slope - b.slope, a.curve - b.curve});
        break;
      }
      case Operation::multiply:
        values.push_back(times(operand(step.first), operand(step.second)));
        break;
      case Operation::inverse: {
        const Along<T>& a = operand(step.first);
        const std::optional<T> b = reciprocal(a.value);
        if (!b) return std::nullopt;
        const T slope = T(0) - a.slope * *b * *b;
        values.push_back({*b, slope, T(0) - (a.slope * slope + a.curve * *b) * *b});
        break;
      }
      default:
        return std::nullopt;
    }
  }
  if (values.empty()) return std::nullopt;
  return values.back();
}

/// The function at (u, t) with h added to one of them, and the roots there.
template <class T>
std::optional<Along<T>> value_along(const ChartedSheet& sheet, const core::WorkingMode& mode, const T& u, const T& t,
                                    int coordinate, std::vector<Along<T>>& variables) {
  variables = {{u, T(coordinate == 0 ? 1 : 0), T(0)}, {t, T(coordinate == 1 ? 1 : 0), T(0)}};
  for (std::size_t j = 0; j < sheet.tower.roots.size(); ++j) {
    const core::Root& root = sheet.tower.roots[j];
    const std::optional<Along<T>> square = root.is_angle() ? std::nullopt : run(root.line, variables);
    const std::optional<T> size = square ? root_of(square->value) : std::nullopt;
    if (!size) return std::nullopt;
    const T s = mode[j] > 0 ? *size : T(T(0) - *size);
    const std::optional<T> half = reciprocal(T(s + s));
    if (!half) return std::nullopt;
    const T slope = square->slope * *half;
    variables.push_back({s, slope, (square->curve - slope * slope) * *half});
  }
  return run(sheet.functions.front().line, variables);
}

}  // namespace

std::optional<StarTouch> star_touch(const Chart& chart, const ChartedSheet& sheet, const core::WorkingMode& mode,
                                    const Interval& t) {
  const Rational at = chart.shortest_direction(t);
  std::vector<Along<Surd>> exact;
  const auto touch = value_along<Surd>(sheet, mode, Surd(0), Surd(at), 1, exact);
  if (!touch || !touch->value.is_zero() || !touch->slope.is_zero()) return std::nullopt;
  std::vector<Along<Interval>> around;
  const Interval place = enclosed_as(at, Rational(0), static_cast<Interval*>(nullptr));
  const auto along = value_along<Interval>(sheet, mode, Interval(0), hull(t, place), 1, around);
  StarTouch result;
  for (const Along<Interval>& variable : around) result.enclosure.push_back(variable.value);
  const auto out = value_along<Interval>(sheet, mode, Interval(0), place, 0, around);
  if (!along || !out || along->curve.sign() == 0 || out->slope.sign() == 0) return std::nullopt;
  result.enters = along->curve.sign() * out->slope.sign() < 0;
  return result;
}

}  // namespace clearloci::loci::sheet
