#include "loci/tasks/design_proof.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "loci/tasks/task_cover.hpp"

namespace clearloci::loci {
namespace {

using core::Interval;
using core::Point2;

/// The finest cells, as a part of the task and of the designs: some hundred spacings of doubles.
constexpr double finest = 0x1p-44;
/// One design of a box. A parameter whose range is but the rounding of one number keeps that range.
std::vector<Interval> one_of(const std::vector<Interval>& box) {
  constexpr double roundings = 0x1p-49;
  std::vector<Interval> one;
  for (const Interval& range : box) {
    const bool number = range.width() <= roundings * range.magnitude();
    one.push_back(number ? range : Interval(std::clamp(range.middle(), range.lower(), range.upper())));
  }
  return one;
}

std::vector<double> middle_of(const std::vector<Interval>& box) {
  std::vector<double> middle;
  for (const Interval& range : box) middle.push_back(std::clamp(range.middle(), range.lower(), range.upper()));
  return middle;
}

}  // namespace

DesignJudge::DesignJudge(const core::TaskConditions& conditions, const core::WorkingMode& mode,
                         const TaskRegion& region, DesignVariables variables, std::vector<core::LoadBall> balls,
                         DesignClearances clearances)
    : cell_(conditions, mode, {std::move(balls), clearances.most_displaced}),
      region_(region),
      variables_(std::move(variables)),
      clearances_(std::move(clearances)),
      samples_(region.samples()) {
  // Corners and middles are where engineers put zeros, and far apart: most designs that fail do so at one of a few.
  constexpr std::size_t most_samples = 24;
  if (samples_.size() > most_samples) {
    core::Polyline some;
    for (std::size_t i = 0; i < most_samples; ++i) some.push_back(samples_[i * samples_.size() / most_samples]);
    samples_ = std::move(some);
  }
}

TaskCell::State DesignJudge::enter(const Box& box) {
  in_tower_.assign({box[0], box[1]});
  const DesignBox parameters(box.begin() + 2, box.end());
  for (std::size_t v = 0; v < variables_.parameters.size(); ++v)
    in_tower_.push_back(variables_.enclosure(v, parameters));
  return cell_.enter(in_tower_, clearances_of(parameters));
}

std::vector<Interval> DesignJudge::clearances_of(const DesignBox& parameters) const {
  std::vector<Interval> clearances;
  for (std::size_t k = 0; k < clearances_.parameters.size(); ++k)
    clearances.push_back(clearances_.enclosure(k, parameters));
  return clearances;
}

DesignJudge::Box DesignJudge::over_designs(const DesignBox& designs, double reach) const {
  Box box = {Interval(region_.lower()[0] - reach, region_.upper()[0] + reach),
             Interval(region_.lower()[1] - reach, region_.upper()[1] + reach)};
  box.insert(box.end(), designs.begin(), designs.end());
  return box;
}

int DesignJudge::cut(const Box& box) {
  const std::vector<double>& spreads = cell_.spreads();
  std::vector<double> moved(box.size(), 0.0);
  moved[0] = spreads[0];
  moved[1] = spreads[1];
  for (std::size_t v = 0; v < variables_.parameters.size(); ++v)
    for (const std::size_t p : variables_.parameters[v]) moved[2 + p] += spreads[2 + v];
  const std::vector<double>& of_clearances = cell_.clearance_spreads();
  for (std::size_t k = 0; k < of_clearances.size(); ++k)
    for (const std::size_t p : clearances_.parameters[k]) moved[2 + p] += of_clearances[k];
  int best = -1;
  for (std::size_t c = 0; c < box.size(); ++c)
    if (box[c].width() > 0 && (best < 0 || moved[c] > moved[static_cast<std::size_t>(best)]))
      best = static_cast<int>(c);
  return best;
}

std::vector<Interval> DesignJudge::coordinates(const Point2& pose, const std::vector<double>& parameters) const {
  const DesignBox thin(parameters.begin(), parameters.end());
  Box all = {Interval(pose[0]), Interval(pose[1])};
  for (std::size_t v = 0; v < variables_.parameters.size(); ++v) all.push_back(variables_.enclosure(v, thin));
  return all;
}

int DesignJudge::sign_at(std::size_t watched, const Point2& pose, const std::vector<double>& parameters) {
  const TaskCell::State state = cell_.enter(coordinates(pose, parameters));
  if (state == TaskCell::State::outside || state == TaskCell::State::boundary) return 0;
  return cell_.sign(watched);
}

std::optional<DesignFailure> DesignJudge::at(const Point2& pose, const DesignBox& designs, bool one) {
  if (!one) return looked_at(pose, designs, {});
  const DesignBox middle = one_of(designs);
  if (auto found = looked_at(pose, middle, middle_of(designs))) return found;
  const DesignBox corner = corner_of(pose, designs);
  return corner.empty() ? std::nullopt : looked_at(pose, corner, middle_of(corner));
}

/// The corner of the designs towards which, at this pose, what is in doubt gets worse. Empty: nothing is in doubt.
DesignBox DesignJudge::corner_of(const Point2& pose, const DesignBox& designs) {
  box_.assign({Interval(pose[0]), Interval(pose[1])});
  box_.insert(box_.end(), designs.begin(), designs.end());
  const TaskCell::State state = enter(box_);
  if (state == TaskCell::State::proven || state == TaskCell::State::outside) return {};
  const std::vector<int> ways = cell_.downhill();
  std::vector<int> worse(designs.size(), 0);
  for (std::size_t v = 0; v < variables_.parameters.size(); ++v)
    for (const std::size_t p : variables_.parameters[v])
      if (worse[p] == 0) worse[p] = ways[2 + v];
  const std::vector<int> of_clearances = cell_.clearances_downhill();
  for (std::size_t k = 0; k < of_clearances.size(); ++k)
    for (const std::size_t p : clearances_.parameters[k])
      if (worse[p] == 0) worse[p] = of_clearances[k];
  DesignBox corner = one_of(designs);
  for (std::size_t p = 0; p < worse.size(); ++p)
    if (corner[p].width() == 0 && worse[p] != 0)
      corner[p] = Interval(worse[p] < 0 ? designs[p].lower() : designs[p].upper());
  return corner;
}

std::optional<DesignFailure> DesignJudge::looked_at(const Point2& pose, const DesignBox& designs,
                                                    std::vector<double> middle) {
  box_.assign({Interval(pose[0]), Interval(pose[1])});
  box_.insert(box_.end(), designs.begin(), designs.end());
  using Kind = DesignFailure::Kind;
  using State = TaskCell::State;
  const State state = enter(box_);
  if (state == State::outside) return DesignFailure{Kind::unreachable, -1, pose, middle};
  if (state == State::boundary) return std::nullopt;
  if (state != State::proven)
    if (const int condition = cell_.failed(); condition >= 0)
      return DesignFailure{Kind::too_small, condition, pose, middle};
  if (state == State::unmet && cell_.unmet() < 0)
    if (const auto loads = cell_.displaced_too_far()) {
      DesignFailure found{Kind::displaced, -1, pose, middle};
      found.load = loads->t.middle();
      for (const Interval& factor : loads->factors) found.load_factors.push_back(factor.middle());
      return found;
    }
  for (std::size_t w = 0; w < cell_.watched(); ++w) {
    const int sign = cell_.sign(w);
    if (sign == 0) continue;
    Seen& seen = seen_[static_cast<std::size_t>(cell_.group_of(w))];
    if (seen.sign == 0) seen = {pose, middle, sign};
    if (seen.sign == sign) continue;
    const int condition = cell_.condition_of(w);
    return DesignFailure{
        condition < 0 ? Kind::singular : Kind::vanishing, condition, pose, middle, w, seen.at, seen.parameters};
  }
  return std::nullopt;
}

DesignProof DesignJudge::judge(const DesignBox& designs, double margin, Refuting refuting, const SearchBudget& budget) {
  DesignProof proof;
  SearchMeter meter(budget);
  const bool one = refuting == Refuting::one;
  seen_.assign(static_cast<std::size_t>(cell_.groups()), Seen{});
  const auto fails = [&](std::optional<DesignFailure> found) {
    if (!found) return false;
    proof.verdict = core::Verdict::refuted;
    proof.failure = std::move(found);
    proof.cost = meter.cost();
    return true;
  };
  for (const Point2& pose : samples_)
    if (fails(at(pose, designs, one))) return proof;
  const double reach = margin + hair_of(region_, margin);
  const Box whole = over_designs(designs, reach);
  std::vector<double> least;
  for (const Interval& range : whole) least.push_back(std::max(finest * range.width(), 0x1p-50 * range.magnitude()));
  BoxSearch<Box> left(SearchOrder::breadth_first);
  const auto push = [&](Box box) {
    if (region_.distance(box[0], box[1]) <= reach) left.push(std::move(box));
  };
  push(whole);
  while (!left.empty() && meter.begin()) {
    const Box box = left.take();
    const TaskCell::State state = enter(box);
    meter.add(cell_.parts_of_loads());
    if (state == TaskCell::State::proven) {
      meter.prove();
      continue;
    }
    int along = cut(box);
    if (const auto pose = pose_within(region_, margin, box[0], box[1]))
      if (fails(at(*pose, one ? DesignBox(box.begin() + 2, box.end()) : designs, one))) return proof;
    if (along >= 0 && box[static_cast<std::size_t>(along)].width() <= least[static_cast<std::size_t>(along)])
      along = -1;
    for (std::size_t c = 0; along < 0 && c < box.size(); ++c)
      if (box[c].width() > least[c]) along = static_cast<int>(c);
    if (along < 0)
      leave_open(proof, box[0], box[1]);
    else
      for (Box& half : halves_of(box, static_cast<std::size_t>(along))) push(std::move(half));
  }
  for (const auto& [key, box] : left) leave_open(proof, box[0], box[1]);
  proof.cost = meter.cost();
  if (proof.open == 0) proof.verdict = core::Verdict::verified;
  return proof;
}

double DesignJudge::violation(const DesignBox& designs) {
  constexpr int along = 8;
  core::Polyline poses = samples_;
  for (int i = 0; i <= along; ++i)
    for (int j = 0; j <= along; ++j)
      poses.push_back(region_.closest({region_.lower()[0] + (region_.upper()[0] - region_.lower()[0]) * i / along,
                                       region_.lower()[1] + (region_.upper()[1] - region_.lower()[1]) * j / along}));
  std::vector<std::array<int, 2>> signs(static_cast<std::size_t>(cell_.groups()), {0, 0});
  int failed = 0;
  const DesignBox one = one_of(designs);
  for (const Point2& pose : poses) {
    box_.assign({Interval(pose[0]), Interval(pose[1])});
    box_.insert(box_.end(), one.begin(), one.end());
    const TaskCell::State state = enter(box_);
    if (state != TaskCell::State::proven) ++failed;
    if (state == TaskCell::State::outside || state == TaskCell::State::boundary) continue;
    for (std::size_t w = 0; w < cell_.watched(); ++w)
      if (const int sign = cell_.sign(w); sign != 0)
        ++signs[static_cast<std::size_t>(cell_.group_of(w))][sign > 0 ? 1 : 0];
  }
  int minority = 0;
  for (const auto& of_group : signs) minority = std::max(minority, std::min(of_group[0], of_group[1]));
  return std::min(1.0, static_cast<double>(failed + minority) / static_cast<double>(poses.size()));
}

double DesignJudge::clearance(const DesignBox& designs, double from, double limit, double accuracy,
                              const SearchBudget& budget) {
  const double size = size_of(region_, 0);
  SearchMeter meter(budget);
  BoxSearch<Box> left(SearchOrder::least_key_first);  // keys: distances
  left.push(over_designs(designs, limit));
  double margin = limit;
  while (!left.empty() && left.next().key < limit) {
    const bool over = !meter.begin();
    const double distance = left.next().key;
    const Box box = left.take();
    const double middle = region_.signed_distance({box[0].middle(), box[1].middle()});
    const double half = 0.5 * std::hypot(box[0].width(), box[1].width());
    if (middle + half <= from) continue;  // the task's proof has covered it
    if (enter(box) == TaskCell::State::proven) continue;
    const int along = cut(box);
    // Cells differ in how far they are by their extent along x and y alone.
    if (over || along < 0 || 2 * half <= accuracy * std::max(distance, size)) {
      margin = distance;
      break;
    }
    for (Box& part : halves_of(box, static_cast<std::size_t>(along))) {
      const double from_task = region_.distance(part[0], part[1]);
      left.push(std::move(part), std::max(distance, from_task));
    }
  }
  return std::max(from, margin - hair_of(region_, limit));
}

Interval DesignJudge::extreme_size(const DesignBox& designs, const std::vector<int>& conditions, double accuracy,
                                   const SearchBudget& budget, bool least) {
  const auto size = [&] {
    Interval all = cell_.size_of(conditions.front(), least);
    for (const int condition : conditions) {
      const Interval one = cell_.size_of(condition, least);
      all = least ? Interval(std::min(all.lower(), one.lower()), std::min(all.upper(), one.upper()))
                  : Interval(std::max(all.lower(), one.lower()), std::max(all.upper(), one.upper()));
    }
    return all;
  };
  return extreme(designs, size, accuracy, budget, least);
}

Interval DesignJudge::greatest_displacement(const DesignBox& designs, double accuracy, const SearchBudget& budget) {
  const auto size = [&] {
    const Interval displaced = cell_.displacement();
    cell_.doubt_displacement();
    return displaced;
  };
  // Loads that differ are looked at part by part in every cell.
  SearchBudget fewer = budget;
  if (cell_.has_many_loads()) fewer.most_cells /= 20;
  return extreme(designs, size, accuracy, fewer, false);
}

/// Best first: the bound of the best cell against the best value at a pose.
Interval DesignJudge::extreme(const DesignBox& designs, const std::function<Interval()>& size, double accuracy,
                              const SearchBudget& budget, bool least) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  struct BoxToCut {
    Box box;
    int along = -1;  ///< the coordinate to cut, where that is known
  };
  const double sign = least ? 1.0 : -1.0;
  double known_loss = infinity;  // some pose's
  const auto over = [&](const Box& box) -> std::optional<Interval> {
    const TaskCell::State state = enter(box);
    if (state == TaskCell::State::boundary || state == TaskCell::State::singular) return std::nullopt;
    if (state == TaskCell::State::outside) return std::nullopt;
    return size();
  };
  const auto look = [&](const Point2& pose, const DesignBox& some) {
    Box box = {Interval(pose[0]), Interval(pose[1])};
    const DesignBox one = one_of(some);
    box.insert(box.end(), one.begin(), one.end());
    if (const auto here = over(box)) known_loss = std::min(known_loss, sign * (least ? here->upper() : here->lower()));
  };
  for (const Point2& pose : samples_) look(pose, designs);
  SearchMeter meter(budget);
  // Keys: bounds of what is to be made least: the size, or what it is short of nothing.
  BoxSearch<BoxToCut> left(SearchOrder::least_key_first);
  left.push({over_designs(designs, 0)}, -infinity);
  double bound = known_loss;
  while (!left.empty()) {
    const double key = left.next().key;
    bound = std::min(key, known_loss);
    if (!meter.begin() || known_loss - key <= accuracy * std::abs(known_loss)) break;
    const BoxToCut cell = left.take();
    bound = known_loss;
    // Where nothing says better, what is widest as a part of the whole.
    const bool along_x = cell.box[0].width() >= cell.box[1].width();
    std::size_t c = along_x ? 0 : 1;
    double widest = cell.box[c].width() / std::max(region_.upper()[c] - region_.lower()[c], 1e-300);
    for (std::size_t k = 2; k < cell.box.size(); ++k) {
      const double part = designs[k - 2].width() > 1e-12 * designs[k - 2].magnitude()
                              ? cell.box[k].width() / designs[k - 2].width()
                              : 0.0;
      if (part > widest) widest = part, c = k;
    }
    if (cell.along >= 0) c = static_cast<std::size_t>(cell.along);
    for (Box& half : halves_of(cell.box, c)) {
      if (region_.distance(half[0], half[1]) > 0) continue;
      const auto size_of_half = over(half);
      const int along = size_of_half && cell_.doubts_displacement() ? cut(half) : -1;
      const double key_of_half =
          std::max(key, size_of_half ? sign * (least ? size_of_half->lower() : size_of_half->upper()) : -infinity);
      if (const auto pose = pose_within(region_, 0, half[0], half[1]))
        look(*pose, DesignBox(half.begin() + 2, half.end()));
      if (key_of_half < known_loss) left.push({std::move(half), along}, key_of_half);
    }
  }
  return least ? Interval(std::max(0.0, bound), known_loss) : Interval(-known_loss, -bound);
}

}  // namespace clearloci::loci
