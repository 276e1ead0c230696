#include "loci/tasks/task_proof.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>

#include "loci/tasks/task_cell.hpp"
#include "loci/tasks/task_cover.hpp"

namespace clearloci::loci {
namespace {

using core::Interval;
using core::Point2;

/// How far what is not proven over a cell is from the task.
struct Reach {
  double least = 0;                                       ///< at least
  double most = std::numeric_limits<double>::infinity();  ///< at most, where that is known: at `at`
  Point2 at{};
  TaskCell::Judgement what{};
};

struct QueuedCell {
  Interval x, y;
  int depth = 0;
  double distance = 0;                                ///< at least so far from the task
  std::optional<TaskCell::Judgement> judgement = {};  ///< where it has been judged ahead of its turn
  Reach reach = {};                                   ///< then: of what is not proven

  Point2 middle() const { return {x.middle(), y.middle()}; }
  double width() const { return std::max(x.width(), y.width()); }
  /// Along the longer side.
  std::array<QueuedCell, 2> halves() const {
    const bool along_x = x.width() >= y.width();
    std::array<QueuedCell, 2> parts;
    for (std::size_t half = 0; half < 2; ++half)
      parts[half] = {along_x ? halves_of(x)[half] : x, along_x ? y : halves_of(y)[half], depth + 1, distance};
    return parts;
  }
};

double apart(const Point2& a, const Point2& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// The finest cells, as a part of the task: some thousand spacings of doubles.
constexpr double finest = 1e-11;

/// Looks for a pose of the task that the witness refutes: poses of cells that were not proven, and places between two
/// of them where something changes its sign.
class Refutation {
 public:
  Refutation(const core::TaskConditions& conditions, const core::WorkingMode& mode, const TaskRegion& region,
             double margin, const RefutedAt& refuted_at)
      : point_(conditions, mode),
        region_(region),
        margin_(margin),
        hair_(hair_of(region, margin)),
        witness_(refuted_at),
        seen_(point_.watched()),
        tried_(point_.watched(), std::numeric_limits<double>::infinity()) {}

  /// Of the task itself, before any cell: its corners and the like are where engineers put zeros.
  bool by_samples() {
    for (const Point2& at : region_.samples())
      if (refuted_at(at, true) || crossed(at)) return true;
    return false;
  }

  bool by_suspect(const Point2& at) {
    if (refuted_at(at, true)) return true;
    // Close enough to be on either side of one curve, far enough for signs to be decided.
    const double step = 1e-7 * (size_of(region_, margin_) + margin_);
    for (int i = 0; i < 8; ++i) {
      const double angle = i * std::numbers::pi / 4;
      const Point2 near = {at[0] + step * std::cos(angle), at[1] + step * std::sin(angle)};
      if (crossed(region_.signed_distance(near) <= margin_ ? near : region_.closest(near))) return true;
    }
    return false;
  }

  bool by_cell(const QueuedCell& cell, TaskCell::State state, int condition) {
    const std::optional<Point2> at = pose_within(region_, margin_, cell.x, cell.y);
    if (at && (refuted_at(*at, false) || crossed(*at))) return true;
    return state == TaskCell::State::unmet && cell.depth % between_steps == 0 && stepped(cell.middle(), condition);
  }

 private:
  static constexpr int between_steps = 4, most_steps = 12, most_starts = 400;
  static constexpr std::size_t remembered = 48;

  /// Only poses of the task, to rounding, or of its margin: one that is as far away as the margin demands is far
  /// enough.
  bool refuted_at(const Point2& at, bool closely) const {
    const double distance = region_.signed_distance(at);
    const double rounding =
        0x1p-50 * std::max({std::abs(at[0]), std::abs(at[1]), std::abs(region_.lower()[0]),
                            std::abs(region_.lower()[1]), std::abs(region_.upper()[0]), std::abs(region_.upper()[1])});
    return (distance <= rounding || distance < margin_ - hair_) && witness_(at, closely);
  }

  /// Whether something has another sign here than at a pose seen before, and the witness refutes a pose between.
  bool crossed(const Point2& at) {
    if (!point_.enter(at)) return refuted_at(at, true);
    std::vector<int> signs;
    for (std::size_t w = 0; w < seen_.size(); ++w) signs.push_back(point_.sign(w));
    for (std::size_t w = 0; w < seen_.size(); ++w) {
      if (signs[w] == 0) {
        if (refuted_at(at, true)) return true;
        continue;
      }
      std::deque<Point2>& same = seen_[w][signs[w] > 0 ? 1 : 0];
      const std::deque<Point2>& other = seen_[w][signs[w] > 0 ? 0 : 1];
      const Point2* nearest = nullptr;
      for (const Point2& p : other)
        if (nearest == nullptr || apart(at, p) < apart(at, *nearest)) nearest = &p;
      // Closer and closer pairs: between them the straight way stays within the task.
      if (nearest != nullptr && apart(at, *nearest) < 0.5 * tried_[w]) {
        tried_[w] = apart(at, *nearest);
        if (between(w, at, *nearest, signs[w])) return true;
      }
      same.push_back(at);
      if (same.size() > remembered) same.pop_front();
    }
    return false;
  }

  bool between(std::size_t watched, Point2 a, Point2 b, int sign_at_a) {
    for (int i = 0; i < 80; ++i) {
      const Point2 middle = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
      if (middle == a || middle == b) break;
      if (!point_.enter(middle)) return refuted_at(middle, true);
      const int sign = point_.sign(watched);
      if (sign == 0) return refuted_at(middle, true);
      (sign == sign_at_a ? a : b) = middle;
    }
    return refuted_at(a, true) || refuted_at(b, true);
  }

  bool stepped(Point2 at, int condition) {
    if (++starts_ > most_starts) return false;
    double load = 0.5;
    const double size = size_of(region_, margin_);
    for (int i = 0; i < most_steps; ++i) {
      const Point2 before = at;
      if (!point_.step(condition, at, load) || region_.signed_distance(at) > margin_ + size) return false;
      if (apart(at, before) <= 1e-15 * (size + std::abs(at[0]) + std::abs(at[1]))) break;
    }
    return refuted_at(at, true);
  }

  TaskPoint point_;
  const TaskRegion& region_;
  double margin_;
  double hair_;
  const RefutedAt& witness_;
  std::vector<std::array<std::deque<Point2>, 2>> seen_;  ///< by sign
  std::vector<double> tried_;                            ///< how close the closest pair was
  int starts_ = 0;
};

}  // namespace

CoverProof prove_task(const core::TaskConditions& conditions, const core::WorkingMode& mode, const TaskRegion& region,
                      double margin, const RefutedAt& refuted_at, const SearchBudget& budget) {
  CoverProof proof;
  Refutation refutation(conditions, mode, region, margin, refuted_at);
  if (refutation.by_samples()) {
    proof.verdict = core::Verdict::refuted;
    return proof;
  }
  TaskCell judge(conditions, mode);
  const double size = size_of(region, margin), reach = margin + hair_of(region, margin);
  // The largest first: a part of the task that fails is met on large cells, before doubtful places are looked at
  // closely.
  SearchMeter meter(budget);
  BoxSearch<QueuedCell> left(SearchOrder::breadth_first);
  const auto push = [&](QueuedCell cell) {
    if (region.distance(cell.x, cell.y) <= reach) left.push(cell);
  };
  push({Interval(region.lower()[0] - reach, region.upper()[0] + reach),
        Interval(region.lower()[1] - reach, region.upper()[1] + reach)});
  // Several at a time, as they stand in the queue.
  const auto judge_ahead = [&] {
    constexpr std::size_t cells_at_a_time = 32;
    std::vector<std::array<Interval, 2>> places;
    for (std::size_t i = 0; i < std::min(left.size(), cells_at_a_time); ++i)
      places.push_back({left[i].box.x, left[i].box.y});
    const std::vector<TaskCell::Judgement> judgements = judge.judge(places);
    for (std::size_t i = 0; i < judgements.size(); ++i) left[i].box.judgement = judgements[i];
  };
  while (!left.empty() && meter.begin()) {
    if (!left.next().box.judgement) judge_ahead();
    const QueuedCell cell = left.take();
    if (cell.judgement->state == TaskCell::State::proven) {
      meter.prove();
      continue;
    }
    if (refutation.by_cell(cell, cell.judgement->state, cell.judgement->unmet)) {
      proof.verdict = core::Verdict::refuted;
      proof.cost = meter.cost();
      return proof;
    }
    if (cell.width() < finest * size)
      leave_open(proof, cell.x, cell.y);
    else
      for (const QueuedCell& half : cell.halves()) push(half);
  }
  for (const auto& [key, cell] : left) leave_open(proof, cell.x, cell.y);
  proof.cost = meter.cost();
  if (proof.open == 0) proof.verdict = core::Verdict::verified;
  return proof;
}

bool refuted_near(const core::TaskConditions& conditions, const core::WorkingMode& mode, const TaskRegion& region,
                  double margin, const RefutedAt& refuted_at, const core::Polyline& suspects) {
  Refutation refutation(conditions, mode, region, margin, refuted_at);
  return std::any_of(suspects.begin(), suspects.end(), [&](const Point2& at) { return refutation.by_suspect(at); });
}

namespace {

/// How far from the task what cells leave in doubt may fail.
class Reaches {
 public:
  explicit Reaches(const TaskRegion& region) : region_(region) {}

