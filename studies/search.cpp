#include "studies/search.hpp"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "core/errors.hpp"
#include "core/rational.hpp"
#include "studies/collection.hpp"
#include "studies/designs.hpp"
#include "studies/pareto.hpp"

namespace clearloci {
namespace {

using core::Rational;
using core::StudyDesign;
using Status = StudyDesign::Status;
using Clock = std::chrono::steady_clock;

/// Evaluations that begin a search with several goals: enough to know how large these are.
constexpr double first_share = 0.25;
/// Of the rest the part that searches all over the box; what is left improves the best found.
constexpr double global_share = 0.6;
constexpr int weights = 8;  ///< directions along a front
constexpr unsigned long seed = 20110501;
/// Designs are told apart to this part of each range: short decimals.
constexpr int digits = 6;
/// Worse than any feasible design.
constexpr double infeasible = 1e12;

struct OptimiserDeleter {
  void operator()(nlopt_opt optimiser) const { nlopt_destroy(optimiser); }
};
using Optimiser = std::unique_ptr<std::remove_pointer_t<nlopt_opt>, OptimiserDeleter>;

class Search {
 public:
  Search(const StudyProblem& problem, const StudyOptions& options)
      : problem_(problem),
        options_(options),
        judge_(problem),
        found_(problem, problem.study().method.count, options),
        budget_(problem.study().method.count) {
    for (const StudyDesign& design : found_.designs()) known_.emplace(design.index, design);
  }

  bool run() {
    const std::size_t goals = problem_.study().goals.size();
    if (goals == 1) {
      weight_ = {1};
      optimise(budget_);
    } else {
      // Evenly over the box first: then goals can be weighed.
      const auto first = static_cast<std::uint64_t>(std::ceil(first_share * static_cast<double>(budget_)));
      for (std::uint64_t i = 0; i < first && !stopped(); ++i) {
        std::vector<double> at;
        for (const std::uint32_t fraction_bits : sobol_point(i, dimensions()))
          at.push_back((fraction_bits + 0.5) * 0x1p-32);
        (void)evaluate(at);
      }
      measure_goals();
      for (int w = 0; w <= weights && !stopped(); ++w) {
        weight_.assign(goals, 0.0);
        const double part = static_cast<double>(w) / weights;
        weight_[0] = 1 - part;
        for (std::size_t g = 1; g < goals; ++g) weight_[g] = part / static_cast<double>(goals - 1);
        best_value_ = HUGE_VAL;
        optimise(evaluations_ + (budget_ - evaluations_) / static_cast<std::uint64_t>(weights + 1 - w));
      }
    }
    return !out_of_time_;
  }

  std::vector<StudyDesign> take() {
    (void)found_.take();
    return std::move(history_);
  }

 private:
  std::size_t dimensions() const { return problem_.study().vary.size(); }

  bool stopped() {
    if (options_.deadline && Clock::now() >= *options_.deadline) out_of_time_ = true;
    return out_of_time_ || evaluations_ >= budget_;
  }

  /// Evaluations up to `until` in all.
  void optimise(std::uint64_t until) {
    const std::uint64_t begin = evaluations_;
    until_ = begin + static_cast<std::uint64_t>(global_share * static_cast<double>(until - begin));
    with(NLOPT_GN_CRS2_LM, {});
    until_ = until;
    // The subplex method ends where it stands still: from there once more with smaller steps.
    for (double step = 0.1; evaluations_ < until_ && !stopped() && step > 1e-5; step /= 4) {
      const std::uint64_t before = evaluations_;
      with(NLOPT_LN_SBPLX, best_at_, step);
      if (evaluations_ == before) break;
    }
  }

  /// `at`: where it starts; empty: in the middle.
  void with(nlopt_algorithm algorithm, std::vector<double> at, double step = 0) {
    if (at.empty()) at.assign(dimensions(), 0.5);
    const Optimiser optimiser(nlopt_create(algorithm, static_cast<unsigned>(dimensions())));
    nlopt_set_min_objective(optimiser.get(), &Search::objective, this);
    nlopt_set_lower_bounds1(optimiser.get(), 0);
    nlopt_set_upper_bounds1(optimiser.get(), 1);
    if (step > 0) nlopt_set_initial_step1(optimiser.get(), step);
    nlopt_set_xtol_abs1(optimiser.get(), 1e-6);
    running_ = optimiser.get();
    double value = 0;
    (void)nlopt_optimize(optimiser.get(), at.data(), &value);  // what it found is in the history
    if (failed_) std::rethrow_exception(failed_);
  }

