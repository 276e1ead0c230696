#include "symbolic/cramer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
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

/// What summands share, with the least multiplicity of each factor; multiplicities may be negative.
FactoredPoly shared_part(const std::vector<FactoredPoly>& summands) {
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
  sort_factors(shared.factors);
  return shared;
}

/// The sum of the summands, each over what they share, multiplied out.
Poly sum_over(const Ring& ring, const FactoredPoly& shared, const std::vector<FactoredPoly>& summands,
              std::size_t most_terms) {
  Poly sum(ring);
  for (const FactoredPoly& summand : summands) {
    if (summand.is_zero()) continue;
    FactoredPoly rest = summand;
    multiply(rest, shared, -1);
    if (terms_of(rest) > static_cast<double>(most_terms)) throw TooLong{};
    sum += expanded(rest, ring);
  }
  return sum;
}

FactoredPoly sum_of(const Ring& ring, const std::vector<FactoredPoly>& summands, std::size_t most_terms) {
  const FactoredPoly shared = shared_part(summands);
  FactoredPoly result = factored(sum_over(ring, shared, summands, most_terms), shared.factors);
  multiply(result, shared);
  return result;
}

/// Rows and as many columns, by their places among those that are left: the rows hold no other columns but those of
/// blocks before them.
struct Block {
  std::vector<std::size_t> rows, columns;
  std::vector<std::size_t> needed;  ///< blocks that its rows depend on, and those that these do; itself last
};