  /// `closely`: also where it does fail.
  Reach of(const TaskCell::Doubt& doubt, const QueuedCell& cell, bool closely) {
    Reach reach;
    if (doubt.anywhere) return reach;
    reach.least = std::numeric_limits<double>::infinity();
    for (const TaskCell::Unproven& unproven : doubt.unproven) {
      if (reach.least <= cell.distance) return reach;
      const double least = nearest(unproven.any.data(), unproven.any.size(), false, doubt.middle, cell).distance;
      reach.least = std::min(reach.least, least);
      if (!closely || !unproven.sharp || !(least < reach.most)) continue;
      TaskRegion::Nearest most = nearest(unproven.any.data(), 1, true, doubt.middle, cell);
      if (unproven.either_side)
        if (const auto other = nearest(&unproven.any[1], 1, true, doubt.middle, cell); other.distance > most.distance)
          most = other;
      if (most.distance < reach.most) reach = {reach.least, most.distance, most.at, unproven.what};
    }
    return reach;
  }

 private:
  /// The nearest place at which none of some bounds over a cell is positive, by what they are at least, or at most; an
  /// infinite distance where one always is. To rounding.
  TaskRegion::Nearest nearest(const TaskCell::Bound* first, std::size_t count, bool at_most, const Point2& middle,
                              const QueuedCell& cell) {
    part_ = {{cell.x.lower(), cell.y.lower()},
             {cell.x.upper(), cell.y.lower()},
             {cell.x.upper(), cell.y.upper()},
             {cell.x.lower(), cell.y.upper()}};
    const Point2 half = {std::max(cell.x.upper() - middle[0], middle[0] - cell.x.lower()),
                         std::max(cell.y.upper() - middle[1], middle[1] - cell.y.lower())};
    for (std::size_t i = 0; i < count; ++i) {
      // A slope of its middle, and what the others make of the cell's extent.
      double value = at_most ? first[i].value.upper() : first[i].value.lower(), doubt = 0, size = std::abs(value);
      Point2 slope{};
      for (std::size_t c = 0; c < 2; ++c) {
        const Interval& interval = first[i].slopes[c];
        slope[c] = interval.middle();
        doubt += std::max(interval.upper() - slope[c], slope[c] - interval.lower()) * half[c];
        size += interval.magnitude() * half[c];
      }
      constexpr double roundings = 1e-14;
      value += (at_most ? doubt : -doubt) - roundings * size;
      cut(value, slope, middle);
    }
    if (part_.empty()) return {std::numeric_limits<double>::infinity()};
    return region_.nearest(part_);
  }

