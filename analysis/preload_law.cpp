#include "analysis/preload_law.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "analysis/effort_corridors.hpp"
#include "analysis/effort_polynomial.hpp"
#include "analysis/pose_efforts.hpp"
#include "analysis/task_demands.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "core/shown_units.hpp"
#include "core/task.hpp"
#include "loci/tasks/tasks.hpp"

namespace clearloci {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Laws keep within so many times the smallest effort that some pose asks for; the last within all that is looked at.
constexpr std::array<double, 4> stretches = {1.25, 2, 8, infinity};
constexpr int largest_degree = 3;

double nearest_to_zero(const EffortCorridor& corridor) {
  return std::max({0.0, corridor.lower.effort, -corridor.upper.effort});
}

class LawSearch {
 public:
  LawSearch(const Model& model, WantedEffort wanted, const Task& task, const VerifyRequest& request)
      : model_(model),
        wanted_(std::move(wanted)),
        task_(task),
        request_(request),
        box_(core::bounds(task.shape)),
        own_gap_(own_gap(model.content().mechanism, wanted_.joint, request_of(task, request.loci))) {
    task_.controlled_preload = false;
    const std::size_t n = box_[0].size();
    const loci::pose::PoseMetric metric{std::vector<double>(n, 1.0), std::vector<bool>(n, true)};
    patterns_ = effort_patterns(model.content().mechanism, wanted_, task_, request_of(task_, request.loci),
                                loci::pose::PoseRegion(task_.shape, metric).samples());
  }

  Verification run() {
    try_constant_zero();
    for (int degree = 0; degree <= largest_degree && !found_; ++degree)
      for (const EffortPattern& pattern : patterns_)
        if (!found_ && !pattern.excluded) try_degree(pattern, degree);
    return found_ ? verified() : unverified();
  }

 private:
  bool out_of_time() const {
    return request_.loci.deadline && std::chrono::steady_clock::now() > *request_.loci.deadline;
  }

  VerifyRequest of_depth(VerifyDepth depth) const {
    VerifyRequest request = request_;
    request.depth = depth;
    return request;
  }

  Model with(const std::string& law) const { return model_.with({{wanted_.parameter, law}}); }

  void try_law(const std::string& law, const std::array<double, 2>& within) {
    const bool leaves_play = own_gap_ && is_within_own_gap(*own_gap_, within[0], within[1]);
    if (out_of_time() || leaves_play || within[0] < core::to_double(wanted_.lower) ||
        within[1] > core::to_double(wanted_.upper))
      return;
    ++laws_;
    if (request_.loci.progress) request_.loci.progress(0, "preload");
    if (verify(with(law), task_, of_depth(VerifyDepth::verdict)).verified()) found_ = core::PreloadLaw{law, within};
  }

  void try_constant_zero() {
    if (std::any_of(patterns_.begin(), patterns_.end(), [](const EffortPattern& pattern) {
          return std::all_of(pattern.corridors.begin(), pattern.corridors.end(),
                             [](const EffortCorridor& each) { return nearest_to_zero(each) == 0; });
        }))
      try_law(wanted_.force ? "0 N" : "0 N m", {0, 0});
  }

  void try_degree(const EffortPattern& pattern, int degree) {
    EffortPolynomial law(model_.content().mechanism, box_, degree, wanted_.force);
    if (law.terms() > pattern.corridors.size() / 2) return;
    double needed = 0;
    for (const EffortCorridor& corridor : pattern.corridors) {
      if (corridor.empty()) return;
      needed = std::max(needed, nearest_to_zero(corridor));
    }
    // Any effort takes up the play of its own motor and loads what others do not, however small: as small as constant
    // ones are told apart.
    if (needed == 0 &&
        (own_gap_ || std::any_of(pattern.corridors.begin(), pattern.corridors.end(), [](const EffortCorridor& each) {
           return each.lower.effort >= -each.lower.rounding || each.upper.effort <= each.upper.rounding;
         })))
      needed = std::max(std::abs(core::to_double(wanted_.lower)), std::abs(core::to_double(wanted_.upper))) / (1 << 16);
    for (const double stretch : stretches) {
      const double most = needed > 0 ? stretch * needed : infinity;
      std::vector<std::vector<double>> poses;
      std::vector<std::array<double, 2>> between;
      for (const EffortCorridor& corridor : pattern.corridors) {
        poses.push_back(corridor.at);
        between.push_back({std::max({corridor.lower.effort, -most, core::to_double(wanted_.lower)}),
                           std::min({corridor.upper.effort, most, core::to_double(wanted_.upper)})});
      }
      if (law.fit(poses, between)) try_law(law.told(), law.range());
      if (found_ || needed == 0) return;
    }
  }

