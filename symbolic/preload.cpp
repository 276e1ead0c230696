#include "symbolic/preload.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "core/errors.hpp"

namespace clearloci::symbolic {
namespace {

using core::Rational;
using core::Vanishing;

bool same_factors(const FactoredPoly& a, const FactoredPoly& b) {
  return std::equal(
      a.factors.begin(), a.factors.end(), b.factors.begin(), b.factors.end(),
      [](const PolyFactor& x, const PolyFactor& y) { return x.multiplicity == y.multiplicity && x.poly == y.poly; });
}

std::vector<const FactoredPoly*> entries_of(const PreloadRow& row) {
  std::vector<const FactoredPoly*> list = {&row.load};
  for (const FactoredPoly& effort : row.efforts) list.push_back(&effort);
  return list;
}

/// Whether one is a number times the other: rows without content are where they are proportional at all.
bool are_proportional(const PreloadRow& a, const PreloadRow& b) {
  const std::vector<const FactoredPoly*> x = entries_of(a), y = entries_of(b);
  std::optional<Rational> ratio;
  for (std::size_t c = 0; c < x.size(); ++c) {
    if (x[c]->is_zero() != y[c]->is_zero() || !same_factors(*x[c], *y[c])) return false;
    if (x[c]->is_zero()) continue;
    const Rational value = x[c]->constant / y[c]->constant;
    if (ratio && *ratio != value) return false;
    ratio = value;
  }
  return true;
}

using Matrix = std::vector<std::vector<Poly>>;

/// By its first column.
Poly determinant_of(const Matrix& matrix, const Ring& ring) {
  if (matrix.empty()) return Poly(ring, 1);
  Poly sum(ring);
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    if (matrix[i].front().is_zero()) continue;
    Matrix rest;
    for (std::size_t k = 0; k < matrix.size(); ++k)
      if (k != i) rest.emplace_back(matrix[k].begin() + 1, matrix[k].end());
    const Poly part = matrix[i].front() * determinant_of(rest, ring);
    sum += i % 2 == 0 ? part : -part;
  }
  return sum;
}

/// Distinct rows, and constraints as sets of them.
class Arrangement {
 public:
  Arrangement(const Ring& ring, const FactoredPoly& determinant, std::size_t efforts)
      : ring_(ring), determinant_(determinant), efforts_(efforts) {}

  void add(const PreloadConstraint& constraint) {
    if (!constraint.words.empty()) add_fixed(constraint);
    std::map<std::size_t, FactoredPoly> contents;
    for (const PreloadRow& row : constraint.rows) {
      if (row.content.is_zero() || (!constraint.infinite && is_fixed(row))) continue;
      const auto [content, fresh] = contents.try_emplace(place_of(row), row.content);
      if (!fresh) content->second = common_factors(content->second, row.content);
    }
    std::set<std::size_t> rows;
    for (const auto& [row, content] : contents) rows.insert(row);
    if (rows.empty()) return;
    const auto found = std::find_if(constraints_.begin(), constraints_.end(),
                                    [&](const Constraint& candidate) { return candidate.rows == rows; });
    Constraint& constraint_of_row =
        found == constraints_.end() ? constraints_.emplace_back(Constraint{rows, {}, {}}) : *found;
    // Where one of several components is zero at every effort, the others can be zero, too.
    if (rows.size() > 1)
      for (const auto& [row, content] : contents)
        constraint_of_row.contents.emplace_back(content, constraint.vanishing);
    constraint_of_row.event.vanishing.insert(constraint_of_row.event.vanishing.end(), constraint.vanishing.begin(),
                                             constraint.vanishing.end());
    if (!constraint.words.empty()) constraint_of_row.event.words.push_back(constraint.words);
    constraint_of_row.event.infinite = constraint_of_row.event.infinite || constraint.infinite;
    constraint_of_row.bounded.insert(constraint.bounded ? constraint.bounded->joint : "");
    if (constraint.bounded) constraint_of_row.event.bounded.push_back(*constraint.bounded);
  }

  PreloadDeterminants run() {
    choose(0, {}, {});
    merge_factors();
    return std::move(result_);
  }

