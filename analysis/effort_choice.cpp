#include "analysis/effort_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/effort_chooser.hpp"
#include "analysis/pose_efforts.hpp"
#include "analysis/side_names.hpp"
#include "analysis/task_demands.hpp"
#include "analysis/verification.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "mechanism/free_cables.hpp"
#include "mechanism/notes.hpp"

namespace clearloci {
namespace {

using core::Task;
using core::Verdict;
using loci::pose::PoseRegion;
using mechanism::Mechanism;
using PoseAt = loci::pose::Pose;

constexpr double unbounded = std::numeric_limits<double>::infinity();
/// Efforts keep within so many times what some pose asks for, one after the other; the last within all that is looked
/// at.
constexpr std::array<double, 6> sizes_tried = {1.008, 1.03, 1.1, 1.3, 3, unbounded};
constexpr long cells_of_verdict = 200'000, cells_of_size = 4'000, cells_of_margin = 4'000;

void require_answerable_by_choice(const Task& task, const VerifyRequest& request) {
  const auto refuse = [&](const std::string& what, const std::string& mend) {
    throw core::InputError({task.file}, what, mend);
  };
  if (request.fit != TaskFit::none)
    refuse("the task is to be moved, and efforts are free", "give them by --preload, or leave --fit out");
  if (task.pose_error) refuse("a pose_error needs efforts that are given", "give them by --preload");
}

/// What is known of one pattern.
struct PatternProof {
  std::unique_ptr<PatternChooser> chooser;
  Verdict verdict = Verdict::undecided;
  double verified_within = unbounded;  ///< a size
  loci::pose::EffortProof proof = {};
};

class ChoiceSearch {
 public:
  ChoiceSearch(const Mechanism& mechanism, const std::vector<WantedEffort>& wanted, const Task& task,
               const VerifyRequest& request)
      : mechanism_(mechanism),
        task_(task),
        request_(request),
        asked_(request_of(task, request.loci)),
        wanted_(wanted),
        systems_(mechanism, wanted, task, requested_modes(mechanism, asked_).front(), asked_),
        region_(task.shape, metric_of(mechanism, task)),
        margin_(core::to_double(task.margin)) {
    side_names(mechanism, systems_.sides());  // there is one for every dyad
  }

  Verification run() {
    Verification result;
    result.task = task_;
    result.notes = mechanism::notes_of(mechanism_);
    if (asked_.progress) asked_.progress(0, "proof");
    if (const auto failure = systems_.unreachable(region_.samples().front())) return failed(result, *failure);
    const bool decided = find_patterns(result);
    for (PatternProof& proof : patterns_) {
      if (proof.verdict != Verdict::refuted) look_for_refutation(proof);
      if (proof.chooser->unreachable) return failed(result, *proof.chooser->unreachable);
    }
    std::stable_sort(patterns_.begin(), patterns_.end(), [](const PatternProof& a, const PatternProof& b) {
      return std::pair(a.verdict == Verdict::refuted, a.chooser->needed) <
             std::pair(b.verdict == Verdict::refuted, b.chooser->needed);
    });
    for (PatternProof& proof : patterns_) {
      if (proof.verdict == Verdict::refuted || (result.verified() && request_.depth != VerifyDepth::everything))
        continue;
      prove(proof, result);
      if (proof.chooser->unreachable) return failed(result, *proof.chooser->unreachable);
    }
    tell(decided, result);
    return result;
  }

 private:
  static loci::pose::PoseMetric metric_of(const Mechanism& mechanism, Task task) {
    task.loads_within.clear();
    task.tolerances.clear();
    return WidenedTask(mechanism, task).metric(mechanism, task);
  }

  Verification& failed(Verification& result, core::TaskWitness witness) const {
    result.verdict = Verdict::refuted;
    witness.distance = region_.distance(witness.at);
    result.witness = std::move(witness);
    return result;
  }

