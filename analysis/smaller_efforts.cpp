#include "analysis/smaller_efforts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <utility>

#include "core/enclosure.hpp"
#include "core/rational.hpp"

namespace clearloci {
namespace {

using core::Rational;

constexpr int most_boxes = 20'000, most_judged = 300;

class SmallerEfforts {
 public:
  SmallerEfforts(const EffortSystem& system, const std::vector<EffortInequality>& rows,
                 const std::vector<loci::pose::Pose>& poses, PreloadJudge& judge, double to)
      : system_(system), rows_(rows), poses_(poses), judge_(judge), to_(to) {
    Part all;
    for (const WantedEffort& own : system.wanted()) {
      const double most = to / own.size_of_one;
      all.box.emplace_back(std::max(Rational(-most), own.lower), std::min(Rational(most), own.upper));
    }
    push(std::move(all.box));
  }

  double run(double enough, const std::optional<std::chrono::steady_clock::time_point>& deadline) {
    for (int i = 0; i < most_boxes && judged_ < most_judged; ++i) {
      if (queue_.empty()) return to_;
      const Part part = queue_.top();
      if (part.size >= enough || (deadline && std::chrono::steady_clock::now() > *deadline)) break;
      queue_.pop();
      if (judged(part)) continue;
      if (is_finest(part)) return part.size;
      cut(part);
    }
    return queue_.empty() ? to_ : queue_.top().size;
  }

 private:
  struct Part {
    std::vector<ExactRange> box;
    double size = 0;                                                       ///< of its smallest effort
    bool operator<(const Part& other) const { return size > other.size; }  // the smallest on top
  };

  double size_of_one(std::size_t k) const { return system_.wanted()[k].size_of_one; }

  /// Whether all of a box fail: asked where it is small beside the size.
  bool judged(const Part& part) {
    constexpr double small = 0.25;
    for (std::size_t k = 0; k < part.box.size(); ++k)
      if (core::to_double(part.box[k].second - part.box[k].first) * size_of_one(k) > small * to_) return false;
    std::vector<std::array<double, 2>> box;
    for (const ExactRange& own : part.box) {
      const core::Interval range = core::range_of(own.first, own.second);
      box.push_back({range.lower(), range.upper()});
    }
    for (const loci::pose::Pose& pose : poses_)
      if (system_.too_small(pose, box) != nullptr) return true;
    ++judged_;
    return judge_.judge(part.box, is_finest(part)).verdict == core::Verdict::refuted;
  }

  bool is_finest(const Part& part) const {
    constexpr double finest = 1.0 / (1 << 10);
    for (std::size_t k = 0; k < part.box.size(); ++k)
      if (core::to_double(part.box[k].second - part.box[k].first) * size_of_one(k) > finest * to_) return false;
    return true;
  }

  void cut(const Part& part) {
    std::size_t widest = 0;
    double most = -1;
    for (std::size_t k = 0; k < part.box.size(); ++k) {
      const double width = core::to_double(part.box[k].second - part.box[k].first) * size_of_one(k);
      if (width > most) most = width, widest = k;
    }
    const Rational middle = (part.box[widest].first + part.box[widest].second) / 2;
    std::vector<ExactRange> lower = part.box, upper = part.box;
    lower[widest].second = middle;
    upper[widest].first = middle;
    push(std::move(lower));
    push(std::move(upper));
  }

  void push(std::vector<ExactRange> box) {
    Part part;
    std::vector<core::Interval> efforts;
    for (std::size_t k = 0; k < box.size(); ++k) {
      efforts.push_back(core::range_of(box[k].first, box[k].second));
      part.size = std::max(part.size, efforts.back().mignitude() * size_of_one(k));
    }
    if (std::any_of(rows_.begin(), rows_.end(), [&](const EffortInequality& row) { return all_fail(row, efforts); }))
      return;
    part.box = std::move(box);
    queue_.push(std::move(part));
  }

  const EffortSystem& system_;
  const std::vector<EffortInequality>& rows_;
  const std::vector<loci::pose::Pose>& poses_;
  PreloadJudge& judge_;
  double to_;
  int judged_ = 0;
  std::priority_queue<Part> queue_;
};

}  // namespace

double size_below_which_all_fail(const EffortSystem& system, const std::vector<EffortInequality>& rows,
                                 const std::vector<loci::pose::Pose>& poses, PreloadJudge& judge, double from,
                                 double enough, double to,
                                 const std::optional<std::chrono::steady_clock::time_point>& deadline) {
  constexpr double rounding = 0x1p-48;
  return std::max(from, SmallerEfforts(system, rows, poses, judge, to).run(enough, deadline) * (1 - rounding));
}

}  // namespace clearloci