 private:
  struct Constraint {
    std::set<std::size_t> rows;
    PreloadEvent event;
    /// Of several rows: what one of them shares, and with which reactions.
    std::vector<std::pair<FactoredPoly, std::vector<Vanishing>>> contents;
    std::set<std::string> bounded = {};  ///< whose efforts are at a bound; "" of others
  };
  struct Found {
    Poly factor;
    std::vector<std::size_t> constraints;
    std::optional<PreloadEvent> alone = {};  ///< of a content: in the place of what the constraints tell
  };

  /// That no free effort changes.
  static bool is_fixed(const PreloadRow& row) {
    return std::all_of(row.efforts.begin(), row.efforts.end(), [](const FactoredPoly& p) { return p.is_zero(); });
  }

  /// Where an effort is at a bound whatever the free ones are.
  void add_fixed(const PreloadConstraint& constraint) {
    for (const PreloadRow& row : constraint.rows)
      for (const PolyFactor& factor : row.content.factors) {
        const int times = factor.multiplicity - determinant_.multiplicity(factor.poly);
        if (times <= 0) continue;
        PreloadEvent event{constraint.vanishing, {constraint.words}, false, true, {}};
        if (constraint.bounded) event.bounded.push_back(*constraint.bounded);
        if (efforts_ == 0) result_.all.push_back({event, {row.content.constant, {{factor.poly, times}}}});
        found_.push_back({factor.poly, {}, std::move(event)});
      }
  }

  std::size_t place_of(const PreloadRow& row) {
    const auto found = std::find_if(rows_.begin(), rows_.end(),
                                    [&](const PreloadRow& preload_row) { return are_proportional(preload_row, row); });
    if (found != rows_.end()) return static_cast<std::size_t>(found - rows_.begin());
    rows_.push_back(row);
    return rows_.size() - 1;
  }

  /// Every choice of constraints from `next` on that brings the rows to r + 1.
  void choose(std::size_t next, const std::vector<std::size_t>& chosen, const std::set<std::size_t>& rows) {
    if (rows.size() == efforts_ + 1) return take(chosen, {rows.begin(), rows.end()});
    for (std::size_t c = next; c < constraints_.size(); ++c) {
      std::set<std::size_t> more = rows;
      more.insert(constraints_[c].rows.begin(), constraints_[c].rows.end());
      if (more.size() != rows.size() + constraints_[c].rows.size() || more.size() > efforts_ + 1) continue;
      if (std::any_of(chosen.begin(), chosen.end(), [&](std::size_t other) { return exclude(other, c); })) continue;
      std::vector<std::size_t> list = chosen;
      list.push_back(c);
      choose(c + 1, list, more);
    }
  }

  /// One effort at two bounds.
  bool exclude(std::size_t a, std::size_t b) const {
    const std::set<std::string>& bounded = constraints_[a].bounded;
    return bounded.size() == 1 && !bounded.begin()->empty() && bounded == constraints_[b].bounded;
  }

  static void add_new(const std::vector<Vanishing>& from, std::vector<Vanishing>& to) {
    for (const Vanishing& one : from)
      if (std::find(to.begin(), to.end(), one) == to.end()) to.push_back(one);
  }

  PreloadEvent event_of(const std::vector<std::size_t>& chosen) const {
    PreloadEvent event;
    event.alone = chosen.size() == 1;
    for (const std::size_t c : chosen) {
      const PreloadEvent& preload_event = constraints_[c].event;
      add_new(preload_event.vanishing, event.vanishing);
      add_new(preload_event.bounded, event.bounded);
      event.words.insert(event.words.end(), preload_event.words.begin(), preload_event.words.end());
      event.infinite = event.infinite || preload_event.infinite;
    }
    return event;
  }

  void take(const std::vector<std::size_t>& chosen, const std::vector<std::size_t>& rows) {
    const std::optional<FactoredPoly> product = determinant(rows);
    PreloadEvent event = event_of(chosen);
    if (!product) {
      std::string names;
      for (const Vanishing& vanishing : event.vanishing)
        names += (names.empty() ? "" : ", ") + core::to_string(vanishing.quantity) + "_" + vanishing.joint;
      result_.left_out.push_back(std::move(names));
      return;
    }
    if (product->is_zero()) return;
    FactoredPoly value{product->constant, {}};
    for (const std::size_t row : rows) value.constant *= rows_[row].content.constant;
    for (std::size_t e = 0; e < efforts_; ++e) value.constant /= determinant_.constant;
    for (const PolyFactor& factor : product->factors) {
      const int times = order_of(factor, rows);
      if (times <= 0 || (!event.infinite && is_without_equilibrium(factor.poly, rows))) continue;
      value.factors.push_back({factor.poly, times});
      found_.push_back({factor.poly, chosen});
    }
    for (const std::size_t c : chosen) add_contents(c, chosen, value);
    result_.all.push_back({std::move(event), std::move(value)});
  }

