#include "analysis/tension_verification.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "analysis/effort_polytope.hpp"
#include "analysis/framed.hpp"
#include "analysis/side_names.hpp"
#include "analysis/task_demands.hpp"
#include "analysis/verification.hpp"
#include "analysis/widened_task.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "loci/tasks/tasks.hpp"
#include "mechanism/free_cables.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/notes.hpp"
#include "symbolic/pose_statics.hpp"

namespace clearloci {
namespace {

using core::Rational;
using core::Task;
using loci::pose::PoseRegion;
using mechanism::JointIndex;
using mechanism::Mechanism;
using PoseAt = loci::pose::Pose;

/// One choice of the cables that are free: the statics have their tensions as coordinates behind those of the pose.
struct Variant {
  Mechanism mechanism;
  std::vector<JointIndex> free;
  std::vector<Mechanism> loads;
  core::PoseStatics statics;
  std::unique_ptr<loci::pose::PosePoint> point;
};

std::unique_ptr<Variant> variant_of(const Mechanism& given, const std::vector<JointIndex>& cables, const Task& task,
                                    const DyadSides& sides, const LociRequest& request) {
  auto own = std::make_unique<Variant>();
  own->mechanism = given;
  mechanism::set_free_cables(own->mechanism, cables);
  own->free = mechanism::joints_without_preload(own->mechanism);
  Mechanism open = own->mechanism;
  for (const JointIndex j : own->free) {
    mechanism::FreeEffort& effort = *open.joints[static_cast<std::size_t>(j)].free_effort;
    effort.given = true;
    std::erase_if(open.parameters, [&](const auto& each) { return each.name == effort.parameter; });
    mechanism::Coordinate tension;
    tension.name = effort.parameter;
    std::tie(tension.lower, tension.upper) = *effort.within;
    open.coordinates.push_back(std::move(tension));
  }
  own->loads = under_loads_of(task, open);
  std::vector<const Mechanism*> loads;
  for (const Mechanism& each : own->loads) loads.push_back(&each);
  std::vector<core::TaskDemand> bounds = demands_of(open, request);
  std::erase_if(bounds, [](const core::TaskDemand& demand) { return !demand.bound; });
  own->statics = symbolic::pose_statics(loads, sides, bounds);
  own->point = std::make_unique<loci::pose::PosePoint>(own->statics);
  return own;
}

class TensionChooser : public loci::pose::PoseChooser {
 public:
  TensionChooser(const Mechanism& mechanism, const Task& task, DyadSides sides, LociRequest request)
      : mechanism_(mechanism), task_(task), sides_(std::move(sides)), request_(std::move(request)) {}

  std::optional<loci::pose::PoseChoice> choose(const PoseAt& pose) override {
    Variant* const own = variant_at(pose);
    if (own == nullptr) return std::nullopt;
    const auto polytope = polytope_at(*own, pose);
    if (!polytope) return std::nullopt;
    const auto deepest = polytope->first.deepest(polytope->second);
    if (!deepest || deepest->depth <= 0) return std::nullopt;
    loci::pose::PoseChoice choice{&own->statics, {}};
    for (const Rational& effort : deepest->at) choice.values.push_back(core::to_double(effort));
    return choice;
  }

  bool refutes(const PoseAt& pose) override {
    const Variant* const own = variant_at(pose);
    if (own == nullptr) return refutes_reach(pose);
    for (const Mechanism& loaded : under_loads_of(task_, own->mechanism)) {
      const std::vector<numeric::Bounded> at(pose.begin(), pose.end());
      const auto rows = effort_rows(loaded, at, sides_);
      if (!rows) return refutes_reach(pose);
      const auto deepest = polytope_of(*rows).deepest(widths_of(*rows));
      if (!deepest || deepest->depth > 0) continue;
      std::vector<EffortRow> binding;
      for (const std::size_t row : deepest->binding) binding.push_back((*rows)[row]);
      if (!exclude_each_other(binding)) continue;
      witness = core::TaskWitness{.kind = core::TaskWitness::Kind::beyond_bound, .at = pose};
      for (const EffortRow& row : binding)
        witness->beyond_bound.push_back(
            {loaded.joints[static_cast<std::size_t>(row.joint)].name, core::Quantity::F, 1});
      return true;
    }
    return false;
  }

