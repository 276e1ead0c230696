#include "tests/laws/double_butterflies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace clearloci::test {
namespace {

using Row = std::vector<double>;

/// The solution of a square system, rows with the right side last, by elimination with pivots.
Row solved(std::vector<Row> rows) {
  const std::size_t size = rows.size();
  for (std::size_t k = 0; k < size; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < size; ++i)
      if (std::abs(rows[i][k]) > std::abs(rows[pivot][k])) pivot = i;
    std::swap(rows[k], rows[pivot]);
    for (std::size_t i = 0; i < size; ++i) {
      if (i == k) continue;
      const double part = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j <= size; ++j) rows[i][j] -= part * rows[k][j];
    }
  }
  Row found;
  for (std::size_t k = 0; k < size; ++k) found.push_back(rows[k][size] / rows[k][k]);
  return found;
}

/// Newton's method does not converge, or a walk does not end.
struct Lost {};

double apart(const Place& p, const Place& q) { return std::hypot(p[0] - q[0], p[1] - q[1]); }

struct Places {
  Place o1, o2, o3, a, b, c, d, e, f, h;
};

Places places(const DoubleButterfly& design, const Assembly& at) {
  const double turn = at[0] - crank_angle(design), cosine = std::cos(turn), sine = std::sin(turn);
  const auto turned = [&](const Place& p) -> Place {
    return {cosine * p[0] - sine * p[1], sine * p[0] + cosine * p[1]};
  };
  return {{0, 0},         design.o2,      design.o3,      turned(design.a), turned(design.b),
          {at[1], at[2]}, {at[3], at[4]}, {at[5], at[6]}, {at[7], at[8]},   {at[9], at[10]}};
}

struct Distance {
  Place Places::*first;
  Place DoubleButterfly::*first_drawn;
  Place Places::*second;
  Place DoubleButterfly::*second_drawn;
  int first_unknown, second_unknown;  ///< the first index in an assembly; 0: none
};

/// C 1, D 3, E 5, F 7, H 9.
constexpr std::array<Distance, 10> distances = {{
    {&Places::a, &DoubleButterfly::a, &Places::c, &DoubleButterfly::c, 0, 1},
    {&Places::b, &DoubleButterfly::b, &Places::f, &DoubleButterfly::f, 0, 7},
    {&Places::o2, &DoubleButterfly::o2, &Places::d, &DoubleButterfly::d, 0, 3},
    {&Places::o3, &DoubleButterfly::o3, &Places::h, &DoubleButterfly::h, 0, 9},
    {&Places::c, &DoubleButterfly::c, &Places::d, &DoubleButterfly::d, 1, 3},
    {&Places::d, &DoubleButterfly::d, &Places::e, &DoubleButterfly::e, 3, 5},
    {&Places::c, &DoubleButterfly::c, &Places::e, &DoubleButterfly::e, 1, 5},
    {&Places::e, &DoubleButterfly::e, &Places::f, &DoubleButterfly::f, 5, 7},
    {&Places::f, &DoubleButterfly::f, &Places::h, &DoubleButterfly::h, 7, 9},
    {&Places::e, &DoubleButterfly::e, &Places::h, &DoubleButterfly::h, 5, 9},
}};

/// Ten rows: the derivatives by the eleven values of the halves of the squared distances, and what these lack.
std::vector<Row> closure(const DoubleButterfly& design, const Assembly& at) {
  const Places now = places(design, at);
  std::vector<Row> rows;
  for (const Distance& distance : distances) {
    const Place &p = now.*distance.first, &q = now.*distance.second;
    const double length = apart(design.*distance.first_drawn, design.*distance.second_drawn);
    Row row(12, 0);
    const Place way = {q[0] - p[0], q[1] - p[1]};
    for (std::size_t k = 0; k < 2; ++k) {
      row[static_cast<std::size_t>(distance.second_unknown) + k] = way[k];
      if (distance.first_unknown > 0) row[static_cast<std::size_t>(distance.first_unknown) + k] = -way[k];
    }
    // The crank's points turn about the origin.
    if (distance.first == &Places::a || distance.first == &Places::b) row[0] = way[0] * p[1] - way[1] * p[0];
    row[11] = (length * length - way[0] * way[0] - way[1] * way[1]) / 2;
    rows.push_back(row);
  }
  return rows;
}

