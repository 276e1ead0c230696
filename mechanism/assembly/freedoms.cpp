// What is loose in a drawing and what is too much, by counting: the joints' reactions in the drawn posture hold the
// links (virtual work), and what is left has to be as many as there are coordinates and motors.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "mechanism/assembly/drawing.hpp"
#include "mechanism/idle.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/redundancy.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using PointAt = std::array<double, 3>;

double apart(const PointAt& p, const PointAt& q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

/// "1 motor", "2 motors".
std::string counted(std::size_t count, const std::string& what, const std::string& more) {
  return std::to_string(count) + " " + (count == 1 ? what : more);
}

void check_every_link_joined(const Drawing& d) {
  for (std::size_t l = 0; l < d.mechanism.links.size(); ++l) {
    const auto link = static_cast<LinkIndex>(l);
    if (d.cabled[l] || std::any_of(d.mechanism.joints.begin(), d.mechanism.joints.end(),
                                   [&](const Joint& joint) { return joint.from == link || joint.to == link; }))
      continue;
    throw InputError(d.link(link).where, "link " + d.link(link).name + " has no joint",
                     "join it to another link, or leave it out");
  }
}

void check_doubled_joints(const Drawing& d) {
  const double near = 1e-9 * d.size;  // of the drawing: two joints so close are meant to be in one place
  const auto& joints = d.mechanism.joints;
  for (std::size_t j = 0; j < joints.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const Joint &a = joints[i], &b = joints[j];
      if (std::minmax(a.from, a.to) != std::minmax(b.from, b.to)) continue;
      if (apart(d.place(a.at), d.place(b.at)) > near || !d.at(a.at).has_place || !d.at(b.at).has_place) continue;
      throw InputError(b.where,
                       "joints " + a.name + " and " + b.name + " join " + d.name_of(a.from) + " and " +
                           d.name_of(a.to) + " in one place",
                       "leave " + b.name + " out, or join another link there");
    }
}

void check_links_drawn_apart(const Drawing& d) {
  for (const Link& link : d.mechanism.links) {
    const auto& points = link.points;
    const auto has_place = [&](PointIndex point) { return d.at(point).has_place; };
    if (points.size() < 2 || !std::all_of(points.begin(), points.end(), has_place)) continue;
    const double near = 1e-9 * d.size;
    if (std::any_of(points.begin() + 1, points.end(),
                    [&](PointIndex point) { return apart(d.place(points[0]), d.place(point)) > near; }))
      continue;
    std::vector<std::string> names;
    for (const PointIndex point : points) names.push_back(d.name(point));
    throw InputError(link.where, "the points of link " + link.name + " are drawn in one place: " + listed(names),
                     "draw them apart, or make one point of them");
  }
}

void check_axes(const Drawing& d) {
  const std::vector<double> pose = spread_poses(d.mechanism, 1).front();
  for (const Joint& joint : d.mechanism.joints)
    for (const VectorExpression& axis : joint.axes)
      if (const auto drawn = sample_vector(d.mechanism, axis, pose); drawn && apart(*drawn, {}) == 0)
        throw InputError(joint.where, "the axis of joint " + joint.name + " is zero: it has no direction",
                         d.is_spatial() ? "write such as axis: [0, 0, 1]" : "write such as axis: [1, 0]");
}

/// A coordinate that is the place of what cannot move.
void check_places_move(const Drawing& d) {
  const std::vector<bool> fixed = fixed_points(d);
  for (const DrawnCoordinate& coordinate : d.coordinates)
    if (coordinate.kind == DrawnCoordinate::Kind::place && fixed[static_cast<std::size_t>(coordinate.point)])
      throw InputError(
          coordinate.where,
          "coordinate " + coordinate.name + " is the place of " + d.name(coordinate.point) + ", which stands still",
          "name a point that moves");
}

/// The same links and joints in a posture beside the drawn one, with other lengths.
Drawing beside(const Drawing& d) {
  Drawing other = d;
  constexpr double part = 0.01;  // of the drawing
  for (std::size_t p = 0; p < other.posture.size(); ++p)
    for (std::size_t i = 0; i < dimension(d.mechanism); ++i) {
      // Any numbers will do that are in no proportion to each other.
      const double step = std::sin(1.0 + 7.0 * static_cast<double>(p) + 3.0 * static_cast<double>(i));
      other.posture[p][i] += part * d.size * step;
    }
  return other;
}

/// The links and joints of the drawing in doubles, and what holds them.
class Freedoms {
 public:
  explicit Freedoms(const Drawing& drawing) : d_(drawing), m_(drawing.mechanism) {
    m_.loads.clear();
    m_.gravity.clear();
    m_.springs.clear();
    m_.end_effector_link = ground;
    for (const DrawnMesh& mesh : drawing.meshes) m_.joints.push_back(mesh.joint);
    for (std::size_t p = 0; p < m_.points.size() && p < d_.points.size(); ++p) {
      ExplicitPoint form;
      for (std::size_t i = 0; i < dimension(m_); ++i)
        form.coordinates.push_back(Expression::number(Rational(d_.posture[p][i])));
      m_.points[p].form = std::move(form);
    }
    for (const Link& link : m_.links)
      for (const PointIndex point : link.points)
        if (!d_.at(point).has_place) return;
    if (drawing.is_spatial()) hold_idle_freedoms(m_);
    pose_ = spread_poses(m_, 1).front();
    for (const auto& place : sample_points(m_, pose_)) places_.push_back(place.value_or(PointAt{}));
    if (auto columns = reactions_at(m_, pose_)) {
      for (const BorneReaction& reaction : *columns) (reaction.motor ? motors_ : passive_).push_back(reaction);
      hold_turning_of_points();
      known_ = true;
    }
  }

  /// False where a point has no place in the posture, or an axis no direction: other checks say so.
  bool known() const { return known_; }
  std::size_t rows() const { return equations_per_link(m_) * m_.links.size(); }
  std::size_t reactions() const { return passive_.size(); }
  std::size_t mobility() const { return rows() - rank(passive_); }
  std::size_t motors() const { return motors_.size(); }

  /// Links that move while the coordinates stand still.
  std::vector<LinkIndex> loose(std::size_t& freedoms) const {
    std::vector<BorneReaction> columns = passive_;
    add_coordinates(columns);
    const Matrix matrix = balances_of(m_, columns, places_);
    const Dependence found = dependence_of(transposed(matrix));
    freedoms = rows() - found.rank;
    std::set<LinkIndex> links;
    for (const std::size_t row : found.columns) links.insert(static_cast<LinkIndex>(row / equations_per_link(m_)));
    return {links.begin(), links.end()};
  }

  /// Rods, and joints where there are none, that work against each other.
  void braced(std::vector<std::string>& rods, std::vector<std::string>& joints) const {
    std::set<JointIndex> braced_joints;
    for (const std::size_t c : dependence_of(balances_of(m_, passive_, places_)).columns)
      braced_joints.insert(passive_[c].joint);
    const auto joint_at = [&](JointIndex j) -> const Joint& { return m_.joints[static_cast<std::size_t>(j)]; };
    for (const JointIndex j : braced_joints) joints.push_back(joint_at(j).name);
    for (std::size_t l = 0; l < m_.links.size(); ++l) {
      const auto link = static_cast<LinkIndex>(l);
      const bool touched = std::any_of(braced_joints.begin(), braced_joints.end(), [&](JointIndex j) {
        return joint_at(j).from == link || joint_at(j).to == link;
      });
      if (touched && is_rod(m_, link)) rods.push_back(m_.links[l].name);
    }
  }

  /// Links that only pass a force on.
  std::vector<std::string> rods() const {
    std::vector<std::string> names;
    for (std::size_t l = 0; l < m_.links.size(); ++l)
      if (is_rod(m_, static_cast<LinkIndex>(l))) names.push_back(m_.links[l].name);
    return names;
  }

  /// Whether motors alone work against each other: any one of them may go.
  std::vector<std::string> motors_too_many() const {
    std::vector<BorneReaction> columns = passive_;
    columns.insert(columns.end(), motors_.begin(), motors_.end());
    std::vector<std::string> names;
    for (const std::size_t c : dependence_of(balances_of(m_, columns, places_)).columns)
      if (columns[c].motor) names.push_back(d_.joint(columns[c].joint).name);
    return names;
  }
  std::vector<LinkIndex> undriven() const {
    std::vector<BorneReaction> columns = passive_;
    columns.insert(columns.end(), motors_.begin(), motors_.end());
    std::set<LinkIndex> links;
    for (const std::size_t row : dependence_of(transposed(balances_of(m_, columns, places_))).columns)
      links.insert(static_cast<LinkIndex>(row / equations_per_link(m_)));
    return {links.begin(), links.end()};
  }

 private:
  std::size_t rank(const std::vector<BorneReaction>& columns) const {
    return dependence_of(balances_of(m_, columns, places_)).rank;
  }

  LinkIndex link_of(PointIndex point) const {
    for (std::size_t l = 0; l < m_.links.size(); ++l)
      if (std::find(m_.links[l].points.begin(), m_.links[l].points.end(), point) != m_.links[l].points.end())
        return static_cast<LinkIndex>(l);
    return ground;
  }

  /// What would hold every coordinate still.
  void add_coordinates(std::vector<BorneReaction>& columns) const {
    const auto hold = [&](PointIndex point, std::size_t axis) {
      BorneReaction reaction{0, false, ground, link_of(point), point, {}, {}};
      reaction.force[axis] = 1;
      if (reaction.to != ground) columns.push_back(reaction);
    };
    for (const DrawnCoordinate& c : d_.coordinates) {
      using Kind = DrawnCoordinate::Kind;
      if (c.kind == Kind::place) hold(c.point, c.axis);
      if (c.kind == Kind::stroke)
        if (const auto axis = sample_vector(m_, d_.joint(c.joint).axes.front(), pose_))
          columns.push_back(
              {c.joint, false, d_.joint(c.joint).from, d_.joint(c.joint).to, d_.joint(c.joint).at, unit(*axis), {}});
      if (c.kind == Kind::direction && !d_.is_spatial())
        columns.push_back({0, false, c.other, c.link, d_.link(c.link).points.front(), {}, {0, 0, 1}});
      if (c.kind == Kind::turn || (c.kind == Kind::direction && d_.is_spatial()))
        for (std::size_t i = 0; i < 3; ++i) {
          BorneReaction reaction{0, false, c.other, c.link, d_.link(c.link).points.front(), {}, {}};
          reaction.couple[i] = 1;
          if (c.kind == Kind::direction || i == static_cast<std::size_t>(c.order[c.axis] - 'x'))
            columns.push_back(reaction);
        }
    }
    for (std::size_t p = 0; p < d_.points.size(); ++p)
      if (d_.points[p].held)
        for (std::size_t i = 0; i < dimension(m_); ++i) hold(static_cast<PointIndex>(p), i);
  }

  /// A point mass on cables does not turn: no balance of its couples is asked for.
  void hold_turning_of_points() {
    for (std::size_t l = 0; l < m_.links.size(); ++l) {
      const auto link = static_cast<LinkIndex>(l);
      const bool joined = std::any_of(m_.joints.begin(), m_.joints.end(),
                                      [&](const Joint& joint) { return joint.from == link || joint.to == link; });
      if (!d_.cabled[l] || joined || m_.links[l].points.size() != 1) continue;
      for (std::size_t i = d_.is_spatial() ? 0 : 2; i < 3; ++i) {
        BorneReaction reaction{0, false, ground, link, m_.links[l].points.front(), {}, {}};
        reaction.couple[i] = 1;
        passive_.push_back(reaction);
      }
    }
  }

  static PointAt unit(const PointAt& v) {
    const double size = std::hypot(v[0], v[1], v[2]);
    return {v[0] / size, v[1] / size, v[2] / size};
  }

  const Drawing& d_;
  Mechanism m_;
  bool known_ = false;
  std::vector<double> pose_;
  std::vector<PointAt> places_;
  std::vector<BorneReaction> passive_, motors_;
};

std::vector<std::string> names_of(const Drawing& d, const std::vector<LinkIndex>& links) {
  std::vector<std::string> names;
  for (const LinkIndex link : links) names.push_back(d.name_of(link));
  return names;
}

std::string link_words(const Drawing& d, const std::vector<LinkIndex>& links) {
  return (links.size() == 1 ? "link " : "links ") + listed(names_of(d, links));
}

std::string counts(const Drawing& d, const Freedoms& freedoms) {
  return counted(freedoms.mobility(), "freedom", "freedoms") + ", " +
         counted(d.coordinates.size(), "coordinate", "coordinates") + ", " +
         counted(freedoms.motors(), "motor", "motors");
}

core::SourcePosition place_of(const Drawing& d, const std::vector<LinkIndex>& links) {
  return links.empty() || links.front() == ground ? core::SourcePosition{d.mechanism.file}
                                                  : d.link(links.front()).where;
}

/// In the plane: rods and joints that hold the rest more than it needs.
void check_braced(const Drawing& d, const Freedoms& freedoms) {
  if (d.is_spatial() || freedoms.reactions() + d.coordinates.size() <= freedoms.rows()) return;
  std::vector<std::string> rods, joints;
  freedoms.braced(rods, joints);
  if (joints.empty()) return;
  const std::size_t more = freedoms.reactions() + d.coordinates.size() - freedoms.rows();
  if (rods.empty())
    throw InputError({d.mechanism.file},
                     "joints " + listed(joints) + " work against each other: " + counts(d, freedoms),
                     "leave out " + counted(more, "link", "links") + " between them with a joint each");
  throw InputError({d.mechanism.file},
                   "rods " + listed(rods) + " hold the links between them more than once: " +
                       std::to_string(rods.size() - more) + " of these " + std::to_string(rods.size()) + " will do",
                   "leave " + rods.back() + " out with its joints, or mark it: redundant: true");
}

}  // namespace

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

