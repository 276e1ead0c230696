#include "check/identity.hpp"

#include <algorithm>
#include <cmath>

#include "check/elimination.hpp"
#include "mechanism/guide.hpp"

namespace clearloci::check {
namespace {

constexpr std::size_t spare_poses = 6, most_tries = 20'000;
// Elimination at a thousand bits leaves hundreds; what it leaves below this is 0.
constexpr double nothing = 0x1p-100;

Interval log_of(const Interval& a) {
  Interval r(a.bits());
  mpfi_abs(r.get(), a.get());
  mpfi_log(r.get(), r.get());
  return r;
}

bool is_nothing(const Interval& a) { return a.is_finite() && std::max(-a.lower(), a.upper()) < nothing; }

/// A fixed sequence of numbers that look random, in (0, 1), each with 40 bits.
class Scatter {
 public:
  core::Rational next() {
    state_ += 0x9e3779b97f4a7c15ull;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return core::Rational(static_cast<unsigned long>((z ^ (z >> 31)) >> 24), 1ul << 40);
  }

 private:
  std::uint64_t state_ = 2011;
};

/// Rows of logarithms at one pose each: columns that may explain, the first of them 1, then columns to be explained.
struct LogSystem {
  std::vector<std::vector<Interval>> rows;
  std::size_t columns = 0;
  std::vector<std::size_t> pivots;

  void eliminate() {
    Interval determinant(1.0, identity_bits);
    pivots = reduce(rows, columns, determinant, nothing);
  }

  bool is_pivot(std::size_t column) const { return std::find(pivots.begin(), pivots.end(), column) != pivots.end(); }

  /// Twice the exponents of the columns in another, all but the constant's, by column; none: they do not make it up.
  std::optional<std::vector<int>> exponents(std::size_t column) const {
    std::vector<int> result(columns, 0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Interval& entry = rows[i][column];
      if (i >= pivots.size()) {
        if (!is_nothing(entry)) return std::nullopt;
        continue;
      }
      if (pivots[i] == 0) continue;  // the constant
      const double twice = std::nearbyint(2 * entry.middle());
      if (!(std::abs(twice) < 1e6) ||
          !is_nothing(Interval(2.0, identity_bits) * entry - Interval(twice, identity_bits)))
        return std::nullopt;
      result[pivots[i]] = static_cast<int>(twice);
    }
    return result;
  }
};

class Fit {
 public:
  Fit(const mechanism::Mechanism& m, const CertificateFile& c, int mode)
      : m_(m),
        c_(c),
        mode_(mode),
        unknowns_(reactions_of(m)),
        dyads_(mechanism::dyad_points(m).size() + limit_ends(m)) {
    // First those that cells tell of, the boundary's with zeros before all: others are made up of them.
    std::vector<int> rank(c.functions.size(), 3);
    const auto told = [&](int function, bool has_zeros) {
      const auto f = static_cast<std::size_t>(function);
      const bool bounds = c.functions[f].role == core::FactorRole::workspace_boundary;
      rank[f] = std::min(rank[f], !bounds ? 2 : has_zeros ? 0 : 1);
    };
    for (const SheetCells& sheet : c.sheets)
      if (sheet.mode == mode)
        told(sheet.function, sheet.cells.size() != 1 || sheet.cells.front().kind != core::CellNode::Kind::free);
    for (const OpenClaim& open : c.open)
      if (open.mode == mode) told(open.function, true);
    for (std::size_t f = 0; f < rank.size(); ++f) order_.push_back(f);
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) { return rank[a] < rank[b]; });
    boundaries_ = static_cast<std::size_t>(std::count(rank.begin(), rank.end(), 0));
  }