Assembly tangent(const DoubleButterfly& design, const Assembly& at, const Assembly& before) {
  std::vector<Row> rows = closure(design, at);
  for (Row& row : rows) row[11] = 0;
  rows.emplace_back(before.begin(), before.end());
  rows.back().push_back(1);
  const Row found = solved(rows);
  double size = 0;
  for (const double part : found) size += part * part;
  Assembly unit{};
  for (std::size_t k = 0; k < unit.size(); ++k) unit[k] = found[k] / std::sqrt(size);
  return unit;
}

/// Newton's method in the plane through `from` across `normal`; whether it converges, within `most` of `from`.
bool correct(const DoubleButterfly& design, const Assembly& from, const Assembly& normal, double most, Assembly& at) {
  at = from;
  double last = 0;
  for (int round = 0; round < 20; ++round) {
    std::vector<Row> rows = closure(design, at);
    rows.emplace_back(normal.begin(), normal.end());
    rows.back().push_back(0);
    for (std::size_t k = 0; k < at.size(); ++k) rows.back()[11] += normal[k] * (from[k] - at[k]);
    const Row step = solved(rows);
    double size = 0, away = 0;
    for (std::size_t k = 0; k < at.size(); ++k) {
      at[k] += step[k];
      size = std::max(size, std::abs(step[k]));
      away = std::max(away, std::abs(at[k] - from[k]));
    }
    if (!(away <= most)) return false;
    if (size < 1e-13 || (round > 2 && size < 1e-9 && size >= last / 2)) return true;
    last = size;
  }
  return false;
}

/// Forces on the second link of each pin by the first, from the balance of seven links about the origin.
Borne borne(const DoubleButterfly& design, const Assembly& at) {
  const Places now = places(design, at);
  // Links: crank, left, right, A C, B F, O2 D, O3 H; -1 the ground.
  struct Pin {
    int first, second;
    Place at;
  };
  const std::array<Pin, 10> pins = {{{-1, 0, now.o1},
                                     {0, 3, now.a},
                                     {0, 4, now.b},
                                     {3, 1, now.c},
                                     {4, 2, now.f},
                                     {1, 2, now.e},
                                     {1, 5, now.d},
                                     {-1, 5, now.o2},
                                     {2, 6, now.h},
                                     {-1, 6, now.o3}}};
  std::vector<Row> rows(21, Row(22, 0));
  const auto add = [&](int link, std::size_t column, double sign, const Place& place) {
    if (link < 0) return;
    const std::size_t row = 3 * static_cast<std::size_t>(link);
    rows[row][column] += sign;
    rows[row + 2][column] -= sign * place[1];
    rows[row + 1][column + 1] += sign;
    rows[row + 2][column + 1] += sign * place[0];
  };
  for (std::size_t k = 0; k < pins.size(); ++k) {
    add(pins[k].first, 2 * k, -1, pins[k].at);
    add(pins[k].second, 2 * k, 1, pins[k].at);
  }
  rows[2][20] = 1;
  const auto load = [&](std::size_t link, const Place& place, const Place& force) {
    rows[3 * link][21] -= force[0];
    rows[3 * link + 1][21] -= force[1];
    rows[3 * link + 2][21] -= place[0] * force[1] - place[1] * force[0];
  };
  load(1, now.e, design.left);
  load(2, now.f, design.right);
  rows[8][21] -= design.couple;
  const Row found = solved(rows);
  Borne all;
  all.motor = found[20];
  for (std::size_t k = 0; k < pins.size(); ++k) all.pins[k] = std::hypot(found[2 * k], found[2 * k + 1]);
  const auto pull = [&](std::size_t pin, const Place& from, const Place& to) {
    return (found[2 * pin] * (to[0] - from[0]) + found[2 * pin + 1] * (to[1] - from[1])) / apart(from, to);
  };
  all.rods = {pull(1, now.a, now.c), pull(2, now.b, now.f), pull(7, now.o2, now.d), pull(9, now.o3, now.h)};
  return all;
}

