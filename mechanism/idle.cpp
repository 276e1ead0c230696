#include "mechanism/idle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>
#include <variant>

#include "core/errors.hpp"
#include "core/parts.hpp"
#include "mechanism/actions.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/spring_ends.hpp"

namespace clearloci::mechanism {
namespace {

/// Links that only two balls join to the rest.
struct Hanging {
  std::vector<LinkIndex> links;
  std::size_t first = 0, second = 0;  ///< the balls, by their places among the joints
};

bool holds(const std::vector<LinkIndex>& links, LinkIndex link) {
  return std::find(links.begin(), links.end(), link) != links.end();
}

/// A ball, also one that holds an idle freedom already.
bool is_ball(const Joint& joint) { return joint.type == JointType::spherical || holds_idle_freedom(joint); }

/// Groups of links that anything but a ball joins, without those on the ground.
std::vector<std::vector<LinkIndex>> groups_between_balls(const Mechanism& m) {
  const auto ground_place = static_cast<LinkIndex>(m.links.size());
  core::Parts parts(m.links.size() + 1);
  const auto place = [&](LinkIndex link) { return link == ground ? ground_place : link; };
  for (const Joint& joint : m.joints)
    if (!is_ball(joint)) parts.join(place(joint.to), place(joint.from));
  std::vector<std::vector<LinkIndex>> groups(m.links.size() + 1);
  for (LinkIndex i = 0; i < ground_place; ++i)
    if (parts.of(i) != parts.of(ground_place)) groups[static_cast<std::size_t>(parts.of(i))].push_back(i);
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  return groups;
}

std::vector<Hanging> hanging_on_two_balls(const Mechanism& m) {
  std::vector<Hanging> all;
  for (std::vector<LinkIndex>& group : groups_between_balls(m)) {
    if (holds(group, m.end_effector_link) || holds(group, m.relative_to)) continue;
    std::vector<std::size_t> balls;
    for (std::size_t j = 0; j < m.joints.size(); ++j) {
      const Joint& joint = m.joints[j];
      if (is_ball(joint) && holds(group, joint.from) != holds(group, joint.to)) balls.push_back(j);
    }
    if (balls.size() == 2 && m.joints[balls[0]].at != m.joints[balls[1]].at)
      all.push_back({std::move(group), balls[0], balls[1]});
  }
  return all;
}

std::string line_name(const Mechanism& m, PointIndex a, PointIndex b) {
  return m.points[static_cast<std::size_t>(a)].name + "-" + m.points[static_cast<std::size_t>(b)].name;
}

/// Whether a point is on the line through two others: as it is built or, where that does not tell, in every posture of
/// a sample.
class OnLine {
 public:
  explicit OnLine(const Mechanism& m) : m_(m), postures_(sample_postures(m, 12)) {}

  /// Nothing where the mechanism closes in no pose of the sample.
  std::optional<bool> holds(PointIndex point, PointIndex a, PointIndex b) const {
    if (is_built_on(point, a, b)) return true;
    if (postures_.empty()) return std::nullopt;
    constexpr double rounding = 1e-9;  // of the line's length
    const auto at = [](const PosturePoints& posture, PointIndex p) { return posture[static_cast<std::size_t>(p)]; };
    return std::all_of(postures_.begin(), postures_.end(), [&](const PosturePoints& posture) {
      const auto p = at(posture, a), q = at(posture, b), x = at(posture, point);
      std::array<double, 3> u{}, v{};
      for (std::size_t c = 0; c < 3; ++c) {
        u[c] = q[c] - p[c];
        v[c] = x[c] - p[c];
      }
      const double across = std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
      const double length2 = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
      return across <= rounding * length2;
    });
  }

 private:
  bool is_built_on(PointIndex point, PointIndex a, PointIndex b) const {
    if (point == a || point == b) return true;
    const PointForm& form = m_.points[static_cast<std::size_t>(point)].form;
    if (const auto* mean = std::get_if<MeanPoint>(&form))
      return is_built_on(mean->first, a, b) && is_built_on(mean->second, a, b);
    if (const auto* offset = std::get_if<OffsetPoint>(&form))
      return is_built_on(offset->first, a, b) && is_built_on(offset->second, a, b);
    if (const auto* shifted = std::get_if<ShiftedPoint>(&form))
      return is_built_on(shifted->from, a, b) && weight_on(shifted->by, a, b) == 0;
    return false;
  }

  /// Of a sum of points of the line how many they are, less those that are taken off: 0 of a way along the line.
  std::optional<int> weight_on(const VectorExpression& v, PointIndex a, PointIndex b) const {
    using Kind = VectorExpression::Kind;
    const auto argument = [&](std::size_t i) { return weight_on(v.arguments[i], a, b); };
    switch (v.kind) {
      case Kind::point:
        return is_built_on(v.point, a, b) ? std::optional(1) : std::nullopt;
      case Kind::add: {
        const auto first = argument(0), second = argument(1);
        return first && second ? std::optional(*first + *second) : std::nullopt;
      }
      case Kind::negate: {
        const auto weight = argument(0);
        return weight ? std::optional(-*weight) : std::nullopt;
      }
      case Kind::scale:
        return argument(0) == 0 ? std::optional(0) : std::nullopt;
      case Kind::components:
      case Kind::cross:
        break;
    }
    return std::nullopt;
  }