std::vector<bool> fixed_points(const Drawing& d) {
  std::vector<bool> fixed(d.points.size());
  std::vector<bool> carried(d.points.size());
  for (const Link& link : d.mechanism.links)
    for (const PointIndex point : link.points)
      if (static_cast<std::size_t>(point) < carried.size()) carried[static_cast<std::size_t>(point)] = true;
  for (std::size_t p = 0; p < fixed.size(); ++p) {
    const DrawnPoint& point = d.points[p];
    fixed[p] = point.built ? !point.moves && point.uses.empty() : !carried[p];
  }
  for (const Joint& joint : d.mechanism.joints) {
    if (joint.from != ground && joint.to != ground) continue;
    const bool pin_stands = is_slot(d.mechanism, joint) && joint.to == ground;
    if (!traits(joint).slides || pin_stands) fixed[static_cast<std::size_t>(joint.at)] = true;
    if (!d.is_spatial() || joint.type != JointType::revolute) continue;
    // What lies on the axis of a crank stands still with it.
    const auto axis = sample_vector(d.mechanism, joint.axes.front(), spread_poses(d.mechanism, 1).front());
    if (!axis) continue;
    for (const PointIndex point : d.link(joint.from == ground ? joint.to : joint.from).points) {
      const PointAt &p = d.place(point), &q = d.place(joint.at);
      const PointAt way = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
      const PointAt& u = *axis;
      const PointAt across = {u[1] * way[2] - u[2] * way[1], u[2] * way[0] - u[0] * way[2],
                              u[0] * way[1] - u[1] * way[0]};
      if (apart(across, {}) <= 1e-12 * d.size * apart(u, {})) fixed[static_cast<std::size_t>(point)] = true;
    }
  }
  for (std::size_t p = 0; p < fixed.size(); ++p) {
    const DrawnPoint& point = d.points[p];
    if (point.built && !point.moves && !point.uses.empty())
      fixed[p] = std::all_of(point.uses.begin(), point.uses.end(),
                             [&](PointIndex base) { return fixed[static_cast<std::size_t>(base)]; });
  }
  return fixed;
}