  std::optional<core::TaskWitness> witness;

 private:
  Variant* variant_at(const PoseAt& pose) {
    const auto cables = mechanism::best_free_cables(mechanism_, pose);
    if (!cables) return nullptr;
    std::unique_ptr<Variant>& own = variants_[*cables];
    if (!own) own = variant_of(mechanism_, *cables, task_, sides_, request_);
    return own.get();
  }

  /// With the widths of its rows; nothing where the pose cannot be solved.
  static std::optional<std::pair<EffortPolytope, std::vector<Rational>>> polytope_at(Variant& own, const PoseAt& pose) {
    std::vector<loci::pose::PosePoint::At> solved;  // under none, then under a unit of each free effort
    for (std::size_t k = 0; k <= own.free.size(); ++k) {
      PoseAt with = pose;
      for (std::size_t i = 0; i < own.free.size(); ++i) with.push_back(i + 1 == k ? 1 : 0);
      const auto at = own.point->at(with);
      if (!at) return std::nullopt;
      solved.push_back(*at);
    }
    EffortPolytope polytope;
    polytope.efforts = own.free.size();
    std::vector<Rational> widths;
    for (std::size_t d = 0; d < own.statics.demands.size(); ++d) {
      const auto joint = std::find_if(own.mechanism.joints.begin(), own.mechanism.joints.end(), [&](const auto& each) {
        return each.name == own.statics.demands[d].demand.joint;
      });
      for (std::size_t load = 0; load < own.statics.loads; ++load) {
        const auto value = [&](std::size_t k) { return solved[k].components[d][load].front(); };
        EffortPolytope::Row& row = polytope.rows.emplace_back();
        row.offset = proposed(value(0));
        for (std::size_t k = 1; k < solved.size(); ++k) row.slope.push_back(proposed(value(k) - value(0)));
        widths.emplace_back(joint->within->second - joint->within->first);
      }
    }
    for (std::size_t i = 0; i < own.free.size(); ++i) {
      const auto& [least, most] = *own.mechanism.joints[static_cast<std::size_t>(own.free[i])].within;
      std::vector<Rational> slope(own.free.size()), opposite(own.free.size());
      slope[i] = 1;
      opposite[i] = -1;
      polytope.rows.push_back({Rational(-least), std::move(slope)});
      polytope.rows.push_back({most, std::move(opposite)});
      widths.insert(widths.end(), 2, most - least);
    }
    return std::pair{std::move(polytope), std::move(widths)};
  }

  /// Of few digits: what is chosen is proven anyhow.
  static Rational proposed(double value) {
    const double grain = std::exp2(std::ilogb(value == 0 ? 1.0 : value) - 24);
    return Rational(std::round(value / grain) * grain);
  }

  bool refutes_reach(const PoseAt& pose) {
    Mechanism loaded = mechanism_;
    for (const JointIndex j : mechanism::joints_without_preload(loaded)) mechanism::give_effort(loaded, j, 0);
    const numeric::NumericModel model = numeric::compile(loaded);
    const numeric::TaskWitness check({{&model}, {}, {}}, sides_, {}, {pose},
                                     numeric::TaskWitness::Rounding::of_coordinates);
    const auto failure = check.failure(pose, false);
    if (!failure || failure->kind != numeric::TaskFailure::Kind::unreachable) return false;
    witness = told_failure(loaded, model, pose, sides_, *failure);
    return true;
  }

