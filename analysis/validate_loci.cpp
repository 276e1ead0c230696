#include "analysis/loci.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "analysis/framed.hpp"
#include "analysis/idle_efforts.hpp"
#include "analysis/model.hpp"
#include "analysis/preload_choice.hpp"
#include "analysis/request_limits.hpp"
#include "core/errors.hpp"
#include "core/straight_line.hpp"
#include "loci/curves/curves.hpp"
#include "loci/surfaces/surfaces.hpp"
#include "mechanism/group_closing.hpp"
#include "mechanism/guide.hpp"
#include "mechanism/joint_traits.hpp"
#include "numeric/validate_preload.hpp"

namespace clearloci {

std::vector<numeric::TracedReaction> selected_reactions(const mechanism::Mechanism& mechanism,
                                                        const LociRequest& request) {
  const std::vector<mechanism::Joint>& joints = mechanism.joints;
  const bool any_clearance =
      std::any_of(joints.begin(), joints.end(), [](const mechanism::Joint& joint) { return joint.clearance; });
  const std::vector<std::string>& named = request.joints;
  std::vector<numeric::TracedReaction> reactions;
  for (const mechanism::Joint& joint : joints) {
    const bool wanted = named.empty() ? joint.clearance.has_value() || !any_clearance
                                      : std::find(named.begin(), named.end(), joint.name) != named.end();
    if (!wanted || mechanism::is_cable(joint)) continue;
    const bool every = mechanism.space == mechanism::Space::planar || !named.empty();
    for (const core::Quantity quantity :
         every ? mechanism::reaction_components(mechanism, joint) : mechanism::force_unknowns(mechanism, joint))
      reactions.push_back({joint.name, quantity});
    if (joint.actuated) reactions.push_back({joint.name, mechanism::actuator_quantity(joint)});
    if (mechanism::has_guide_ends(mechanism, joint))
      for (const auto& [end, sign] : mechanism::guide_end_signs) reactions.push_back({joint.name, end});
  }
  return reactions;
}

namespace {

/// The loci of free efforts over two coordinates against the choice of efforts at the nodes.
core::Validation validate_preload(const mechanism::Mechanism& mechanism, const LociRequest& request,
                                  const numeric::GridSpec& grid) {
  if (mechanism.coordinates.size() != 2)
    throw core::InputError({mechanism.file}, "loci of free efforts are validated over two coordinates",
                           "give the efforts by --preload");
  const numeric::FindChoice choice = preload_choice(mechanism, request);
  core::LocusMap map = trace_loci(mechanism, request);
  if (map.out_of_time)
    throw core::LimitReached("the loci could not be traced completely within the time limit; allow more time");
  const mechanism::Joint& joint =
      mechanism.joints[static_cast<std::size_t>(mechanism::joints_without_preload(mechanism).front())];
  numeric::ValidationReport report =
      numeric::validate_preload(numeric::compile(with_idle_efforts(mechanism)), map, grid, choice,
                                {joint.name, mechanism::actuator_quantity(joint)});
  return {std::move(map), {grid.nx, grid.ny}, std::move(report)};
}

}  // namespace

core::Validation validate_loci(const mechanism::Mechanism& mechanism, LociRequest request,
                               const numeric::GridSpec& grid) {
  require_coordinates(mechanism, 1, 3, "loci are held against a grid");
  if (!mechanism::joints_without_preload(mechanism).empty()) return validate_preload(mechanism, request, grid);
  if (const std::optional<Framed> scaled = framed(mechanism)) {
    core::Validation inside = validate_loci(scaled->mechanism, in_frame(std::move(request), scaled->frame), grid);
    return {from_frame(std::move(inside.map), mechanism, scaled->frame), std::move(inside.nodes),
            from_frame(std::move(inside.report), mechanism, scaled->frame)};
  }
  std::vector<numeric::TracedReaction> reactions = selected_reactions(mechanism, request);
  // Where a pin in space loses its contact no component of its force need vanish.
  for (const mechanism::Joint& joint : mechanism.joints)
    if (mechanism::presses_across_axis(mechanism, joint) &&
        std::any_of(reactions.begin(), reactions.end(),
                    [&](const auto& reaction) { return reaction.joint == joint.name; }))
      reactions.push_back({joint.name, core::Quantity::f});
  // Of points that close together the loci of efforts and whole forces are known, not those of components.
  if (!mechanism.groups.empty())
    std::erase_if(reactions, [](const numeric::TracedReaction& reaction) {
      return reaction.quantity != core::Quantity::M && reaction.quantity != core::Quantity::F;
    });
  std::vector<core::Quantity>& quantities = request.quantities = {core::Quantity::f};
  for (const numeric::TracedReaction& reaction : reactions)
    if (std::find(quantities.begin(), quantities.end(), reaction.quantity) == quantities.end())
      quantities.push_back(reaction.quantity);
  core::LocusMap map = trace_loci(mechanism, request);
  if (map.out_of_time)
    throw core::LimitReached("the loci could not be traced completely within the time limit; allow more time");
  numeric::ValidationReport report = numeric::validate(mechanism, map, grid, reactions);
  std::vector<int> nodes = {grid.nx, grid.ny, grid.nz};
  nodes.resize(mechanism.coordinates.size());
  return {std::move(map), std::move(nodes), std::move(report)};
}

core::Validation validate_loci(const Model& model, const ValidationRequest& request) {
  const mechanism::Mechanism& mechanism = model.content().mechanism;
  check_request(mechanism, request.loci);
  check_nodes(request.nodes, 2);
  const std::size_t coordinates = mechanism.coordinates.size();
  numeric::GridSpec grid;
  if (coordinates == 1) grid.nx = 4000;
  if (coordinates == 3) grid.nx = grid.ny = grid.nz = 40;
  if (!request.nodes.empty()) {
    const bool grid_like = std::all_of(request.nodes.begin(), request.nodes.end(), [](int n) { return n > 1; });
    if (request.nodes.size() != coordinates || !grid_like)
      throw core::InputError({mechanism.file}, "the nodes are those of no grid over the free coordinates",
                             "give a number above 1 for each of them");
    for (std::size_t c = 0; c < std::min<std::size_t>(coordinates, 3); ++c)
      (c == 0 ? grid.nx : c == 1 ? grid.ny : grid.nz) = request.nodes[c];
  }
  return validate_loci(mechanism, request.loci, grid);
}

}  // namespace clearloci