  void add_contents(std::size_t constraint, const std::vector<std::size_t>& chosen, FactoredPoly& value) {
    for (const auto& [content, vanishing] : constraints_[constraint].contents)
      for (const PolyFactor& factor : content.factors) {
        const int times = factor.multiplicity - determinant_.multiplicity(factor.poly);
        if (times <= 0) continue;
        if (value.multiplicity(factor.poly) == 0) multiply(value, {1, {{factor.poly, times}}});
        if (chosen.size() == 1)
          found_.push_back({factor.poly, chosen, PreloadEvent{vanishing, {}, false, true, {}}});
        else
          found_.push_back({factor.poly, chosen});
      }
  }

  /// Of the rows without their contents: |A|^r times what is sought.
  std::optional<FactoredPoly> determinant(const std::vector<std::size_t>& rows) const {
    std::vector<std::vector<const FactoredPoly*>> entries;
    for (const std::size_t row : rows) entries.push_back(entries_of(rows_[row]));
    FactoredPoly outside{1, {}};
    Matrix matrix(rows.size());
    double most = 1;
    for (std::size_t c = 0; c <= efforts_; ++c) {
      std::vector<FactoredPoly> column;
      for (const auto& row : entries) column.push_back(*row[c]);
      const FactoredPoly shared = shared_factors(column);
      multiply(outside, shared);
      double longest = 1;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        matrix[i].push_back(column[i].is_zero() ? Poly(ring_) : without(column[i], shared, ring_));
        longest = std::max(longest, static_cast<double>(matrix[i].back().length()));
      }
      most *= longest;
    }
    if (most > most_terms) return std::nullopt;
    FactoredPoly product = factored(determinant_of(matrix, ring_), determinant_.factors);
    multiply(product, outside);
    return product;
  }

  /// Of the determinant over |A|^r, beyond what vanishes in a row at every effort.
  int order_of(const PolyFactor& factor, const std::vector<std::size_t>& rows) const {
    const int singular = determinant_.multiplicity(factor.poly);
    if (singular == 0) return factor.multiplicity;
    int order = factor.multiplicity - static_cast<int>(efforts_) * singular;
    for (const std::size_t row : rows) {
      const int content = rows_[row].content.multiplicity(factor.poly);
      order += std::min(content, singular);
    }
    return order;
  }