  /// Of the first pose at which |A| is not zero.
  bool find_patterns(Verification& result) {
    for (const PoseAt& pose : region_.samples()) {
      const EffortSystem* const system = systems_.at(pose);
      if (system == nullptr) continue;
      std::optional<EffortSystem::OneLoad> load;
      if (task_.knows_load) load = EffortSystem::OneLoad{0, std::vector<double>(system->statics().directions(), 0.0)};
      const auto signs = sign_patterns(*system, system->places(pose), load);
      if (!signs) continue;
      result.notes.insert(result.notes.end(), system->notes().begin(), system->notes().end());
      for (const SignPattern& pattern : signs->possible)
        patterns_.push_back({std::make_unique<PatternChooser>(systems_, pattern)});
      for (const auto& [impossible, exclusion] : signs->impossible) {
        PatternProof& pattern = patterns_.emplace_back();
        pattern.chooser = std::make_unique<PatternChooser>(systems_, impossible);
        pattern.chooser->exclusion = exclusion;
        pattern.chooser->excluding = system;
        pattern.verdict = Verdict::refuted;
      }
      first_ = pose;
      return true;
    }
    return false;
  }

  void look_for_refutation(PatternProof& proof) {
    constexpr std::size_t most = 40;
    const std::vector<PoseAt> samples = region_.samples();
    const std::size_t stride = (samples.size() + most - 1) / most;
    for (std::size_t i = 0; i < samples.size(); i += i < (std::size_t{1} << 4) ? 1 : stride)
      if (proof.chooser->refutes(samples[i])) {
        if (proof.chooser->exclusion) proof.verdict = Verdict::refuted;  // else the pose is out of reach
        return;
      }
  }

  /// Sizes a little above what poses ask for first: so both sides of the smallest are near each other.
  void prove(PatternProof& pattern_proof, Verification& result) {
    // Of what is not the verdict less is tried.
    const int most_tries = result.verified() ? 6 : 16;
    std::size_t level = 0;
    for (int i = 0; i < most_tries && level < sizes_tried.size() && pattern_proof.verdict == Verdict::undecided; ++i) {
      const double needed = pattern_proof.chooser->needed;
      const double within =
          std::isfinite(sizes_tried[level]) ? sizes_tried[level] * std::max(needed, least_size()) : unbounded;
      pattern_proof.chooser->keep_within(within);
      const bool last = level + 1 == sizes_tried.size() && !result.verified();
      loci::pose::EffortProof proof = proven(pattern_proof, margin_, last ? cells_of_verdict : cells_of_size);
      result.cells += proof.proof.cost.cells;
      if (pattern_proof.chooser->unreachable) return;
      if (pattern_proof.chooser->exclusion) {
        pattern_proof.verdict = Verdict::refuted;
      } else if (proof.proof.verdict == Verdict::verified) {
        pattern_proof.verdict = Verdict::verified;
        pattern_proof.verified_within = std::isfinite(within) ? within : size_of(proof);
        pattern_proof.proof = std::move(proof);
      } else if (!(pattern_proof.chooser->needed > needed)) {
        ++level;
        if (last) pattern_proof.proof = std::move(proof);
      }
    }
    pattern_proof.chooser->keep_within(unbounded);
    if (pattern_proof.verdict != Verdict::verified || result.verified()) return;
    result.verdict = Verdict::verified;
    if (request_.depth != VerifyDepth::verdict) tell_margin(pattern_proof, result);
  }

  loci::pose::EffortProof proven(PatternProof& proof, double margin, long cells) {
    const EffortSystem* const system = systems_.at(first_);
    const loci::SearchBudget budget{.most_cells = cells, .deadline = asked_.deadline};
    return loci::pose::prove_with_efforts(*proof.chooser, region_, system->designs(), margin, budget);
  }

  /// Where no pose asks for any: a thousandth of what is looked at.
  double least_size() const {
    double size = unbounded;
    for (const WantedEffort& effort : wanted_)
      size = std::min(size, core::to_double(std::max(abs(effort.lower), abs(effort.upper))) * effort.size_of_one);
    return std::isfinite(size) ? 1e-3 * size : 1;
  }

  double size_of(const loci::pose::EffortProof& proof) const {
    double size = 0;
    for (const loci::pose::EffortCell& cell : proof.cells) {
      const std::vector<WantedEffort>& wanted = systems_.of(*cell.statics).wanted();
      for (const std::vector<double>& efforts : cell.choice.efforts)
        for (std::size_t k = 0; k < efforts.size(); ++k)
          size = std::max(size, (std::abs(efforts[k]) + beside(cell, k)) * wanted[k].size_of_one);
    }
    return size;
  }