  /// Keeps the part on which value + slope . (p - middle) <= 0.
  void cut(double value, const Point2& slope, const Point2& middle) {
    whole_.swap(part_);
    part_.clear();
    const auto height = [&](const Point2& p) {
      return value + slope[0] * (p[0] - middle[0]) + slope[1] * (p[1] - middle[1]);
    };
    for (std::size_t i = 0; i < whole_.size(); ++i) {
      const Point2 &p = whole_[i], &q = whole_[(i + 1) % whole_.size()];
      const double at_p = height(p), at_q = height(q);
      if (at_p <= 0) part_.push_back(p);
      if ((at_p < 0) == (at_q < 0) || at_p == 0 || at_q == 0) continue;
      const double t = at_p / (at_p - at_q);
      part_.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
    }
  }

  const TaskRegion& region_;
  core::Polyline part_, whole_;
};

}  // namespace

TaskClearance proven_clearance(const core::TaskConditions& conditions, const core::WorkingMode& mode,
                               const TaskRegion& region, double from, double limit, const SearchBudget& budget) {
  // What ends the margin is told apart to this part of it; where bounds tell what does, they tell it to that part.
  constexpr double resolution = 1e-4, known_within = 1e-5;
  // Cells this wide, as a part of their distance, may tell it so well.
  constexpr double close = 0.02;
  TaskCell judge(conditions, mode);
  Reaches reaches(region);
  const double hair = hair_of(region, limit), size = size_of(region, 0);
  const auto at_hand = [&](const QueuedCell& cell) { return std::max(cell.distance, resolution * size); };
  SearchMeter meter(budget);
  BoxSearch<QueuedCell> left(SearchOrder::least_key_first);
  left.push({Interval(region.lower()[0] - limit, region.upper()[0] + limit),
             Interval(region.lower()[1] - limit, region.upper()[1] + limit)});
  TaskClearance result;
  result.margin = from;
  const auto proven_to = [&](double distance) { result.margin = std::max(result.margin, distance - hair); };
  // What the task's proof has covered.
  const auto is_covered = [&](const QueuedCell& cell) {
    return region.signed_distance(cell.middle()) + 0.5 * std::hypot(cell.x.width(), cell.y.width()) <= from;
  };
  // The nearest, with some that are likely to come soon after it.
  const auto judge_ahead = [&] {
    std::vector<QueuedCell*> next;
    std::vector<std::array<Interval, 2>> places;
    for (std::size_t i = 0; i < std::min<std::size_t>(left.size(), 2 * sheet::SheetCells::size); ++i) {
      QueuedCell& cell = left[i].box;
      if (next.size() == sheet::SheetCells::size || cell.judgement || cell.distance >= limit || is_covered(cell))
        continue;
      next.push_back(&cell);
      places.push_back({cell.x, cell.y});
    }
    std::vector<TaskCell::Doubt> doubts;
    const std::vector<TaskCell::Judgement> judgements = judge.judge(places, &doubts);
    for (std::size_t i = 0; i < next.size(); ++i) {
      next[i]->judgement = judgements[i];
      next[i]->reach = reaches.of(doubts[i], *next[i], next[i]->width() <= close * at_hand(*next[i]));
    }
  };
  while (!left.empty() && left.next().key < limit) {
    if (!meter.begin()) {
      proven_to(left.next().key);
      return result;
    }
    if (const QueuedCell& nearest = left.next().box; !nearest.judgement && !is_covered(nearest)) judge_ahead();
    QueuedCell cell = left.take();
    if (!cell.judgement) continue;  // the task's proof has covered it
    if (cell.judgement->state == TaskCell::State::proven) continue;
    if (cell.reach.least > cell.distance) {  // its turn comes later
      cell.distance = cell.reach.least;
      left.push(cell, cell.distance);
      continue;
    }
    const bool is_known = cell.reach.most <= cell.distance + known_within * at_hand(cell);
    if (is_known || cell.width() <= resolution * at_hand(cell)) {
      proven_to(cell.distance);
      const auto [what, which] = is_known ? cell.reach.what : *cell.judgement;
      result.at = is_known ? cell.reach.at : cell.middle();
      result.kind = what == TaskCell::State::singular ? core::LocusKind::direct_singularity
                    : what == TaskCell::State::unmet  ? core::LocusKind::contact_loss
                                                      : core::LocusKind::workspace_boundary;
      result.condition = which;
      return result;
    }
    for (QueuedCell part : cell.halves()) {
      part.distance = std::max(cell.distance, region.distance(part.x, part.y));
      left.push(part, part.distance);
    }
  }
  proven_to(limit);
  return result;
}

}  // namespace clearloci::loci
