#include "analysis/smaller_efforts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/enclosure.hpp"
#include "core/rational.hpp"
#include "loci/search/search.hpp"

namespace clearloci {
namespace {

using core::Rational;

constexpr int most_boxes = 20'000, most_judged = 300;

class SmallerEfforts {
 public:
  SmallerEfforts(const EffortSystem& system, const std::vector<EffortInequality>& rows,
                 const std::vector<loci::pose::Pose>& poses, PreloadJudge& judge, double to)
      : system_(system), rows_(rows), poses_(poses), judge_(judge), to_(to) {
    Box all;
    for (const WantedEffort& effort : system.wanted()) {
      const double most = to / effort.size_of_one;
      all.emplace_back(std::max(Rational(-most), effort.lower), std::min(Rational(most), effort.upper));
    }
    push(std::move(all));
  }

  double run(double enough, const std::optional<std::chrono::steady_clock::time_point>& deadline) {
    loci::SearchMeter meter({.most_cells = most_boxes, .deadline = deadline});
    while (!left_.empty() && left_.next().key < enough && judged_ < most_judged && meter.begin()) {
      const double size = left_.next().key;
      const Box box = left_.take();
      if (judged(box)) continue;
      if (is_finest(box)) return size;
      cut(box);
    }
    return left_.empty() ? to_ : left_.next().key;
  }

 private:
  using Box = std::vector<ExactRange>;

  double size_of_one(std::size_t k) const { return system_.wanted()[k].size_of_one; }

  /// Whether all of a box fail: asked where it is small beside the size.
  bool judged(const Box& box) {
    constexpr double small = 0.25;
    for (std::size_t k = 0; k < box.size(); ++k)
      if (core::to_double(box[k].second - box[k].first) * size_of_one(k) > small * to_) return false;
    loci::pose::PoseBox enclosed;
    for (const ExactRange& exact_range : box) {
      const core::Interval range = core::range_of(exact_range.first, exact_range.second);
      enclosed.push_back({range.lower(), range.upper()});
    }
    for (const loci::pose::Pose& pose : poses_)
      if (system_.too_small(pose, enclosed) != nullptr) return true;
    ++judged_;
    return judge_.judge(box, is_finest(box)).verdict == core::Verdict::refuted;
  }

  bool is_finest(const Box& box) const {
    constexpr double finest = 1.0 / (1 << 10);
    for (std::size_t k = 0; k < box.size(); ++k)
      if (core::to_double(box[k].second - box[k].first) * size_of_one(k) > finest * to_) return false;
    return true;
  }

  void cut(const Box& box) {
    std::size_t widest = 0;
    double most = -1;
    for (std::size_t k = 0; k < box.size(); ++k) {
      const double width = core::to_double(box[k].second - box[k].first) * size_of_one(k);
      if (width > most) most = width, widest = k;
    }
    const Rational middle = (box[widest].first + box[widest].second) / 2;
    Box lower = box, upper = box;
    lower[widest].second = middle;
    upper[widest].first = middle;
    push(std::move(lower));
    push(std::move(upper));
  }

  void push(Box box) {
    double size = 0;  // of its smallest effort
    std::vector<core::Interval> efforts;
    for (std::size_t k = 0; k < box.size(); ++k) {
      efforts.push_back(core::range_of(box[k].first, box[k].second));
      size = std::max(size, efforts.back().mignitude() * size_of_one(k));
    }
    if (std::none_of(rows_.begin(), rows_.end(), [&](const EffortInequality& row) { return all_fail(row, efforts); }))
      left_.push(std::move(box), size);
  }

  const EffortSystem& system_;
  const std::vector<EffortInequality>& rows_;
  const std::vector<loci::pose::Pose>& poses_;
  PreloadJudge& judge_;
  double to_;
  int judged_ = 0;
  loci::BoxSearch<Box> left_{loci::SearchOrder::least_key_first};
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