  /// What loads add to an effort at most.
  static double beside(const loci::pose::EffortCell& cell, std::size_t k) {
    double sum = 0;
    for (const core::LoadBall& ball : cell.statics->balls) {
      double square = 0;
      for (std::size_t c = ball.first; c < ball.first + ball.count && !cell.choice.gains.empty(); ++c)
        square += cell.choice.gains[c][k] * cell.choice.gains[c][k];
      sum += ball.radius * std::sqrt(square);
    }
    return sum;
  }

  /// How far around the task poses have efforts, proven, up to the size of the box.
  void tell_margin(PatternProof& proof, Verification& result) {
    const auto& all = mechanism_.coordinates;
    const double limit = widest_margin(mechanism_, margin_, &region_.metric());
    constexpr int attempts = 8;
    double proven_to = margin_, too_far = limit;
    for (int i = 0; i < attempts; ++i) {
      const double margin = proven_to + (i < 3 ? 0.25 : 0.5) * (too_far - proven_to);
      PatternProof wider{std::make_unique<PatternChooser>(systems_, proof.chooser->signs())};
      const bool good = proven(wider, margin, cells_of_margin).proof.verdict == Verdict::verified;
      (good ? proven_to : too_far) = margin;
    }
    const bool of_angles =
        !task_.angle_length && std::all_of(all.begin(), all.end(), [](const auto& c) { return c.angle; });
    (of_angles ? result.angle_margin : result.margin) = proven_to;
  }

  void tell(bool decided, Verification& result) {
    const bool none = decided && std::all_of(patterns_.begin(), patterns_.end(), [](const PatternProof& proof) {
                        return proof.verdict == Verdict::refuted;
                      });
    if (none && !result.verified()) tell_refutation(result);
    if (!result.verified() && !none) tell_open(result);
    core::PreloadAnswer& answer = result.preload.emplace();
    answer.of_poses = true;
    answer.cells = result.cells;
    answer.size = {unbounded, unbounded};
    for (const PatternProof& proof : patterns_) {
      answer.patterns.push_back(told(proof));
      const auto& [least, most] = answer.patterns.back().size;
      answer.size[0] = std::min(answer.size[0], least);
      if (most < answer.size[1]) {
        answer.size[1] = most;
        answer.cells_of_law = cells_of(proof.proof);
      }
    }
    if (!decided) answer.size[0] = 0;
  }

  core::PreloadPattern told(const PatternProof& proof) const {
    core::PreloadPattern pattern;
    for (const auto& [name, sign] : proof.chooser->signs()) pattern.signs.emplace_back(name, sign);
    pattern.verdict = proof.verdict;
    pattern.size = {proof.verdict == Verdict::refuted ? unbounded : proof.chooser->needed, proof.verified_within};
    if (proof.chooser->exclusion)
      tell_rows(*proof.chooser->excluding, *proof.chooser->exclusion, pattern);
    else if (proof.chooser->needing != nullptr)
      tell_rows(*proof.chooser->needing, proof.chooser->below_needed, pattern);
    return pattern;
  }

  std::vector<core::PreloadLawCell> cells_of(const loci::pose::EffortProof& proof) const {
    std::vector<core::PreloadLawCell> cells;
    for (const loci::pose::EffortCell& effort_cell : proof.cells) {
      core::PreloadLawCell& cell = cells.emplace_back();
      for (const auto& [low, high] : effort_cell.poses) {
        cell.lower.push_back(low);
        cell.upper.push_back(high);
      }
      for (const WantedEffort& wanted : systems_.of(*effort_cell.statics).wanted()) cell.joints.push_back(wanted.joint);
      cell.efforts = effort_cell.choice.efforts;
      if (!task_.knows_load) cell.efforts.resize(1);
      cell.gains = effort_cell.choice.gains;
    }
    return cells;
  }