LinkIndex carrier_of(const Drawing& d, const Joint& mesh) {
  if (!mesh.meshing->second) return ground;
  const PointIndex first = mesh.meshing->first, second = *mesh.meshing->second;
  const std::vector<bool> fixed = fixed_points(d);
  if (fixed[static_cast<std::size_t>(first)] && fixed[static_cast<std::size_t>(second)]) return ground;
  for (std::size_t l = 0; l < d.mechanism.links.size(); ++l) {
    const auto link = static_cast<LinkIndex>(l);
    const std::vector<PointIndex>& points = d.link(link).points;
    const auto has = [&](PointIndex point) { return std::find(points.begin(), points.end(), point) != points.end(); };
    if (link != mesh.from && link != mesh.to && has(first) && has(second)) return link;
  }
  throw InputError(mesh.where,
                   "no link holds both centres of " + to_string(mesh.type) + " " + mesh.name + ", " + d.name(first) +
                       " and " + d.name(second),
                   "pin both wheels to one carrier, a link or the ground");
}

/// A coordinate that only constructions use moves no link that is drawn.
void refuse_plain(const Drawing& d, const std::vector<LinkIndex>& loose) {
  for (const DrawnCoordinate& coordinate : d.coordinates)
    if (coordinate.kind == DrawnCoordinate::Kind::plain)
      throw InputError(coordinate.where,
                       link_words(d, loose) + (loose.size() == 1 ? " moves" : " move") + " while coordinate " +
                           coordinate.name + " stands still: it is the angle of no link",
                       "say of which link it is, such as of: " + d.name_of(loose.front()));
}

