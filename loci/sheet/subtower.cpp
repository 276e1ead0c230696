#include "loci/sheet/subtower.hpp"

#include <algorithm>

#include "core/errors.hpp"

namespace clearloci::loci::sheet {

namespace {

void sort_terms(core::Polynomial& p) {
  std::sort(p.terms.begin(), p.terms.end(),
            [](const core::Term& a, const core::Term& b) { return a.exponents > b.exponents; });
}

}  // namespace

Subtower subtower(const core::RootTower& whole, const core::WorkingMode& mode,
                  const std::vector<core::Polynomial>& functions) {
  const int m = static_cast<int>(whole.roots.size());
  std::vector<bool> needed(m, false);
  const auto need_what_they_are_built_on = [&] {
    for (int j = m - 1; j >= 0; --j)
      for (int k = j + 1; k < m; ++k)
        needed[j] = needed[j] || (needed[k] && core::depends_on(whole.roots[k].square, 2 + j));
  };
  for (int j = 0; j < m; ++j)
    for (const core::Polynomial& f : functions) needed[j] = needed[j] || core::depends_on(f, 2 + j);
  need_what_they_are_built_on();
  // With an angle comes where it is cut: beyond that the functions are others.
  for (int k = 0; k < m; ++k)
    for (int j = 0; j < m; ++j)
      needed[k] =
          needed[k] || (needed[j] && whole.roots[j].is_angle() && whole.roots[k].bounds == whole.roots[j].point);
  need_what_they_are_built_on();
  Subtower part;
  part.tower.coordinates = whole.coordinates;
  for (int j = 0; j < m; ++j) (needed[j] ? part.kept : part.dropped).push_back(j);
  for (const int j : part.kept) {
    part.tower.roots.push_back(whole.roots[j]);
    part.mode.push_back(mode[j]);
  }
  for (core::Root& root : part.tower.roots) {
    core::rewrite(root, [&](const core::Polynomial& p) { return narrowed(p, part); });
    root.line = narrowed(root.line, part);
    for (core::Rim& rim : root.rims) rim.line = narrowed(rim.line, part);
  }
  for (const core::Polynomial& denominator : whole.denominators)
    if (std::none_of(part.dropped.begin(), part.dropped.end(),
                     [&](int j) { return core::depends_on(denominator, 2 + j); }))
      part.tower.denominators.push_back(narrowed(denominator, part));
  for (const core::DyadBase& base : whole.bases) {
    const bool kept = std::none_of(part.dropped.begin(), part.dropped.end(), [&](int j) {
      return core::depends_on(base.x, 2 + j) || core::depends_on(base.y, 2 + j) ||
             core::depends_on(base.x_line, 2 + j) || core::depends_on(base.y_line, 2 + j);
    });
    if (kept)
      part.tower.bases.push_back(
          {narrowed(base.x, part), narrowed(base.y, part), narrowed(base.x_line, part), narrowed(base.y_line, part)});
  }
  return part;
}

core::Polynomial narrowed(const core::Polynomial& p, const Subtower& part) {
  core::Polynomial result{2 + static_cast<int>(part.kept.size()), {}};
  result.terms.reserve(p.terms.size());
  for (const core::Term& term : p.terms) {
    std::vector<int> exponents;
    exponents.reserve(2 + part.kept.size());
    exponents.assign({term.exponents[0], term.exponents[1]});
    for (const int j : part.kept) exponents.push_back(term.exponents[2 + j]);
    for (const int j : part.dropped) core::ensure(term.exponents[2 + j] == 0, "a dropped root does not occur");
    result.terms.push_back({std::move(exponents), term.coefficient});
  }
  sort_terms(result);
  return result;
}

core::Polynomial widened(const core::Polynomial& p, const Subtower& part, int variables) {
  core::Polynomial result{variables, {}};
  for (const core::Term& term : p.terms) {
    std::vector<int> exponents(variables, 0);
    exponents[0] = term.exponents[0];
    exponents[1] = term.exponents[1];
    for (std::size_t i = 0; i < part.kept.size(); ++i) exponents[2 + part.kept[i]] = term.exponents[2 + i];
    result.terms.push_back({std::move(exponents), term.coefficient});
  }
  sort_terms(result);
  return result;
}

core::StraightLine narrowed(const core::StraightLine& line, const Subtower& part) {
  core::StraightLine result = line;
  for (core::StraightLine::Step& step : result.steps) {
    if (step.operation != core::StraightLine::Operation::variable || step.first < 2) continue;
    const auto place = std::find(part.kept.begin(), part.kept.end(), step.first - 2);
    if (place == part.kept.end()) return {};
    step.first = 2 + static_cast<int>(place - part.kept.begin());
  }
  return result;
}

core::StraightLine widened(core::StraightLine line, const Subtower& part) {
  for (core::StraightLine::Step& step : line.steps)
    if (step.operation == core::StraightLine::Operation::variable && step.first >= 2)
      step.first = 2 + part.kept[static_cast<std::size_t>(step.first - 2)];
  return line;
}

SheetFunction narrowed(const SheetFunction& function, const Subtower& part) {
  return {narrowed(function.polynomial, part), narrowed(function.line, part)};
}

core::Polynomial without_variable(const core::Polynomial& p, int variable) {
  core::Polynomial result{p.variables - 1, {}};
  for (core::Term term : p.terms) {
    if (term.exponents[variable] != 0) continue;
    term.exponents.erase(term.exponents.begin() + variable);
    result.terms.push_back(std::move(term));
  }
  return result;
}

core::StraightLine without_variable(core::StraightLine line, int variable) {
  for (core::StraightLine::Step& step : line.steps) {
    if (step.operation != core::StraightLine::Operation::variable || step.first < variable) continue;
    if (step.first == variable)
      step = {};  // the constant 0
    else
      --step.first;
  }
  return line;
}

SheetFunction without_variable(const SheetFunction& function, int variable) {
  return {without_variable(function.polynomial, variable), without_variable(function.line, variable)};
}

core::RootTower on_rim(const core::RootTower& tower, int root) {
  core::RootTower result = tower;
  result.roots.erase(result.roots.begin() + root);
  for (core::Root& other : result.roots) {
    core::rewrite(other, [&](const core::Polynomial& p) { return without_variable(p, 2 + root); });
    other.line = without_variable(other.line, 2 + root);
    for (core::Rim& rim : other.rims) rim.line = without_variable(rim.line, 2 + root);
  }
  result.bases.clear();  // special points of a rim are those of the tower
  result.denominators.clear();
  for (const core::Polynomial& denominator : tower.denominators)
    result.denominators.push_back(without_variable(denominator, 2 + root));
  return result;
}

}  // namespace clearloci::loci::sheet
