#include "cli/verification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/zone_search.hpp"
#include "core/errors.hpp"
#include "loci/plane_graph.hpp"
#include "loci/task_proof.hpp"
#include "numeric/reactions.hpp"
#include "report/wording.hpp"

namespace clearloci {
namespace {

using core::Point2;
using core::Quantity;
using core::Task;

// A range of loads is cut into this many pieces, then twice, four times ... as many.
constexpr int most_pieces = 16;
constexpr int cells_of_the_task = 400'000, cells_of_a_margin = 40'000;

int sign(const numeric::Bounded& value) { return value.value > value.error ? 1 : value.value < -value.error ? -1 : 0; }

double rounded_down(double value) { return std::nextafter(value, 0.0); }

/// One load: the mechanism under it, the problem, its loci.
struct Case {
  mechanism::Mechanism mechanism;
  numeric::NumericModel model;
  TracedProblem traced;
};

mechanism::Mechanism under_load(mechanism::Mechanism mechanism, const core::LoadRange& loads, int piece, int pieces) {
  const core::Rational t(piece, pieces);
  for (std::size_t c = 0; c < 2; ++c)
    mechanism.loads.front().force[c] = core::Expression::number((1 - t) * loads.first[c] + t * loads.second[c]);
  return mechanism;
}

class Verifier {
 public:
  Verifier(const mechanism::Mechanism& mechanism, const Task& task, LociRequest request)
      : mechanism_(mechanism), task_(task), request_(std::move(request)) {
    if (task.min_force) request_.selection.min_force = task.min_force;
    if (task.min_couple) request_.selection.min_couple = task.min_couple;
    request_.all_working_modes = false;
    if (request_.working_modes.size() > 1) request_.working_modes.resize(1);
    pieces(1);
    mode_ = first().traced.problem.modes.front();
    sides_ = numeric::dyad_signs(first().model, first().traced.map.tower, mode_);
  }

  /// The task where it lies, or moved.
  Verification verify(const Task& task) {
    const loci::TaskRegion region(task.shape);
    Verification result;
    result.task = task;
    result.mode = mode_;
    result.notes = first().traced.map.notes;
    result.nearest = nearest(region);
    result.witness = witness(region, core::to_double(task.margin), result.nearest);
    if (!result.witness) prove(region, core::to_double(task.margin), result);
    return result;
  }

  bool proven(const Task& task) {
    const loci::TaskRegion region(task.shape);
    const double margin = core::to_double(task.margin);
    return !witness(region, margin, nearest(region)) && proof(region, margin, cells_of_the_task).proven;
  }

  std::vector<const core::LocusMap*> maps() const {
    std::vector<const core::LocusMap*> list;
    for (const Case& one : cases_) list.push_back(&one.traced.map);
    return list;
  }
  const core::WorkingMode& mode() const { return mode_; }

  /// None unless assembled, bearing enough, and every couple on one side all over the range of loads.
  std::optional<std::vector<int>> signature(const Point2& at) const {
    if (complaint(at)) return std::nullopt;
    const numeric::BoundedNumerators n = numeric::bounded_numerators(first().model, at, sides_);
    std::vector<int> signs = {sign(n.determinant)};
    const auto wanted = selected_reactions(mechanism_, request_.selection);
    for (std::size_t k = 0; k < n.values.size(); ++k) {
      const mechanism::Unknown& unknown = first().model.unknowns[k];
      const std::string& joint = mechanism_.joints[static_cast<std::size_t>(unknown.joint)].name;
      const bool couple = unknown.quantity == Quantity::M || unknown.quantity == Quantity::F;
      if (couple && std::any_of(wanted.begin(), wanted.end(),
                                [&](const auto& w) { return w.joint == joint && w.quantity == unknown.quantity; }))
        signs.push_back(sign(n.values[k]));
    }
    return signs;
  }

 private:
  const Case& first() const { return cases_.front(); }

  /// Derives the loads between the ends of the range; what is there stays.
  void pieces(int count) {
    if (!task_.loads) count = 1;
    std::vector<Case> all;
    for (int k = 0; k <= (task_.loads ? count : 0); ++k) {
      const bool known = !cases_.empty() && k % 2 == 0;
      if (known) {
        all.push_back(std::move(cases_[static_cast<std::size_t>(k / 2)]));
        continue;
      }
      mechanism::Mechanism loaded = task_.loads ? under_load(mechanism_, *task_.loads, k, count) : mechanism_;
      numeric::NumericModel model = numeric::compile(loaded);
      TracedProblem traced = trace_problem(loaded, request_);
      if (!traced.map.complete)
        throw core::LimitReached("the loci could not be traced completely within the time limit");
      all.push_back({std::move(loaded), std::move(model), std::move(traced)});
    }
    cases_ = std::move(all);
  }

