// How far the end effector is displaced over a cell of poses and designs by the clearances that its joints take up
// (task_cell.hpp). Which way a joint takes up its clearance turns with the load, unlike sizes of reactions: loads are
// cut where one part of them at a time says more than all at once.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/errors.hpp"
#include "loci/search/search.hpp"
#include "loci/tasks/task_cell.hpp"

namespace clearloci::loci {
namespace {

using core::Interval;
using core::TaskCondition;

/// Parts of the loads that a cell may be looked at under, to be proven, and to be measured.
constexpr int most_parts = 200, most_parts_of_a_bound = 24;

Interval around_zero(double size) { return {-size, size}; }

/// Both, whichever of them it is.
Centred either(const Centred& a, const Centred& b) {
  return centred::combined(a, b, hull(a.over, b.over), hull(a.middle, b.middle),
                           [](const Interval& x, const Interval& y) { return hull(x, y); });
}

}  // namespace

void TaskCell::enclose_centred() {
  differentiate();
  if (!offsets_.empty()) return;
  centred_.assign(static_cast<std::size_t>(program_.functions()), std::nullopt);
  for (int c = 0; c < cell_->coordinates(); ++c) {
    const Interval& range = cell_->local(c);
    offsets_.push_back(range.width() == 0 ? Interval(0.0) : range - Interval(cell_->middle(c)));
  }
}

const Centred& TaskCell::centred(int function) {
  std::optional<Centred>& centred = centred_[static_cast<std::size_t>(function)];
  if (!centred) {
    centred = Centred{value(function), cell_->middle_value(function), {}};
    for (int c = 0; c < cell_->coordinates(); ++c) centred->slopes.push_back(cell_->slope(function, c));
    centred->tighten(offsets_);
  }
  return *centred;
}

/// A component of a reaction times D.
Centred TaskCell::loaded(const TaskCondition& take_up, std::size_t part, const Loads& loads) {
  const auto along = [&](double t) {
    const Centred& first = centred(take_up.parts.front()[part]);
    if (t == 0) return first;
    const Centred& last = centred(take_up.parts.back()[part]);
    if (t == 1) return last;
    return centred::sum(centred::scaled(Interval(1.0) - Interval(t), first), centred::scaled(t, last));
  };
  // Affine in t.
  Centred loaded = along(loads.t.lower());
  if (loads.t.width() > 0) loaded = either(loaded, along(loads.t.upper()));
  for (std::size_t d = 0; d < loads.factors.size(); ++d)
    if (loads.factors[d].magnitude() > 0)
      loaded = centred::sum(loaded, centred::scaled(loads.factors[d], centred(take_up.directions[d][part])));
  return loaded;
}

/// f / |f| times the sign of D, or the sign of M likewise; what is not known of it is anything up to 1.
std::vector<Centred> TaskCell::directions_taken(const TaskCondition& take_up, const Loads& loads) {
  const std::size_t n = static_cast<std::size_t>(cell_->coordinates()), parts = take_up.parts.front().size();
  std::vector<Centred> directions_taken;
  for (std::size_t i = 0; i < parts; ++i) directions_taken.push_back(loaded(take_up, i, loads));
  if (parts == 1) {
    const int sign = directions_taken[0].over.sign();
    return {sign != 0 ? Centred::constant(sign, n) : Centred::rough(around_zero(1), n)};
  }
  Centred square = Centred::constant(0.0, n);
  for (const Centred& part : directions_taken) square = centred::sum(square, centred::square(part));
  square.tighten(offsets_);
  if (!(square.over.lower() > 0)) return std::vector(parts, Centred::rough(around_zero(1), n));
  const Centred per_length = centred::reciprocal(centred::root(square));
  for (Centred& part : directions_taken) {
    part = centred::product(part, per_length).tighten(offsets_);
    part.over = meet(part.over, around_zero(1));
  }
  return directions_taken;
}

Centred TaskCell::squared_displacement(const Loads& loads) {
  const std::size_t n = static_cast<std::size_t>(cell_->coordinates());
  std::array<Centred, 2> displaced = {Centred::constant(0.0, n), Centred::constant(0.0, n)};
  std::vector<std::array<Interval, 2>> shares;
  per_clearance_.assign(clearances_.size(), Interval(0.0));
  for (std::size_t k = 0; k < conditions_.take_ups.size(); ++k) {
    const TaskCondition& take_up = conditions_.take_ups[k];
    const Centred below = centred(take_up.denominator);
    if (below.over.sign() == 0) return Centred::rough({0, 1e50}, n);
    Centred per_d = centred::scaled(below.over.sign(), centred::reciprocal(below));
    // Both factors of f^u . f / |f| are |axis| times what the joint bears, and |f| is.
    if (take_up.squared_axis >= 0) {
      const Centred square = centred(take_up.squared_axis);
      if (!(square.over.lower() > 0)) return Centred::rough({0, 1e50}, n);
      per_d = centred::product(per_d, centred::reciprocal(centred::root(square)));
    }
    const std::vector<Centred> taken = directions_taken(take_up, loads);
    std::array<Interval, 2>& share = shares.emplace_back();
    for (std::size_t u = 0; u < 2; ++u) {
      // The unit forces are the last two directions.
      const std::vector<int>& to = take_up.directions[take_up.directions.size() - 2 + u];
      Centred moved = Centred::constant(0.0, n);
      for (std::size_t i = 0; i < taken.size(); ++i)
        moved = centred::sum(moved, centred::product(centred(to[i]), taken[i]));
      moved = centred::product(moved, per_d).tighten(offsets_);
      share[u] = moved.over;
      displaced[u] = centred::sum(displaced[u], centred::scaled(clearances_[k], moved));
    }
  }
  for (Centred& centred : displaced) centred.tighten(offsets_);
  for (std::size_t k = 0; k < shares.size(); ++k)
    per_clearance_[k] = Interval(2.0) * (displaced[0].over * shares[k][0] + displaced[1].over * shares[k][1]);
  Centred all = centred::sum(centred::square(displaced[0]), centred::square(displaced[1]));
  all.over = meet(all.over, squared(displaced[0].over) + squared(displaced[1].over));
  return all.tighten(offsets_);
}

TaskCell::Loads TaskCell::all_loads() const {
  Loads all{Interval(0.0, conditions_.loads > 1 ? 1.0 : 0.0), std::vector(conditions_.directions, Interval(0.0))};
  for (const core::LoadBall& ball : extent_.balls)
    std::fill_n(all.factors.begin() + static_cast<std::ptrdiff_t>(ball.first), ball.count, around_zero(ball.radius));
  return all;
}

/// Nothing: outside some ball.
std::optional<Interval> TaskCell::displacement_under(const Loads& loads) {
  for (const core::LoadBall& ball : extent_.balls) {
    double size = 0;
    for (std::size_t d = ball.first; d < ball.first + ball.count; ++d)
      size = std::hypot(size, loads.factors[d].mignitude());
    if (size > ball.radius * (1 + 0x1p-40)) return std::nullopt;
  }
  squared_ = squared_displacement(loads);
  return square_root(Interval(std::max(0.0, squared_.over.lower()), std::max(0.0, squared_.over.upper())));
}

/// One load in the middle of some.
TaskCell::Loads TaskCell::middle_of(const Loads& loads) {
  Loads middle{loads.t.middle(), {}};
  for (const Interval& factor : loads.factors) middle.factors.emplace_back(factor.middle());
  return middle;
}

/// The two halves of some, along what is the largest part of the whole; nothing where it is one load.
std::vector<TaskCell::Loads> TaskCell::halves_of(const Loads& loads) const {
  const Loads all = all_loads();
  double widest = loads.t.width() > 0 ? loads.t.width() / all.t.width() : 0.0;
  int along = widest > 0 ? -1 : -2;
  for (std::size_t d = 0; d < loads.factors.size(); ++d) {
    const double part = loads.factors[d].width() > 0 ? loads.factors[d].width() / all.factors[d].width() : 0.0;
    if (part > widest) widest = part, along = static_cast<int>(d);
  }
  if (along == -2) return {};
  std::vector<Loads> halves(2, loads);
  for (std::size_t half = 0; half < 2; ++half) {
    Interval& interval = along < 0 ? halves[half].t : halves[half].factors[static_cast<std::size_t>(along)];
    interval = loci::halves_of(interval)[half];
  }
  return halves;
}

bool TaskCell::displaced_within(double most) {
  enclose_centred();
  const Loads all = all_loads();
  if (displacement_under(all)->upper() <= most) return true;
  // Where one load is too much of it, or leaves little room, the poses are to be cut, or it is too far.
  constexpr double room_of_poses = 0.3;
  const Loads middle = middle_of(all);
  BoxSearch<Loads> left(SearchOrder::depth_first);
  for (Loads& half : halves_of(all)) left.push(std::move(half));
  const Interval one = *displacement_under(middle);
  if (left.empty() || one.width() > room_of_poses * (most - one.lower())) return false;
  while (!left.empty()) {
    const Loads loads = left.take();
    ++parts_of_loads_;
    const auto size = displacement_under(loads);
    if (!size || size->upper() <= most) continue;
    const std::vector<Loads> halves = halves_of(loads);
    if (parts_of_loads_ >= most_parts || halves.empty() ||
        displacement_under(middle_of(loads)).value_or(0.0).upper() > most) {
      (void)displacement_under(middle);  // its slopes say where to cut
      return false;
    }
    for (const Loads& half : halves) left.push(half);
  }
  return true;
}

/// Best first over the loads: the bound of the worst part of them against what single loads do.
Interval TaskCell::displacement() {
  core::ensure(clearances_.size() == conditions_.take_ups.size(), "a clearance for every take-up");
  enclose_centred();
  struct LoadsPart {
    Loads loads;
    Interval size;
  };
  BoxSearch<LoadsPart> left(SearchOrder::least_key_first);  // keys: bounds, negated
  const auto push = [&](const Loads& loads, const Interval& size) { left.push({loads, size}, -size.upper()); };
  const Loads all = all_loads();
  push(all, *displacement_under(all));
  double lower = 0;
  for (int parts = 0; parts < most_parts_of_a_bound; ++parts) {
    const std::vector<Loads> halves = halves_of(left.next().box.loads);
    if (halves.empty()) return left.next().box.size;
    if (const auto one = displacement_under(middle_of(left.next().box.loads))) lower = std::max(lower, one->lower());
    const Interval whole = left.take().size;
    for (const Loads& half : halves)
      if (const auto displacement = displacement_under(half))
        push(half, meet(*displacement, Interval(0.0, whole.upper())));
  }
  const auto& [loads, size] = left.next().box;
  (void)displacement_under(middle_of(loads));
  return {std::min(lower, size.upper()), size.upper()};
}

std::optional<TaskCell::Loads> TaskCell::displaced_too_far() {
  if (clearances_.empty() || extent_.most_displaced == std::numeric_limits<double>::infinity()) return std::nullopt;
  const auto too_far = [&](const Loads& loads) {
    const auto size = displacement_under(loads);
    return size && size->lower() > extent_.most_displaced;
  };
  const Loads all = all_loads();
  const std::array<double, 3> parts = {0.5 * all.t.upper(), 0.0, all.t.upper()};
  for (const double t : parts) {
    Loads one = middle_of(all);
    one.t = t;
    if (too_far(one)) return one;
  }
  if (extent_.balls.empty()) return std::nullopt;
  // Every ball at its edge: forces in the same direction, couples to either side.
  constexpr int directions = 16;
  for (int i = 0; i < 2 * directions; ++i) {
    Loads one = middle_of(all);
    const double angle = M_PI * i / directions, inwards = 1 - 0x1p-40;
    for (const core::LoadBall& ball : extent_.balls) {
      const double edge = inwards * ball.radius;
      if (ball.count == 2) {
        one.factors[ball.first] = edge * std::cos(angle);
        one.factors[ball.first + 1] = edge * std::sin(angle);
      } else {
        one.factors[ball.first] = (i % 2 == 0 ? 1 : -1) * edge;
      }
    }
    if (too_far(one)) return one;
  }
  return std::nullopt;
}

}  // namespace clearloci::loci
