#include "symbolic/cramer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>

#include "core/errors.hpp"

namespace clearloci::symbolic {
namespace {

/// Column to entry, zeros left out; column n is the right-hand side.
using SparseRow = std::map<int, Poly>;

struct Pivot {
  std::size_t row;
  int column;
};

/// Sign of the permutation that takes row order to column order.
int permutation_sign(std::vector<int> columns) {
  int sign = 1;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    while (columns[i] != static_cast<int>(i)) {
      std::swap(columns[i], columns[static_cast<std::size_t>(columns[i])]);
      sign = -sign;
    }
  }
  return sign;
}

/// That a polynomial has more terms than are worth having; caught in cramer_determinants_within.
struct TooLong {};

/// The common factor of some entries.
class Content {
 public:
  explicit Content(const Ring& ring) : shared_(ring) {}
  /// False once nothing but a number is shared.
  bool add(const Poly& entry) {
    shared_ = shared_.is_zero() ? entry.primitive() : gcd(shared_, entry);
    return !shared_.is_constant();
  }
  Poly value() const { return shared_.is_zero() || shared_.is_constant() ? Poly(shared_.ring(), 1) : shared_; }

 private:
  Poly shared_;
};

/// Terms of a product before equal ones are added, or more.
double terms_of(const FactoredPoly& product) {
  double terms = 1;
  for (const PolyFactor& factor : product.factors)
    terms *= std::pow(static_cast<double>(factor.poly.length()), factor.multiplicity);
  return terms;
}

/// Multiplicities may be negative; what the summands share is not multiplied out.
FactoredPoly sum_of(const Ring& ring, const std::vector<FactoredPoly>& summands, std::size_t most_terms) {
  FactoredPoly shared{1, {}};
  bool first = true;
  for (const FactoredPoly& summand : summands) {
    if (summand.is_zero()) continue;
    if (first) shared.factors = summand.factors;
    first = false;
    for (PolyFactor& factor : shared.factors)
      factor.multiplicity = std::min(factor.multiplicity, summand.multiplicity(factor.poly));
    for (const PolyFactor& factor : summand.factors)
      if (factor.multiplicity < 0 && shared.multiplicity(factor.poly) == 0) shared.factors.push_back(factor);
    std::erase_if(shared.factors, [](const PolyFactor& factor) { return factor.multiplicity == 0; });
  }
  Poly sum(ring);
  for (const FactoredPoly& summand : summands) {
    if (summand.is_zero()) continue;
    FactoredPoly rest = summand;
    multiply(rest, shared, -1);
    if (terms_of(rest) > static_cast<double>(most_terms)) throw TooLong{};
    sum += expanded(rest, ring);
  }
  sort_factors(shared.factors);
  FactoredPoly result = factored(sum, shared.factors);
  multiply(result, shared);
  return result;
}

class CramerElimination {
 public:
  CramerElimination(const Ring& ring, const std::vector<std::vector<Poly>>& matrix,
                    const std::vector<Poly>& right_hand_side, std::size_t most_terms)
      : ring_(ring),
        most_terms_(most_terms),
        n_(static_cast<int>(matrix.size())),
        rows_(matrix.size()),
        active_(matrix.size(), true),
        column_of_row_(matrix.size(), -1),
        solution_(matrix.size()) {
    for (std::size_t i = 0; i < matrix.size(); ++i) {
      core::ensure(matrix[i].size() == matrix.size(), "a square matrix");
      for (std::size_t j = 0; j < matrix.size(); ++j)
        if (!matrix[i][j].is_zero()) rows_[i].emplace(static_cast<int>(j), matrix[i][j]);
      if (!right_hand_side[i].is_zero()) rows_[i].emplace(n_, right_hand_side[i]);
    }
  }

  CramerDeterminants run() {
    std::size_t left = rows_.size();
    for (Choice next; left > 0 && (next = choose(left)).how != How::not_at_all; --left) eliminate(next);
    if (left > most_expanded || !expand_rest()) return {};
    determinant_.constant *= permutation_sign(column_of_row_);
    for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) solve(*step);
    CramerDeterminants result{determinant_, {}, std::move(forms_)};
    for (FactoredPoly& w : solution_) {  // N_k = w_k |A|, where what divides w_k divides |A|
      if (!w.is_zero()) multiply(w, determinant_);
      result.numerators.push_back(std::move(w));
    }
    return result;
  }

