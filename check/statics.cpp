#include "check/statics.hpp"

#include "check/elimination.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/guide.hpp"

namespace clearloci::check {
namespace {

using mechanism::Mechanism;

/// The coordinates of the model at a place of the frame that the certificate is in.
VariablesOf<Interval> variables_at(const Mechanism& m, const Interval& x, const Interval& y) {
  VariablesOf<Interval> variables;
  for (const mechanism::Coordinate& coordinate : m.coordinates) {
    const std::size_t c = variables.names.size();
    const Interval& inside = c == 0 ? x : y;
    variables.names.push_back(coordinate.name);
    variables.values.push_back(!m.frame || m.frame->is_usual() ? inside
                                                               : Interval(m.frame->from[c], inside.bits()) +
                                                                     Interval(m.frame->scale, inside.bits()) * inside);
  }
  return variables;
}

std::vector<core::TaskDemand> ends_of_guides(const Mechanism& m) {
  std::vector<core::TaskDemand> ends;
  for (const mechanism::Joint& joint : m.joints)
    if (mechanism::has_guide_ends(m, joint))
      for (const auto& [end, sign] : mechanism::guide_end_signs) ends.push_back({joint.name, end, {}});
  return ends;
}

}  // namespace

std::optional<Posture> posture(const Mechanism& m, const Sides& sides, const Interval& x, const Interval& y) {
  Posture posture = posture_over(m, sides, variables_at(m, x, y));
  if (posture.stopped_by) return std::nullopt;
  return posture;
}

std::size_t limit_ends(const Mechanism& m) {
  std::size_t count = 0;
  for (const mechanism::Spring& spring : m.springs) count += spring.kind == mechanism::Spring::Kind::torsion ? 1U : 0U;
  count += 2 * mechanism::bounded_laws(m).size();
  for (const mechanism::Limit& limit : m.limits)
    count += (limit.keeps_lower() ? 1U : 0U) + (limit.keeps_upper() ? 1U : 0U);
  return count;
}

std::vector<mechanism::Unknown> reactions_of(const Mechanism& m) {
  std::vector<mechanism::Unknown> list = mechanism::unknowns(m);
  for (std::size_t j = 0; j < m.joints.size(); ++j)
    if (mechanism::has_guide_ends(m, m.joints[j]))
      for (const auto& [end, sign] : mechanism::guide_end_signs) list.push_back({static_cast<int>(j), end});
  return list;
}

std::optional<Solution> solve(const Mechanism& m, const Posture& posture, const Interval& x, const Interval& y) {
  const EquationsOf<Interval> equations = equations_over(m, posture, variables_at(m, x, y), ends_of_guides(m));
  const std::size_t n = equations.unknowns;
  std::vector<std::vector<Interval>> rows(n, std::vector<Interval>(n + 1, Interval(x.bits())));
  for (const EntryOf<Interval>& entry : equations.matrix)
    rows[entry.row][entry.unknown] = rows[entry.row][entry.unknown] + entry.value;
  for (std::size_t i = 0; i < n; ++i) rows[i][n] = equations.right[i];
  Solution solution{{}, Interval(1.0, x.bits())};
  if (reduce(rows, n, solution.determinant).size() < n) return std::nullopt;
  for (const std::vector<Interval>& row : rows) solution.reactions.push_back(row[n]);
  for (const std::vector<EntryOf<Interval>>& end : equations.demands) {
    Interval sum(x.bits());
    for (const EntryOf<Interval>& entry : end) sum = sum + entry.value * solution.reactions[entry.unknown];
    solution.reactions.push_back(sum);
  }
  return solution;
}

}  // namespace clearloci::check
