#include "mechanism/redundancy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "mechanism/dependence.hpp"
#include "mechanism/idle.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/place_vectors.hpp"
#include "mechanism/posture_sample.hpp"

namespace clearloci::mechanism {
namespace {

using place_vectors::cross;
using place_vectors::distance;
using place_vectors::unit;
using place_vectors::Vector;
using Column = BorneReaction;

/// Two directions across u.
std::array<Vector, 2> across(const Vector& u) {
  const auto least =
      std::min_element(u.begin(), u.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) - u.begin();
  Vector other{};
  other[static_cast<std::size_t>(least)] = 1;
  const Vector first = unit(cross(u, other));
  return {first, cross(u, first)};
}

constexpr std::array<Vector, 3> xyz = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

void add_borne(const Mechanism& m, JointIndex index, const std::vector<Vector>& axes, std::vector<Column>& columns) {
  const Joint& joint = m.joints[static_cast<std::size_t>(index)];
  const JointTraits& joint_traits = traits(joint);
  const auto force = [&](const Vector& v) { columns.push_back({index, false, joint.from, joint.to, joint.at, v, {}}); };
  const auto couple = [&](const Vector& v) {
    columns.push_back({index, false, joint.from, joint.to, joint.at, {}, v});
  };
  if (is_cable(joint)) {
    if (joint.holds_turning && m.space == Space::spatial)
      for (const Vector& v : xyz) couple(v);
    else if (joint.holds_turning)
      couple(xyz[2]);
    return;
  }
  if (m.space == Space::planar) {
    if (is_guide(m, joint)) {
      force({-axes[0][1], axes[0][0], 0});
      couple(xyz[2]);
    } else if (is_slot(m, joint)) {
      force({-axes[0][1], axes[0][0], 0});
    } else if (joint_traits.meshes && axes.empty()) {
      couple(xyz[2]);
    } else if (joint_traits.meshes) {
      force(axes[0]);
    } else {
      force(xyz[0]);
      force(xyz[1]);
    }
    return;
  }
  if (joint_traits.slides)
    for (const Vector& v : across(axes[0])) force(v);
  else
    for (const Vector& v : xyz) force(v);
  if (holds_idle_freedom(joint))
    couple(axes[0]);
  else if (joint_traits.couple == BorneCouple::cross)
    couple(unit(cross(axes[0], axes[1])));
  else if (joint_traits.couple == BorneCouple::across_axis)
    for (const Vector& v : across(axes[0])) couple(v);
  else if (joint_traits.couple == BorneCouple::any)
    for (const Vector& v : xyz) couple(v);
}

}  // namespace

std::optional<std::vector<BorneReaction>> reactions_at(const Mechanism& m, const std::vector<double>& pose) {
  std::vector<Column> columns;
  for (std::size_t j = 0; j < m.joints.size(); ++j) {
    const Joint& joint = m.joints[j];
    std::vector<Vector> axes;
    for (const VectorExpression& written : joint.axes) {
      const auto axis = sample_vector(m, written, pose);
      if (!axis) return std::nullopt;
      axes.push_back(unit(*axis));
    }
    const auto index = static_cast<JointIndex>(j);
    add_borne(m, index, axes, columns);
    if (!joint.actuated || traits(joint).meshes) continue;
    const Vector along = axes.empty() ? xyz[2] : axes[0];
    if (actuator_quantity(joint) == core::Quantity::F)
      columns.push_back({index, true, joint.from, joint.to, joint.at, along, {}});
    else
      columns.push_back({index, true, joint.from, joint.to, joint.at, {}, along});
  }
  return columns;
}

Matrix balances_of(const Mechanism& m, const std::vector<BorneReaction>& columns, const std::vector<Vector>& places) {
  double size = 0;
  for (const Vector& p : places)
    for (const Vector& q : places) size = std::max(size, distance(p, q));
  if (!(size > 0)) size = 1;
  const std::size_t rows = equations_per_link(m);
  Matrix matrix(rows * m.links.size(), std::vector<double>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const Vector& at = places[static_cast<std::size_t>(columns[c].at)];
    Vector arm{};
    for (std::size_t i = 0; i < 3; ++i) arm[i] = (at[i] - places.front()[i]) / size;
    const Vector turned = cross(arm, columns[c].force);
    const auto add = [&](LinkIndex link, double sign) {
      if (link == ground) return;
      std::vector<double> all(columns[c].force.begin(), columns[c].force.end());
      for (std::size_t i = 0; i < 3; ++i) all.push_back(turned[i] + columns[c].couple[i]);
      if (rows == 3) all = {all[0], all[1], all[5]};
      for (std::size_t i = 0; i < rows; ++i) matrix[rows * static_cast<std::size_t>(link) + i][c] += sign * all[i];
    };
    add(columns[c].to, 1);
    add(columns[c].from, -1);
  }
  return matrix;
}

bool is_rod(const Mechanism& m, LinkIndex link) {
  if (link == m.end_effector_link || link == m.relative_to) return false;
  std::size_t pins = 0;
  for (const Joint& joint : m.joints) {
    if (joint.from != link && joint.to != link) continue;
    const bool turns_freely = m.space == Space::planar ? !traits(joint).slides
                                                       : traits(joint).couple == BorneCouple::none ||
                                                             traits(joint).couple == BorneCouple::cross;
    if (!turns_freely || joint.actuated || joint.effort) return false;
    ++pins;
  }
  return pins == 2;
}

namespace {

struct Dependent {
  std::set<JointIndex> motors, joints;
  std::set<LinkIndex> loose;
};

/// In one posture.
std::optional<Dependent> dependent_at(const Mechanism& m, const std::vector<double>& pose) {
  const auto columns = reactions_at(m, pose);
  if (!columns || columns->size() != unknowns(m).size()) return std::nullopt;
  std::vector<Vector> places;
  for (const auto& place : sample_points(m, pose)) {
    if (!place) return std::nullopt;
    places.push_back(*place);
  }
  const Matrix matrix = balances_of(m, *columns, places);
  Dependent found;
  for (const std::size_t c : dependence_of(matrix).columns)
    ((*columns)[c].motor ? found.motors : found.joints).insert((*columns)[c].joint);
  for (const std::size_t row : dependence_of(transposed(matrix)).columns)
    found.loose.insert(static_cast<LinkIndex>(row / equations_per_link(m)));
  return found;
}

std::string listed(std::vector<std::string> names) {
  constexpr std::size_t most = 10;
  std::string more;
  if (names.size() > most + 1) {
    more = " and " + std::to_string(names.size() - most) + " more";
    names.resize(most);
  }
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text + more;
}

/// "motor A1", "motors A1, A2".
std::string named(const std::string& what, const std::vector<std::string>& names) {
  return what + (names.size() == 1 ? " " : "s ") + listed(names);
}

const std::string general_excess = "remove joints or actuators, or add the missing links";

}  // namespace

std::optional<Redundancy> redundancy(const Mechanism& m) {
  // What depends on each other in all postures does in these: single ones may be singular.
  constexpr std::size_t poses = 256, enough = 3;
  std::optional<Dependent> all;
  std::size_t sampled = 0;
  const auto common = [](auto& first, const auto& second) {
    std::erase_if(first, [&](const auto& one) { return !second.contains(one); });
  };
  for (const std::vector<double>& pose : spread_poses(m, poses)) {
    const auto found = dependent_at(m, pose);
    if (!found) continue;
    if (all) {
      common(all->motors, found->motors);
      common(all->joints, found->joints);
      common(all->loose, found->loose);
    } else {
      all = found;
    }
    if (++sampled == enough) break;
  }
  if (!all) return std::nullopt;
  Redundancy result;
  const auto joint_name = [&](JointIndex j) { return m.joints[static_cast<std::size_t>(j)].name; };
  for (const JointIndex j : all->motors) result.motors.push_back(joint_name(j));
  for (const JointIndex j : all->joints) result.joints.push_back(joint_name(j));
  for (const LinkIndex link : all->loose) result.loose.push_back(m.links[static_cast<std::size_t>(link)].name);
  for (std::size_t l = 0; l < m.links.size(); ++l) {
    const auto link = static_cast<LinkIndex>(l);
    const bool braced = std::any_of(all->joints.begin(), all->joints.end(), [&](JointIndex j) {
      const Joint& joint = m.joints[static_cast<std::size_t>(j)];
      return joint.from == link || joint.to == link;
    });
    if (braced && is_rod(m, link)) result.rods.push_back(m.links[l].name);
  }
  return result;
}

Advice too_many(const Mechanism& m, std::size_t count) {
  const auto found = redundancy(m);
  if (!found || found->joints.size() + found->motors.size() == 0) return {"", general_excess};
  const std::string number = std::to_string(count) + " of ";
  if (found->motors.empty() && found->rods.empty())
    return {": joints " + listed(found->joints) + " work against each other",
            m.space == Space::spatial
                ? "use joints with more freedoms: spherical, universal or cylindrical instead of revolute or prismatic"
                : "leave out " + number + "the links between them, with one of its joints"};
  std::string problem, mend;
  if (!found->motors.empty()) {
    problem = named("motor", found->motors);
    mend = number +
           "these motors (actuated: false), or give as many a known effort (actuated: {effort: 0}), or one that is "
           "chosen for a task (actuated: {effort: free})";
  }
  if (!found->rods.empty()) {
    problem += (problem.empty() ? "" : " and ") + named("rod", found->rods);
    mend +=
        (mend.empty() ? number : ", or leave out ") + "these rods with their joints, or mark as many: redundant: true";
  }
  return {": " + problem + " work against each other", "leave out " + mend};
}

Advice too_few(const Mechanism& m) {
  const auto found = redundancy(m);
  const std::string general = "add joints or actuate more of them (actuated: true)";
  if (!found || found->loose.empty()) return {"", general};
  const bool one = found->loose.size() == 1;
  return {": " + named("link", found->loose) + (one ? " moves" : " move") + " although every motor stands still",
          std::string("actuate a joint of ") + (one ? "it" : "these") + " (actuated: true), or join " +
              (one ? "it" : "them") + " to more links"};
}

Advice misplaced(const Mechanism& m) {
  const auto found = redundancy(m);
  if (!found || found->loose.empty() || found->joints.size() + found->motors.size() == 0)
    return {"", "a part moves freely while another is over-constrained; check joints and actuators"};
  std::string braced = named("joint", found->joints);
  if (!found->motors.empty())
    braced = named("motor", found->motors);
  else if (!found->rods.empty())
    braced = named("rod", found->rods);
  return {": " + named("link", found->loose) + (found->loose.size() == 1 ? " moves" : " move") +
              " although every motor stands still, and " + braced + " work against each other",
          "actuate a joint of the former, and leave out one of the latter"};
}

}  // namespace clearloci::mechanism