  void tell_refutation(Verification& result) const {
    result.verdict = Verdict::refuted;
    result.notes.emplace_back("no efforts that vary continuously with the pose" +
                              std::string(task_.knows_load ? " and the load" : "") + " verify the task: proven");
    for (const PatternProof& proof : patterns_) {
      if (!proof.chooser->exclusion) continue;
      const EffortExclusion& exclusion = *proof.chooser->exclusion;
      constexpr std::size_t most_notes = 12;
      if (result.notes.size() < most_notes)
        result.notes.push_back(exclusion_words(*proof.chooser->excluding, exclusion));
      if (result.witness) continue;
      result.witness = witness_of(*proof.chooser->excluding, exclusion);
      result.witness->distance = region_.distance(result.witness->at);
    }
  }

  core::TaskWitness witness_of(const EffortSystem& system, const EffortExclusion& exclusion) const {
    core::TaskWitness witness{.kind = core::TaskWitness::Kind::beyond_bound, .at = first_};
    for (const EffortInequality& row : exclusion.rows) {
      if (!row.at.empty())
        witness.at.assign(row.at.begin(), row.at.begin() + static_cast<std::ptrdiff_t>(first_.size()));
      const std::size_t line = row.reaction.find('_');
      const std::string joint = row.reaction.substr(line + 1);
      for (const core::TaskDemand& demand : system.demands())
        if (reaction_name(demand) == row.reaction) {
          add_once(witness.beyond_bound, {joint, demand.quantity, 1});
          break;
        }
      if (row.at.empty())
        add_once(witness.beyond_bound, {joint, row.reaction.front() == 'F' ? core::Quantity::F : core::Quantity::M, 1});
    }
    return witness;
  }

  static void add_once(std::vector<core::Vanishing>& all, core::Vanishing vanishing) {
    if (std::none_of(all.begin(), all.end(), [&](const auto& each) {
          return each.joint == vanishing.joint && each.quantity == vanishing.quantity;
        }))
      all.push_back(std::move(vanishing));
  }

  void tell_open(Verification& result) const {
    result.verdict = Verdict::undecided;
    for (const PatternProof& proof : patterns_) {
      if (proof.verdict != Verdict::undecided || proof.proof.proof.open == 0) continue;
      result.open = open_part(proof.proof.proof);
      return;
    }
  }

  const Mechanism& mechanism_;
  Task task_;
  const VerifyRequest& request_;
  LociRequest asked_;
  std::vector<WantedEffort> wanted_;
  EffortSystems systems_;
  PoseRegion region_;
  double margin_;
  std::vector<PatternProof> patterns_;
  PoseAt first_;
};

}  // namespace

Verification verify_with_choices(const Model& model, const Task& task, const VerifyRequest& request) {
  const Mechanism& mechanism = model.content().mechanism;
  require_answerable_by_choice(task, request);
  const std::vector<WantedEffort> wanted = wanted_efforts(model, task, request);
  Verification result = ChoiceSearch(mechanism, wanted, task, request).run();
  core::PreloadAnswer answer;
  if (result.preload) answer = std::move(*result.preload);
  answer.of_poses = true;
  const auto add = [&](const std::string& joint, bool force, const core::Rational& lower, const core::Rational& upper) {
    answer.joints.push_back(joint);
    answer.forces.push_back(force);
    answer.lower.push_back(core::to_double(lower));
    answer.upper.push_back(core::to_double(upper));
  };
  for (const WantedEffort& effort : wanted)
    if (const auto cables = mechanism::cables_of(mechanism);
        std::none_of(cables.begin(), cables.end(), [&](mechanism::JointIndex j) {
          return mechanism.joints[static_cast<std::size_t>(j)].name == effort.joint;
        }))
      add(effort.joint, effort.force, effort.lower, effort.upper);
  for (const mechanism::JointIndex j : mechanism::cables_of(mechanism)) {
    const mechanism::Joint& joint = mechanism.joints[static_cast<std::size_t>(j)];
    if (joint.effort && (!joint.free_effort || joint.free_effort->given)) continue;
    add(joint.name, true, joint.within->first, joint.within->second);
  }
  result.preload = std::move(answer);
  tell_mechanism(mechanism, request, result);
  return result;
}

}  // namespace clearloci
