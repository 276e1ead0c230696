#include "loci/curves/margin_nodes.hpp"

#include <algorithm>

#include "loci/search/search.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci {

using core::LocusFactor;

MarginNodes::MarginNodes(const core::LocusProblem& problem, const core::WorkingMode& mode,
                         const sheet::ZeroOptions& options)
    : problem_(problem) {
  for (const LocusFactor& factor : problem.factors) {
    if (!factor.nodes) continue;
    const auto found = std::find_if(groups_.begin(), groups_.end(), [&](const Group& group) {
      return group.factors.front()->nodes->parts.back().sheet == factor.nodes->parts.back().sheet;
    });
    if (found == groups_.end())
      groups_.push_back({{&factor}, {}});
    else
      found->factors.push_back(&factor);
  }
  for (Group& group : groups_) {
    std::vector<const core::NodeForm*> forms;
    for (const LocusFactor* factor : group.factors) forms.push_back(&*factor->nodes);
    group.stars = sheet::enclosed_nodes(problem.tower, mode, forms, problem.lower, problem.upper, options);
  }
}

const MarginNodes::Group* MarginNodes::group_of(const LocusFactor& factor) const {
  const auto found = std::find_if(groups_.begin(), groups_.end(), [&](const Group& group) {
    return std::find(group.factors.begin(), group.factors.end(), &factor) != group.factors.end();
  });
  return found == groups_.end() ? nullptr : &*found;
}

std::vector<sheet::Star> MarginNodes::of(const LocusFactor& factor) const { return of(factor, factor); }

std::vector<sheet::Star> MarginNodes::of(const LocusFactor& first, const LocusFactor& second) const {
  const Group* const group = group_of(first);
  std::vector<sheet::Star> stars;
  if (group == nullptr || group != group_of(second)) return stars;
  for (const sheet::Star& star : group->stars)
    if (sheet::power_at(star, problem_.tower, first.line) >= 2 &&
        sheet::power_at(star, problem_.tower, second.line) >= 2)
      stars.push_back(star);
  return stars;
}

}  // namespace clearloci::loci