void check_drawing(const Drawing& d) {
  check_every_link_joined(d);
  check_links_drawn_apart(d);
  check_doubled_joints(d);
  check_axes(d);
  check_places_move(d);
  const Freedoms freedoms(d);
  if (!freedoms.known()) return;
  check_braced(d, freedoms);
  if (freedoms.mobility() == 0) {
    const std::vector<std::string> rods = freedoms.rods();
    throw InputError(
        {d.mechanism.file}, "nothing moves: " + counts(d, freedoms),
        rods.empty() ? "leave out a link with its joints" : "leave out a link with its joints, such as " + rods.back());
  }
  std::size_t left = 0;
  const std::vector<LinkIndex> loose = freedoms.loose(left);
  if (!loose.empty() && freedoms.mobility() > d.coordinates.size() && !d.is_spatial()) {
    const Drawing other = beside(d);
    const Freedoms usual(other);
    if (usual.known() && usual.mobility() == d.coordinates.size())
      throw InputError(place_of(d, loose),
                       link_words(d, loose) + (loose.size() == 1 ? " has " : " have ") +
                           counted(freedoms.mobility(), "freedom", "freedoms") + " in the drawn posture and " +
                           std::to_string(usual.mobility()) + " beside it: the drawn posture is singular",
                       "draw another posture, such as one in which no links are in line");
  }
  if (!loose.empty() && freedoms.mobility() > d.coordinates.size())
    throw InputError(
        place_of(d, loose),
        link_words(d, loose) + (loose.size() == 1 ? " moves" : " move") + " freely: " + counts(d, freedoms),
        "join " + std::string(loose.size() == 1 ? "it" : "one of them") +
            " to another link, actuate another joint, or name a coordinate of it under workspace");
  if (!loose.empty()) refuse_plain(d, loose);
  if (!loose.empty())
    throw InputError(place_of(d, loose),
                     link_words(d, loose) + (loose.size() == 1 ? " moves" : " move") +
                         " in the drawn posture while the coordinates stand still: it is singular, or the coordinates "
                         "say one thing twice",
                     "draw another posture, or name other coordinates");
  if (d.coordinates.size() > freedoms.mobility() &&
      std::none_of(d.coordinates.begin(), d.coordinates.end(),
                   [](const auto& coordinate) { return coordinate.kind == DrawnCoordinate::Kind::plain; }))
    throw InputError(d.coordinates.back().where,
                     "coordinate " + d.coordinates.back().name + " is one too many: " + counts(d, freedoms),
                     "leave out " + counted(d.coordinates.size() - freedoms.mobility(), "coordinate", "coordinates"));
  if (freedoms.motors() > freedoms.mobility()) {
    const std::vector<std::string> names = freedoms.motors_too_many();
    throw InputError({d.mechanism.file}, "motors " + listed(names) + " work against each other: " + counts(d, freedoms),
                     "leave out one of them (actuated: false), or give it a known effort (actuated: {effort: 0})");
  }
  if (freedoms.motors() + d.cables < freedoms.mobility()) {
    const std::vector<LinkIndex> undriven = freedoms.undriven();
    throw InputError(
        place_of(d, undriven),
        link_words(d, undriven) + (undriven.size() == 1 ? " moves" : " move") +
            " freely while the motors stand still: " + counts(d, freedoms),
        "actuate another joint of " + (undriven.size() == 1 ? std::string("it") : "these") + " (actuated: true)");
  }
}

