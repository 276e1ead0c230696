// The posture in which all joints of a source meet (joint_constraints.hpp). Levenberg-Marquardt finds the zero nearest
// to the posture of the file: (JᵀJ + λ) d = -Jᵀ r.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

#include "core/errors.hpp"
#include "mechanism/import/joint_constraints.hpp"

namespace clearloci::mechanism::imports {
namespace {

constexpr double digits_of_ratios = 3e-3;  ///< rad: what lengths of three digits leave
constexpr double met = 1e-11;  ///< residual, in sizes of the source and in rad: joints meet to double precision

double squares(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

/// The angles of pins that follow others, in the posture of the source: they keep their ratios from there on.
class Ratios {
 public:
  Ratios() = default;
  explicit Ratios(const Source& source) {
    for (const SourceFollower& follower : source.followers) {
      const SourceJoint &joint = source.joints[follower.joint], &leader = source.joints[follower.leader];
      const bool pins = joint.kind == SourceKind::revolute && leader.kind == SourceKind::revolute;
      if (!pins || joint.dropped || leader.dropped) continue;
      followers_.push_back(follower);
      start_.push_back({joint, leader});
    }
  }

  /// How far each is from where it follows, rad.
  std::vector<double> values(const Source& source) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < followers_.size(); ++i) {
      const SourceFollower& follower = followers_[i];
      const double off = way_between(start_[i][0], source.joints[follower.joint]) -
                         follower.ratio * way_between(start_[i][1], source.joints[follower.leader]);
      values.push_back(std::remainder(off, 2 * std::numbers::pi));
    }
    return values;
  }
  void add(const Source& source, std::vector<double>& all, Rows* rows) const {
    const std::vector<double> more = values(source);
    all.insert(all.end(), more.begin(), more.end());
    for (std::size_t i = 0; rows != nullptr && i < followers_.size(); ++i) {
      std::vector<double> row = motor_row(source, source.joints[followers_[i].joint]);
      const std::vector<double> of_leader = motor_row(source, source.joints[followers_[i].leader]);
      for (std::size_t c = 0; c < row.size(); ++c) row[c] -= followers_[i].ratio * of_leader[c];
      rows->push_back(std::move(row));
    }
  }
  const std::vector<SourceFollower>& followers() const { return followers_; }

 private:
  std::vector<SourceFollower> followers_;
  std::vector<std::array<SourceJoint, 2>> start_;  ///< of each the joint and its leader in the posture of the source
};

std::vector<double> values_of(const Source& source, const Ratios& ratios) {
  const Constraints constraints(source);
  std::vector<double> values;
  for (const SourceJoint& joint : source.joints)
    if (!joint.dropped) constraints.add(joint, values, nullptr);
  ratios.add(source, values, nullptr);
  return values;
}

/// Cholesky of a symmetric positive matrix, in place; false where it is not.
bool solve(Rows& a, std::vector<double>& b) {
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
      if (i != j) {
        a[i][j] = sum / a[j][j];
      } else {
        if (!(sum > 0)) return false;
        a[i][i] = std::sqrt(sum);
      }
    }
    double sum = b[i];
    for (std::size_t k = 0; k < i; ++k) sum -= a[i][k] * b[k];
    b[i] = sum / a[i][i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k][i] * b[k];
    b[i] /= a[i][i];
  }
  return true;
}

Source moved_by(const Source& source, const Constraints& constraints, const std::vector<double>& step) {
  Source moved = source;
  const double size = 1 / constraints.scale();
  for (std::size_t l = 0; l < source.links.size(); ++l) {
    if (source.links[l].dropped) continue;
    const double* d = &step[freedoms * l];
    const Vec angles = {d[3], d[4], d[5]};
    const double angle = norm(angles);
    move_link(moved, static_cast<int>(l), constraints.centre(static_cast<int>(l)),
              {size * d[0], size * d[1], size * d[2]}, angle > 0 ? turn((1 / angle) * angles, angle) : Rotation{});
  }
  return moved;
}