  const Mechanism& m_;
  std::vector<PosturePoints> postures_;
};

std::string what_turns(const Mechanism& m, const Hanging& hanging, const std::string& what) {
  const std::string link = m.links[static_cast<std::size_t>(hanging.links.front())].name;
  return what + " turns link " + link + " about the line " +
         line_name(m, m.joints[hanging.first].at, m.joints[hanging.second].at) +
         ", about which it spins between its two balls";
}

[[noreturn]] void refuse(const Mechanism& m, const Hanging& hanging, const core::SourcePosition& where,
                         const std::string& what) {
  throw core::InputError(where, what_turns(m, hanging, what),
                         "let it act on that line, or make one of the balls a universal joint");
}

void require_on_line(const Mechanism& m, const Hanging& hanging, const OnLine& on_line, PointIndex point,
                     const core::SourcePosition& where, const std::string& what) {
  const auto held = on_line.holds(point, m.joints[hanging.first].at, m.joints[hanging.second].at);
  if (!held)
    throw core::InputError(where,
                           "the mechanism closes in no pose that was tried, so that it is not known whether " +
                               what_turns(m, hanging, what),
                           "give a workspace in which it closes, or write " +
                               m.points[static_cast<std::size_t>(point)].name + " as a point of that line");
  if (!*held) refuse(m, hanging, where, what);
}

void require_balance(const Mechanism& m, const Hanging& hanging, const OnLine& on_line) {
  for (std::size_t i = 0; i < m.loads.size(); ++i) {
    const Load& load = m.loads[i];
    if (!holds(hanging.links, load.link)) continue;
    const std::string name = "load " + std::to_string(i + 1);
    if (std::any_of(load.couple_vector.begin(), load.couple_vector.end(),
                    [](const Expression& e) { return !e.is_zero_literal(); }))
      refuse(m, hanging, load.where, name);
    if (load.at && load.has_force()) require_on_line(m, hanging, on_line, *load.at, load.where, name);
  }
  for (const Mass& mass : masses(m))
    if (!m.gravity.empty() && holds(hanging.links, mass.link))
      require_on_line(m, hanging, on_line, mass.at, m.links[static_cast<std::size_t>(mass.link)].where, "its weight");
  for (const Spring& spring : m.springs)
    for (const auto& [link, other, point] :
         {std::tuple(spring.from, spring.to, spring.from_point), std::tuple(spring.to, spring.from, spring.to_point)})
      if (holds(hanging.links, link) && !holds(hanging.links, other)) {
        if (spring.kind == Spring::Kind::torsion) refuse(m, hanging, spring.where, "spring " + spring.name);
        require_on_line(m, hanging, on_line, point, spring.where, "spring " + spring.name);
      }
}

}  // namespace

void hold_idle_freedoms(Mechanism& m) {
  if (m.space != Space::spatial) return;
  const std::vector<Hanging> all = hanging_on_two_balls(m);
  if (all.empty()) return;
  const OnLine on_line(m);
  for (const Hanging& hanging : all) {
    require_balance(m, hanging, on_line);
    // The line moves: the ball that holds it is not one of the ground's, if there is another.
    const Joint& first = m.joints[hanging.first];
    const bool grounded = first.from == ground || first.to == ground;
    Joint& held = m.joints[grounded ? hanging.second : hanging.first];
    held.axes = {way(m.joints[hanging.first].at, m.joints[hanging.second].at)};
    held.type = JointType::universal;
  }
}

bool turns_idly(const Mechanism& m, LinkIndex link) {
  if (std::any_of(m.joints.begin(), m.joints.end(),
                  [&](const Joint& joint) { return joint.holds_turning && (joint.from == link || joint.to == link); }))
    return true;
  const std::vector<Hanging> all = hanging_on_two_balls(m);
  return std::any_of(all.begin(), all.end(), [&](const Hanging& hanging) {
    return holds(hanging.links, link) &&
           (holds_idle_freedom(m.joints[hanging.first]) || holds_idle_freedom(m.joints[hanging.second]));
  });
}

std::vector<std::string> idle_notes(const Mechanism& m) {
  std::string lines, balls;
  // Not by the axis that was put in: in another frame it is written in coordinates.
  for (const Hanging& hanging : hanging_on_two_balls(m))
    for (const std::size_t ball : {hanging.first, hanging.second}) {
      if (!holds_idle_freedom(m.joints[ball])) continue;
      lines += (lines.empty() ? "" : ", ") + line_name(m, m.joints[hanging.first].at, m.joints[hanging.second].at);
      balls += (balls.empty() ? "" : ", ") + m.joints[ball].name;
    }
  std::vector<std::string> notes = notes_of_spring_ends(m);
  if (!lines.empty())
    notes.insert(notes.begin(), "links between two ball joints may rotate about the line through these (" + lines +
                                    "); no result depends on this rotation, which is locked at " + balls);
  return notes;
}

}  // namespace clearloci::mechanism