 private:
  /// As many rows as are left to be expanded by minors: 2^n of them, which share most of their work.
  static constexpr std::size_t most_expanded = 7;
  /// Of a constant pivot: the entries that it may fill in before rows of two or three entries are used up.
  static constexpr std::size_t little_fill = 4;

  enum class How { not_at_all, by_rows, by_columns };
  struct Choice {
    How how = How::not_at_all;
    Pivot pivot{};
  };
  /// An equation in the unknowns as they were then, and how those were changed after it: w = times * its new w.
  struct Step {
    int column;
    SparseRow equation;
    std::vector<std::pair<int, FactoredPoly>> times;
  };

  std::vector<std::size_t> entries_of_columns() const {
    std::vector<std::size_t> count(static_cast<std::size_t>(n_), 0);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (active_[i])
        for (const auto& [column, entry] : rows_[i])
          if (column < n_) ++count[static_cast<std::size_t>(column)];
    return count;
  }

  /// The cheapest of what raises no degree: a number that fills in little, or a polynomial in a row of few entries
  /// without a load, of which the other columns take what they need (the parts of a force along a link become one).
  /// Behind those, where too much is left to be expanded, any number, then any polynomial.
  Choice choose(std::size_t left) const {
    const std::vector<std::size_t> in_column = entries_of_columns();
    std::size_t least_fill = unbounded, least_by_columns = unbounded, least_by_rows = unbounded;
    Choice number, by_columns, by_rows;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!active_[i]) continue;
      const std::size_t others = rows_[i].size() - 1;
      const bool loaded = rows_[i].contains(n_);
      for (const auto& [column, entry] : rows_[i]) {
        if (column == n_) continue;
        const std::size_t fill = others * (in_column[static_cast<std::size_t>(column)] - 1);
        const auto take = [&, here = Pivot{i, column}](How how, std::size_t cost, std::size_t& least, Choice& best) {
          if (cost >= least) return;
          least = cost;
          best = {how, here};
        };
        if (entry.is_constant()) {
          take(How::by_rows, fill, least_fill, number);
          continue;
        }
        const std::size_t cost = (fill + 1) * entry.length();
        take(How::by_rows, cost, least_by_rows, by_rows);
        if (!loaded && others <= 2) take(How::by_columns, cost, least_by_columns, by_columns);
      }
    }
    if (least_fill <= little_fill) return number;
    if (by_columns.how != How::not_at_all) return by_columns;
    if (left <= most_expanded) return {};
    return number.how != How::not_at_all ? number : by_rows;
  }

  void eliminate(const Choice& choice) {
    const auto& [row, column] = choice.pivot;
    steps_.push_back({column, rows_[row], {}});
    const SparseRow& equation = steps_.back().equation;
    active_[row] = false;
    column_of_row_[row] = column;
    multiply(determinant_, factored(equation.at(column), {}));
    if (choice.how == How::by_columns) {
      for (const auto& [other, entry] : equation)
        if (other != column) take_column(other, equation, column, steps_.back().times);
      for (std::size_t i = 0; i < rows_.size(); ++i)
        if (active_[i]) rows_[i].erase(column);
      return;
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!active_[i] || !rows_[i].contains(column)) continue;
      if (equation.at(column).is_constant())
        subtract(rows_[i], rows_[i].at(column).scaled(1 / equation.at(column).constant()), equation);
      else
        take_row(rows_[i], equation, column);
    }
  }

  /// The product; what is long is as a rule a product of short ones, so that no time goes into any that is too long.
  Poly product(const Poly& a, const Poly& b) const {
    if (static_cast<double>(a.length()) * static_cast<double>(b.length()) > static_cast<double>(most_terms_))
      throw TooLong{};
    return a * b;
  }

  /// row -= multiple * pivot_row, dropping what cancels.
  void subtract(SparseRow& row, const Poly& multiple, const SparseRow& pivot_row) const {
    for (const auto& [column, entry] : pivot_row) {
      auto [place, fresh] = row.try_emplace(column, entry.ring());
      place->second -= product(multiple, entry);
      if (place->second.is_zero()) row.erase(place);
    }
  }

  /// row = (p row - e pivot_row) / content, p and e the two entries of the pivot's column without their common factor.
  void take_row(SparseRow& row, const SparseRow& pivot_row, int column) {
    const Poly shared = gcd(row.at(column), pivot_row.at(column));
    const Poly e = row.at(column).exact_quotient(shared), p = pivot_row.at(column).exact_quotient(shared);
    for (auto& [other, entry] : row) entry = product(entry, p);
    subtract(row, e, pivot_row);
    divide_row(row);
    multiply(determinant_, factored(p, {}), -1);
  }

  void divide_row(SparseRow& row) {
    Content content(ring_);
    for (const auto& [other, entry] : row)
      if (!content.add(entry)) return;
    const Poly common = content.value();
    if (common.is_constant()) return;
    for (auto& [other, entry] : row) entry = entry.exact_quotient(common);
    multiply(determinant_, factored(common, {}));
  }

  /// The same of a column `own`, whose entry in the pivot's row is to vanish.
  void take_column(int target, const SparseRow& pivot_row, int column,
                   std::vector<std::pair<int, FactoredPoly>>& times) {
    const Poly shared = gcd(pivot_row.at(target), pivot_row.at(column));
    const Poly e = pivot_row.at(target).exact_quotient(shared), p = pivot_row.at(column).exact_quotient(shared);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!active_[i]) continue;
      const auto by = rows_[i].find(column);
      auto place = rows_[i].find(target);
      if (place != rows_[i].end()) place->second = product(place->second, p);
      if (by == rows_[i].end()) continue;
      if (place == rows_[i].end()) place = rows_[i].emplace(target, ring_).first;
      place->second -= product(e, by->second);
      if (place->second.is_zero()) rows_[i].erase(place);
    }
    FactoredPoly factor = factored(p, {});
    multiply(factor, divide_column(target), -1);
    multiply(determinant_, factor, -1);
    times.emplace_back(target, std::move(factor));
  }

  /// What the entries of a column share, taken out of them.
  FactoredPoly divide_column(int target) {
    Content content(ring_);
    bool any = true;
    for (std::size_t i = 0; any && i < rows_.size(); ++i)
      if (active_[i] && rows_[i].contains(target)) any = content.add(rows_[i].at(target));
    const Poly common = content.value();
    if (common.is_constant()) return {1, {}};
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!active_[i]) continue;
      const auto place = rows_[i].find(target);
      if (place != rows_[i].end()) place->second = place->second.exact_quotient(common);
    }
    return factored(common, {});
  }

  /// What is left, by its minors; false where it is singular.
  bool expand_rest() {
    std::vector<std::size_t> rest;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (active_[i]) rest.push_back(i);
    if (rest.empty()) return true;
    for (const std::size_t i : rest) divide_row(rows_[i]);
    // Short rows first: most minors are of those.
    const auto terms = [&](std::size_t i) {
      std::size_t sum = 0;
      for (const auto& [column, entry] : rows_[i]) sum += entry.length();
      return sum;
    };
    std::stable_sort(rest.begin(), rest.end(), [&](std::size_t a, std::size_t b) { return terms(a) < terms(b); });
    std::vector<int> columns;
    for (int j = 0; j < n_; ++j)
      if (std::find(column_of_row_.begin(), column_of_row_.end(), j) == column_of_row_.end()) columns.push_back(j);
    for (std::size_t i = 0; i < rest.size(); ++i) column_of_row_[rest[i]] = columns[i];
    std::vector<FactoredPoly> taken;
    for (const int column : columns) {
      taken.push_back(divide_column(column));
      multiply(determinant_, taken.back());
    }
    columns.push_back(n_);
    std::map<unsigned, Poly> minors;
    const unsigned all = (1U << rest.size()) - 1;
    const FactoredPoly below = factored(minor(rest, columns, all, minors), {});
    if (below.is_zero()) return false;
    multiply(determinant_, below);
    remember(below, rest, columns, all);
    for (std::size_t j = 0; j < rest.size(); ++j) {
      FactoredPoly& w = solution_[static_cast<std::size_t>(columns[j])];
      const unsigned replaced = (all & ~(1U << j)) | (all + 1);
      w = factored(minor(rest, columns, replaced, minors), below.factors);
      if (w.is_zero()) continue;
      remember(w, rest, columns, replaced);
      if ((rest.size() - 1 - j) % 2 == 1) w.constant = -w.constant;
      multiply(w, below, -1);
      multiply(w, taken[j], -1);
    }
    return true;
  }

  /// Keeps the form of an irreducible minor that has many more terms than its entries and their products.
  void remember(const FactoredPoly& product, const std::vector<std::size_t>& rest, const std::vector<int>& columns,
                unsigned set) {
    if (product.factors.size() != 1 || product.factors.front().multiplicity != 1) return;
    DeterminantForm form{product.factors.front().poly, 1 / product.constant, {}};
    std::size_t terms = rest.size() << rest.size();
    for (const std::size_t i : rest) {
      std::vector<Poly>& row = form.rows.emplace_back();
      for (std::size_t j = 0; j < columns.size(); ++j) {
        if ((set >> j & 1U) == 0) continue;
        const auto entry = rows_[i].find(columns[j]);
        row.push_back(entry == rows_[i].end() ? Poly(ring_) : entry->second);
        terms += row.back().length();
      }
    }
    if (form.value.length() > 2 * terms) forms_.push_back(std::move(form));
  }

  /// Of the first rows, as many as there are columns in the set, expanded along the last of them.
  const Poly& minor(const std::vector<std::size_t>& rest, const std::vector<int>& columns, unsigned set,
                    std::map<unsigned, Poly>& minors) const {
    if (const auto found = minors.find(set); found != minors.end()) return found->second;
    const auto size = static_cast<std::size_t>(std::popcount(set));
    Poly sum(ring_, size == 0 ? 1 : 0);
    std::size_t place = 0;
    for (std::size_t j = 0; j < columns.size(); ++j) {
      if ((set >> j & 1U) == 0) continue;
      const SparseRow& row = rows_[rest[size - 1]];
      if (const auto entry = row.find(columns[j]); entry != row.end()) {
        const Poly summand = product(entry->second, minor(rest, columns, set & ~(1U << j), minors));
        if ((size - 1 + place) % 2 == 0)
          sum += summand;
        else
          sum -= summand;
      }
      ++place;
    }
    return minors.emplace(set, std::move(sum)).first->second;
  }

  /// The unknown of a step's column, from its equation and what is known of the other unknowns.
  void solve(const Step& step) {
    for (const auto& [column, factor] : step.times) {
      FactoredPoly& w = solution_[static_cast<std::size_t>(column)];
      if (!w.is_zero()) multiply(w, factor);
    }
    std::vector<FactoredPoly> summands;
    for (const auto& [column, entry] : step.equation) {
      if (column == step.column) continue;
      FactoredPoly polynomial = factored(entry, {});
      if (column < n_) {
        const FactoredPoly& w = solution_[static_cast<std::size_t>(column)];
        if (w.is_zero()) continue;
        multiply(polynomial, w);
        polynomial.constant = -polynomial.constant;
      }
      summands.push_back(std::move(polynomial));
    }
    FactoredPoly& w = solution_[static_cast<std::size_t>(step.column)];
    w = sum_of(ring_, summands, most_terms_);
    if (!w.is_zero()) multiply(w, factored(step.equation.at(step.column), {}), -1);
  }

  static constexpr std::size_t unbounded = std::numeric_limits<std::size_t>::max();

  const Ring& ring_;
  std::size_t most_terms_;
  int n_;
  std::vector<SparseRow> rows_;  ///< as they are while they are active
  std::vector<bool> active_;
  std::vector<int> column_of_row_;
  std::vector<Step> steps_;
  std::vector<DeterminantForm> forms_;
  FactoredPoly determinant_{1, {}};
  std::vector<FactoredPoly> solution_;  ///< w, found backwards; multiplicities of denominators are negative
};

}  // namespace

CramerDeterminants cramer_determinants(const Ring& ring, const std::vector<std::vector<Poly>>& matrix,
                                       const std::vector<Poly>& right_hand_side) {
  constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();
  return CramerElimination(ring, matrix, right_hand_side, any_number).run();
}

std::optional<CramerDeterminants> cramer_determinants_within(std::size_t most_terms, const Ring& ring,
                                                             const std::vector<std::vector<Poly>>& matrix,
                                                             const std::vector<Poly>& right_hand_side) {
  try {
    return CramerElimination(ring, matrix, right_hand_side, most_terms).run();
  } catch (const TooLong&) {
    return std::nullopt;
  }
}

}  // namespace clearloci::symbolic