  std::optional<NearestOfTask> nearest(const loci::TaskRegion& region) const {
    std::optional<NearestOfTask> best;
    for (const Case& one : cases_) {
      const core::LocusMap& map = one.traced.map;
      const auto found = loci::nearest_locus(one.traced.problem, map, mode_, region);
      if (!found || (best && best->distance <= found->distance)) continue;
      best = NearestOfTask{};
      best->at = found->at;
      best->distance = found->distance;
      if (found->curve >= 0) {
        const core::LocusCurve& curve = map.curves[static_cast<std::size_t>(found->curve)];
        best->curve = curve.id;
        best->kind = curve.kind;
        best->vanishing = curve.vanishing;
      } else {
        const core::IsolatedPoint& point = map.isolated_points[static_cast<std::size_t>(found->point)];
        best->kind = point.kind;
        best->vanishing = point.vanishing;
      }
    }
    return best;
  }

  /// What is wrong at a pose whatever lies around it.
  std::optional<std::string> complaint(const Point2& at) const {
    std::vector<numeric::BoundedNumerators> numerators;
    for (const Case& one : cases_) numerators.push_back(numeric::bounded_numerators(one.model, at, sides_));
    if (!numerators.front().reachable) return "the mechanism does not reach it";
    const numeric::NumericModel& model = first().model;
    const auto wanted = selected_reactions(mechanism_, request_.selection);
    for (std::size_t k = 0; k < model.unknowns.size(); ++k) {
      const mechanism::Unknown& unknown = model.unknowns[k];
      const std::string& joint = mechanism_.joints[static_cast<std::size_t>(unknown.joint)].name;
      const Quantity q = unknown.quantity;
      if (std::none_of(wanted.begin(), wanted.end(),
                       [&](const auto& w) { return w.joint == joint && w.quantity == q; }))
        continue;
      const auto size = [&](std::size_t i, std::size_t column) {
        const numeric::BoundedNumerators& n = numerators[i];
        return std::abs(n.values[column].value / n.determinant.value);
      };
      if (q == Quantity::M || q == Quantity::F) {
        int side = 0;
        for (std::size_t i = 0; i < numerators.size(); ++i) {
          const int own = sign(numerators[i].values[k]);
          if (own != 0 && side != 0 && own != side)
            return fmt::format("{}_{} changes its sign within the range of loads", core::to_string(q), joint);
          side = own == 0 ? side : own;
          if (q == Quantity::M && task_.min_couple && size(i, k) < core::to_double(*task_.min_couple))
            return fmt::format("|M_{}| is {:.6g} N m, less than {}", joint, size(i, k),
                               core::to_string(*task_.min_couple));
        }
      }
    }
    if (!task_.min_force) return std::nullopt;
    for (std::size_t j = 0; j < mechanism_.joints.size(); ++j) {
      const mechanism::Joint& joint = mechanism_.joints[j];
      const std::vector<Quantity> parts = mechanism::force_components(mechanism_, joint);
      if (parts.empty() ||
          std::none_of(wanted.begin(), wanted.end(), [&](const auto& w) { return w.joint == joint.name; }))
        continue;
      for (const numeric::BoundedNumerators& n : numerators) {
        double square = 0;
        for (const Quantity part : parts) {
          const int column = numeric::column_of(model, static_cast<int>(j), part);
          square += std::pow(n.values[static_cast<std::size_t>(column)].value / n.determinant.value, 2);
        }
        if (std::sqrt(square) < core::to_double(*task_.min_force))
          return fmt::format("|f_{}| is {:.6g} N, less than {}", joint.name, std::sqrt(square),
                             core::to_string(*task_.min_force));
      }
    }
    return std::nullopt;
  }

  static std::string names(const std::vector<core::Vanishing>& vanishing) {
    return vanishing.empty() ? std::string() : " (" + report::reaction_names(vanishing) + ")";
  }

  std::optional<TaskWitness> witness(const loci::TaskRegion& region, double margin,
                                     const std::optional<NearestOfTask>& nearest) const {
    const double touching = 1e-10 * (region.upper()[0] - region.lower()[0] + region.upper()[1] - region.lower()[1]);
    if (nearest && nearest->distance < std::max(margin, touching)) {
      const std::string what = report::kind_words(nearest->kind) + names(nearest->vanishing);
      const std::string reason =
          nearest->distance < touching
              ? what + " meets the task"
              : fmt::format("{} is {:.6g} m away, less than the margin of {:.6g} m", what, nearest->distance, margin);
      return TaskWitness{nearest->at, reason, nearest->vanishing};
    }
    for (const Point2& at : region.samples())
      if (auto reason = complaint(at)) return TaskWitness{at, *reason, {}};
    return std::nullopt;
  }

