#include "loci/tasks/task_functions.hpp"

#include <algorithm>
#include <utility>

namespace clearloci::loci {

sheet::SheetProgram program_of(const core::TaskConditions& conditions) {
  std::vector<core::Polynomial> none(conditions.functions.size(), core::Polynomial{conditions.tower.variables(), {}});
  return {conditions.tower, std::move(none), conditions.functions};
}

double nearest_part(const std::vector<double>& a, const std::vector<double>& b) {
  double along = 0, length2 = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    along -= a[i] * (b[i] - a[i]);
    length2 += (b[i] - a[i]) * (b[i] - a[i]);
  }
  return length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
}

core::Interval size_of_vector(const std::vector<core::Interval>& parts) {
  core::Interval square = 0;
  for (const core::Interval& part : parts) square = square + squared(part);
  return square_root(square);
}

}  // namespace clearloci::loci