/// The zero that is reached from here, or the best that was found. `work`: multiplications that may still be done.
Source descend(Source source, const Ratios& ratios, double& work) {
  double damping = 1e-6;
  double cost = squares(values_of(source, ratios));
  constexpr int most_steps = 200;
  for (int step = 0; step < most_steps && cost > met * met && work > 0; ++step) {
    const Constraints constraints(source);
    std::vector<double> values;
    Rows rows;
    for (const SourceJoint& joint : source.joints)
      if (!joint.dropped) constraints.add(joint, values, &rows);
    ratios.add(source, values, &rows);
    const std::size_t n = constraints.columns();
    Rows normal(n, std::vector<double>(n));
    std::vector<double> right(n);
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (std::size_t i = 0; i < n; ++i) {
        if (rows[r][i] == 0) continue;
        right[i] -= rows[r][i] * values[r];
        for (std::size_t j = 0; j <= i; ++j) normal[i][j] += rows[r][i] * rows[r][j];
      }
    const double size = static_cast<double>(n);
    work -= static_cast<double>(rows.size()) * size * size / 2;
    bool better = false;
    for (; damping < 1e6 && !better; damping *= better ? 1 : 10) {
      work -= size * size * size / 3;
      Rows damped = normal;
      for (std::size_t i = 0; i < n; ++i) damped[i][i] += damping;
      std::vector<double> way = right;
      if (!solve(damped, way)) continue;
      Source next = moved_by(source, constraints, way);
      const double next_cost = squares(values_of(next, ratios));
      if (!(next_cost < cost)) continue;
      source = std::move(next);
      cost = next_cost;
      better = true;
    }
    if (!better) break;
    damping = std::max(damping / 30, 1e-14);
  }
  return source;
}

/// A reproducible sequence: an open posture is looked for from places spread over turns (splitmix64).
class Spread {
 public:
  double next() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53 * 2 - 1;
  }

 private:
  std::uint64_t state_ = 1;
};

/// Brings `to` of a joint to where its `from` is, or the other way round, anywhere in the joint's own freedom.
void hang(Source& source, const SourceJoint& joint, bool to_is_placed, double size, Spread& spread) {
  const JointSide& still = to_is_placed ? joint.on_to : joint.on_from;
  const JointSide& moved = to_is_placed ? joint.on_from : joint.on_to;
  Rotation target = still.frame;
  Vec at = still.at;
  const double angle = std::numbers::pi * spread.next();
  switch (joint.kind) {
    case SourceKind::spherical:
      target = turn(unit({spread.next(), spread.next(), spread.next()}), angle) * target;
      break;
    case SourceKind::universal: {
      const Vec axis = std::cos(angle) * target.x + std::sin(angle) * target.y;
      target = frame_along(axis);
      break;
    }
    case SourceKind::revolute:
    case SourceKind::cylindrical:
      target = turn(target.z, angle) * target;
      break;
    case SourceKind::slot:
      target = turn({0, 0, 1}, angle) * target;
      break;
    case SourceKind::prismatic:
    case SourceKind::fixed:
      break;
  }
  if (joint.slides()) {
    std::array<double, 2> range = {-size, size};
    if (joint.range && joint.range_is_distance) range = *joint.range;
    const double way = range[0] + (range[1] - range[0]) * (1 + spread.next()) / 2;
    at = at + (to_is_placed ? -way : way) * still.frame.z;
  }
  const Vec from = moved.at;
  move_link(source, to_is_placed ? joint.from : joint.to, from, at - from, target * moved.frame.transposed());
}

/// Link after link from the ground outwards: of what is planar a planar posture, though loops are open.
Source spread_out(const Source& source, Spread& spread) {
  Source spread_source = source;
  const double size = size_of(source);
  std::vector<bool> placed(spread_source.links.size());
  const auto is_placed = [&](int link) { return link == ground_link || placed[static_cast<std::size_t>(link)]; };
  for (bool more = true; more;) {
    more = false;
    for (std::size_t j = 0; j < spread_source.joints.size(); ++j) {
      const SourceJoint joint = spread_source.joints[j];
      if (joint.dropped || is_placed(joint.from) == is_placed(joint.to)) continue;
      hang(spread_source, joint, is_placed(joint.to), size, spread);
      placed[static_cast<std::size_t>(is_placed(joint.to) ? joint.from : joint.to)] = true;
      more = true;
    }
  }
  return spread_source;
}

