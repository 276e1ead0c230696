#include "loci/numbers/sheet_program.hpp"

#include <cmath>
#include <limits>
#include <map>

#include "core/enclosure.hpp"
#include "core/errors.hpp"

namespace clearloci::loci::sheet {

namespace {

/// Coefficients of (v + shift)^n, lowest power first.
std::vector<core::Rational> power_of_sum(const core::Rational& shift, int n) {
  std::vector<core::Rational> result = {1};
  for (int i = 0; i < n; ++i) {
    result.emplace_back(0);
    for (std::size_t k = result.size() - 1; k > 0; --k) result[k] = shift * result[k] + result[k - 1];
    result[0] *= shift;
  }
  return result;
}

}  // namespace

core::Polynomial shifted(const core::Polynomial& p, int variable, const core::Rational& shift) {
  if (shift == 0) return p;
  std::vector<std::vector<core::Rational>> powers;
  for (int n = 0; n <= std::max(0, core::degree_in(p, variable)); ++n) powers.push_back(power_of_sum(shift, n));
  std::map<std::vector<int>, core::Rational, std::greater<>> collected;
  for (const core::Term& term : p.terms) {
    std::vector<int> exponents = term.exponents;
    const int n = term.exponents[variable];
    for (int k = 0; k <= n; ++k) {
      exponents[variable] = k;
      collected[exponents] += term.coefficient * powers[n][k];
    }
  }
  core::Polynomial result{p.variables, {}};
  for (const auto& [exponents, coefficient] : collected)
    if (coefficient != 0) result.terms.push_back({exponents, coefficient});
  return result;
}

double constant_as(const core::Rational& value, double*) { return core::to_double(value); }

Interval constant_as(const core::Rational& value, Interval*) { return core::enclosed(value); }

DoubleDouble constant_as(const core::Rational& value, DoubleDouble*) { return DoubleDouble(value); }

MultiInterval constant_as(const core::Rational& value, MultiInterval*) { return MultiInterval(value); }

SheetProgram::SheetProgram(const core::RootTower& tower, std::vector<core::Polynomial> functions,
                           std::vector<core::StraightLine> lines)
    : tower_(tower), functions_(std::move(functions)), lines_(std::move(lines)) {
  lines_.resize(functions_.size());
  compile();
}

SheetProgram::SheetProgram(const core::RootTower& tower, const std::vector<SheetFunction>& functions) : tower_(tower) {
  for (const SheetFunction& function : functions) {
    functions_.push_back(function.polynomial);
    lines_.push_back(function.line);
  }
  compile();
}

SheetProgram SheetProgram::with_tangency(const core::RootTower& tower, const std::vector<SheetFunction>& two) {
  core::ensure(two.size() == 2, "two functions are tangent");
  SheetProgram program;
  program.tower_ = tower;
  for (const SheetFunction& function : two) {
    program.functions_.push_back(function.polynomial);
    program.lines_.push_back(function.line);
  }
  program.compile(true);
  return program;
}

bool SheetProgram::is_nested() const {
  return std::any_of(code_->square_partials.begin(), code_->square_partials.end(),
                     [this](const std::vector<int>& partials) {
                       return std::any_of(partials.begin() + coordinates(), partials.end(),
                                          [this](int p) { return p != code_->zero; });
                     });
}

void SheetProgram::compile(bool tangency) {
  CompiledSheet compiled = compile_sheet(tower_, functions_, lines_, tangency);
  code_ = std::move(compiled.code);
  const std::size_t count = code_->constants.size();
  constants_.reserve(count);
  nearest_constants_.reserve(count);
  enclosed_constants_.reserve(count);
  for (const int number : code_->constants) {  // each once
    SheetNumber& constant = compiled.numbers[static_cast<std::size_t>(number)];
    nearest_constants_.push_back(core::to_double(constant.value));
    enclosed_constants_.push_back(enclosed_as(constant.value, constant.radius, static_cast<Interval*>(nullptr)));
    constants_.push_back(std::move(constant));
  }
}

}  // namespace clearloci::loci::sheet