/// Of `holds`, a square table of which row holds which column, the blocks in an order in which they can be solved; none
/// where it is singular whatever the entries are.
std::vector<Block> blocks_of(const std::vector<std::vector<bool>>& holds) {
  const std::size_t n = holds.size();
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  // A column of its own for every row, by augmenting paths.
  std::vector<std::size_t> row_of(n, none);
  std::vector<bool> seen;
  const std::function<bool(std::size_t)> find_column = [&](std::size_t row) {
    for (std::size_t column = 0; column < n; ++column) {
      if (!holds[row][column] || seen[column]) continue;
      seen[column] = true;
      if (row_of[column] != none && !find_column(row_of[column])) continue;
      row_of[column] = row;
      return true;
    }
    return false;
  };
  for (std::size_t row = 0; row < n; ++row) {
    seen.assign(n, false);
    if (!find_column(row)) return {};
  }
  // Rows depend on those whose columns they hold, and on what these do.
  std::vector<std::vector<bool>> depends(n, std::vector<bool>(n, false));
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t column = 0; column < n; ++column)
      if (holds[row][column]) depends[row][row_of[column]] = true;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (depends[i][k] && depends[k][j]) depends[i][j] = true;
  std::vector<Block> blocks;
  std::vector<std::size_t> block_of(n, none);
  for (std::size_t solved = 0; solved < n;) {
    for (std::size_t row = 0; row < n; ++row) {
      bool is_next = block_of[row] == none;
      for (std::size_t other = 0; other < n; ++other)
        if (depends[row][other] && !depends[other][row] && block_of[other] == none) is_next = false;
      if (!is_next) continue;
      Block block;
      for (std::size_t other = 0; other < n; ++other) {
        if (!depends[row][other]) continue;
        if (depends[other][row])
          block.rows.push_back(other), block_of[other] = blocks.size();
        else if (std::find(block.needed.begin(), block.needed.end(), block_of[other]) == block.needed.end())
          block.needed.push_back(block_of[other]);
      }
      std::sort(block.needed.begin(), block.needed.end());
      block.needed.push_back(blocks.size());
      for (std::size_t column = 0; column < n; ++column)
        if (block_of[row_of[column]] == blocks.size()) block.columns.push_back(column);
      solved += block.rows.size();
      blocks.push_back(std::move(block));
    }
  }
  return blocks;
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
  /// Of a constant pivot: the entries that it may fill in before rows of few entries are used up.
  static constexpr std::size_t little_fill = 4;
  /// Entries of such a row besides the pivot: a force in space and two couples along one axis.
  static constexpr std::size_t few_others = 3;
  static constexpr std::size_t unbounded = std::numeric_limits<std::size_t>::max();

  enum class How { not_at_all, by_rows, by_columns };
  struct Choice {
    How how = How::not_at_all;
    Pivot pivot{};
  };
  /// The first of the cheapest of those taken.
  struct Cheapest {
    Choice choice{};
    std::size_t cost = unbounded;
    void take(const Choice& other, std::size_t other_cost) {
      if (other_cost >= cost) return;
      cost = other_cost;
      choice = other;
    }
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

  /// The cheapest of what raises no degree. First numbers that fill in little, of rows without a load; then polynomials
  /// in rows of few entries without a load, of which the other columns take what they need: so a leg's own equations
  /// leave what it can bear, such as one force along it, before it meets the rest of the mechanism. Then numbers in
  /// rows with loads, which spread these. Behind those, where too much is left to be expanded, any number, then any
  /// polynomial.
  Choice choose(std::size_t left) const {
    const std::vector<std::size_t> in_column = entries_of_columns();
    Cheapest number, loaded_number, by_columns, by_rows;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!active_[i]) continue;
      const std::size_t others = rows_[i].size() - 1;
      const bool loaded = rows_[i].contains(n_);
      for (const auto& [column, entry] : rows_[i]) {
        if (column == n_) continue;
        const std::size_t fill = others * (in_column[static_cast<std::size_t>(column)] - 1);
        const Choice by_this_row = {How::by_rows, {i, column}};
        if (entry.is_constant()) {
          (loaded && fill > 0 ? loaded_number : number).take(by_this_row, fill);
          continue;
        }
        const std::size_t cost = (fill + 1) * entry.length();
        by_rows.take(by_this_row, cost);
        if (!loaded && others <= few_others) by_columns.take({How::by_columns, {i, column}}, cost);
      }
    }
    if (number.cost <= little_fill) return number.choice;
    if (by_columns.cost != unbounded) return by_columns.choice;
    number.take(loaded_number.choice, loaded_number.cost);
    if (number.cost <= little_fill) return number.choice;
    if (left <= most_expanded) return {};
    return number.cost != unbounded ? number.choice : by_rows.choice;
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

  /// What is left, block by block; false where it is singular. Minors of the whole would hold the determinants of
  /// blocks as factors, multiplied out.
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
    std::vector<FactoredPoly> taken;
    for (const int column : columns) {
      taken.push_back(divide_column(column));
      multiply(determinant_, taken.back());
    }
    std::vector<std::vector<bool>> holds;
    for (const std::size_t i : rest) {
      std::vector<bool>& row = holds.emplace_back();
      for (const int column : columns) row.push_back(rows_[i].contains(column));
    }
    std::vector<SolvedBlock> solved;
    const std::vector<Block> blocks = blocks_of(holds);
    for (const Block& block : blocks) {
      SolvedBlock& own = solved.emplace_back();
      for (const std::size_t i : block.rows) own.rows.push_back(rest[i]);
      for (const std::size_t j : block.columns) own.columns.push_back(columns[j]);
      for (std::size_t i = 0; i < own.rows.size(); ++i) column_of_row_[own.rows[i]] = own.columns[i];
      if (!solve(block, solved)) return false;
    }
    for (std::size_t j = 0; j < columns.size(); ++j) {
      FactoredPoly& w = solution_[static_cast<std::size_t>(columns[j])];
      if (!w.is_zero()) multiply(w, taken[j], -1);
    }
    return !blocks.empty();
  }

  /// Rows and columns of the whole, and the determinant.
  struct SolvedBlock {
    std::vector<std::size_t> rows;
    std::vector<int> columns;
    FactoredPoly determinant{1, {}};
  };

  /// The unknowns of the last of the blocks, from those of blocks before it; false where it is singular.
  bool solve(const Block& block, std::vector<SolvedBlock>& solved) {
    SolvedBlock& own = solved.back();
    std::vector<std::vector<FactoredPoly>> summands;
    std::vector<FactoredPoly> all_summands;
    std::vector<SparseRow> rows;
    for (const std::size_t i : own.rows) {
      SparseRow& row = rows.emplace_back();
      std::vector<FactoredPoly>& loads = summands.emplace_back();
      for (const auto& [column, entry] : rows_[i]) {
        if (std::find(own.columns.begin(), own.columns.end(), column) != own.columns.end())
          row.emplace(column, entry);
        else if (FactoredPoly load = load_of(column, entry); !load.is_zero())
          loads.push_back(std::move(load));
      }
      all_summands.insert(all_summands.end(), loads.begin(), loads.end());
    }
    const FactoredPoly shared = shared_part(all_summands);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Poly load = sum_over(ring_, shared, summands[i], most_terms_);
      if (!load.is_zero()) rows[i].emplace(n_, std::move(load));
    }
    std::vector<int> columns = own.columns;
    columns.push_back(n_);
    std::map<unsigned, Poly> minors;
    const unsigned all = (1U << rows.size()) - 1;
    own.determinant = factored(minor(rows, columns, all, minors), {});
    if (own.determinant.is_zero()) return false;
    multiply(determinant_, own.determinant);
    remember(own.determinant, own.rows, own.columns);
    SolvedBlock needed;
    for (const std::size_t b : block.needed) {
      needed.rows.insert(needed.rows.end(), solved[b].rows.begin(), solved[b].rows.end());
      needed.columns.insert(needed.columns.end(), solved[b].columns.begin(), solved[b].columns.end());
      multiply(needed.determinant, solved[b].determinant);
    }
    for (std::size_t j = 0; j < rows.size(); ++j) {
      FactoredPoly& w = solution_[static_cast<std::size_t>(own.columns[j])];
      w = factored(minor(rows, columns, (all & ~(1U << j)) | (all + 1), minors), needed.determinant.factors);
      if (w.is_zero()) continue;
      if ((rows.size() - 1 - j) % 2 == 1) w.constant = -w.constant;
      multiply(w, own.determinant, -1);
      multiply(w, shared);
      remember_numerator(w, needed, own.columns[j]);
    }
    return true;
  }

  /// What a known unknown, or the load in the column behind the last, puts on the right-hand side.
  FactoredPoly load_of(int column, const Poly& entry) const {
    FactoredPoly load = factored(entry, {});
    if (column == n_) return load;
    const FactoredPoly& w = solution_[static_cast<std::size_t>(column)];
    if (w.is_zero()) return w;
    multiply(load, w);
    load.constant = -load.constant;
    return load;
  }

  /// The numerator of w = |A_k| / |A|, A the blocks that it takes: with the loads behind the other columns.
  void remember_numerator(FactoredPoly w, const SolvedBlock& needed, int column) {
    multiply(w, needed.determinant);
    std::vector<int> columns = needed.columns;
    const auto replaced = std::find(columns.begin(), columns.end(), column);
    if ((columns.end() - replaced) % 2 == 0) w.constant = -w.constant;
    columns.erase(replaced);
    columns.push_back(n_);
    remember(w, needed.rows, columns);
  }

  /// Keeps the form of an irreducible determinant that has many more terms than its entries and their products.
  void remember(const FactoredPoly& product, const std::vector<std::size_t>& rows, const std::vector<int>& columns) {
    if (product.factors.size() != 1 || product.factors.front().multiplicity != 1) return;
    DeterminantForm form{product.factors.front().poly, 1 / product.constant, {}};
    std::size_t terms = rows.size() << rows.size();
    for (const std::size_t i : rows) {
      std::vector<Poly>& row = form.rows.emplace_back();
      for (const int column : columns) {
        const auto entry = rows_[i].find(column);
        row.push_back(entry == rows_[i].end() ? Poly(ring_) : entry->second);
        terms += row.back().length();
      }
    }
    if (form.value.length() > 2 * terms) forms_.push_back(std::move(form));
  }

  /// Of the first rows, as many as there are columns in the set, expanded along the last of them.
  const Poly& minor(const std::vector<SparseRow>& rows, const std::vector<int>& columns, unsigned set,
                    std::map<unsigned, Poly>& minors) const {
    if (const auto found = minors.find(set); found != minors.end()) return found->second;
    const auto size = static_cast<std::size_t>(std::popcount(set));
    Poly sum(ring_, size == 0 ? 1 : 0);
    std::size_t place = 0;
    for (std::size_t j = 0; j < columns.size(); ++j) {
      if ((set >> j & 1U) == 0) continue;
      const SparseRow& row = rows[size - 1];
      if (const auto entry = row.find(columns[j]); entry != row.end()) {
        const Poly summand = product(entry->second, minor(rows, columns, set & ~(1U << j), minors));
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
      if (FactoredPoly load = load_of(column, entry); !load.is_zero()) summands.push_back(std::move(load));
    }
    FactoredPoly& w = solution_[static_cast<std::size_t>(step.column)];
    w = sum_of(ring_, summands, most_terms_);
    if (!w.is_zero()) multiply(w, factored(step.equation.at(step.column), {}), -1);
  }

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
