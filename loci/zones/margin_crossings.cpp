#include "loci/zones/margin_crossings.hpp"

namespace clearloci::loci {

core::StraightLine difference_of_margins(const core::LocusFactor& first, const core::LocusFactor& second) {
  if (!first.nodes || !second.nodes) return {};
  core::StraightLineBuilder builder;
  const auto sum_of_squares = [&](const core::NodeForm& form) {
    int sum = builder.constant(0);
    for (std::size_t k = 0; k + 1 < form.parts.size(); ++k)
      sum = builder.add(sum, builder.power(builder.append(form.parts[k].line), 2));
    return sum;
  };
  // Equal steps are made once: the same number tells the same line.
  const int bound = builder.append(first.nodes->parts.back().line);
  if (bound != builder.append(second.nodes->parts.back().line)) return {};
  return builder.line(builder.subtract(sum_of_squares(*first.nodes), sum_of_squares(*second.nodes)));
}

}  // namespace clearloci::loci
