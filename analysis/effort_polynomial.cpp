#include "analysis/effort_polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numbers>

#include "core/interval.hpp"
#include "core/rational.hpp"
#include "numeric/weighted_fit.hpp"

namespace clearloci {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

std::string decimal(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

/// All of a total degree up to `degree`, those of a lower one first.
std::vector<std::vector<int>> powers_up_to(std::size_t variables, int degree) {
  std::vector<std::vector<int>> all;
  std::vector<int> powers(variables, 0);
  const std::function<void(std::size_t, int)> add = [&](std::size_t variable, int left) {
    if (variable == variables) {
      if (left == 0) all.push_back(powers);
      return;
    }
    for (int power = left; power >= 0; --power) {
      powers[variable] = power;
      add(variable + 1, left - power);
    }
    powers[variable] = 0;
  };
  for (int total = 0; total <= degree; ++total) add(0, total);
  return all;
}

core::Interval power_of(const core::Interval& base, int power) {
  core::Interval result(1.0);
  for (int i = 0; i < power; ++i) result = result * base;
  return result;
}

}  // namespace

EffortPolynomial::EffortPolynomial(const mechanism::Mechanism& mechanism, const std::array<core::RationalPose, 2>& box,
                                   int degree, bool force)
    : force_(force) {
  for (std::size_t c = 0; c < mechanism.coordinates.size(); ++c) {
    const mechanism::Coordinate& coordinate = mechanism.coordinates[c];
    Variable variable;
    variable.name = coordinate.name;
    variable.angle = coordinate.angle;
    variable.lower = core::to_double(box[0][c]);
    variable.upper = core::to_double(box[1][c]);
    if (!(variable.lower < variable.upper)) continue;
    constexpr int digits = 3;
    variable.middle = decimal(0.5 * (variable.lower + variable.upper) * (variable.angle ? degrees : 1), digits);
    variable.from = std::strtod(variable.middle.c_str(), nullptr) / (variable.angle ? degrees : 1);
    variables_.push_back(std::move(variable));
    places_.push_back(c);
  }
  powers_ = powers_up_to(variables_.size(), degree);
}

std::vector<double> EffortPolynomial::monomials(const std::vector<double>& pose) const {
  std::vector<double> all;
  for (const std::vector<int>& powers : powers_) {
    double product = 1;
    for (std::size_t v = 0; v < variables_.size(); ++v) {
      const double off = pose[places_[v]] - variables_[v].from;
      product *= std::pow(variables_[v].angle ? std::sin(off) : off, powers[v]);
    }
    all.push_back(product);
  }
  return all;
}

double EffortPolynomial::at(const std::vector<double>& pose) const {
  const std::vector<double> all = monomials(pose);
  double sum = 0;
  for (std::size_t t = 0; t < all.size(); ++t) sum += values_[t] * all[t];
  return sum;
}

bool EffortPolynomial::fit(const std::vector<std::vector<double>>& poses,
                           const std::vector<std::array<double, 2>>& between) {
  std::vector<std::vector<double>> rows;
  for (const std::vector<double>& pose : poses) rows.push_back(monomials(pose));
  const auto found = numeric::weighted_fit(rows, between);
  if (!found) return false;
  coefficients_.clear();
  values_.clear();
  for (const double coefficient : *found) {
    constexpr int digits = 4;
    coefficients_.push_back(decimal(coefficient, digits));
    values_.push_back(std::strtod(coefficients_.back().c_str(), nullptr));
  }
  for (std::size_t k = 0; k < poses.size(); ++k)
    if (const double effort = at(poses[k]); effort <= between[k][0] || effort >= between[k][1]) return false;
  return true;
}

std::array<double, 2> EffortPolynomial::range() const {
  const std::size_t n = variables_.size();
  const int cuts = n == 1 ? 256 : n == 2 ? 32 : n == 3 ? 8 : n == 4 ? 4 : 2;
  std::array<double, 2> range = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  std::vector<int> cell(n, 0);
  const auto enclosed = [&](std::size_t v) {
    const Variable& variable = variables_[v];
    const double step = (variable.upper - variable.lower) / cuts;
    double low = variable.lower + cell[v] * step - variable.from,
           high = variable.lower + (cell[v] + 1) * step - variable.from;
    const double rounding = 1e-14 * (std::abs(variable.lower) + std::abs(variable.upper) + std::abs(variable.from));
    if (variable.angle) {
      const bool rises = low > -0.5 * std::numbers::pi && high < 0.5 * std::numbers::pi;
      low = rises ? std::sin(low) : -1;
      high = rises ? std::sin(high) : 1;
    }
    return core::Interval(low - rounding - 1e-15, high + rounding + 1e-15);
  };
  while (true) {
    core::Interval sum(0.0);
    for (std::size_t t = 0; t < powers_.size(); ++t) {
      core::Interval term(values_[t]);
      for (std::size_t v = 0; v < n; ++v) term = term * power_of(enclosed(v), powers_[t][v]);
      sum = sum + term;
    }
    range = {std::min(range[0], sum.lower()), std::max(range[1], sum.upper())};
    std::size_t v = 0;
    while (v < n && ++cell[v] == cuts) cell[v++] = 0;
    if (v == n) return range;
  }
}

std::string EffortPolynomial::variable_words(const Variable& variable) const {
  const bool below = variable.middle.front() == '-';
  const std::string off = variable.from == 0
                              ? variable.name
                              : variable.name + (below ? " + " + variable.middle.substr(1) : " - " + variable.middle) +
                                    (variable.angle ? " deg" : " m");
  if (variable.angle) return "sin(" + off + ")";
  return variable.from == 0 ? off : "(" + off + ")";
}

std::string EffortPolynomial::unit_words(const std::vector<int>& powers) const {
  int lengths = force_ ? 1 : 0;
  for (std::size_t v = 0; v < powers.size(); ++v)
    if (!variables_[v].angle) lengths += powers[v];
  if (lengths == 0) return "N m";
  if (lengths == 1) return "N";
  return lengths == 2 ? "N/m" : "N/m^" + std::to_string(lengths - 1);
}

std::string EffortPolynomial::told() const {
  std::string text;
  for (std::size_t t = 0; t < powers_.size(); ++t) {
    if (t > 0 && values_[t] == 0) continue;
    const bool below = coefficients_[t].front() == '-';
    const std::string size = below ? coefficients_[t].substr(1) : coefficients_[t];
    text += text.empty() ? (below ? "-" : "") : below ? " - " : " + ";
    text += size + " " + unit_words(powers_[t]);
    for (std::size_t v = 0; v < variables_.size(); ++v) {
      if (powers_[t][v] == 0) continue;
      text += "*" + variable_words(variables_[v]);
      if (powers_[t][v] > 1) text += "^" + std::to_string(powers_[t][v]);
    }
  }
  return text;
}

}  // namespace clearloci
