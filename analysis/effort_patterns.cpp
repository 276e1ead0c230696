#include "analysis/effort_patterns.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/shown_units.hpp"

namespace clearloci {
namespace {

using PoseAt = loci::pose::Pose;

class PatternTree {
  static constexpr std::size_t most_patterns = 400;

 public:
  PatternTree(const EffortSystem& system, const std::vector<PoseAt>& places,
              const std::optional<EffortSystem::OneLoad>& load)
      : system_(system), names_(system.signed_reactions()) {
    std::sort(names_.begin(), names_.end());
    names_.erase(std::unique(names_.begin(), names_.end()), names_.end());
    const auto always = all_rows(system, places, {}, load);
    if (!always) return;
    rows_ = *always;
    for (const std::string& name : names_)
      for (const int sign : {1, -1}) {
        auto rows = all_rows(system, places, {{name, sign}}, load);
        if (!rows) return;
        std::erase_if(*rows, [](const EffortInequality& row) { return row.bound; });
        signed_[{name, sign}] = std::move(*rows);
      }
    complete_ = true;
  }

  std::optional<SignPatterns> run() {
    if (!complete_) return std::nullopt;
    SignPattern signs;
    descend(0, signs);
    if (patterns_.possible.size() >= most_patterns) return std::nullopt;  // they are not all
    return std::move(patterns_);
  }

 private:
  void descend(std::size_t i, SignPattern& signs) {
    if (patterns_.possible.size() >= most_patterns) return;
    if (auto none = excluded(system_, rows_)) {
      patterns_.impossible.emplace_back(signs, std::move(*none));
      return;
    }
    if (i == names_.size()) {
      patterns_.possible.push_back(signs);
      return;
    }
    for (const int sign : {1, -1}) {
      const std::vector<EffortInequality>& inequalities = signed_.at({names_[i], sign});
      rows_.insert(rows_.end(), inequalities.begin(), inequalities.end());
      signs[names_[i]] = sign;
      descend(i + 1, signs);
      signs.erase(names_[i]);
      rows_.resize(rows_.size() - inequalities.size());
    }
  }

  const EffortSystem& system_;
  std::vector<std::string> names_;
  std::vector<EffortInequality> rows_;
  std::map<std::pair<std::string, int>, std::vector<EffortInequality>> signed_;
  SignPatterns patterns_;
  bool complete_ = false;
};

std::string row_words(const EffortInequality& row) {
  return row.reaction + (row.bound      ? (row.sign > 0 ? " above its least" : " below its most")
                         : row.sign > 0 ? " > 0"
                                        : " < 0");
}

}  // namespace

std::optional<SignPatterns> sign_patterns(const EffortSystem& system, const std::vector<PoseAt>& places,
                                          const std::optional<EffortSystem::OneLoad>& load) {
  return PatternTree(system, places, load).run();
}

std::optional<std::vector<EffortInequality>> all_rows(const EffortSystem& system, const std::vector<PoseAt>& places,
                                                      const SignPattern& signs,
                                                      const std::optional<EffortSystem::OneLoad>& load) {
  std::vector<EffortInequality> all = system.rows_of_efforts(signs);
  for (const PoseAt& place : places) {
    auto rows = system.rows(place, signs, load);
    if (!rows) return std::nullopt;
    std::move(rows->begin(), rows->end(), std::back_inserter(all));
  }
  return all;
}

void tell_rows(const EffortSystem& system, const EffortExclusion& exclusion, core::PreloadPattern& pattern) {
  pattern.joints.clear();
  for (const WantedEffort& wanted : system.wanted()) pattern.joints.push_back(wanted.joint);
  pattern.refutation.clear();
  const std::size_t poses = system.mechanism().coordinates.size();
  for (std::size_t i = 0; i < exclusion.rows.size(); ++i) {
    const EffortInequality& inequality = exclusion.rows[i];
    core::PreloadRow& row = pattern.refutation.emplace_back();
    row.reaction = inequality.reaction;
    row.sign = inequality.sign;
    row.bound = inequality.bound;
    row.at = inequality.at;
    if (row.at.size() > poses) row.at.resize(poses);
    row.load = inequality.load;
    for (const numeric::Bounded& slope : inequality.slope) row.slope.push_back(slope.value);
    row.offset = inequality.offset.value;
    row.multiplier = exclusion.multipliers[i];
  }
}

std::string exclusion_words(const EffortSystem& system, const EffortExclusion& exclusion) {
  const mechanism::Mechanism& mechanism = system.mechanism();
  const auto place = [&](const std::vector<double>& at) {
    std::string words;
    for (std::size_t c = 0; c < mechanism.coordinates.size(); ++c)
      words +=
          (c == 0 ? "" : ", ") + core::told(at[c], mechanism.coordinates[c].angle ? "rad" : "m", mechanism.units, 4);
    return "at (" + words + ") ";
  };
  std::string words;
  std::vector<double> last;
  for (const EffortInequality& row : exclusion.rows) {
    words += words.empty() ? "" : ", ";
    if (!row.at.empty() && row.at != last) words += place(row.at);
    if (!row.at.empty()) last = row.at;
    words += row_words(row);
    // To rounding, no effort makes a difference.
    if (row.slope.size() != 1 || std::abs(row.slope[0].value) <= row.slope[0].error) continue;
    const double effort = -row.offset.value / row.slope[0].value;
    words += (row.slope[0].value > 0 ? " for efforts above " : " for efforts below ") +
             core::told(effort, system.wanted().front().force ? "N" : "N m", mechanism.units, 4);
  }
  return words + (exclusion.rows.size() > 1 ? ": these exclude each other" : ": no effort that is looked at meets it");
}

}  // namespace clearloci
