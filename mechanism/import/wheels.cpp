// Gears and belts of other programs' files: wheels that mesh, and joints that follow others in a constant ratio. What
// joins such joints is not said: here wheels about their pins, on the link that has both.
#include <algorithm>
#include <cmath>
#include <numeric>
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

class Follower {
 public:
  Follower(const Source& source, const SourceFollower& own, const std::string& file)
      : source_(source), own_(own), file_(file), joint_(source.joints[own.joint]), leader_(source.joints[own.leader]) {}

  SourceMesh mesh() const {
    const std::string mend = "write the linkage that makes it follow, or fix the joint";
    if (joint_.kind != SourceKind::revolute || leader_.kind != SourceKind::revolute)
      refuse("but not both of them are pins", mend);
    if (!source_.planar) refuse("but the mechanism is not in one plane, and gears are planar here", mend);
    for (const int carrier : {joint_.from, joint_.to}) {
      const auto a = side_of(joint_, carrier), b = side_of(leader_, carrier);
      if (!a || !b) continue;
      if (a->wheel == b->wheel || distance(a->at, b->at) <= near * size_of(source_))
        refuse("but both turn about one axis", mend);
      return of(*a, *b);
    }
    refuse("but no link has both of them", mend);
  }

 private:
  [[noreturn]] void refuse(const std::string& problem, const std::string& mend) const {
    throw InputError({file_, own_.line}, "joint " + joint_.name + " follows joint " + leader_.name + ", " + problem,
                     mend);
  }

  /// turn of a = ratio of b, about z.
  SourceMesh of(const Side& a, const Side& b) const {
    const double ratio = own_.ratio * a.sense * b.sense;
    SourceMesh mesh;
    mesh.name = joint_.name + "_follows";
    mesh.line = own_.line;
    mesh.belt = std::abs(ratio - 1) < 1e-9;
    // Of a ring and its pinion the pinion, which turns faster, comes first.
    const bool swapped = ratio > 0 && ratio < 1 && !mesh.belt;
    const Side &first = swapped ? b : a, &second = swapped ? a : b;
    mesh.links = {first.wheel, second.wheel};
    mesh.at = {first.at, second.at};
    if (mesh.belt) return mesh;
    const double size = std::abs(swapped ? 1 / ratio : ratio);
    mesh.teeth = teeth_of(1, size, "joint " + joint_.name, file_, own_.line);
    if (ratio > 0) mesh.teeth[1] = -mesh.teeth[1];
    return mesh;
  }

  const Source& source_;
  const SourceFollower& own_;
  const std::string& file_;
  const SourceJoint &joint_, &leader_;
};

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
  for (const SourceFollower& own : source.followers) {
    const SourceJoint &joint = source.joints[own.joint], &leader = source.joints[own.leader];
    if (joint.dropped && leader.dropped) continue;
    if (joint.dropped || leader.dropped)
      throw InputError({file, own.line},
                       "joint " + joint.name + " follows joint " + leader.name + ", but one of them does not move",
                       "fix both joints, or none");
    source.meshes.push_back(Follower(source, own, file).mesh());
    const SourceMesh& mesh = source.meshes.back();
    source.note("joint " + joint.name + " follows joint " + leader.name + ": " +
                (mesh.belt           ? "a belt"
                 : mesh.teeth[1] < 0 ? "a gear in a ring"
                                     : "a pair of gears") +
                " stands for what joins " + link_words(source, mesh.links[0]) + " and " +
                link_words(source, mesh.links[1]));
  }
}

void check_meshes(const Source& source, const std::string& file) {
  for (const SourceMesh& mesh : source.meshes) {
    const auto refuse = [&](const std::string& problem, const std::string& mend) {
      throw InputError({file, mesh.line}, mesh.name + " joins " + problem, mend);
    };
    const std::string wheels = link_words(source, mesh.links[0]) + " and " + link_words(source, mesh.links[1]);
    if (mesh.links[0] == mesh.links[1])
      refuse("wheels of one link, " + link_words(source, mesh.links[0]), "take it out");
    if (!source.planar) refuse(wheels + ", which are not in one plane", "take it out, and close the loop otherwise");
    if (!carrier_of(source, mesh))
      refuse(wheels + ", but nothing has both of their centres", "pin both wheels to the ground or to one link");
  }
}

}  // namespace clearloci::mechanism::imports