/// Two joints without a link in common are in one place: a posture in which a loop is folded, at a branching of its
/// ways.
bool is_folded(const Source& source) {
  const double near = 1e-3 * size_of(source);
  for (std::size_t i = 0; i < source.joints.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const SourceJoint &a = source.joints[i], &b = source.joints[j];
      if (a.dropped || b.dropped || a.slides() || b.slides()) continue;
      if (a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to) continue;
      if (distance(a.at(), b.at()) < near) return true;
    }
  return false;
}

/// Turns legs to their positive side; false where a guide is beyond its range.
bool within_ranges(Source& source) {
  bool within = true;
  for (SourceJoint& joint : source.joints) {
    if (joint.dropped || !joint.range || !joint.range_is_distance) continue;
    double apart = dot(joint.axis(), joint.on_to.at - joint.on_from.at);
    if (joint.either_way && apart < 0) {
      const Rotation back = turn(joint.on_from.frame.x, std::acos(-1.0));
      joint.on_from.frame = back * joint.on_from.frame;
      joint.on_to.frame = back * joint.on_to.frame;
      apart = -apart;
    }
    within = within && apart >= (*joint.range)[0] && apart <= (*joint.range)[1];
  }
  return within;
}

}  // namespace

void move_link(Source& source, int link, const Vec& centre, const Vec& shift, const Rotation& r) {
  const auto place_of = [&](Vec& at) { at = centre + shift + r * (at - centre); };
  for (SourceJoint& joint : source.joints) {
    for (auto [end, side] : {std::pair{joint.from, &joint.on_from}, std::pair{joint.to, &joint.on_to}}) {
      if (end != link) continue;
      place_of(side->at);
      side->frame = r * side->frame;
    }
    if (joint.from == link && joint.along) {
      place_of(joint.along->first);
      place_of(joint.along->second);
    }
  }
  for (SourcePoint& point : source.points)
    if (point.link == link) place_of(point.at);
  for (SourceLoad& load : source.loads)
    if (load.link == link) {
      place_of(load.at);
      if (load.turns) load.force = r * load.force;
    }
  for (SourceSpring& spring : source.springs)
    for (std::size_t i = 0; i < 2; ++i)
      if (spring.links[i] == link) place_of(spring.at[i]);
  for (SourceMesh& mesh : source.meshes)
    for (std::size_t i = 0; i < 2; ++i)
      if (mesh.links[i] == link) place_of(mesh.at[i]);
  SourceLink& source_link = source.links[static_cast<std::size_t>(link)];
  if (source_link.centre) place_of(*source_link.centre);
  if (source_link.inertia) source_link.inertia = imports::turned(r, *source_link.inertia);
}

double size_of(const Source& source) {
  std::vector<Vec> places;
  for (const SourceJoint& joint : source.joints)
    if (!joint.dropped) {
      places.push_back(joint.on_from.at);
      places.push_back(joint.on_to.at);
    }
  for (const SourcePoint& point : source.points) places.push_back(point.at);
  if (places.empty()) return 0;
  Vec low = places.front(), high = low;
  for (const Vec& at : places)
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], at[i]);
      high[i] = std::max(high[i], at[i]);
    }
  return distance(low, high);
}

namespace {

/// Ranges are counted from the posture: from the one that was found.
void keep_ranges(const Source& before, Source& source) {
  for (std::size_t j = 0; j < source.joints.size(); ++j) {
    SourceJoint& joint = source.joints[j];
    if (!joint.range || joint.range_is_distance) continue;
    const double way = way_between(before.joints[j], joint);
    joint.range = std::array<double, 2>{(*joint.range)[0] - way, (*joint.range)[1] - way};
  }
}

}  // namespace