  /// Where all minors of the efforts' columns vanish with a factor, the rows are zero at no effort.
  bool is_without_equilibrium(const Poly& factor, const std::vector<std::size_t>& rows) const {
    if (efforts_ == 1)
      return std::all_of(rows.begin(), rows.end(), [&](std::size_t row) {
        const FactoredPoly& effort = rows_[row].efforts.front();
        return effort.is_zero() || effort.multiplicity(factor) > 0;
      });
    for (std::size_t left = 0; left < rows.size(); ++left) {
      Matrix minor;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i == left) continue;
        std::vector<Poly>& row = minor.emplace_back();
        for (const FactoredPoly& effort : rows_[rows[i]].efforts)
          row.push_back(effort.multiplicity(factor) > 0 || effort.is_zero() ? Poly(ring_) : expanded(effort, ring_));
      }
      const Poly value = determinant_of(minor, ring_);
      if (Poly quotient(ring_); !value.is_zero() && !value.divides(factor, quotient)) return false;
    }
    return true;
  }

  /// With one effort free, constraints that meet others at one effort meet each other there.
  void merge_factors() {
    for (const Found& found : found_) {
      auto same_factor = std::find_if(result_.factors.begin(), result_.factors.end(),
                                      [&](const PreloadFactor& factor) { return factor.natural == found.factor; });
      if (same_factor == result_.factors.end()) {
        result_.factors.push_back({found.factor, {}});
        sets_.emplace_back();
        same_factor = std::prev(result_.factors.end());
      }
      if (found.alone)
        add_alone(same_factor->events, *found.alone);
      else
        join(sets_[static_cast<std::size_t>(same_factor - result_.factors.begin())], found.constraints);
    }
    for (std::size_t f = 0; f < sets_.size(); ++f)
      for (const std::set<std::size_t>& joined : sets_[f])
        result_.factors[f].events.push_back(event_of({joined.begin(), joined.end()}));
  }

  static void add_alone(std::vector<PreloadEvent>& events, const PreloadEvent& event) {
    if (std::none_of(events.begin(), events.end(), [&](const PreloadEvent& preload_event) {
          return preload_event.vanishing == event.vanishing && preload_event.words == event.words;
        }))
      events.push_back(event);
  }

  void join(std::vector<std::set<std::size_t>>& sets, const std::vector<std::size_t>& constraints) const {
    std::set<std::size_t> merged(constraints.begin(), constraints.end());
    if (efforts_ == 1)
      std::erase_if(sets, [&](const std::set<std::size_t>& other) {
        const bool meets = std::any_of(other.begin(), other.end(), [&](std::size_t c) { return merged.contains(c); });
        if (meets) merged.insert(other.begin(), other.end());
        return meets;
      });
    sets.push_back(std::move(merged));
  }

  static constexpr double most_terms = 4e6;

  const Ring& ring_;
  const FactoredPoly& determinant_;
  std::size_t efforts_;
  std::vector<PreloadRow> rows_;
  std::vector<Constraint> constraints_;
  std::vector<Found> found_;
  std::vector<std::vector<std::set<std::size_t>>> sets_;  ///< of every factor
  PreloadDeterminants result_;
};

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i)
    list += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return list;
}

}  // namespace

PreloadRow preload_row(const std::vector<const FactoredPoly*>& columns) {
  std::vector<FactoredPoly> all;
  for (const FactoredPoly* column : columns) all.push_back(*column);
  PreloadRow row;
  row.content = shared_factors(all);
  if (std::all_of(all.begin(), all.end(), [](const FactoredPoly& p) { return p.is_zero(); })) row.content = {};
  for (FactoredPoly& p : all)
    if (!p.is_zero()) multiply(p, row.content, -1);
  row.load = std::move(all.front());
  row.efforts.assign(std::make_move_iterator(all.begin() + 1), std::make_move_iterator(all.end()));
  return row;
}

PreloadRow infinite_row(std::size_t efforts, const FactoredPoly& determinant) {
  return {{1, {}}, std::vector<FactoredPoly>(efforts), determinant};
}

PreloadRow bound_row(std::size_t efforts, std::size_t effort, const Rational& bound, const FactoredPoly& determinant) {
  PreloadRow row{{-bound, {}}, std::vector<FactoredPoly>(efforts), determinant};
  row.efforts[effort] = {1, {}};
  return row;
}

PreloadDeterminants preload_determinants(const Ring& ring, const FactoredPoly& determinant, std::size_t efforts,
                                         const std::vector<PreloadConstraint>& constraints) {
  Arrangement all(ring, determinant, efforts);
  for (const PreloadConstraint& constraint : constraints) all.add(constraint);
  return all.run();
}

std::string words_of(const PreloadEvent& event, const std::string& motors, std::size_t efforts) {
  std::vector<std::string> names;
  for (const Vanishing& vanishing : event.vanishing)
    names.push_back(core::to_string(vanishing.quantity) + "_" + vanishing.joint);
  const bool one = names.size() == 1;
  if (event.infinite && efforts == 1)
    return listed(names) + (one ? " does" : " do") + " not depend on the effort of " + motors;
  if (event.infinite) return listed(names) + " depend alike on the efforts of " + motors;
  if (names.empty()) return listed(event.words) + (event.words.size() > 1 ? " at once" : "");
  if (!event.words.empty()) return listed(names) + (one ? " vanishes with " : " vanish with ") + listed(event.words);
  if (event.alone) return listed(names) + " can vanish, at one choice of the effort";
  return listed(names) + " can only vanish together";
}

}  // namespace clearloci::symbolic
