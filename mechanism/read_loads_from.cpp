#include "mechanism/read_loads_from.hpp"

namespace clearloci::mechanism {

std::pair<std::vector<core::Rational>, std::vector<core::Rational>> read_loads_from(const Mechanism& mechanism,
                                                                                    const Value& value) {
  const bool one_force = mechanism.loads.size() == 1 && !mechanism.loads.front().force.empty();
  if (!one_force)
    throw core::InputError(value.where,
                           value.what + " takes the place of a mechanism's one force, but " + mechanism.file + " has " +
                               std::to_string(mechanism.loads.size()) + " loads",
                           "give the mechanism a single load with a force");
  const std::vector<Value> ends = elements(value, 2);
  std::pair<std::vector<core::Rational>, std::vector<core::Rational>> range;
  for (std::size_t i = 0; i < 2; ++i)
    for (const Value& part : elements(ends[i], static_cast<int>(dimension(mechanism))))
      (i == 0 ? range.first : range.second).push_back(read_number(mechanism, part, Sign::any).value);
  const auto& [f, g] = range;
  core::Rational along = 0;
  bool parallel = true;
  for (std::size_t i = 0; i < f.size(); ++i) {
    along += f[i] * g[i];
    for (std::size_t k = 0; k < i; ++k) parallel = parallel && f[i] * g[k] == f[k] * g[i];
  }
  if (parallel && along <= 0)
    throw core::InputError(value.where, value.what + " passes through no load at all: its ends are opposite or zero",
                           "write two vectors less than half a turn apart");
  return range;
}

}  // namespace clearloci::mechanism