void close_posture(Source& source, const std::string& file) {
  const Ratios ratios(source);
  const auto refuse = [&](const Source& found) {
    const Constraints constraints(found);
    const SourceJoint* worst = nullptr;
    double most = -1;
    for (const SourceJoint& joint : found.joints) {
      if (joint.dropped) continue;
      std::vector<double> values;
      constraints.add(joint, values, nullptr);
      if (largest(values) > most) {
        most = largest(values);
        worst = &joint;
      }
    }
    const std::vector<double> off = ratios.values(found);
    for (std::size_t i = 0; i < off.size(); ++i) {
      const SourceFollower& follower = ratios.followers()[i];
      const std::string name = found.joints[follower.joint].name, leader = found.joints[follower.leader].name;
      if (std::abs(off[i]) > most)
        throw core::InputError({file, follower.line},
                               "the links do not close while joint " + name + " follows joint " + leader,
                               "correct the ratio, the lengths, or the posture of the file");
    }
    const double gap = worst == nullptr ? 0 : distance(worst->on_from.at, worst->on_to.at);
    // A guide's sides are apart along it, too; and what meets in one place may be turned.
    const std::string apart = worst != nullptr && !worst->slides() && gap * constraints.scale() > met
                                  ? "stays " + shortest_decimal(gap, 0.005 * gap) + " " + source.unit + " apart"
                                  : "stays out of line";
    throw core::InputError(
        {file, worst == nullptr ? 0 : worst->line},
        "the links do not close: joint " + (worst == nullptr ? "" : worst->name) + " between " +
            (worst == nullptr ? "" : link_words(found, worst->from) + " and " + link_words(found, worst->to)) + " " +
            apart + (source.open_posture ? "" : " near the file's posture"),
        "correct the lengths, or the posture of the file");
  };
  const std::vector<double> before = values_of(source, ratios);
  if (largest(before) <= met) return;
  constexpr double rounding = 1e-6;  // of the size: what digits that were cut off leave, as in files of CAD programs
  if (!source.open_posture && largest(before) <= rounding) {
    source.note("joints meet within " + shortest_decimal(largest(before) * size_of(source), 1e-12 * size_of(source)) +
                " " + source.unit + " in the file: each was put at its place on its first link");
    for (SourceJoint& joint : source.joints) {
      if (!joint.slides()) joint.on_to.at = joint.on_from.at;
      if (joint.kind != SourceKind::universal) joint.on_to.frame = joint.on_from.frame;
    }
    return;
  }
  const Source start = source;
  double work = 1e9;  // a second
  if (!source.open_posture) {
    // A ratio that the loops keep by themselves is kept as well as the file's digits say, and no better.
    source = descend(std::move(source), {}, work);
    const double off = largest(ratios.values(source));
    if (largest(values_of(source, {})) <= 100 * met && off <= digits_of_ratios) {
      if (off > met)
        source.note("joints that follow others do so within " + shortest_decimal(off, 0.05 * off) +
                    " rad where the loops are closed");
    } else {
      source = descend(start, ratios, work);
      if (!(largest(values_of(source, ratios)) <= 100 * met)) refuse(source);
    }
    keep_ranges(start, source);
    double moved = 0;
    for (std::size_t j = 0; j < source.joints.size(); ++j)
      moved = std::max(moved, distance(source.joints[j].on_from.at, start.joints[j].on_from.at));
    if (moved > 1e-9 * size_of(source))
      source.note("the loops do not close in the file's posture: they were closed near it, and joints moved by " +
                  shortest_decimal(moved, 0.005 * moved) + " " + source.unit + " at most");
    return;
  }
  Spread spread;
  constexpr int most_starts = 40;
  Source best = source;
  std::optional<Source> folded, beyond;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_starts && work > 0; ++i) {
    Source found = descend(spread_out(start, spread), ratios, work);
    const double left = largest(values_of(found, ratios));
    if (left < least) {
      least = left;
      best = found;
    }
    if (!(left <= 100 * met)) continue;
    if (!within_ranges(found)) {
      if (!beyond) beyond = std::move(found);
      continue;
    }
    if (is_folded(found)) {
      if (!folded) folded = std::move(found);
      continue;
    }
    source = std::move(found);
    source.note("the file has no posture: one in which all joints meet was found; there may be other assemblies");
    return;
  }
  if (folded) {
    source = std::move(*folded);
    source.note("the file has no posture: one in which all joints meet was found, but there the mechanism is folded");
    return;
  }
  if (!beyond) refuse(best);
  source = std::move(*beyond);
  source.note(
      "the file has no posture: one in which all joints meet was found, but not one in which all guides are within "
      "their ranges");
}

}  // namespace clearloci::mechanism::imports
