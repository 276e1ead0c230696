// The construction of a planar drawing, part by part: what a coordinate or two known points turn is oriented, a point
// is where two of the lines and circles meet on which its links keep it.
//
//   link with one known point P          circle about P                    R of RRR, RRP
//   link that slides on a known one      line along the guide              P of RRP, PRP
//   two pins and a guide between them    both links turn with P -> Q       RPR
#include <algorithm>
#include <cmath>

#include "mechanism/assembly/planar_groups.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

class PlanarConstruction : public PlanarGroups {
 public:
  using PlanarGroups::PlanarGroups;

 private:
  bool put_on_link(PointIndex point) override {
    for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l) {
      const auto link = static_cast<LinkIndex>(l);
      if (!has_point(link, point)) continue;
      const std::vector<PointIndex> bases = known_points(link);
      const Orientation* turn = orientation(link);
      if (turn == nullptr || bases.empty()) continue;
      const std::string comment = "a point of " + d_.link(link).name;
      if (turn->means == Means::points && bases.size() > 1) {
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

  /// Of gears whose centres move: what the drawing says.
  void write_distances() override {
    for (const DrawnMesh& mesh : d_.meshes)
      if (!mesh.joint.axes.empty() && mesh.joint.meshing->second && mesh.carrier != ground)
        found_.distances[mesh.written] =
            shape(mesh.carrier).distance(mesh.joint.meshing->first, *mesh.joint.meshing->second).text();
  }

  // --- axes

  void write_axes(JointIndex index) override {
    const Joint& joint = d_.joint(index);
    if (joint.axes.empty() || axis_stays(index)) return;
    const bool carried = is_slot(d_.mechanism, joint) || orientation(joint.from) != nullptr;
    const LinkIndex link = carried ? joint.from : joint.to;
    const auto axis = drawn_axis(index);
    if (orientation(link) == nullptr || !axis)
      throw core::InputError(
          joint.where,
          "the axis of joint " + joint.name + " is fixed in links whose direction is not known: " +
              d_.name_of(joint.from) + " and " + d_.name_of(joint.to),
          "write it from one point to another, such as axis: [A, B], or draw a second point of a link");
    const WrittenVector vector = image(link, *axis);
    if (vector.is_constant()) return;
    found_.axes[index] = {direction_from(handle(joint.at), vector, turned_in_posture(link, *axis), d_.name_of(link))};
  }
};

}  // namespace

FoundConstruction construct_in_plane(const Drawing& drawing) { return PlanarConstruction(drawing).run(); }

}  // namespace clearloci::mechanism
