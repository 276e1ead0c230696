// A pose in every working mode and every assembly of its groups (clearloci/pose.hpp).
#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "analysis/flanks.hpp"
#include "analysis/loci.hpp"
#include "analysis/model.hpp"
#include "analysis/pose.hpp"
#include "analysis/pose_answer.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "loci/sheet/sheet.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/group_closing.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/rigidity.hpp"
#include "mechanism/written_unit.hpp"

namespace clearloci {
namespace {

ModePose solve_in(const mechanism::Mechanism& mechanism, const std::vector<core::Rational>& at,
                  const PoseRequest& request) {
  ModePose mode_pose{named_mode(mechanism, request.working_mode), {}};
  try {
    Pose pose = solve_pose(mechanism, at, request);
    if (!pose.unreachable.empty())
      mode_pose.why_not = "point " + pose.unreachable + " cannot be placed";
    else if (!pose.beyond_limit.empty())
      mode_pose.why_not = "beyond the limit of the " + pose.beyond_limit;
    else if (pose.actual && !pose.actual->converged)
      mode_pose.why_not = "the pose error cannot be iterated: " + pose.actual->reason;
    else if (const std::vector<std::string> pulled = pulled_gears(mechanism, pose); !pulled.empty())
      mode_pose.why_not = words_of_pulled(pulled);
    else
      mode_pose.pose = std::move(pose);
  } catch (const core::InputError& error) {  // singular in every pose of this mode
    mode_pose.why_not = error.problem();
  }
  return mode_pose;
}

/// How many assemblies a group has at most. Of three points of a body at given distances from each other, with six
/// further distances from points of the body to known ones: a Stewart-Gough platform, which has 40 (F. Ronga, T. Vust,
/// Stewart platforms without computer?, Real Analytic and Algebraic Geometry, 1995).
std::optional<std::size_t> most_assemblies(const mechanism::Mechanism& mechanism, const mechanism::Group& group) {
  constexpr std::size_t sides = 3, legs = 6, of_a_platform = 40;
  if (mechanism.space != mechanism::Space::spatial || group.count != 3 || group.distances.size() != sides + legs ||
      !group.lines.empty())
    return std::nullopt;
  const auto moves = [&](mechanism::PointIndex point) { return point >= group.first && point <= group.last; };
  std::set<mechanism::PointIndex> of_body;
  std::size_t within = 0;
  for (const mechanism::Group::Distance& distance : group.distances) {
    within += moves(distance.first) && moves(distance.second) ? 1 : 0;
    for (const mechanism::PointIndex point : {distance.first, distance.second})
      if (moves(point)) of_body.insert(point);
  }
  const bool rigid = std::any_of(mechanism.links.begin(), mechanism.links.end(), [&](const mechanism::Link& link) {
    const std::set<mechanism::PointIndex> points(link.points.begin(), link.points.end());
    return std::includes(points.begin(), points.end(), of_body.begin(), of_body.end());
  });
  return rigid && within == sides ? std::optional(of_a_platform) : std::nullopt;
}

/// One assembly of the groups so far, or all of them.
struct Assembly {
  core::BlockUnknowns unknowns;
  loci::pose::UnknownsBox enclosed;
};

void put_assembly(mechanism::Mechanism& mechanism, const core::BlockUnknowns& unknowns) {
  std::size_t k = 0;
  for (mechanism::Group& group : mechanism.groups)
    for (auto& place : group.near)
      for (std::size_t c = 0; c < mechanism::dimension(mechanism) && k < unknowns.size(); ++c)
        place[c] = core::Rational(unknowns[k++]);
}

/// Group by group at a pose, each over the assemblies of those before it. `complete`: none is missing.
std::vector<Assembly> assemblies_at(const mechanism::Mechanism& mechanism, const std::vector<double>& pose,
                                    const DyadSides& sides, bool& complete) {
  std::vector<Assembly> all = {{}};
  for (std::size_t g = 0; g < mechanism.groups.size(); ++g) {
    std::vector<Assembly> longer;
    for (const Assembly& assembly : all) {
      mechanism::Mechanism until = mechanism::up_to_group(mechanism, g);
      put_assembly(until, assembly.unknowns);
      const auto box = mechanism::group_reach(until, pose, sides);
      loci::pose::AllSolutions found;
      if (box)
        found = loci::pose::all_solutions(mechanism::group_program(until, sides), pose, assembly.enclosed, *box,
                                          most_assemblies(mechanism, mechanism.groups[g]));
      complete = complete && found.complete;
      for (std::size_t i = 0; i < found.found.size(); ++i) {
        Assembly next{std::move(found.found[i]), assembly.enclosed};
        const loci::pose::UnknownsBox& here = found.enclosed[i];
        next.enclosed.insert(next.enclosed.end(), here.begin(), here.end());
        // Of one that meets another nothing is proven of what stands on it.
        if (!here.empty() || g + 1 == mechanism.groups.size())
          longer.push_back(std::move(next));
        else
          complete = false;
      }
    }
    all = std::move(longer);
  }
  return all;
}

/// Of every assembly of the groups in a working mode: it is that of a posture at this very pose.
void add_assemblies(const mechanism::Mechanism& mechanism, const std::vector<core::Rational>& at,
                    const PoseRequest& request, std::vector<ModePose>& modes) {
  std::vector<double> pose;
  for (const core::Rational& value : at) pose.push_back(core::to_double(value));
  mechanism::Mechanism in_mode = mechanism;
  in_mode.near = at;
  // Nothing is asked of other poses.
  for (std::size_t c = 0; c < at.size(); ++c) {
    mechanism::Coordinate& coordinate = in_mode.coordinates[c];
    const core::Rational near = (coordinate.upper - coordinate.lower) / 1'000'000;
    coordinate.lower = at[c] - near;
    coordinate.upper = at[c] + near;
  }
  bool complete = true;
  std::vector<Assembly> all = assemblies_at(in_mode, pose, request.working_mode, complete);
  // No link is bent or turned over.
  const mechanism::HeldByLinks held = mechanism::held_by_links(mechanism);
  std::erase_if(all, [&](const Assembly& assembly) {
    put_assembly(in_mode, assembly.unknowns);
    const auto posture = mechanism::sample_posture(in_mode, pose, request.working_mode);
    return posture && !mechanism::keeps(held, *posture);
  });
  std::string names;
  for (const mechanism::Group& group : mechanism.groups) names += (names.empty() ? "" : ", ") + group.name;
  if (all.empty()) {
    modes.push_back(solve_in(mechanism, at, request));
    if (!complete) modes.back().working_mode.emplace_back(names, "that of its posture, others are not told");
    return;
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    put_assembly(in_mode, all[i].unknowns);
    modes.push_back(solve_in(in_mode, at, request));
    modes.back().working_mode.emplace_back(names, "assembly " + std::to_string(i + 1) + " of " +
                                                      std::to_string(all.size()) + (complete ? "" : " or more"));
  }
}

}  // namespace

PoseInModes solve_pose_in_modes(const mechanism::Mechanism& mechanism, const std::vector<core::Rational>& at,
                                const PoseRequest& request) {
  require_values(mechanism, at.size());
  require_rates(mechanism, request);
  PoseInModes all{mechanism.name, mechanism::told_parameters(mechanism), {}};
  PoseRequest pose_request = request;
  for (const DyadSides& sides : requested_modes(mechanism, {.all_working_modes = true})) {
    pose_request.working_mode = sides;
    if (mechanism.groups.empty())
      all.modes.push_back(solve_in(mechanism, at, pose_request));
    else
      add_assemblies(mechanism, at, pose_request, all.modes);
  }
  return all;
}

PoseInModes solve_pose_in_modes(const Model& model, const std::vector<double>& at, const PoseRequest& request) {
  return solve_pose_in_modes(model.content().mechanism, exact_values(at), request);
}

}  // namespace clearloci
