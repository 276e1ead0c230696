// Gears and belts of other programs' files: wheels that mesh, and joints that follow others in a constant ratio. What
// joins such joints is not said: here wheels about their pins, on the link that has both.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/errors.hpp"
#include "mechanism/import/common.hpp"

namespace clearloci::mechanism::imports {
namespace {

using core::InputError;

constexpr double near = 1e-6;  ///< of the source's size
constexpr long most_teeth = 1000, usual_teeth = 20;

/// Links that have a joint at a place.
std::set<int> links_at(const Source& source, const Vec& at, double size) {
  std::set<int> links;
  for (const SourceJoint& joint : source.joints)
    if (!joint.dropped && joint.kind == SourceKind::revolute && distance(joint.at(), at) <= near * size) {
      links.insert(joint.from);
      links.insert(joint.to);
    }
  return links;
}

/// A joint that follows, or leads: seen from the link that has both.
struct Side {
  int wheel = ground_link;
  Vec at{};
  double sense = 1;  ///< of its angle, about z
};

std::optional<Side> side_of(const SourceJoint& joint, int carrier) {
  if (joint.from != carrier && joint.to != carrier) return std::nullopt;
  const bool forward = joint.from == carrier;
  return Side{forward ? joint.to : joint.from, joint.at(), (forward ? 1.0 : -1.0) * (joint.axis()[2] < 0 ? -1 : 1)};
}

/// Both joints from a link that has both, at two places; nothing where none has.
std::optional<std::pair<Side, Side>> sides_of(const Source& source, const SourceJoint& joint,
                                              const SourceJoint& leader) {
  for (const int carrier : {joint.from, joint.to}) {
    const auto a = side_of(joint, carrier), b = side_of(leader, carrier);
    if (a && b && a->wheel != b->wheel && distance(a->at, b->at) > near * size_of(source)) return std::pair{*a, *b};
  }
  return std::nullopt;
}

[[noreturn]] void refuse(const Source& source, const SourceFollower& follower, const std::string& file) {
  const SourceJoint &joint = source.joints[follower.joint], &leader = source.joints[follower.leader];
  const bool shares = side_of(leader, joint.from).has_value() || side_of(leader, joint.to).has_value();
  std::string why = shares ? "but both turn about one axis" : "but no link has both of them";
  if (joint.kind != SourceKind::revolute || leader.kind != SourceKind::revolute)
    why = "but not both of them are pins";
  else if (!source.planar)
    why = "but the mechanism is not in one plane, and gears are planar here";
  throw InputError({file, follower.line}, "joint " + joint.name + " follows joint " + leader.name + ", " + why,
                   "write the linkage that makes it follow, or fix the joint");
}

/// Wheels of which the first turns by `ratio` of the second's joint, as the joints count.
SourceMesh mesh_of(const SourceJoint& joint, const std::pair<Side, Side>& sides, double of_leader, int line,
                   const std::string& file) {
  const auto& [a, b] = sides;
  const double ratio = of_leader * a.sense * b.sense;
  SourceMesh mesh;
  mesh.name = joint.name + "_follows";
  mesh.line = line;
  mesh.belt = std::abs(ratio - 1) < 1e-9;
  // Of a ring and its pinion the pinion, which turns faster, comes first.
  const bool swapped = ratio > 0 && ratio < 1 && !mesh.belt;
  const Side &first = swapped ? b : a, &second = swapped ? a : b;
  mesh.links = {first.wheel, second.wheel};
  mesh.at = {first.at, second.at};
  if (mesh.belt) return mesh;
  mesh.teeth = teeth_of(1, std::abs(swapped ? 1 / ratio : ratio), "joint " + joint.name, file, line);
  if (ratio > 0) mesh.teeth[1] = -mesh.teeth[1];
  return mesh;
}

/// Joints that follow one of them, by way of others or not, and by how much.
struct Followers {
  std::map<std::size_t, double> turns;  ///< of those that are meshed already, the leader's being 1
  std::vector<std::pair<SourceFollower, double>> left;
};

std::map<std::size_t, Followers> by_leaders(const Source& source) {
  std::map<std::size_t, SourceFollower> followers;
  for (const SourceFollower& follower : source.followers) followers.emplace(follower.joint, follower);
  std::map<std::size_t, Followers> all;
  for (const auto& [joint, follower] : followers) {
    double ratio = follower.ratio;
    std::size_t leader = follower.leader;
    for (std::size_t depth = 0; followers.contains(leader) && depth < followers.size(); ++depth) {
      ratio *= followers.at(leader).ratio;
      leader = followers.at(leader).leader;
    }
    all[leader].turns = {{leader, 1}};
    all[leader].left.emplace_back(follower, ratio);
  }
  return all;
}

/// Meshes one joint with one that is meshed already, its own leader or another one of the same; false where none can
/// be.
bool mesh_one(Source& source, Followers& followers, const std::string& file) {
  for (auto next = followers.left.begin(); next != followers.left.end(); ++next) {
    const SourceJoint& joint = source.joints[next->first.joint];
    std::vector<std::size_t> leaders;
    if (followers.turns.contains(next->first.leader)) leaders.push_back(next->first.leader);
    for (const auto& other : followers.turns) leaders.push_back(other.first);
    for (const std::size_t leader : leaders) {
      const SourceJoint& to = source.joints[leader];
      const bool pins = joint.kind == SourceKind::revolute && to.kind == SourceKind::revolute;
      const auto sides = pins && source.planar ? sides_of(source, joint, to) : std::nullopt;
      if (!sides) continue;
      source.meshes.push_back(
          mesh_of(joint, *sides, next->second / followers.turns.at(leader), next->first.line, file));
      const SourceMesh& mesh = source.meshes.back();
      source.note("joint " + joint.name + " follows joint " + to.name + ": " +
                  (mesh.belt           ? "a belt"
                   : mesh.teeth[1] < 0 ? "a gear in a ring"
                                       : "a pair of gears") +
                  " stands for what joins " + link_words(source, mesh.links[0]) + " and " +
                  link_words(source, mesh.links[1]));
      followers.turns.emplace(next->first.joint, next->second);
      followers.left.erase(next);
      return true;
    }
  }
  return false;
}

}  // namespace

std::optional<int> carrier_of(const Source& source, const SourceMesh& mesh) {
  const double size = size_of(source);
  const std::set<int> first = links_at(source, mesh.at[0], size), second = links_at(source, mesh.at[1], size);
  for (const int link : first)
    if (second.contains(link) && link != mesh.links[0] && link != mesh.links[1]) return link;
  return std::nullopt;
}

std::array<long, 2> teeth_of(double first, double second, const std::string& what, const std::string& file, int line) {
  constexpr double digits = 1e-6;  // of a ratio that is written with six digits
  const double ratio = second / first;
  if (ratio > 0 && std::isfinite(ratio))
    for (long below = 1; below < most_teeth; ++below) {
      const double above = std::round(ratio * static_cast<double>(below));
      if (above < 1 || above > static_cast<double>(most_teeth)) continue;
      if (std::abs(above / static_cast<double>(below) - ratio) > digits * ratio) continue;
      const long other = std::lround(above),
                 factor = (usual_teeth + std::min(below, other) - 1) / std::min(below, other);
      return {below * factor, other * factor};
    }
  throw InputError({file, line},
                   "the ratio of " + what + ", " + shortest_decimal(ratio, 1e-9 * std::abs(ratio)) +
                       ", is not that of two whole numbers below 1000",
                   "write it as one of two numbers of teeth");
}

void mesh_followers(Source& source, const std::string& file) {
  std::erase_if(source.followers, [&](const SourceFollower& follower) {
    const SourceJoint &joint = source.joints[follower.joint], &leader = source.joints[follower.leader];
    if (joint.dropped != leader.dropped)
      throw InputError({file, follower.line},
                       "joint " + joint.name + " follows joint " + leader.name + ", but one of them does not move",
                       "fix both joints, or none");
    return joint.dropped;
  });
  for (auto& [leader, leaders] : by_leaders(source)) {
    while (mesh_one(source, leaders, file)) {
    }
    if (!leaders.left.empty()) refuse(source, leaders.left.front().first, file);
  }
}

void check_meshes(const Source& source, const std::string& file) {
  for (const SourceMesh& mesh : source.meshes) {
    const auto fault = [&](const std::string& problem, const std::string& mend) {
      throw InputError({file, mesh.line}, mesh.name + " joins " + problem, mend);
    };
    const std::string wheels = link_words(source, mesh.links[0]) + " and " + link_words(source, mesh.links[1]);
    if (mesh.links[0] == mesh.links[1])
      fault("wheels of one link, " + link_words(source, mesh.links[0]), "take it out");
    if (!source.planar) fault(wheels + ", which are not in one plane", "take it out, and close the loop otherwise");
    if (!carrier_of(source, mesh))
      fault(wheels + ", but nothing has both of their centres", "pin both wheels to the ground or to one link");
  }
}

}  // namespace clearloci::mechanism::imports