  core::PreloadAnswer answer() const {
    core::PreloadAnswer answer;
    answer.joints = {wanted_.joint};
    answer.forces = {wanted_.force};
    answer.lower = {core::to_double(wanted_.lower)};
    answer.upper = {core::to_double(wanted_.upper)};
    double least = infinity;
    for (const EffortPattern& pattern : patterns_) least = std::min(least, pattern.excluded ? infinity : pattern.least);
    if (patterns_.empty()) least = 0;
    answer.size = {least * wanted_.size_of_one, infinity};
    if (found_)
      answer.size[1] = std::max(std::abs(found_->within[0]), std::abs(found_->within[1])) * wanted_.size_of_one;
    answer.law = found_;
    answer.cells = laws_;
    return answer;
  }

  Verification verified() const {
    Verification result = verify(with(found_->expression), task_, request_);
    result.preload = answer();
    return result;
  }

  Verification unverified() const {
    const core::Rational effort = nearest_to_none(wanted_.lower, wanted_.upper);
    Verification result = verify(with_efforts(model_, {wanted_}, {effort}), task_, request_);
    result.preload = answer();
    const bool none =
        !patterns_.empty() && std::all_of(patterns_.begin(), patterns_.end(),
                                          [](const EffortPattern& pattern) { return pattern.excluded.has_value(); });
    if (none) {
      result.notes.emplace_back("no effort of " + wanted_.joint +
                                " that varies with the pose verifies the task: proven");
      for (const EffortPattern& pattern : patterns_) result.notes.push_back(excluded_words(*pattern.excluded));
    } else if (!fails_under_any(result)) {
      result.verdict = core::Verdict::undecided;
      result.witness.reset();
      result.notes.emplace_back("no polynomial up to degree " + std::to_string(largest_degree) +
                                " was found with which the task is verified; other laws may exist");
    }
    return result;
  }

  /// Out of reach, or where |A| vanishes, whatever the effort.
  static bool fails_under_any(const Verification& verification) {
    using Kind = core::TaskWitness::Kind;
    return verification.witness && verification.witness->kind != Kind::vanishing &&
           verification.witness->kind != Kind::too_small && verification.witness->kind != Kind::beyond_bound &&
           verification.witness->kind != Kind::displaced;
  }

  /// "at (0.1, 0.5) M_A1 asks for more than 12 N m and M_A2 for less than 7 N m".
  std::string excluded_words(const EffortCorridor& corridor) const {
    const mechanism::Mechanism& mechanism = model_.content().mechanism;
    const auto told = [&](double effort) {
      return core::told(effort, wanted_.force ? "N" : "N m", mechanism.units, 4);
    };
    std::string at;
    for (std::size_t c = 0; c < corridor.at.size(); ++c)
      at += (c == 0 ? "" : ", ") +
            core::told(corridor.at[c], mechanism.coordinates[c].angle ? "rad" : "m", mechanism.units, 4);
    return "at (" + at + ") " + corridor.lower.reaction + " asks for more than " + told(corridor.lower.effort) +
           " and " + corridor.upper.reaction + " for less than " + told(corridor.upper.effort);
  }

  const Model& model_;
  WantedEffort wanted_;
  Task task_;
  const VerifyRequest& request_;
  std::array<core::RationalPose, 2> box_;
  std::optional<numeric::EffortGap> own_gap_;
  std::vector<EffortPattern> patterns_;
  std::optional<core::PreloadLaw> found_;
  long laws_ = 0;
};

}  // namespace

Verification verify_with_law(const Model& model, const Task& task, const VerifyRequest& request) {
  std::vector<WantedEffort> wanted = wanted_efforts(model, task, request);
  if (wanted.size() != 1)
    throw core::InputError(
        {task.file}, "a law is looked for of one free effort, and those of " + named_efforts(wanted) + " are free",
        "give the others by --preload");
  Verification result = LawSearch(model, wanted.front(), task, request).run();
  result.task.controlled_preload = true;
  return result;
}

}  // namespace clearloci