  /// Signs of the numerators of one load relative to their factors, by the independent witness at poses of the task.
  std::map<loci::Component, int> signs_of(const Case& one, const loci::TaskRegion& region) const {
    std::map<loci::Component, int> signs;
    const core::LocusProblem& problem = one.traced.problem;
    const core::Polyline samples = region.samples();
    for (std::size_t s = 0; s < std::min<std::size_t>(samples.size(), 6); ++s) {
      const numeric::BoundedNumerators at = numeric::bounded_numerators(one.model, samples[s], sides_);
      if (!at.reachable) continue;
      for (std::size_t k = 0; k < one.model.unknowns.size(); ++k) {
        const mechanism::Unknown& unknown = one.model.unknowns[k];
        const loci::Component component = {mechanism_.joints[static_cast<std::size_t>(unknown.joint)].name,
                                           unknown.quantity};
        int& known = signs[component];
        if (known == 0) known = sign(at.values[k]) * loci::product_sign(problem, mode_, component, samples[s]);
      }
    }
    return signs;
  }

  loci::TaskProof proof(const loci::TaskRegion& region, double margin, int most_cells) {
    while (true) {
      std::vector<loci::LoadCase> loads;
      for (const Case& one : cases_)
        loads.push_back({&one.traced.problem, task_.loads ? signs_of(one, region) : std::map<loci::Component, int>{}});
      loci::TaskProof proof = loci::prove_task(loads, mode_, region, margin, most_cells);
      if (proof.proven || !task_.loads || static_cast<int>(cases_.size()) > most_pieces) return proof;
      pieces(2 * (static_cast<int>(cases_.size()) - 1));
    }
  }

  void prove(const loci::TaskRegion& region, double wanted, Verification& result) {
    const loci::TaskProof first_proof = proof(region, wanted, cells_of_the_task);
    result.verified = first_proof.proven;
    if (!result.verified) {
      result.witness = TaskWitness{first_proof.open.value_or(region.samples().front()), {}, {}};
      const auto reason = complaint(result.witness->at);
      result.witness->reason = reason ? *reason : "it is not proven that no locus passes here";
      return;
    }
    result.margin = wanted;
    if (!result.nearest) return;
    // What lies outside the box is not among the nearest loci, but counts in the proof: bisection where that is so.
    double good = wanted, bad = result.nearest->distance;
    const auto holds = [&](double margin) {
      const bool held = margin > good && proof(region, margin, cells_of_a_margin).proven;
      (held ? good : bad) = margin;
      return held;
    };
    for (const double part : {1 - 1e-3, 1 - 1e-2, 0.9})
      if (holds(rounded_down(part * result.nearest->distance))) break;
    for (int i = 0; i < 6 && good < 0.9 * result.nearest->distance && bad - good > 0.01 * bad; ++i)
      holds((good + bad) / 2);
    result.margin = good;
  }

  const mechanism::Mechanism& mechanism_;
  const Task& task_;
  LociRequest request_;
  std::vector<Case> cases_;
  core::WorkingMode mode_;
  std::vector<int> sides_;
};

bool inside(const core::Zone& zone, const Point2& at) {
  return loci::inside_ring(zone.outer, at) && std::none_of(zone.holes.begin(), zone.holes.end(), [&](const auto& hole) {
           return loci::inside_ring(hole, at);
         });
}

/// The zones that the picture shows and the answer names. Under a range of loads they are those of the file's load.
void add_zones(const mechanism::Mechanism& mechanism, const LociRequest& request, Verification& result) {
  LociRequest own = request;
  own.all_working_modes = false;
  if (own.working_modes.size() > 1) own.working_modes.resize(1);
  if (result.task.min_force) own.selection.min_force = result.task.min_force;
  if (result.task.min_couple) own.selection.min_couple = result.task.min_couple;
  result.map = find_zones(mechanism, own);
  if (!result.verified || result.task.loads) return;
  const Point2 at = loci::TaskRegion(result.task.shape).samples().front();
  for (const core::Zone& zone : result.map.zones)
    if (inside(zone, at)) result.zone = zone.id;
}

}  // namespace

Verification verify_task(const mechanism::Mechanism& mechanism, const Task& task, const LociRequest& request) {
  Verification result = Verifier(mechanism, task, request).verify(task);
  add_zones(mechanism, request, result);
  return result;
}

Verification fit_task(const mechanism::Mechanism& mechanism, const Task& task, const LociRequest& request,
                      loci::FitGoal goal) {
  Verifier verifier(mechanism, task, request);
  const auto moved = [&](const Point2& by) {
    Task other = task;
    other.shape = core::translated(task.shape, {core::Rational(by[0]), core::Rational(by[1])});
    return other;
  };
  const auto accept = [&](const loci::Fit& fit) { return verifier.proven(moved(fit.by)); };
  const auto fit = loci::fit_task(
      verifier.maps(), verifier.mode(), task.shape, core::to_double(task.margin), goal,
      [&](const Point2& at) { return verifier.signature(at); }, accept);
  Verification result = verifier.verify(fit ? moved(fit->by) : task);
  if (fit) result.by = core::RationalPoint{core::Rational(fit->by[0]), core::Rational(fit->by[1])};
  add_zones(mechanism, request, result);
  return result;
}

}  // namespace clearloci