std::array<double, 5> signed_values(const Borne& all) {
  return {all.motor, all.rods[0], all.rods[1], all.rods[2], all.rods[3]};
}

Assembly ahead(const Assembly& at, const Assembly& along, double step) {
  Assembly next{};
  for (std::size_t k = 0; k < at.size(); ++k) next[k] = at[k] + step * along[k];
  return next;
}

/// The step at which `is_beyond` changes, within 0 and `step`.
double changing(double step, const std::function<bool(double)>& is_beyond) {
  double low = 0, high = step;
  for (int round = 0; round < 60; ++round) {
    const double middle = (low + high) / 2;
    (is_beyond(middle) ? high : low) = middle;
  }
  return low;
}

/// From the posture to larger angles (way 1) or smaller ones (way -1).
class HalfWalk {
 public:
  HalfWalk(const DoubleButterfly& design, double way, double bound, Walk& walk)
      : design_(design), way_(way), bound_(bound), walk_(walk) {}

  /// Whether it ends at a dead centre, and where it ends.
  std::pair<bool, double> go(Assembly at) {
    Assembly along{};
    along[0] = way_;
    along = tangent(design_, at, along);
    double step = 1e-3;
    for (int steps = 0; steps < 20000; ++steps) {
      Assembly next{};
      const bool is_near = correct(design_, ahead(at, along, step), along, step / 4, next);
      const Assembly further = is_near ? tangent(design_, next, along) : along;
      double cosine = 0;
      for (std::size_t k = 0; k < along.size(); ++k) cosine += along[k] * further[k];
      if (!is_near || cosine < 0.998) {
        step /= 2;
        if (step < 1e-12) throw Lost();
        continue;
      }
      const bool is_dead = further[0] * way_ <= 0, is_out = (next[0] - bound_) * way_ >= 0;
      if (is_dead || is_out) return end(at, along, step, is_dead);
      note(at, along, step);
      at = next;
      along = further;
      walk_.along.push_back(at);
      step = std::min(1.4 * step, 5e-3);
    }
    throw Lost();
  }

 private:
  Assembly on_curve(const Assembly& at, const Assembly& along, double step) const {
    Assembly next{};
    if (!correct(design_, ahead(at, along, step), along, 1, next)) throw Lost();
    return next;
  }

  std::pair<bool, double> end(const Assembly& at, const Assembly& along, double step, bool is_dead) {
    double last = step;
    if (is_dead)
      last = changing(step,
                      [&](double part) { return tangent(design_, on_curve(at, along, part), along)[0] * way_ <= 0; });
    const Assembly dead = on_curve(at, along, last);
    if ((dead[0] - bound_) * way_ < 0) {
      note(at, along, last * (1 - 1e-6));
      walk_.along.push_back(on_curve(at, along, last * (1 - 1e-6)));
      return {true, dead[0]};
    }
    last = changing(last, [&](double part) { return (on_curve(at, along, part)[0] - bound_) * way_ >= 0; });
    note(at, along, last);
    walk_.along.push_back(on_curve(at, along, last));
    return {false, bound_};
  }

  void note(const Assembly& at, const Assembly& along, double step) {
    const auto now = signed_values(borne(design_, at)), then = signed_values(borne(design_, on_curve(at, along, step)));
    for (std::size_t k = 0; k < now.size(); ++k) {
      if ((now[k] < 0) == (then[k] < 0)) continue;
      const double part = changing(step, [&](double candidate) {
        return (signed_values(borne(design_, on_curve(at, along, candidate)))[k] < 0) != (now[k] < 0);
      });
      walk_.along.push_back(on_curve(at, along, part));
      walk_.changes.push_back({k, walk_.along.back()[0]});
    }
  }

  const DoubleButterfly& design_;
  double way_, bound_;
  Walk& walk_;
};

std::string pair_of(const Place& p) { return fmt::format("[{}, {}]", p[0], p[1]); }