namespace {

/// Balls at both ends leave a rod to turn about the line between them: idle, if nothing acts beside that line.
std::vector<const Joint*> balls_of_rod(const Drawing& d, LinkIndex link) {
  std::vector<const Joint*> joints;
  for (const Joint& joint : d.mechanism.joints)
    if (joint.from == link || joint.to == link) joints.push_back(&joint);
  const bool is_rod = joints.size() == 2 && std::all_of(joints.begin(), joints.end(), [](const Joint* joint) {
                        return joint->type == JointType::spherical;
                      });
  return is_rod ? joints : std::vector<const Joint*>{};
}

}  // namespace

void refuse_rest(const Drawing& d, const std::vector<LinkIndex>& open) {
  if (open.size() == 1)
    if (const std::vector<const Joint*> balls = balls_of_rod(d, open.front()); !balls.empty())
      throw InputError(place_of(d, open),
                       link_words(d, open) + " turns about the line of its balls " + balls[0]->name + " and " +
                           balls[1]->name + ", and what acts on it may do so beside that line",
                       "let weights, loads and springs act on the line, or make one of the two a universal joint");
  throw InputError(
      place_of(d, open),
      link_words(d, open) + (open.size() == 1 ? " has a position that follows" : " have positions that follow") +
          " only from common equations, and no construction of such a group is known here",
      "name a coordinate of one of them under workspace, such as {angle: [0, 360 deg], of: " + d.name_of(open.front()) +
          "}, or give one of their points a construction under points");
}

}  // namespace clearloci::mechanism
