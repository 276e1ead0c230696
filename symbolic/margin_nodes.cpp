#include "symbolic/margin_nodes.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "symbolic/determinants.hpp"

namespace clearloci::symbolic {

std::optional<MarginNodes::Form> MarginNodes::of(const Margin& margin) {
  if (!margin.force) return std::nullopt;
  std::vector<FactoredPoly> parts = margin.force->components;
  parts.push_back(margin.force->bound);
  Form form;
  core::StraightLineBuilder builder;
  std::vector<int> steps;
  const std::vector<int> variables = geometry_.tower_variables();
  for (const FactoredPoly& part : parts) {
    const Poly sheet = elimination_.over_tower(expanded(part, geometry_.ring()));
    if (sheet.is_constant()) return std::nullopt;
    steps.push_back(builder.append(lines_.of(part.constant, part.factors)));
    form.nodes.parts.push_back({core::scaled_for_doubles(sheet.plain(variables)), builder.line(steps.back())});
  }
  int sum = builder.constant(0);
  for (std::size_t k = 0; k + 1 < steps.size(); ++k) sum = builder.add(sum, builder.power(steps[k], 2));
  form.line = builder.line(builder.subtract(sum, builder.power(steps.back(), 2)));
  const auto force =
      std::find_if(margin.reactions.begin(), margin.reactions.end(),
                   [](const core::Vanishing& vanishing) { return vanishing.quantity == core::Quantity::f; });
  core::ensure(force != margin.reactions.end(), "a squared force is that of a joint");
  for (const core::Quantity quantity : {core::Quantity::fx, core::Quantity::fy}) {
    const FactoredPoly* const probe = numerator(probed(), force->joint, quantity);
    if (probe == nullptr || probe->is_zero()) return std::nullopt;
    form.nodes.probes.push_back(lines_.of(probe->constant, probe->factors));
  }
  if (form.nodes.probes.size() + 1 != form.nodes.parts.size()) return std::nullopt;
  return form;
}

const std::vector<Reaction>& MarginNodes::probed() {
  if (!probed_) {
    const FactoredDeterminants determinants = probed_determinants(geometry_);
    lines_.know(determinants.forms);
    probed_ = reactions(geometry_, determinants);
  }
  return *probed_;
}

}  // namespace clearloci::symbolic