/// Of the crank's angle, of six digits.
std::array<double, 2> bounds(const DoubleButterfly& design, double reach) {
  return {std::round(1e6 * (crank_angle(design) - reach)) / 1e6, std::round(1e6 * (crank_angle(design) + reach)) / 1e6};
}

std::string head(const DoubleButterfly& design, double reach, bool is_drawn) {
  return fmt::format("format: 1\nspace: planar\nworkspace:\n  theta: {{angle: [{:.6f}, {:.6f}]{}}}\n",
                     bounds(design, reach)[0], bounds(design, reach)[1], is_drawn ? ", of: crank" : "");
}

std::string rest(const DoubleButterfly& design) {
  std::string text = R"(links:
  crank: {points: [O1, A, B]}
  left:  {points: [C, D, E]}
  right: {points: [E, F, H]}
  AC:  {points: [A, C]}
  BF:  {points: [B, F]}
  O2D: {points: [O2, D]}
  O3H: {points: [O3, H]}
joints:
  O1: {revolute: [ground, crank], at: O1, actuated: true, clearance: {radial: 10e-6, angular: 0.5e-3}}
  A: {revolute: [crank, AC], at: A, clearance: {radial: 10e-6}}
  B: {revolute: [crank, BF], at: B, clearance: {radial: 10e-6}}
  C: {revolute: [AC, left], at: C, clearance: {radial: 10e-6}}
  F: {revolute: [BF, right], at: F, clearance: {radial: 10e-6}}
  E: {revolute: [left, right], at: E, clearance: {radial: 10e-6}}
  D: {revolute: [left, O2D], at: D, clearance: {radial: 10e-6}}
  O2: {revolute: [ground, O2D], at: O2, clearance: {radial: 10e-6}}
  H: {revolute: [right, O3H], at: H, clearance: {radial: 10e-6}}
  O3: {revolute: [ground, O3H], at: O3, clearance: {radial: 10e-6}}
end_effector: {link: left, at: E}
loads:
)";
  text += fmt::format("  - {{link: left, at: E, force: {}}}\n", pair_of(design.left));
  if (design.couple != 0)
    text += fmt::format("  - {{link: right, at: F, force: {}, couple: {}}}\n", pair_of(design.right), design.couple);
  return text;
}

}  // namespace

DoubleButterfly double_butterfly(std::mt19937& random, bool lattice) {
  const auto number = [&](double low, double high) {
    const double this_uniform_real_distribution = std::uniform_real_distribution<double>(low, high)(random);
    return lattice ? std::round(4 * this_uniform_real_distribution) / 4
                   : std::round(1000 * this_uniform_real_distribution) / 1000;
  };
  const auto near = [&](double x, double y) -> Place { return {number(x - 0.7, x + 0.7), number(y - 0.7, y + 0.7)}; };
  DoubleButterfly butterfly;
  butterfly.o2 = near(-2.5, 0);
  butterfly.o3 = near(4, 0);
  butterfly.a = near(-0.5, 1);
  butterfly.b = near(1.2, 0.8);
  butterfly.c = near(-0.5, 2.5);
  butterfly.d = near(-2.5, 2);
  butterfly.e = near(0.5, 3.5);
  butterfly.f = near(2, 2.2);
  butterfly.h = near(3.5, 2.5);
  const std::array<Place, 10> all = {Place{0, 0}, butterfly.o2, butterfly.o3, butterfly.a, butterfly.b,
                                     butterfly.c, butterfly.d,  butterfly.e,  butterfly.f, butterfly.h};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (apart(all[i], all[k]) < 0.1) return double_butterfly(random, lattice);
  butterfly.left = {number(-50, 50), number(-100, -10)};
  if (random() % 2 == 0) {
    butterfly.right = {number(-50, 50), number(-80, 20)};
    butterfly.couple = number(5, 40);
  }
  return butterfly;
}

double crank_angle(const DoubleButterfly& design) { return std::atan2(design.a[1], design.a[0]); }