  static double objective(unsigned n, const double* at, double*, void* data) {
    Search& self = *static_cast<Search*>(data);
    try {
      if (self.stopped() || self.evaluations_ >= self.until_) {
        nlopt_force_stop(self.running_);
        return infeasible;
      }
      const std::vector<double> place(at, at + n);
      const double value = self.evaluate(place);
      if (value < self.best_value_) {
        self.best_value_ = value;
        self.best_at_ = place;
      }
      return value;
    } catch (...) {  // nothing may pass through C
      self.failed_ = std::current_exception();
      nlopt_force_stop(self.running_);
      return infeasible;
    }
  }

  std::vector<Rational> values_at(const std::vector<double>& at) const {
    std::vector<Rational> values;
    for (std::size_t d = 0; d < at.size(); ++d) {
      const core::StudyParameter& parameter = problem_.study().vary[d];
      const Rational range = parameter.upper - parameter.lower;
      const int exponent = static_cast<int>(std::floor(std::log10(core::to_double(range)))) - digits;
      const Rational unit = core::rational_from_decimal("1e" + std::to_string(exponent));
      const Rational exact = (parameter.lower + range * Rational(at[d])) / unit + Rational(1, 2);
      core::Integer whole;
      mpz_fdiv_q(whole.get_mpz_t(), exact.get_num_mpz_t(), exact.get_den_mpz_t());
      values.push_back(std::clamp<Rational>(Rational(whole) * unit, parameter.lower, parameter.upper));
    }
    return values;
  }

  double evaluate(const std::vector<double>& at) {
    const std::vector<Rational> values = values_at(at);
    const std::uint64_t index = evaluations_++;
    StudyDesign design;
    const auto again = seen_.find(values);
    const auto kept = known_.find(index);
    if (again != seen_.end()) {
      design = history_[again->second];
      design.index = index;
    } else if (kept != known_.end()) {
      design = kept->second;
      design.values.clear();
      for (const Rational& value : values) design.values.push_back(core::to_double(value));
    } else {
      design = judge_.judge(index, values);
    }
    seen_.try_emplace(values, history_.size());
    if (kept == known_.end()) found_.add({design});
    history_.push_back(design);
    return value_of(design, values);
  }

  double value_of(const StudyDesign& design, const std::vector<Rational>& values) {
    if (design.status != Status::feasible) return infeasible * (1 + judge_.violation(values));
    double sum = 0;
    const std::vector<core::StudyGoal>& goals = problem_.study().goals;
    for (std::size_t g = 0; g < goals.size() && g < weight_.size(); ++g) {
      const double goal = problem_.goal(goals[g], design);
      if (std::isnan(goal)) return infeasible;
      const double scaled = scale_.empty() ? goal : (goal - scale_[g][0]) / (scale_[g][1] - scale_[g][0]);
      sum += weight_[g] * (goals[g].maximise ? -scaled : scaled);
    }
    return sum;
  }

  void measure_goals() {
    const std::vector<core::StudyGoal>& goals = problem_.study().goals;
    scale_.assign(goals.size(), {HUGE_VAL, -HUGE_VAL});
    for (const StudyDesign& design : history_) {
      if (design.status != Status::feasible) continue;
      for (std::size_t g = 0; g < goals.size(); ++g) {
        const double value = problem_.goal(goals[g], design);
        if (std::isnan(value)) continue;
        scale_[g] = {std::min(scale_[g][0], value), std::max(scale_[g][1], value)};
      }
    }
    for (auto& range : scale_)
      if (!(range[0] < range[1])) range = {0, 1};
  }

  const StudyProblem& problem_;
  const StudyOptions& options_;
  StudyJudge judge_;
  Collection found_;
  std::uint64_t budget_, evaluations_ = 0, until_ = 0;
  bool out_of_time_ = false;
  std::map<std::uint64_t, StudyDesign> known_;
  std::map<std::vector<Rational>, std::size_t> seen_;
  std::vector<StudyDesign> history_;
  std::vector<double> weight_, best_at_;
  std::vector<std::array<double, 2>> scale_;
  double best_value_ = HUGE_VAL;
  nlopt_opt running_ = nullptr;
  std::exception_ptr failed_;
};

}  // namespace

void search(const StudyProblem& problem, const StudyOptions& options, core::StudyResult& result) {
  static std::mutex one_at_a_time;  // NLopt's random numbers are the process's
  const std::lock_guard lock(one_at_a_time);
  nlopt_srand(seed);
  Search search(problem, options);
  result.complete = search.run();
  result.designs = search.take();
  choose(problem, result);
}

}  // namespace clearloci