  Orders run() {
    Orders orders;
    if (!sample()) return orders;
    orders.known = true;
    check_roots();
    system_.eliminate();
    orders.makers = makers();
    const auto found = [&](std::size_t column, const std::string& what) {
      auto exponents = exponents_of(column);
      if (!exponents) throw FalseClaim("functions: they do not make up " + what);
      return std::move(*exponents);
    };
    orders.determinant = found(system_.columns, "the direct singularity |A|");
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      const std::size_t column = system_.columns + 1 + k;
      orders.reactions.emplace_back();
      if (always_zero_[k]) continue;
      if (is_wanted(unknowns_[k]))
        orders.reactions.back() = found(column, core::to_string(unknowns_[k].quantity) + "_" +
                                                    m_.joints[static_cast<std::size_t>(unknowns_[k].joint)].name);
      else
        (void)exponents_of(column);
    }
    const std::size_t squares = 1 + divisors_ + order_.size();
    for (std::size_t j = 0; j < dyads_; ++j)
      orders.squares.push_back(is_made(squares + j) ? exponents_of(squares + j) : std::nullopt);
    for (std::size_t j = 0; j < c_.squares.size(); ++j)
      orders.roots.push_back(is_made(squares + dyads_ + j) ? of_functions(squares + dyads_ + j) : std::nullopt);
    for (std::size_t i = 0; i < order_.size(); ++i)
      if (system_.is_pivot(column_of(i)) && !used_[order_[i]] &&
          c_.functions[order_[i]].role != core::FactorRole::margin)
        throw FalseClaim("functions: " + c_.functions[order_[i]].name + " (" + std::to_string(order_[i]) +
                         ") is part of no reaction and not of |A|");
    return orders;
  }

 private:
  /// Of a function, by its place in order_.
  std::size_t column_of(std::size_t place) const { return 1 + place + (place < boundaries_ ? 0 : divisors_); }

  /// Functions make up a square. What the closure divides by, which has zeros at points, does not do so alone.
  bool is_made(std::size_t square) const {
    if (system_.is_pivot(square)) return false;
    const auto all = system_.exponents(square);
    if (!all) return false;
    bool functions = false, divisors = false;
    for (std::size_t i = 0; i < order_.size(); ++i) functions = functions || (*all)[column_of(i)] > 0;
    for (std::size_t d = 0; d < divisors_; ++d) divisors = divisors || (*all)[1 + boundaries_ + d] > 0;
    return functions || !divisors;
  }

  /// Rows of logarithms: 1, the functions of boundaries, the model's divisors, the other functions, the model's squares
  /// and the certificate's, then |A| and the reactions. A divisor may vanish all along a boundary, such as the axis of
  /// a guide from a foot to the pin: what it is in is the boundary's, then.
  bool sample() {
    std::vector<const core::StraightLine*> programs;
    for (const Function& f : c_.functions) programs.push_back(&f.program);
    // Roots that no function holds are wanted too.
    std::vector<core::StraightLine> variables;
    for (int j = 0; j < static_cast<int>(c_.squares.size()); ++j) {
      core::StraightLineBuilder builder;
      variables.push_back(builder.line(builder.variable(2 + j)));
    }
    for (const core::StraightLine& variable : variables) programs.push_back(&variable);
    Sheet sheet(parts_of(c_, mode_), programs, identity_bits);
    const Sides sides = sides_of(c_, mode_);
    always_zero_.assign(unknowns_.size(), true);
    used_.assign(order_.size(), false);
    Scatter scatter;
    for (std::size_t tries = 0; tries < most_tries; ++tries) {
      const Interval x(core::Rational(c_.box[0] + (c_.box[1] - c_.box[0]) * scatter.next()), identity_bits);
      const Interval y(core::Rational(c_.box[2] + (c_.box[3] - c_.box[2]) * scatter.next()), identity_bits);
      const std::optional<Posture> here = posture(m_, sides, x, y);
      if (!here || !std::all_of(here->squares.begin(), here->squares.end(), [](const auto& q) { return q.sign() > 0; }))
        continue;
      if (!sheet.enter(x, y)) throw FalseClaim("roots: one of them is imaginary where the model has a pose");
      const std::optional<Solution> solved = solve(m_, *here, x, y);
      if (!solved) continue;
      const auto log_of_function = [&](std::size_t place) {
        return log_of(sheet.value(static_cast<int>(order_[place])));
      };
      std::vector<Interval> row = {Interval(1.0, identity_bits)}, root_row = {Interval(1.0, identity_bits)};
      for (const Interval& d : here->divisors) root_row.push_back(log_of(d));
      roots_.columns = root_row.size();
      divisors_ = here->divisors.size();
      for (std::size_t i = 0; i < boundaries_; ++i) row.push_back(log_of_function(i));
      row.insert(row.end(), root_row.begin() + 1, root_row.end());
      for (std::size_t i = boundaries_; i < order_.size(); ++i) row.push_back(log_of_function(i));
      for (const Interval& q : here->squares) row.push_back(log_of(q));
      std::size_t root = 0, limit = dyads_ - c_.limit_roots.size();
      for (std::size_t j = 0; j < c_.squares.size(); ++j) {
        const Interval square = log_of(sheet.square(static_cast<int>(j)));
        row.push_back(square);
        const bool of_limit =
            std::find(c_.limit_roots.begin(), c_.limit_roots.end(), static_cast<int>(j)) != c_.limit_roots.end();
        if (of_limit || c_.root_roles[j] == core::RootRole::working_mode)
          root_row.push_back(square - log_of(here->squares[of_limit ? limit++ : root++]));
      }
      system_.columns = row.size();
      row.push_back(log_of(solved->determinant));
      for (std::size_t k = 0; k < unknowns_.size(); ++k) {
        const bool zero = solved->reactions[k].sign() == 0;
        always_zero_[k] = always_zero_[k] && zero;
        row.push_back(zero ? Interval(identity_bits) : log_of(solved->reactions[k]));
      }
      if (!std::all_of(row.begin(), row.end(), [](const Interval& v) { return v.is_finite(); })) continue;
      system_.rows.push_back(std::move(row));
      roots_.rows.push_back(std::move(root_row));
      if (system_.rows.size() == system_.columns + spare_poses) return true;
    }
    return false;
  }

  /// Wanted by itself or as a part of f.
  bool is_wanted(const mechanism::Unknown& unknown) const {
    const mechanism::Joint& joint = m_.joints[static_cast<std::size_t>(unknown.joint)];
    const auto among = [](const auto& list, const auto& value) {
      return std::find(list.begin(), list.end(), value) != list.end();
    };
    return among(c_.joints, joint.name) && (among(c_.quantities, unknown.quantity) ||
                                            (among(c_.quantities, core::Quantity::f) &&
                                             among(mechanism::contact_components(m_, joint), unknown.quantity)));
  }

  std::optional<Exponents> of_functions(std::size_t column) const {
    const auto all = system_.exponents(column);
    if (!all) return std::nullopt;
    Exponents result(order_.size(), 0);
    for (std::size_t i = 0; i < order_.size(); ++i) result[order_[i]] = (*all)[column_of(i)];
    return result;
  }

  /// The same; the functions are used, then.
  std::optional<Exponents> exponents_of(std::size_t column) {
    std::optional<Exponents> result = of_functions(column);
    for (std::size_t f = 0; result && f < used_.size(); ++f) used_[f] = used_[f] || (*result)[f] != 0;
    return result;
  }

  /// Every root of a dyad, slider or limit is the model's, times what the closure divides by: both are real in the same
  /// poses.
  void check_roots() {
    roots_.eliminate();
    for (std::size_t column = roots_.columns; column < roots_.rows.front().size(); ++column)
      if (!roots_.exponents(column)) throw FalseClaim("roots: one of them is not the model's");
  }

  std::vector<std::vector<int>> makers() const {
    std::vector<std::vector<int>> result(order_.size());
    for (std::size_t place = 0; place < order_.size(); ++place) {
      const auto exponents = system_.exponents(column_of(place));
      for (std::size_t i = 0; exponents && i < order_.size(); ++i)
        if ((*exponents)[column_of(i)] > 0) result[order_[place]].push_back(static_cast<int>(order_[i]));
    }
    return result;
  }

  const mechanism::Mechanism& m_;
  const CertificateFile& c_;
  int mode_;
  std::vector<mechanism::Unknown> unknowns_;
  std::size_t dyads_;               // with the ends of limits
  std::vector<std::size_t> order_;  // of the functions among the columns
  std::size_t boundaries_ = 0;      // how many of them come first
  std::size_t divisors_ = 0;        // of the model, after these
  LogSystem system_, roots_;
  std::vector<bool> always_zero_, used_;
};

}  // namespace

Sides sides_of(const CertificateFile& certificate, int mode) {
  Sides sides;
  for (std::size_t j = 0; j < certificate.squares.size(); ++j)
    if (certificate.root_roles[j] == core::RootRole::working_mode)
      sides.push_back(certificate.modes.at(static_cast<std::size_t>(mode))[j]);
  return sides;
}

bool may_be_on_boundary(const mechanism::Mechanism& m, const CertificateFile& certificate, int mode, const Interval& x,
                        const Interval& y) {
  const auto here = posture(m, sides_of(certificate, mode), x, y);
  return !here ||
         std::any_of(here->squares.begin(), here->squares.end(), [](const Interval& q) { return q.contains_zero(); });
}

SheetParts parts_of(const CertificateFile& certificate, int mode, std::vector<int> at_zero) {
  return {&certificate.squares, certificate.modes.at(static_cast<std::size_t>(mode)), std::move(at_zero),
          certificate.slits, certificate.deadline};
}

Orders orders_of(const mechanism::Mechanism& m, const CertificateFile& certificate, int mode) {
  return Fit(m, certificate, mode).run();
}

}  // namespace clearloci::check
