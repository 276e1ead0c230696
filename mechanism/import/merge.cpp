// Links that are one: welded, pinned together twice, or braced by a triangle of pins.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>

#include "mechanism/import/common.hpp"

namespace clearloci::mechanism::imports {
namespace {

/// Of the source's size: places and axes so near are meant to be one.
constexpr double near = 1e-6;
constexpr double parallel = 1e-6;

bool is_pin(const SourceJoint& j) { return !j.dropped && j.kind == SourceKind::revolute; }
bool is_ball(const SourceJoint& j) { return !j.dropped && j.kind == SourceKind::spherical; }
bool join_the_same(const SourceJoint& a, const SourceJoint& b) {
  return std::minmax(a.from, a.to) == std::minmax(b.from, b.to);
}

/// A link without a centre of mass has it in the middle of its first two joints.
void give_centre(Source& source, int link) {
  SourceLink& source_link = source.links[static_cast<std::size_t>(link)];
  if (source_link.centre || !(source_link.mass > 0)) return;
  std::vector<Vec> places;
  for (const SourceJoint& joint : source.joints)
    if (!joint.dropped && (joint.from == link || joint.to == link)) places.push_back(joint.at());
  if (places.empty()) return;
  source_link.centre = places.size() == 1 ? places[0] : 0.5 * (places[0] + places[1]);
}

void add_mass(Source& source, int into, int from) {
  give_centre(source, into);
  give_centre(source, from);
  SourceLink& a = source.links[static_cast<std::size_t>(into)];
  const SourceLink& b = source.links[static_cast<std::size_t>(from)];
  if (!(b.mass > 0)) return;
  const double mass = a.mass + b.mass, metres = source.metres();
  const Vec at_a = a.centre.value_or(Vec{}), at_b = b.centre.value_or(Vec{});
  const Vec centre = (1 / mass) * (a.mass * at_a + b.mass * at_b);
  if (a.inertia || b.inertia)
    a.inertia = a.inertia.value_or(Tensor{}) + b.inertia.value_or(Tensor{}) +
                point_inertia(a.mass, metres * (at_a - centre)) + point_inertia(b.mass, metres * (at_b - centre));
  a.mass = mass;
  a.centre = centre;
}

}  // namespace

std::string enumerated(const std::vector<std::string>& names) {
  constexpr std::size_t most = 8;
  std::string text;
  const std::size_t shown = std::min(names.size(), names.size() > most + 1 ? most : most + 1);
  for (std::size_t i = 0; i < shown; ++i) text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  if (shown < names.size()) text += " and " + std::to_string(names.size() - shown) + " more";
  return text;
}

std::string link_words(const Source& source, int link) {
  return link == ground_link ? "the ground" : "link " + source.links[static_cast<std::size_t>(link)].name;
}

void merge_links(Source& source, int into, int from) {
  if (into == from || from == ground_link) return;
  if (into != ground_link) add_mass(source, into, from);
  for (SourceJoint& joint : source.joints) {
    if (joint.from == from) joint.from = into;
    if (joint.to == from) joint.to = into;
    if (joint.from == joint.to) joint.dropped = true;
  }
  for (SourcePoint& point : source.points)
    if (point.link == from) point.link = into;
  for (SourceLoad& load : source.loads)
    if (load.link == from) load.link = into;
  for (SourceSpring& spring : source.springs)
    for (int& link : spring.links)
      if (link == from) link = into;
  for (SourceMesh& mesh : source.meshes)
    for (int& link : mesh.links)
      if (link == from) link = into;
  source.links[static_cast<std::size_t>(from)].dropped = true;
}

void merge_welds(Source& source) {
  std::vector<std::string> names;
  const double size = std::max(size_of(source), 1e-300);
  for (std::size_t i = 0; i < source.joints.size(); ++i) {
    const SourceJoint joint = source.joints[i];
    if (joint.dropped || joint.kind != SourceKind::fixed) continue;
    const bool meets = distance(joint.on_from.at, joint.on_to.at) <= near * size &&
                       distance(joint.on_from.frame.x, joint.on_to.frame.x) <= parallel &&
                       distance(joint.on_from.frame.z, joint.on_to.frame.z) <= parallel;
    if (!meets) continue;
    source.joints[i].dropped = true;
    if (joint.from == joint.to) continue;
    const bool grounded = joint.to == ground_link;
    const int into = grounded ? ground_link : joint.from, gone = grounded ? joint.from : joint.to;
    names.push_back(link_words(source, gone) + " (to " + link_words(source, into) + ")");
    merge_links(source, into, gone);
  }
  if (!names.empty()) source.note("welded: " + enumerated(names));
}

namespace {

double from_line(const Vec& point, const Vec& on, const Vec& axis) { return norm(cross(axis, point - on)); }

/// What two joints between the same two links are together. True where something changed.
bool join_pair(Source& source, std::size_t i, std::size_t j, double size) {
  SourceJoint &a = source.joints[i], &b = source.joints[j];
  const auto words = [&](const SourceJoint& joint) {
    return link_words(source, joint.from) + " and " + link_words(source, joint.to);
  };
  const auto weld = [&](const std::string& why) {
    const int from = a.from, to = a.to;
    source.note(words(a) + " are one: " + why);
    a.dropped = b.dropped = true;
    if (to == ground_link)
      merge_links(source, ground_link, from);
    else
      merge_links(source, from, to);
    return true;
  };
  const auto drop = [&](const std::string& why) {
    source.note(why);
    a.actuated = a.actuated || b.actuated;
    if (!a.range) a.range = b.range;
    if (!a.speed) a.speed = b.speed;
    b.dropped = true;
    return true;
  };
  if (is_pin(a) && is_pin(b)) {
    if (norm(cross(a.axis(), b.axis())) > parallel) return weld("pins " + a.name + " and " + b.name + " cross");
    if (from_line(b.at(), a.at(), a.axis()) > near * size)
      return weld("two pins, " + a.name + " and " + b.name + ", join them");
    return drop("pin " + b.name + " doubles " + a.name + " and was left out");
  }
  if (is_ball(a) && is_ball(b)) {
    const Vec way = b.at() - a.at();
    if (norm(way) <= near * size) return drop("ball " + b.name + " doubles " + a.name + " and was left out");
    source.note("balls " + a.name + " and " + b.name + " between " + words(a) + " are one pin");
    place(a, a.at(), way);
    a.kind = SourceKind::revolute;
    b.dropped = true;
    return true;
  }
  if ((is_pin(a) && is_ball(b)) || (is_ball(a) && is_pin(b))) {
    const SourceJoint &pin = is_pin(a) ? a : b, &ball = is_pin(a) ? b : a;
    if (from_line(ball.at(), pin.at(), pin.axis()) > near * size)
      return weld("pin " + pin.name + " and ball " + ball.name + " join them");
    if (is_ball(a)) std::swap(a, b);
    return drop("ball " + b.name + " is on the axis of pin " + a.name + " and was left out");
  }
  if (!a.dropped && !b.dropped && a.kind == SourceKind::prismatic && b.kind == SourceKind::prismatic) {
    if (norm(cross(a.axis(), b.axis())) > parallel) return weld("guides " + a.name + " and " + b.name + " cross");
    return drop("guide " + b.name + " doubles " + a.name + " and was left out");
  }
  return false;
}

/// Where pins of one axis meet: all links there are pinned to each other, however the joints pair them.
struct Meeting {
  Vec at{}, axis{};
  std::set<int> links;
  std::string name;
};

std::vector<Meeting> meetings(const Source& source, double size) {
  std::vector<Meeting> found;
  for (const SourceJoint& joint : source.joints) {
    if (!is_pin(joint)) continue;
    Meeting meeting{joint.at(), joint.axis(), {joint.from, joint.to}, joint.name};
    for (auto other = found.begin(); other != found.end();) {
      const bool shares =
          std::any_of(other->links.begin(), other->links.end(), [&](int l) { return meeting.links.contains(l); });
      if (shares && norm(cross(other->axis, meeting.axis)) <= parallel &&
          norm(cross(meeting.axis, other->at - meeting.at)) <= near * size) {
        meeting.links.insert(other->links.begin(), other->links.end());
        meeting.name = other->name;
        meeting.at = other->at;
        other = found.erase(other);
      } else {
        ++other;
      }
    }
    found.push_back(std::move(meeting));
  }
  return found;
}

void merge_all(Source& source, const std::set<int>& links) {
  int into = *links.begin();  // the ground where it is among them: -1
  for (const int link : links) merge_links(source, into, link);
}

/// Links with two pins in common, or a triangle of pins. True where something changed.
bool join_braced(Source& source, double size) {
  const std::vector<Meeting> all = meetings(source, size);
  const std::size_t n = all.size();
  std::vector<std::vector<int>> common(n, std::vector<int>(n, ground_link - 1));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (norm(cross(all[i].axis, all[j].axis)) > parallel) continue;
      std::vector<int> shared;
      std::set_intersection(all[i].links.begin(), all[i].links.end(), all[j].links.begin(), all[j].links.end(),
                            std::back_inserter(shared));
      if (shared.size() > 1) {
        source.note(link_words(source, shared[0]) + " and " + link_words(source, shared[1]) + " are one: two pins, " +
                    all[j].name + " and " + all[i].name + ", join them");
        merge_all(source, {shared[0], shared[1]});
        return true;
      }
      if (!shared.empty()) common[i][j] = common[j][i] = shared.front();
    }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (common[i][j] < ground_link) continue;
      for (std::size_t k = 0; k < j; ++k) {
        if (common[i][k] < ground_link || common[j][k] < ground_link) continue;
        const std::set<int> links = {common[i][j], common[i][k], common[j][k]};
        const Vec area = cross(all[j].at - all[i].at, all[k].at - all[i].at);
        if (links.size() < 3 || std::abs(dot(area, all[i].axis)) <= near * size * size) continue;
        std::vector<std::string> names;
        for (const int link : links) names.push_back(link_words(source, link));
        source.note(enumerated(names) + " are one: pins " + enumerated({all[k].name, all[j].name, all[i].name}) +
                    " brace them");
        merge_all(source, links);
        return true;
      }
    }
  return false;
}

