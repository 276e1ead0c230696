// The construction of a drawing in space, part by part.
//
//   link with one known point P              sphere about P
//   link that turns about an axis of a       circle about the axis
//   known one, or about two known points
//   link that slides on a known one          line along the guide
//
// Where a circle meets a sphere is a dyad with an axis, where a line meets a sphere a slider. A link is turned as its
// guide is, by the angle about its axis, by the axis and a point, by three points, or by the angles of a frame.
#include <algorithm>
#include <cmath>

#include "mechanism/assembly/spatial_turning.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

constexpr double close = 1e-9;  // of vectors' lengths: what a drawing means to be in line

struct SpaceLocus {
  enum class Kind { sphere, circle, line } kind = Kind::sphere;
  std::function<int()> base;  ///< the centre, or a point of the line
  std::string radius;
  std::string axis;   ///< of a circle, along a line
  Amounts direction;  ///< the same as drawn
  std::string source;
  std::optional<PointIndex> centre = {};  ///< of a sphere of a constant radius
  Amount length = {};                     ///< that radius
};

class SpatialConstruction : public SpatialTurning {
 public:
  using SpatialTurning::SpatialTurning;

 private:
  using Kind = SpaceLocus::Kind;

  bool put_on_link(PointIndex point) override {
    for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l) {
      const auto link = static_cast<LinkIndex>(l);
      if (!has_point(link, point)) continue;
      const std::vector<PointIndex> bases = known_points(link);
      const std::string comment = "a point of " + d_.link(link).name;
      if (bases.size() > 1) {
        const Amounts way = shape(link).way(bases[0], point), line = shape(link).way(bases[0], bases[1]);
        if (is_parallel(way, line)) {
          put(point,
              map({{"on", list({known(handle(bases[0])).name, known(handle(bases[1])).name})},
                   {"offset", list({(dot(way, line) / length(line)).text()})}}),
              comment);
          return true;
        }
      }
      if (!is_turned(link) || bases.empty()) continue;
      const Attitude& orientation = attitude(link);
      if (orientation.triad && !orientation.by_shape && !shape(link).is_drawn()) {
        if (put_about_axis(link, point)) return true;
        refuse_about_axis(link, point);
      }
      if (!orientation.frame.empty()) {
        for (const PointIndex base : bases)
          if (handle(base) == orientation.origin) {
            put(point, frame_form(orientation, shape(link).way(base, point)), comment);
            return true;
          }
      }
      put_from(bases, point, comment, [&](PointIndex base) { return image(link, shape(link).way(base, point)); });
      return true;
    }
    return false;
  }

  /// On its circle about the axis of its hinge, as far from another known point as its length says.
  bool put_about_axis(LinkIndex link, PointIndex point) {
    const auto hinge = hinge_of(link);
    if (!hinge || !is_known(d_.joint(*hinge).at) || !turns_with_drawing(link, *hinge, point)) return false;
    std::vector<SpaceLocus> circles;
    if (!add_circle(link, point, circles)) return false;
    const PointIndex at = d_.joint(*hinge).at;
    const std::vector<PointIndex> bases = known_points(link);
    const auto other = std::find_if(bases.begin(), bases.end(), [&](PointIndex base) {
      return base != at && is_apart(at, base) && turns_with_drawing(link, *hinge, base);
    });
    if (other == bases.end()) return false;
    SpaceLocus sphere;
    sphere.base = [this, base = *other] { return handle(base); };
    sphere.radius = shape(link).distance(*other, point).text();
    sphere.source = circles.front().source + " about " + d_.name(*other);
    circles.front().source += " about " + d_.name(at);
    return meet(point, circles.front(), sphere);
  }

  /// Lengths fix a shape, and not where an axis passes it.
  [[noreturn]] void refuse_about_axis(LinkIndex link, PointIndex point) const {
    throw core::InputError(d_.link(link).where,
                           "the lengths of link " + d_.link(link).name + " do not tell how " + d_.name(point) +
                               " lies about the axis of its joint",
                           "give none, for the shape that is drawn, or write a construction of " + d_.name(point));
  }

  // --- spheres, circles and lines

  std::vector<SpaceLocus> loci(PointIndex point) {
    std::vector<SpaceLocus> all;
    for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l) {
      const auto link = static_cast<LinkIndex>(l);
      if (!has_point(link, point)) continue;
      if (is_turned(link)) {
        if (known_points(link).empty()) add_line(link, point, all);
        continue;
      }
      if (!add_circle(link, point, all)) add_sphere(link, point, all);
    }
    for (const Stroke& stroke : strokes_at(point))
      if (stroke.origin && !is_turned(stroke.base) &&
          is_parallel(stroke.axis, d_.at(point).at - d_.at(*stroke.origin).at)) {
        SpaceLocus leg;
        leg.base = [this, origin = *stroke.origin] { return handle(origin); };
        leg.radius = stroke.coordinate->name;
        leg.source = stroke.coordinate->name;
        all.push_back(std::move(leg));
      }
    return all;
  }

  void add_sphere(LinkIndex link, PointIndex point, std::vector<SpaceLocus>& all) {
    const std::vector<PointIndex> bases = known_points(link);
    if (bases.empty() || !is_apart(bases[0], point)) return;
    SpaceLocus locus;
    locus.base = [this, base = bases[0]] { return handle(base); };
    locus.radius = shape(link).distance(bases[0], point).text();
    locus.source = d_.link(link).name;
    locus.centre = bases[0];
    locus.length = shape(link).distance(bases[0], point);
    all.push_back(std::move(locus));
  }

  /// Of two points that keep their distance: it, and nothing of others.
  std::optional<Amount> constant_distance(PointIndex a, PointIndex b) const {
    if (!d_.at(a).is_exact || !d_.at(b).is_exact || !is_apart(a, b)) return std::nullopt;
    if (fixed_[static_cast<std::size_t>(a)] && fixed_[static_cast<std::size_t>(b)])
      return mechanism::length(d_.at(b).at - d_.at(a).at);
    for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l)
      if (const auto link = static_cast<LinkIndex>(l); has_point(link, a) && has_point(link, b))
        return shape(link).distance(a, b);
    return std::nullopt;
  }

  /// Where two spheres meet whose centres A and B keep their distance d: a circle about A + t (B - A), with
  ///     t = (r_A^2 - r_B^2 + d^2)/(2 d^2),   radius^2 = r_A^2 - t^2 d^2
  std::optional<SpaceLocus> circle_of(const SpaceLocus& first, const SpaceLocus& second) {
    if (!first.centre || !second.centre) return std::nullopt;
    const PointIndex a = *first.centre, b = *second.centre;
    const auto distance = constant_distance(a, b);
    if (!distance) return std::nullopt;
    const Amount square = *distance * *distance, amount = first.length * first.length;
    const Amount t = (amount - second.length * second.length + square) / (square + square);
    const Amount left = amount - t * t * square;
    if (!(left.value() > close * square.value())) return std::nullopt;
    const std::string p = known(handle(a)).name, q = known(handle(b)).name;
    SpaceLocus circle;
    circle.kind = Kind::circle;
    circle.source = first.source + " and " + second.source;
    circle.direction = d_.at(b).at - d_.at(a).at;
    circle.axis = q + " - " + p;
    circle.radius = square_root(left).text();
    circle.base = [this, a, p, q, t, way = t * circle.direction] {
      return t.is_zero() ? handle(a) : shifted(a, t * way_between(p, q), way);
    };
    return circle;
  }

  /// About the axis of a hinge on a known link, or about two known points of the link.
  bool add_circle(LinkIndex link, PointIndex point, std::vector<SpaceLocus>& all) {
    SpaceLocus locus;
    locus.kind = Kind::circle;
    locus.source = d_.link(link).name;
    const std::vector<PointIndex> bases = known_points(link);
    if (const auto hinge = hinge_of(link);
        hinge && is_known(d_.joint(*hinge).at) && turns_with_drawing(link, *hinge, point)) {
      const PointIndex at = d_.joint(*hinge).at;
      locus.direction = *drawn_axis(*hinge);
      const LinkIndex base = other_of(d_.joint(*hinge), link);
      locus.axis = base == ground ? written_axis(*hinge) : direction_text(base, locus.direction);
      if (!shape(link).is_drawn()) {
        set_circle_by_length(locus, link, at, point, base);
      } else {
        set_circle(locus, at, d_.at(point).at - d_.at(at).at,
                   [this, base, at](const Amounts& along) { return shifted(at, image(base, along), along); });
      }
    } else if (bases.size() > 1) {
      const std::string p = known(handle(bases[0])).name, q = known(handle(bases[1])).name;
      locus.direction = shape(link).way(bases[0], bases[1]);
      locus.axis = q + " - " + p;
      set_circle(locus, bases[0], shape(link).way(bases[0], point),
                 [this, p, q, at = bases[0], axis = locus.direction](const Amounts& along) {
                   const Amount part = dot(along, axis) / dot(axis, axis);
                   return shifted(at, part * way_between(p, q), along);
                 });
    } else {
      return false;
    }
    all.push_back(std::move(locus));
    return true;
  }

  /// Whether the circle of a point about a hinge is told: its place along the axis by the drawing.
  bool turns_with_drawing(LinkIndex link, JointIndex hinge, PointIndex point) const {
    const PointIndex at = d_.joint(hinge).at;
    if (!d_.at(at).is_exact || !d_.at(point).is_exact) return false;
    return shape(link).is_drawn() || (shape(link).has(at) && shape(link).has(point));
  }

  /// The length that is given, and along the axis what is drawn, tell the radius.
  void set_circle_by_length(SpaceLocus& locus, LinkIndex link, PointIndex at, PointIndex point, LinkIndex base) {
    const Amounts along = part_along(d_.at(point).at - d_.at(at).at, locus.direction);
    locus.radius = beside(link, at, point, along).text();
    if (size_of(along) == 0)
      locus.base = [this, at] { return handle(at); };
    else
      locus.base = [this, at, base, along] { return shifted(at, image(base, along), along); };
  }

  template <typename Shift>
  void set_circle(SpaceLocus& locus, PointIndex at, const Amounts& way, const Shift& shift) {
    const Amounts along = (dot(way, locus.direction) / dot(locus.direction, locus.direction)) * locus.direction;
    locus.radius = length(way - along).text();
    const bool in_plane = size_of(along) <= close * size_of(way);
    locus.base = [this, at, along, shift, in_plane] { return in_plane ? handle(at) : shift(along); };
  }

  /// The foot of a circle's plane on its axis.
  Handle shifted(PointIndex base, const WrittenVector& by, const Amounts& way) {
    std::optional<WrittenVector> place;
    const Node form = form_at(handle(base), by, place);
    std::array<double, 3> posture = d_.place(base);
    for (std::size_t i = 0; i < 3; ++i) posture[i] += way[i].value() * core::to_double(d_.unit);
    return put_extra(d_.name(base) + "_foot", form, posture, "on the axis through " + d_.name(base), std::move(place));
  }

  void add_line(LinkIndex link, PointIndex point, std::vector<SpaceLocus>& all) {
    for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j) {
      const Joint& joint = d_.mechanism.joints[j];
      if (joint.type != JointType::prismatic || !joins(joint, link)) continue;
      const LinkIndex guide = other_of(joint, link);
      const auto axis = drawn_axis(static_cast<JointIndex>(j));
      if (!is_placed(guide) || !axis || !d_.at(point).is_exact) continue;
      SpaceLocus line;
      line.kind = Kind::line;
      line.direction = *axis;
      line.axis = guide == ground ? written_axis(static_cast<JointIndex>(j)) : direction_text(guide, *axis);
      line.source = "guide " + joint.name;
      line.base = [this, guide, point, axis = *axis, name = joint.name] {
        return base_of_line(guide, point, axis, name);
      };
      all.push_back(std::move(line));
    }
  }

  bool put_where_loci_meet(PointIndex point) override {
    const std::vector<SpaceLocus> all = loci(point);
    for (const SpaceLocus& first : all)
      for (const SpaceLocus& second : all)
        if (first.kind != Kind::sphere && second.source != first.source && meet(point, first, second)) return true;
    return put_where_spheres_meet(point, all);
  }

  /// At given distances from three points, of which two keep theirs.
  bool put_where_spheres_meet(PointIndex point, const std::vector<SpaceLocus>& all) {
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t k = i + 1; k < all.size(); ++k) {
        const bool apart = all[i].source != all[k].source;
        const auto circle = apart ? circle_of(all[i], all[k]) : std::nullopt;
        for (const SpaceLocus& third : all)
          if (circle && third.source != all[i].source && third.source != all[k].source && meet(point, *circle, third))
            return true;
      }
    return false;
  }

  /// A circle or a line with a sphere; of a second circle or line about another base its sphere.
  bool meet(PointIndex point, const SpaceLocus& first, const SpaceLocus& sphere) {
    if (sphere.kind != Kind::sphere) return false;
    const Handle base = first.base(), from = sphere.base();
    require_place(base);
    require_place(from);
    const auto &a = known(base).posture, &c = known(from).posture, &r = d_.place(point);
    const std::array<double, 3> n = {first.direction[0].value(), first.direction[1].value(),
                                     first.direction[2].value()};
    const auto minus = [](const auto& p, const auto& q) {
      return std::array<double, 3>{p[0] - q[0], p[1] - q[1], p[2] - q[2]};
    };
    const auto product = [](const auto& p, const auto& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; };
    const std::string comment = "where " + first.source + " and " + sphere.source + " meet";
    const auto rod = minus(r, c), way = minus(c, a), arm = minus(r, a);
    if (first.kind == Kind::line) {
      const double ahead = product(rod, n);
      if (std::abs(ahead) <= close * std::sqrt(product(rod, rod) * product(n, n)))
        refuse_stretched(point, first.source, sphere.source);
      put(point,
          map({{"slider", Node::sequence({text(known(base).name), vector_node(first.axis)}, {})},
               {"from", text(known(from).name)},
               {"length", text(sphere.radius)},
               {"side", text(ahead > 0 ? "ahead" : "behind")}}),
          comment);
      return true;
    }
    // Left as seen against the axis: n . (way x arm) > 0.
    const std::array<double, 3> across = {way[1] * arm[2] - way[2] * arm[1], way[2] * arm[0] - way[0] * arm[2],
                                          way[0] * arm[1] - way[1] * arm[0]};
    const double turn = product(n, across);
    if (std::abs(turn) <= close * std::sqrt(product(n, n) * product(way, way) * product(arm, arm)))
      refuse_stretched(point, first.source, sphere.source);
    put(point,
        map({{"dyad", list({known(base).name, known(from).name})},
             {"lengths", list({first.radius, sphere.radius})},
             {"axis", vector_node(first.axis)},
             {"side", text(turn > 0 ? "left" : "right")}}),
        comment);
    return true;
  }

  // --- axes

  /// Two points between which a link, or the leg that it is a part of, goes.
  std::optional<std::array<PointIndex, 2>> way_of(LinkIndex link) const {
    const std::vector<PointIndex> points = known_points(link);
    if (points.size() > 1) return std::array<PointIndex, 2>{points[0], points[1]};
    for (const Joint& joint : d_.mechanism.joints) {
      if (!traits(joint).slides || !joins(joint, link) || points.empty()) continue;
      const std::vector<PointIndex> there = known_points(other_of(joint, link));
      if (!there.empty() && is_apart(points[0], there[0])) return std::array<PointIndex, 2>{points[0], there[0]};
    }
    return std::nullopt;
  }

  void write_axes(JointIndex index) override {
    const Joint& joint = d_.joint(index);
    std::vector<std::string> written(joint.axes.size());
    for (std::size_t which = 0; which < joint.axes.size(); ++which) written[which] = axis_in_all_poses(index, which);
    if (std::any_of(written.begin(), written.end(), [](const std::string& candidate) { return !candidate.empty(); }))
      found_.axes[index] = std::move(written);
  }

  /// Empty where it stays as it is written.
  std::string axis_in_all_poses(JointIndex index, std::size_t which, bool by_the_other = true) {
    const Joint& joint = d_.joint(index);
    const bool both = joint.axes.size() == 1;
    const LinkIndex holder = both || which == 0 ? joint.from : joint.to;
    if (!points_of(joint.axes[which]).empty() || holder == ground || (both && joint.to == ground)) return "";
    const auto axis = drawn_axis(index, which);
    if (!axis || keeps_constructions(holder) || (both && keeps_constructions(joint.to))) return "";
    if (is_hinge_axis(holder, *axis) || (both && is_hinge_axis(joint.to, *axis))) return "";
    for (const LinkIndex link : {holder, both ? joint.to : holder}) {
      if (!is_turned(link) || attitude(link).by_shape) continue;
      return image(link, *axis).is_constant() ? "" : direction_text(link, *axis);
    }
    for (const LinkIndex link : {holder, both ? joint.to : holder}) {
      const auto way = way_of(link);
      if (!way || !d_.at((*way)[0]).is_exact || !d_.at((*way)[1]).is_exact) continue;
      const Amounts along = d_.at((*way)[1]).at - d_.at((*way)[0]).at;
      const std::string p = known(handle((*way)[0])).name, q = known(handle((*way)[1])).name;
      if (is_parallel(*axis, along)) return dot(*axis, along).value() > 0 ? q + " - " + p : p + " - " + q;
      if (both || !by_the_other || !is_square(*axis, along)) continue;
      // Of a cross: square to the other axis and to the link.
      const auto other = drawn_axis(index, 1 - which);
      if (!other || !is_square(*axis, *other)) continue;
      const std::string rewritten = axis_in_all_poses(index, 1 - which, false);
      const std::string words = rewritten.empty() ? words_of_axis(index, 1 - which) : rewritten;
      const bool same = dot(cross(*other, along), *axis).value() > 0;
      return (same ? "cross(" : "-cross(") + words + ", " + q + " - " + p + ")";
    }
    throw core::InputError(joint.where,
                           "the axis " +
                               std::string(both         ? ""
                                           : which == 0 ? "of the first link "
                                                        : "of the second link ") +
                               "of joint " + joint.name +
                               " turns with links whose orientation is not known: " + d_.name_of(holder),
                           "write it over points, such as axis: B - A or 'cross([0, 1, 0], B - A)'");
  }

  /// What is along the axis by which a link turns on the ground stands still, whatever decimals its points are drawn
  /// by.
  bool is_hinge_axis(LinkIndex link, const Amounts& axis) const {
    const auto hinge = hinge_of(link);
    return hinge && other_of(d_.joint(*hinge), link) == ground && is_parallel(axis, *drawn_axis(*hinge));
  }

  /// A link whose points all keep their own constructions, or are told by coordinates, keeps its axes as written too.
  bool keeps_constructions(LinkIndex link) const {
    if (link == ground) return false;
    const auto is_told = [&](PointIndex point) {
      return std::any_of(d_.coordinates.begin(), d_.coordinates.end(), [&](const DrawnCoordinate& coordinate) {
        return coordinate.kind == DrawnCoordinate::Kind::place && coordinate.point == point;
      });
    };
    const auto is_built = [&](PointIndex point) { return d_.at(point).built && d_.at(point).moves; };
    const auto& points = d_.link(link).points;
    return std::any_of(points.begin(), points.end(), is_built) &&
           std::all_of(points.begin(), points.end(), [&](PointIndex p) { return is_built(p) || is_told(p); });
  }

  std::string words_of_axis(JointIndex joint, std::size_t which) const {
    const std::string words = written_axis(joint, which);
    return words.front() == '[' ? words : "(" + words + ")";
  }
};

}  // namespace

FoundConstruction construct_in_space(const Drawing& drawing) { return SpatialConstruction(drawing).run(); }

}  // namespace clearloci::mechanism