  const Mechanism& mechanism_;
  const Task& task_;
  DyadSides sides_;
  LociRequest request_;
  std::map<std::vector<JointIndex>, std::unique_ptr<Variant>> variants_;
};

void require_known_design(const Mechanism& mechanism, const Task& task, const VerifyRequest& request) {
  const auto refuse = [&](const std::string& what, const std::string& mend) {
    throw core::InputError({task.file}, what, mend);
  };
  if (!task.tolerances.empty() || !task.loads_within.empty())
    refuse("tensions are chosen pose by pose for one design and its loads or loads_from",
           "leave out tolerances and loads_within, or ask for constant tensions");
  if (request.fit != TaskFit::none)
    refuse("the task is to be moved, and tensions are free", "give them by --preload, or leave --fit out");
  if (task.pose_error) refuse("a pose_error needs tensions that are given", "give them by --preload");
  if (std::any_of(mechanism.joints.begin(), mechanism.joints.end(), [](const auto& own) { return own.clearance; }))
    refuse("tensions are chosen pose by pose where no joint has a clearance",
           "ask for constant tensions, or leave the clearances out");
}

/// How far around the task poses have tensions, proven, up to the size of the box.
double proven_margin(TensionChooser& chooser, const PoseRegion& region, const Mechanism& mechanism, double from,
                     const std::optional<std::chrono::steady_clock::time_point>& deadline) {
  double limit = from;
  for (std::size_t c = 0; c < mechanism.coordinates.size(); ++c)
    if (region.metric().grows[c])
      limit +=
          region.metric().weights[c] * core::to_double(mechanism.coordinates[c].upper - mechanism.coordinates[c].lower);
  constexpr int attempts = 8;
  constexpr long cells = 4'000;
  double proven = from, too_far = limit;
  for (int i = 0; i < attempts; ++i) {
    const double margin = proven + (i < 3 ? 0.25 : 0.5) * (too_far - proven);
    const loci::pose::PoseEffort effort{.most_cells = cells, .deadline = deadline};
    const bool good = loci::pose::prove_with_choice(chooser, region, margin, effort).verdict == core::Verdict::verified;
    (good ? proven : too_far) = margin;
  }
  return proven;
}

Verification judged(const Mechanism& mechanism, const Task& task, const VerifyRequest& request) {
  if (const std::optional<Framed> own = framed(mechanism, Scaling::none, mechanism::Parameters::kept))
    return from_frame(judged(own->mechanism, in_frame(task, own->frame), request), task, mechanism, own->frame);
  const LociRequest asked = request_of(task, request.loci);
  const DyadSides sides = requested_modes(mechanism, asked).front();
  side_names(mechanism, sides);  // there is one for every dyad
  const PoseRegion region(task.shape, WidenedTask(mechanism, task).metric(mechanism, task));
  TensionChooser chooser(mechanism, task, sides, asked);
  constexpr long cells = 200'000;
  const loci::pose::PoseEffort effort{.most_cells = cells, .deadline = asked.deadline};
  if (asked.progress) asked.progress(0, "proof");
  const double margin = core::to_double(task.margin);
  const loci::pose::PoseProof proof = loci::pose::prove_with_choice(chooser, region, margin, effort);
  Verification result;
  result.task = task;
  result.notes = mechanism::notes_of(mechanism);
  result.verdict = proof.verdict;
  result.cells = proof.cells;
  if (proof.verdict == core::Verdict::refuted) {
    result.witness = chooser.witness;
    result.witness->distance = region.distance(result.witness->at);
  }
  if (proof.verdict == core::Verdict::undecided) result.open = open_part(proof, proof.lower, proof.upper);
  const auto& all = mechanism.coordinates;
  const bool of_angles =
      !task.angle_length && std::all_of(all.begin(), all.end(), [](const auto& c) { return c.angle; });
  if (result.verified() && request.depth != VerifyDepth::verdict)
    (of_angles ? result.angle_margin : result.margin) =
        proven_margin(chooser, region, mechanism, margin, asked.deadline);
  return result;
}

}  // namespace

Verification verify_with_tensions(const Model& model, const Task& task, const VerifyRequest& request) {
  const Mechanism& mechanism = model.content().mechanism;
  require_known_design(mechanism, task, request);
  Verification result = judged(mechanism, task, request);
  core::PreloadAnswer& answer = result.preload.emplace();
  for (const JointIndex j : mechanism::cables_of(mechanism)) {
    const mechanism::Joint& joint = mechanism.joints[static_cast<std::size_t>(j)];
    if (joint.effort && (!joint.free_effort || joint.free_effort->given)) continue;
    answer.joints.push_back(joint.name);
    answer.forces.push_back(true);
    answer.lower.push_back(core::to_double(joint.within->first));
    answer.upper.push_back(core::to_double(joint.within->second));
  }
  answer.of_poses = true;
  answer.size = {0, result.verified() ? 1 : std::numeric_limits<double>::infinity()};
  answer.cells = result.cells;
  tell_mechanism(mechanism, request, result);
  return result;
}

}  // namespace clearloci