/// A wheel, or a link of a joint that follows or leads another one.
bool is_meshed(const Source& source, int link) {
  const auto joins = [&](std::size_t joint) {
    return source.joints[joint].from == link || source.joints[joint].to == link;
  };
  return std::any_of(source.meshes.begin(), source.meshes.end(),
                     [&](const SourceMesh& mesh) { return mesh.links[0] == link || mesh.links[1] == link; }) ||
         std::any_of(source.followers.begin(), source.followers.end(),
                     [&](const SourceFollower& follower) { return joins(follower.joint) || joins(follower.leader); });
}

/// A link between two pins of one axis that has nothing else, such as a bush: its own turn changes nothing, and it is
/// fixed to one of its neighbours. True where there was one.
bool join_idle(Source& source, double size) {
  for (std::size_t l = 0; l < source.links.size(); ++l) {
    const int link = static_cast<int>(l);
    const auto on_it = [&](const auto& candidate) { return candidate.link == link; };
    std::vector<const SourceJoint*> joints;
    for (const SourceJoint& joint : source.joints)
      if (!joint.dropped && (joint.from == link || joint.to == link)) joints.push_back(&joint);
    if (joints.size() != 2 || !is_pin(*joints[0]) || !is_pin(*joints[1])) continue;
    const SourceJoint &a = *joints[0], &b = *joints[1];
    const std::optional<Vec>& centre = source.links[l].centre;
    const bool on_axis = norm(cross(a.axis(), b.axis())) <= parallel &&
                         from_line(b.at(), a.at(), a.axis()) <= near * size &&
                         (!centre || from_line(*centre, a.at(), a.axis()) <= near * size);
    const bool borne = std::any_of(source.loads.begin(), source.loads.end(), on_it) ||
                       std::any_of(source.points.begin(), source.points.end(), on_it) ||
                       std::any_of(source.springs.begin(), source.springs.end(), [&](const SourceSpring& spring) {
                         return spring.links[0] == link || spring.links[1] == link;
                       });
    if (!on_axis || borne || is_meshed(source, link) || (a.actuated && b.actuated)) continue;
    const SourceJoint& gone = a.actuated ? b : a;
    const int into = gone.from == link ? gone.to : gone.from;
    source.note(link_words(source, link) + " turns idly between pins " + a.name + " and " + b.name +
                " and was fixed to " + link_words(source, into));
    merge_links(source, into, link);
    return true;
  }
  return false;
}

}  // namespace

void merge_rigid(Source& source) {
  const double size = std::max(size_of(source), 1e-300);
  bool changed = true;
  while (changed) {
    changed = false;
    for (std::size_t i = 0; i < source.joints.size() && !changed; ++i)
      for (std::size_t j = i + 1; j < source.joints.size() && !changed; ++j)
        if (!source.joints[i].dropped && !source.joints[j].dropped && join_the_same(source.joints[i], source.joints[j]))
          changed = join_pair(source, i, j, size);
    if (!changed) changed = join_braced(source, size) || join_idle(source, size);
  }
}

}  // namespace clearloci::mechanism::imports
