// The construction of a planar drawing, part by part: what a coordinate or two known points turn is oriented, a point
// is where two of the lines and circles meet on which its links keep it.
//
//   link with one known point P          circle about P                    R of RRR, RRP
//   link that slides on a known one      line along the guide              P of RRP, PRP
//   two pins and a guide between them    both links turn with P -> Q       RPR
#include <algorithm>
#include <charconv>
#include <cmath>

#include "mechanism/assembly/planar_turning.hpp"
#include "mechanism/assembly/smallest_group.hpp"
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

  // --- points that close together

  /// A distance or a line that holds unknown points.
  struct Held {
    std::vector<PointIndex> points;
    std::string first, second;     ///< of a distance, by names
    std::string length;            ///< of a distance
    const Locus* locus = nullptr;  ///< what a point is held by that is known; else a distance or a line between points
    std::string along;             ///< of a line between points
  };
  struct Derived {
    PointIndex point = 0;
    std::vector<PointIndex> bases;
    Node form;
  };

  const std::string& name_of(PointIndex point) const {
    return is_known(point) ? known(handle(point)).name : d_.name(point);
  }

  /// Unknown points that more than one link has, or that something else holds.
  bool is_shared(PointIndex point) {
    if (is_known(point) || d_.at(point).built || !d_.at(point).has_place) return false;
    std::size_t links = 0;
    for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l)
      links += has_point(static_cast<LinkIndex>(l), point) ? 1 : 0;
    const auto& joints = d_.mechanism.joints;
    const bool is_joint =
        std::any_of(joints.begin(), joints.end(), [&](const Joint& joint) { return joint.at == point; });
    return links > 1 || is_joint || place_coordinate(point, 0) != nullptr || place_coordinate(point, 1) != nullptr;
  }

  bool put_group() override {
    enum class Use { free, base, derived };
    std::map<PointIndex, Use> use;
    std::vector<Derived> derived;
    std::vector<Held> held;
    std::vector<std::pair<std::size_t, LinkIndex>> links;  // those with most points first
    for (PointIndex p = 0; p < static_cast<PointIndex>(d_.points.size()); ++p)
      if (is_shared(p)) use[p] = Use::free;
    const auto shared_of = [&](LinkIndex link) {
      std::vector<PointIndex> points;
      for (const PointIndex p : d_.link(link).points)
        if (use.contains(p) && has_point(link, p)) points.push_back(p);
      return points;
    };
    for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l)
      if (const std::size_t own = shared_of(static_cast<LinkIndex>(l)).size(); own > 0)
        links.emplace_back(own, static_cast<LinkIndex>(l));
    std::stable_sort(links.begin(), links.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    const auto distance = [&](LinkIndex link, PointIndex a, PointIndex b) {
      Held own;
      for (const PointIndex p : {a, b})
        if (!is_known(p)) own.points.push_back(p);
      own.first = name_of(a);
      own.second = name_of(b);
      own.length = shape(link).distance(a, b).text();
      held.push_back(std::move(own));
    };
    const auto to_base = [&](PointIndex p) {
      if (auto own = use.find(p); own != use.end() && own->second == Use::free) own->second = Use::base;
    };
    for (const auto& [count, link] : links) {
      std::vector<PointIndex> points = shared_of(link);
      std::stable_sort(points.begin(), points.end(), [&](PointIndex a, PointIndex b) {
        return (use[a] == Use::free ? 1 : 0) < (use[b] == Use::free ? 1 : 0);
      });
      const bool turned = orientation(link) != nullptr;
      if (turned && !known_points(link).empty()) continue;
      if (!turned)
        if (const std::vector<PointIndex> bases = known_points(link); !bases.empty())
          points.insert(points.begin(), bases.front());
      const std::size_t fixed = turned ? 1 : 2;
      for (std::size_t k = 0; k < std::min(fixed, points.size()); ++k) to_base(points[k]);
      if (!turned && points.size() > 1) distance(link, points[0], points[1]);
      for (std::size_t k = fixed; k < points.size(); ++k) {
        const PointIndex p = points[k];
        if (use[p] == Use::free) {
          use[p] = Use::derived;
          Derived own{p, {points[0]}, {}};
          if (turned) {
            own.form = map({{"from", text(name_of(points[0]))},
                            {"by", vector_node(text_of(image_of_shape(link, shape(link).way(points[0], p)), 2))}});
          } else {
            own.bases.push_back(points[1]);
            const auto [along, beside] =
                parts(shape(link).way(points[0], p), shape(link).way(points[0], points[1]), false);
            own.form = map({{"on", list({name_of(points[0]), name_of(points[1])})},
                            {"offset", list({along.text(), beside.text()})}});
          }
          derived.push_back(std::move(own));
          continue;
        }
        if (turned) return false;  // a link that does not turn on its own, with two points that others place
        for (std::size_t i = 0; i < 2; ++i) distance(link, points[i], p);
      }
    }
    std::vector<std::vector<Locus>> by_point(use.size());
    std::size_t at = 0;
    for (const auto& own : use) {
      std::vector<Locus>& all = by_point[at++];
      for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l)
        if (const auto link = static_cast<LinkIndex>(l);
            has_point(link, own.first) && orientation(link) != nullptr && known_points(link).empty())
          add_lines(link, own.first, all);
      for (const Stroke& stroke : strokes_at(own.first)) add_leg(stroke, own.first, all);
      for (std::size_t axis = 0; axis < 2; ++axis)
        if (const DrawnCoordinate* c = place_coordinate(own.first, axis)) add_coordinate_line(own.first, axis, *c, all);
      for (const Locus& locus : all) {
        Held line;
        line.points = {own.first};
        line.locus = &locus;
        held.push_back(std::move(line));
      }
    }
    add_moving_guides(held);
    return put_smallest(
        use.size(),
        [&] {
          std::vector<PointIndex> all;
          for (const auto& own : use) all.push_back(own.first);
          return all;
        }(),
        derived, held);
  }

  /// A point that slides along the way between two points of a link that closes with it.
  void add_moving_guides(std::vector<Held>& held) {
    const double close = 1e-12 * d_.size / core::to_double(d_.unit);
    for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j) {
      const Joint& joint = d_.mechanism.joints[j];
      const auto axis = drawn_axis(static_cast<JointIndex>(j));
      if (!traits(joint).slides || !axis || joint.from == ground || joint.to == ground) continue;
      if (orientation(joint.from) != nullptr || orientation(joint.to) != nullptr || !d_.at(joint.at).is_exact) continue;
      for (const LinkIndex guide : {joint.from, joint.to}) {
        std::vector<PointIndex> on_line;
        for (const PointIndex p : d_.link(guide).points)
          if (p != joint.at && d_.at(p).is_exact &&
              size_of(cross(*axis, d_.at(p).at - d_.at(joint.at).at)) <= close * size_of(*axis))
            on_line.push_back(p);
        if (on_line.size() < 2) continue;
        Held line;
        for (const PointIndex p : {joint.at, on_line[0], on_line[1]})
          if (!is_known(p)) line.points.push_back(p);
        if (line.points.empty()) break;
        line.first = name_of(joint.at);
        line.second = name_of(on_line[0]);
        line.along = "[" + name_of(on_line[0]) + ", " + name_of(on_line[1]) + "]";
        held.push_back(std::move(line));
        break;
      }
    }
  }

  bool put_smallest(std::size_t, const std::vector<PointIndex>& points, const std::vector<Derived>& derived,
                    const std::vector<Held>& held) {
    const auto place = [&](PointIndex p) {
      return static_cast<std::size_t>(std::find(points.begin(), points.end(), p) - points.begin());
    };
    std::vector<bool> is_derived(points.size(), false);
    for (const Derived& own : derived) is_derived[place(own.point)] = true;
    // Derived points stand for those that they are built on.
    std::function<void(PointIndex, std::vector<std::size_t>&)> expand = [&](PointIndex p,
                                                                            std::vector<std::size_t>& into) {
      if (is_known(p)) return;
      const auto own =
          std::find_if(derived.begin(), derived.end(), [&](const Derived& other) { return other.point == p; });
      if (own == derived.end()) {
        if (place(p) < points.size()) into.push_back(place(p));
        return;
      }
      for (const PointIndex base : own->bases) expand(base, into);
    };
    std::vector<std::vector<std::size_t>> equations;
    for (const Held& own : held) {
      std::vector<std::size_t>& used = equations.emplace_back();
      for (const PointIndex p : own.points) expand(p, used);
      std::sort(used.begin(), used.end());
      used.erase(std::unique(used.begin(), used.end()), used.end());
    }
    const SmallestGroup group = smallest_group(points.size(), 2, equations);
    if (group.points.empty()) return false;
    write_group(group, points, derived, held, expand);
    return true;
  }

  template <class Expand>
  void write_group(const SmallestGroup& group, const std::vector<PointIndex>& points,
                   const std::vector<Derived>& derived, const std::vector<Held>& held, const Expand& expand) {
    std::vector<std::string> names;
    std::vector<PointIndex> placed;
    std::vector<std::pair<std::string, Node>> near;
    std::vector<std::pair<std::string, Node>> pose;
    for (std::size_t c = 0; c < d_.coordinates.size(); ++c) {
      const bool angle = d_.mechanism.coordinates[c].angle;
      const double value = drawn_value(c) / (angle ? 1 : core::to_double(d_.unit));
      pose.emplace_back(d_.coordinates[c].name, text(number_text(value) + (angle ? " rad" : "")));
    }
    near.emplace_back("at", map(pose));
    for (const std::size_t own : group.points) {
      const PointIndex p = points[own];
      names.push_back(d_.name(p));
      placed.push_back(p);
      const double unit = core::to_double(d_.unit);
      near.emplace_back(d_.name(p), list({number_text(d_.place(p)[0] / unit), number_text(d_.place(p)[1] / unit)}));
    }
    std::vector<std::pair<std::string, Node>> with, lengths, lines;
    for (const Derived& own : derived) {
      std::vector<std::size_t> used;
      for (const PointIndex base : own.bases) expand(base, used);
      if (!std::all_of(used.begin(), used.end(), [&](std::size_t p) {
            return std::find(group.points.begin(), group.points.end(), p) != group.points.end();
          }))
        continue;
      with.emplace_back(d_.name(own.point), own.form);
      placed.push_back(own.point);
    }
    for (const std::size_t e : group.equations) {
      const Held& own = held[e];
      if (own.locus != nullptr && own.locus->is_circle)
        lengths.emplace_back(known(own.locus->base()).name + "-" + d_.name(own.points.front()),
                             text(radius_of(*own.locus)));
      else if (own.locus != nullptr)
        lines.emplace_back(d_.name(own.points.front()), line(own.locus->base(), *own.locus));
      else if (own.along.empty())
        lengths.emplace_back(own.first + "-" + own.second, text(own.length));
      else
        lines.emplace_back(own.first, Node::sequence({text(own.second), vector_node(own.along)}, {}));
    }
    std::vector<std::pair<std::string, Node>> form = {{"group", list(names)}};
    if (!with.empty()) form.emplace_back("with", map(with));
    if (!lengths.empty()) form.emplace_back("lengths", map(lengths));
    if (!lines.empty()) form.emplace_back("lines", map(lines));
    form.emplace_back("near", map(near));
    std::string name = "group";
    for (const std::string& own : names) name += "_" + own;
    put_together(name.size() > 40 ? "group" : name, map(form), "close together", placed);
  }

  static std::string number_text(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
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