std::string drawn_text(const DoubleButterfly& butterfly, double reach) {
  return "drawn:\n  O1: [0, 0]\n" +
         fmt::format("  O2: {}\n  O3: {}\n  A: {}\n  B: {}\n  C: {}\n  D: {}\n  E: {}\n  F: {}\n  H: {}\n",
                     pair_of(butterfly.o2), pair_of(butterfly.o3), pair_of(butterfly.a), pair_of(butterfly.b),
                     pair_of(butterfly.c), pair_of(butterfly.d), pair_of(butterfly.e), pair_of(butterfly.f),
                     pair_of(butterfly.h)) +
         head(butterfly, reach, true) + rest(butterfly);
}

std::string group_text(const DoubleButterfly& butterfly, double reach) {
  const auto length = [](const Place& p, const Place& q) {
    return fmt::format("'sqrt(({} - ({}))^2 + ({} - ({}))^2)'", q[0], p[0], q[1], p[1]);
  };
  const double square = butterfly.a[0] * butterfly.a[0] + butterfly.a[1] * butterfly.a[1];
  const double along = (butterfly.b[0] * butterfly.a[0] + butterfly.b[1] * butterfly.a[1]) / std::sqrt(square),
               beside = (butterfly.a[0] * butterfly.b[1] - butterfly.a[1] * butterfly.b[0]) / std::sqrt(square);
  const std::string crank = length({0, 0}, butterfly.a);
  const std::string radius = crank.substr(1, crank.size() - 2);
  return head(butterfly, reach, false) +
         fmt::format("points:\n  O1: [0, 0]\n  O2: {}\n  O3: {}\n", pair_of(butterfly.o2), pair_of(butterfly.o3)) +
         fmt::format("  A: ['{0}*cos(theta)', '{0}*sin(theta)']\n", radius) +
         fmt::format(
             "  B: ['{0:.15f}*cos(theta) - ({1:.15f})*sin(theta)', '{0:.15f}*sin(theta) + ({1:.15f})*cos(theta)']\n",
             along, beside) +
         fmt::format(
             "  links:\n    group: [C, D, E, F, H]\n    lengths: {{A-C: {}, B-F: {}, O2-D: {}, O3-H: {}, C-D: {}, "
             "D-E: {}, C-E: {}, E-F: {}, F-H: {}, E-H: {}}}\n",
             length(butterfly.a, butterfly.c), length(butterfly.b, butterfly.f), length(butterfly.o2, butterfly.d),
             length(butterfly.o3, butterfly.h), length(butterfly.c, butterfly.d), length(butterfly.d, butterfly.e),
             length(butterfly.c, butterfly.e), length(butterfly.e, butterfly.f), length(butterfly.f, butterfly.h),
             length(butterfly.e, butterfly.h)) +
         fmt::format("    near: {{at: {{theta: {:.15f}}}, C: {}, D: {}, E: {}, F: {}, H: {}}}\n",
                     crank_angle(butterfly), pair_of(butterfly.c), pair_of(butterfly.d), pair_of(butterfly.e),
                     pair_of(butterfly.f), pair_of(butterfly.h)) +
         rest(butterfly);
}

std::optional<Walk> walk(const DoubleButterfly& design, double reach) try {
  Walk found;
  const Assembly at = {crank_angle(design), design.c[0], design.c[1], design.d[0], design.d[1], design.e[0],
                       design.e[1],         design.f[0], design.f[1], design.h[0], design.h[1]};
  found.along.push_back(at);
  std::tie(found.dead_from, found.from) = HalfWalk(design, -1, bounds(design, reach)[0], found).go(at);
  std::tie(found.dead_to, found.to) = HalfWalk(design, 1, bounds(design, reach)[1], found).go(at);
  return found;
} catch (const Lost&) {
  return std::nullopt;
}

std::optional<Borne> borne_at(const DoubleButterfly& design, const Walk& walk, double theta) {
  const auto nearest = *std::min_element(walk.along.begin(), walk.along.end(), [&](const auto& one, const auto& other) {
    return std::abs(one[0] - theta) < std::abs(other[0] - theta);
  });
  Assembly from = nearest, crank{}, at{};
  from[0] = theta;
  crank[0] = 1;
  if (!correct(design, from, crank, 1, at)) return std::nullopt;
  return borne(design, at);
}

}  // namespace clearloci::test
