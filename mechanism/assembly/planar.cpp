// The construction of a planar drawing, part by part: what a coordinate or two known points turn is oriented, a point
// is where two of the lines and circles meet on which its links keep it.
//
//   link with one known point P          circle about P                    R of RRR, RRP
//   link that slides on a known one      line along the guide              P of RRP, PRP
//   two pins and a guide between them    both links turn with P -> Q       RPR
#include <algorithm>
#include <cmath>

#include "mechanism/assembly/planar_turning.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

/// Where a link lets a point be.
struct Locus {
  bool is_circle = false;
  std::function<int()> base;  ///< the centre, or a point of the line
  Amount radius;
  std::string radius_text;  ///< of a motor's stroke; else empty
  std::string along;        ///< direction of a line
  std::array<double, 2> way{};
  LinkIndex link = ground;  ///< that it is of, if any
  std::string source;       ///< the link, guide or coordinate that it is of, for words and to tell two of them apart
};

class PlanarConstruction : public PlanarTurning {
 public:
  using PlanarTurning::PlanarTurning;

 private:
  bool put_on_link(PointIndex point) override {
    for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l) {
      const auto link = static_cast<LinkIndex>(l);
      if (!has_point(link, point)) continue;
      const std::vector<PointIndex> bases = known_points(link);
      const Orientation* own = orientation(link);
      if (own == nullptr || bases.empty()) continue;
      const std::string comment = "a point of " + d_.link(link).name;
      if (own->means == Means::points && bases.size() > 1) {
        const auto [along, beside] =
            parts(shape(link).way(bases[0], point), shape(link).way(bases[0], bases[1]), false);
        put(point,
            map({{"on", list({known(handle(bases[0])).name, known(handle(bases[1])).name})},
                 {"offset", list({along.text(), beside.text()})}}),
            comment);
        return true;
      }
      put_from(bases, point, comment,
               [&](PointIndex base) { return image_of_shape(link, shape(link).way(base, point)); });
      return true;
    }
    return false;
  }

  // --- circles and lines

  std::vector<Locus> loci(PointIndex point, int depth = 0) {
    std::vector<Locus> all;
    for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l) {
      const auto link = static_cast<LinkIndex>(l);
      if (!has_point(link, point)) continue;
      add_circle(link, point, all);
      if (orientation(link) != nullptr && known_points(link).empty()) {
        add_lines(link, point, all);
        if (depth == 0) add_translated(link, point, all);
      }
    }
    for (const Stroke& own : strokes_at(point)) add_leg(own, point, all);
    for (std::size_t axis = 0; axis < 2; ++axis)
      if (const DrawnCoordinate* own = place_coordinate(point, axis)) add_coordinate_line(point, axis, *own, all);
    return all;
  }

  void add_circle(LinkIndex link, PointIndex point, std::vector<Locus>& all) {
    if (orientation(link) != nullptr) return;
    const std::vector<PointIndex> bases = known_points(link);
    if (bases.size() != 1 || !is_apart(bases[0], point)) return;
    Locus own;
    own.is_circle = true;
    own.base = [this, base = bases[0]] { return handle(base); };
    own.radius = shape(link).distance(bases[0], point);
    own.link = link;
    own.source = d_.link(link).name;
    all.push_back(std::move(own));
  }

  /// A leg whose motor says how long it is.
  void add_leg(const Stroke& own, PointIndex point, std::vector<Locus>& all) {
    if (!own.origin || is_turned(own.base)) return;
    const Amounts way = d_.at(point).at - d_.at(*own.origin).at;
    if (std::abs(cross(own.axis, way)[2].value()) > 1e-12 * size_of(own.axis) * size_of(way)) return;
    Locus locus;
    locus.is_circle = true;
    locus.base = [this, origin = *own.origin] { return handle(origin); };
    locus.radius_text = own.coordinate->name;
    locus.source = d_.joint(own.joint).name;
    all.push_back(std::move(locus));
  }

  void add_coordinate_line(PointIndex point, std::size_t axis, const DrawnCoordinate& own, std::vector<Locus>& all) {
    Locus line;
    line.along = axis == 0 ? "[0, 1]" : "[1, 0]";
    line.way = axis == 0 ? std::array<double, 2>{0, 1} : std::array<double, 2>{1, 0};
    line.source = own.name;
    line.base = [this, point, axis, name = own.name] {
      WrittenVector place;
      place.components[axis].push_back({one_, name});
      std::array<double, 3> posture{};
      posture[axis] = d_.place(point)[axis];
      return put_extra(d_.name(point) + "_" + name, explicit_form(place), posture, "", place);
    };
    all.push_back(std::move(line));
  }

  /// Lines along the guides of a link that turns as a known one does.
  void add_lines(LinkIndex link, PointIndex point, std::vector<Locus>& all) {
    for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j) {
      const Joint& joint = d_.mechanism.joints[j];
      if (!slides(joint, link)) continue;
      const LinkIndex guide = other_of(joint, link);
      const auto axis = drawn_axis(static_cast<JointIndex>(j));
      // The joint's own point stays on the guide where lengths are given that beat the drawing.
      const PointIndex on_guide = !shape(link).is_drawn() && shape(link).has(joint.at) ? joint.at : point;
      if (!is_placed(guide) || !axis || !d_.at(on_guide).is_exact) continue;
      Locus line;
      line.way = turned_in_posture(guide, *axis);
      line.link = link;
      line.source = "guide " + joint.name;
      line.along = axis_text(static_cast<JointIndex>(j), guide, *axis);
      line.base = [this, link, guide, point, on_guide, axis = *axis, name = joint.name] {
        const Handle base = base_of_line(guide, on_guide, axis, name);
        return on_guide == point ? base : carried_along(link, base, on_guide, point);
      };
      all.push_back(std::move(line));
    }
  }

  std::array<double, 2> turned_in_posture(LinkIndex guide, const Amounts& axis) const {
    const std::array<double, 2> drawn = {axis[0].value(), axis[1].value()};
    const std::vector<PointIndex> points = guide == ground ? std::vector<PointIndex>{} : known_points(guide);
    if (points.size() < 2 || !d_.at(points[0]).is_exact || !d_.at(points[1]).is_exact) return drawn;
    // Lengths that are given may have turned it from where it is drawn.
    const Amounts was = d_.at(points[1]).at - d_.at(points[0]).at;
    const auto &p = d_.place(points[0]), &q = d_.place(points[1]);
    const double x = was[0].value(), y = was[1].value(), u = q[0] - p[0], v = q[1] - p[1];
    const double size = std::hypot(x, y) * std::hypot(u, v);
    const double c = (x * u + y * v) / size, s = (x * v - y * u) / size;
    return {c * drawn[0] - s * drawn[1], s * drawn[0] + c * drawn[1]};
  }

  std::string axis_text(JointIndex joint, LinkIndex guide, const Amounts& axis) {
    if (guide == ground && !d_.axes[static_cast<std::size_t>(joint)].empty()) return written_axis(joint);
    return text_of(image(guide, axis), 2);
  }

  /// What keeps a point of a link that does not turn on its own, for another one.
  Handle carried_along(LinkIndex link, Handle from, PointIndex other, PointIndex point) {
    const WrittenVector by = image_of_shape(link, shape(link).way(other, point));
    std::optional<WrittenVector> place;
    const Node form = form_at(from, by, place);
    std::array<double, 3> posture = known(from).posture;
    for (std::size_t i = 0; i < 2; ++i) posture[i] += d_.place(point)[i] - d_.place(other)[i];
    return put_extra(known(from).name + "_" + d_.name(point), form, posture, "carried along by " + d_.link(link).name,
                     std::move(place));
  }

  /// A link that does not turn on its own carries what keeps its other points over to this one.
  void add_translated(LinkIndex link, PointIndex point, std::vector<Locus>& all) {
    for (const PointIndex other : d_.link(link).points) {
      if (other == point || is_known(other) || !shape(link).has(other) || d_.at(other).built) continue;
      for (Locus& own : loci(other, 1)) {
        if (own.link == link) continue;
        own.base = [this, link, base = own.base, point, other] { return carried_along(link, base(), other, point); };
        all.push_back(std::move(own));
      }
    }
  }

  /// A joint at the point goes from one of its links to the other, and so does the dyad; else they go as in the file.
  bool comes_first(PointIndex point, const Locus& one, const Locus& other) const {
    const auto& joints = d_.mechanism.joints;
    return one.link != ground && other.link != ground &&
           std::any_of(joints.begin(), joints.end(), [&](const Joint& joint) {
             return joint.at == point && joint.from == one.link && joint.to == other.link;
           });
  }

  bool put_where_loci_meet(PointIndex point) override {
    const std::vector<Locus> all = loci(point);
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t k = i + 1; k < all.size(); ++k)
        if (all[i].source != all[k].source &&
            (comes_first(point, all[k], all[i]) ? meet(point, all[k], all[i]) : meet(point, all[i], all[k])))
          return true;
    return false;
  }

  bool meet(PointIndex point, const Locus& a, const Locus& b) {
    const std::string comment = "where " + a.source + " and " + b.source + " meet";
    if (!a.is_circle && !b.is_circle) {
      if (std::abs(a.way[0] * b.way[1] - a.way[1] * b.way[0]) <=
          1e-9 * std::hypot(a.way[0], a.way[1]) * std::hypot(b.way[0], b.way[1]))
        return false;
      const Handle first = a.base(), second = b.base();
      put(point, map({{"crossing", Node::sequence({line(first, a), line(second, b)}, {})}}), comment);
      return true;
    }
    if (a.is_circle != b.is_circle) {
      put_slider(point, a.is_circle ? b : a, a.is_circle ? a : b, comment);
      return true;
    }
    const Handle from = a.base(), to = b.base();
    require_place(from);
    require_place(to);
    const auto &p = known(from).posture, &q = known(to).posture, &r = d_.place(point);
    const double size = std::hypot(q[0] - p[0], q[1] - p[1]) * std::hypot(r[0] - p[0], r[1] - p[1]);
    if (!(std::hypot(q[0] - p[0], q[1] - p[1]) > 1e-9 * d_.size)) return false;
    const double turn = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    if (std::abs(turn) <= 1e-9 * size) refuse_stretched(point, a.source, b.source);
    put(point,
        map({{"dyad", list({known(from).name, known(to).name})},
             {"lengths", list({radius_of(a), radius_of(b)})},
             {"side", text(turn > 0 ? "left" : "right")}}),
        comment);
    return true;
  }

  static std::string radius_of(const Locus& circle) {
    return circle.radius_text.empty() ? circle.radius.text() : circle.radius_text;
  }

  Node line(Handle base, const Locus& own) const {
    return Node::sequence({text(known(base).name), vector_node(own.along)}, {});
  }

  void put_slider(PointIndex point, const Locus& guide, const Locus& circle, const std::string& comment) {
    const Handle base = guide.base(), from = circle.base();
    require_place(from);
    const auto &c = known(from).posture, &r = d_.place(point);
    const double along = (r[0] - c[0]) * guide.way[0] + (r[1] - c[1]) * guide.way[1];
    if (std::abs(along) <= 1e-9 * std::hypot(guide.way[0], guide.way[1]) * std::hypot(r[0] - c[0], r[1] - c[1]))
      refuse_stretched(point, guide.source, circle.source);
    put(point,
        map({{"slider", line(base, guide)},
             {"from", text(known(from).name)},
             {"length", text(radius_of(circle))},
             {"side", text(along > 0 ? "ahead" : "behind")}}),
        comment);
  }

  // --- axes

  void write_axes(JointIndex index) override {
    const Joint& joint = d_.joint(index);
    if (joint.axes.empty() || axis_stays(index)) return;
    const LinkIndex link = orientation(joint.from) != nullptr ? joint.from : joint.to;
    const auto axis = drawn_axis(index);
    if (orientation(link) == nullptr || !axis)
      throw core::InputError(
          joint.where,
          "the axis of joint " + joint.name + " is fixed in links whose direction is not known: " +
              d_.name_of(joint.from) + " and " + d_.name_of(joint.to),
          "write it from one point to another, such as axis: [A, B], or draw a second point of a link");
    const WrittenVector own = image(link, *axis);
    if (own.is_constant()) return;
    found_.axes[index] = {text_of(own, 2)};
  }
};

}  // namespace

FoundConstruction construct_in_plane(const Drawing& drawing) { return PlanarConstruction(drawing).run(); }

}  // namespace clearloci::mechanism
