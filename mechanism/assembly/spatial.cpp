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

#include "mechanism/assembly/construction.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

constexpr double aligned = 1e-9;  // of vectors' lengths: what a drawing means to be parallel or square

/// The same of drawn decimals that stand for irrational places, where a length is given besides.
constexpr double meant = 1e-6;

bool is_parallel(const Amounts& a, const Amounts& b) {
  return size_of(cross(a, b)) <= aligned * size_of(a) * size_of(b);
}
bool is_square(const Amounts& a, const Amounts& b) {
  return std::abs(dot(a, b).value()) <= aligned * size_of(a) * size_of(b);
}

/// Three vectors that turn with a link, as drawn and as written; any other is a sum of them.
struct Triad {
  std::array<Amounts, 3> drawn;
  std::array<WrittenVector, 3> written;
};

/// The orientation of a link: a triad, or the points of a frame of the file.
struct Attitude {
  std::optional<Triad> triad;  ///< none: not turned from the drawing, or by a frame
  std::string frame;           ///< of the file; else empty
  int origin = -1;             ///< handle of the frame's
  bool by_shape = false;       ///< the triad is of the link's shape alone
};

struct SpaceLocus {
  enum class Kind { sphere, circle, line } kind = Kind::sphere;
  std::function<int()> base;  ///< the centre, or a point of the line
  std::string radius;
  std::string axis;   ///< of a circle, along a line
  Amounts direction;  ///< the same as drawn
  std::string source;
};

class SpatialConstruction : public Construction {
 public:
  explicit SpatialConstruction(const Drawing& drawing)
      : Construction(drawing), attitudes_(drawing.mechanism.links.size()), one_(core::Rational(1)) {}

  FoundConstruction run() {
    while (!is_complete()) {
      while (turn_one()) {
      }
      if (!place_one()) refuse_rest(d_, open_links());
    }
    while (turn_one()) {
    }
    for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j) write_axes(static_cast<JointIndex>(j));
    return std::move(found_);
  }

 private:
  using Kind = SpaceLocus::Kind;

  bool is_turned(LinkIndex link) const {
    return link == ground || attitudes_[static_cast<std::size_t>(link)].has_value();
  }
  bool is_placed(LinkIndex link) const { return link == ground || (is_turned(link) && !known_points(link).empty()); }
  static LinkIndex other_of(const Joint& joint, LinkIndex link) { return joint.from == link ? joint.to : joint.from; }
  bool joins(const Joint& joint, LinkIndex link) const { return joint.from == link || joint.to == link; }

  // --- vectors that turn with a link

  static std::array<Amount, 3> parts(const Amounts& v, const std::array<Amounts, 3>& base) {
    const Amount volume = dot(base[0], cross(base[1], base[2]));
    return {dot(v, cross(base[1], base[2])) / volume, dot(v, cross(base[2], base[0])) / volume,
            dot(v, cross(base[0], base[1])) / volume};
  }

  /// v as drawn (by shape: of the link's shape).
  WrittenVector image(LinkIndex link, const Amounts& v) {
    if (link == ground) return constant_vector(v);
    const Attitude& own = *attitudes_[static_cast<std::size_t>(link)];
    if (own.triad) {
      const std::array<Amount, 3> part = parts(v, own.triad->drawn);
      WrittenVector result;
      for (std::size_t i = 0; i < 3; ++i) result += part[i] * own.triad->written[i];
      return result;
    }
    if (own.frame.empty()) return constant_vector(v);
    return way_between(known(own.origin).name, in_frame(own, v));
  }

  /// A cross product of two ways is a length more than a way: over one, in the file's units.
  Amount per_length() const { return Amount(1 / d_.unit); }

  /// A vector as an axis: components, a sum of ways, or else the way to a point that is put at it.
  std::string direction_text(LinkIndex link, const Amounts& v) {
    const WrittenVector vector = image(link, v);
    const bool mixed =
        !std::all_of(vector.components.begin(), vector.components.end(), [](const Terms& t) { return t.empty(); });
    const bool crossed = std::any_of(vector.ways.begin(), vector.ways.end(),
                                     [](const Term& own) { return own.factor.find("cross") != std::string::npos; });
    if (vector.ways.empty() || (!mixed && !crossed)) return text_of(vector, 3);
    const PointIndex base = known_points(link).front();
    const std::string key = std::to_string(link) + " " + v[0].text() + " " + v[1].text() + " " + v[2].text();
    auto found = extras_.find(key);
    if (found == extras_.end()) {
      std::array<double, 3> posture = d_.place(base);
      for (std::size_t i = 0; i < 3; ++i) posture[i] += v[i].value() * core::to_double(d_.unit);
      std::optional<WrittenVector> place;
      const Node form = form_at(handle(base), vector, place);
      const Handle end = put_extra(d_.link(link).name + "_axis", form, posture, "a direction of " + d_.link(link).name,
                                   std::move(place));
      found = extras_.emplace(key, known(end).name).first;
    }
    return found->second + " - " + known(handle(base)).name;
  }

  /// A point of the frame at a way from its origin.
  std::string in_frame(const Attitude& own, const Amounts& way) {
    const std::string key = own.frame + " " + way[0].text() + " " + way[1].text() + " " + way[2].text();
    const auto found = extras_.find(key);
    if (found != extras_.end()) return found->second;
    std::array<double, 3> posture = known(own.origin).posture;
    for (std::size_t i = 0; i < 3; ++i) posture[i] += way[i].value() * core::to_double(d_.unit);
    const Handle handle = put_extra(own.frame + "_to", frame_form(own, way), posture, "a direction of " + own.frame);
    return extras_.emplace(key, known(handle).name).first->second;
  }
  Node frame_form(const Attitude& own, const Amounts& way) const {
    return map({{"in", text(own.frame)}, {"place", list({way[0].text(), way[1].text(), way[2].text()})}});
  }

  // --- orientations

  bool turn_one() {
    for (std::size_t l = 0; l < attitudes_.size(); ++l)
      if (!attitudes_[l] && turn(static_cast<LinkIndex>(l))) return true;
    return false;
  }

  bool turn(LinkIndex link) {
    return turn_by_frame(link) || turn_by_guide(link) || turn_by_angle(link) || turn_by_points(link) ||
           turn_by_axis(link);
  }

  void set(LinkIndex link, Attitude attitude) { attitudes_[static_cast<std::size_t>(link)] = std::move(attitude); }

  /// Its angles in some order, at a point whose coordinates are written out.
  bool turn_by_frame(LinkIndex link) {
    std::array<const DrawnCoordinate*, 3> angles{};
    for (const DrawnCoordinate& own : d_.coordinates)
      if (own.kind == DrawnCoordinate::Kind::turn && own.link == link) angles[own.axis] = &own;
    if (angles[0] == nullptr && angles[1] == nullptr && angles[2] == nullptr) return false;
    const std::vector<PointIndex> points = known_points(link);
    const auto origin =
        std::find_if(points.begin(), points.end(), [&](PointIndex p) { return known(handle(p)).place.has_value(); });
    if (origin == points.end() || !shape(link).is_drawn()) return false;
    std::string order;
    std::map<char, std::string> by_axis;
    for (std::size_t i = 0; i < 3; ++i)
      if (angles[i] != nullptr) order = angles[i]->order;
    for (std::size_t i = 0; i < 3; ++i) by_axis[order[i]] = angles[i] != nullptr ? angles[i]->name : "0";
    Attitude own;
    own.frame = new_name(d_.link(link).name + "_frame");
    own.origin = handle(*origin);
    found_.frames.push_back({own.frame,
                             map({{"at", text(known(own.origin).name)},
                                  {"turned", list({by_axis['x'], by_axis['y'], by_axis['z']})},
                                  {"order", text(order)}}),
                             ""});
    set(link, std::move(own));
    return true;
  }

  bool turn_by_guide(LinkIndex link) {
    for (const Joint& joint : d_.mechanism.joints) {
      if (joint.type != JointType::prismatic || !joins(joint, link)) continue;
      const LinkIndex guide = other_of(joint, link);
      if (!is_turned(guide) || !shape(link).is_drawn()) continue;
      Attitude own;
      if (guide != ground) own = *attitudes_[static_cast<std::size_t>(guide)];
      if (own.by_shape) continue;
      set(link, std::move(own));
      return true;
    }
    return false;
  }

  /// The revolute joint by which a link turns about a known one.
  std::optional<JointIndex> hinge_of(LinkIndex link) const {
    for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j) {
      const Joint& joint = d_.mechanism.joints[j];
      if (joint.type == JointType::revolute && joins(joint, link) && is_turned(other_of(joint, link)) &&
          drawn_axis(static_cast<JointIndex>(j)))
        return static_cast<JointIndex>(j);
    }
    return std::nullopt;
  }

  /// The angle about its axis, 0 as drawn: v = (n.v) n + cos(angle) v' + sin(angle) n x v.
  bool turn_by_angle(LinkIndex link) {
    if (!shape(link).is_drawn()) return false;
    for (const DrawnCoordinate& c : d_.coordinates) {
      if (c.kind != DrawnCoordinate::Kind::direction || (c.link != link && c.other != link)) continue;
      for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j) {
        const Joint& joint = d_.mechanism.joints[j];
        const LinkIndex base = other_of(joint, link);
        if (joint.type != JointType::revolute || !joins(joint, link) || !is_turned(base)) continue;
        if (c.other != ground && base != (c.link == link ? c.other : c.link)) continue;
        const auto axis = drawn_axis(static_cast<JointIndex>(j));
        if (!axis) continue;
        const Amounts n = (one_ / length(*axis)) * *axis;
        const bool forward = joint.to == link;
        Triad triad;
        for (std::size_t i = 0; i < 3; ++i) {
          Amounts v;
          v[i] = one_;
          triad.drawn[i] = v;
          const Amounts along = (dot(*axis, v) / dot(*axis, *axis)) * *axis, beside = v - along,
                        across = (forward ? one_ : -one_) * cross(n, v);
          triad.written[i] = image(base, along) + times("cos(" + c.name + ")", image(base, beside)) +
                             times("sin(" + c.name + ")", image(base, across));
        }
        Attitude own;
        own.triad = std::move(triad);
        set(link, std::move(own));
        return true;
      }
    }
    return false;
  }

  bool turn_by_points(LinkIndex link) {
    const std::vector<PointIndex> points = known_points(link);
    for (std::size_t k = 2; k < points.size(); ++k) {
      const Amounts a = shape(link).way(points[0], points[1]), b = shape(link).way(points[0], points[k]);
      if (is_parallel(a, b)) continue;
      const std::string p = known(handle(points[0])).name, q = known(handle(points[1])).name,
                        r = known(handle(points[k])).name;
      Triad triad;
      triad.drawn = {a, b, cross(a, b)};
      triad.written = {way_between(p, q), way_between(p, r), WrittenVector{}};
      triad.written[2].ways.push_back({per_length(), "cross(" + q + " - " + p + ", " + r + " - " + p + ")"});
      Attitude own;
      own.triad = std::move(triad);
      own.by_shape = !shape(link).is_drawn();
      set(link, std::move(own));
      return true;
    }
    return false;
  }

  /// The axis about which it turns on a known link, and a way that is not along it.
  bool turn_by_axis(LinkIndex link) {
    const auto hinge = hinge_of(link);
    const std::vector<PointIndex> points = known_points(link);
    if (!hinge || points.size() < 2) return false;
    const Amounts n = *drawn_axis(*hinge);
    for (std::size_t k = 1; k < points.size(); ++k) {
      if (!d_.at(points[0]).is_exact || !d_.at(points[k]).is_exact) continue;
      const Amounts way = d_.at(points[k]).at - d_.at(points[0]).at;
      if (is_parallel(n, way)) continue;
      const std::string p = known(handle(points[0])).name, q = known(handle(points[k])).name;
      Triad triad;
      triad.drawn = {n, way, cross(n, way)};
      const std::string axis = direction_text(other_of(d_.joint(*hinge), link), n);
      const Amount drawn_part =
          shape(link).is_drawn() ? one_ : length(way) / shape(link).distance(points[0], points[k]);
      triad.written = {WrittenVector{}, drawn_part * way_between(p, q), WrittenVector{}};
      if (axis.front() == '[')
        triad.written[0] = image(other_of(d_.joint(*hinge), link), n);
      else
        triad.written[0].ways.push_back({one_, "(" + axis + ")"});
      triad.written[2].ways.push_back({drawn_part * per_length(), "cross(" + axis + ", " + q + " - " + p + ")"});
      Attitude own;
      own.triad = std::move(triad);
      set(link, std::move(own));
      return true;
    }
    return false;
  }

  // --- points

  bool place_one() {
    const auto count = static_cast<PointIndex>(d_.points.size());
    for (PointIndex point = 0; point < count; ++point)
      if (!is_known(point) && place(point)) return true;
    return false;
  }

  bool place(PointIndex point) {
    if (put_given(point)) return true;
    if (d_.at(point).built) return false;
    return put_by_coordinates(point) || put_on_link(point) || put_by_stroke(point) || put_where_loci_meet(point);
  }

  bool put_by_coordinates(PointIndex point) {
    WrittenVector place;
    for (const DrawnCoordinate& own : d_.coordinates)
      if (own.kind == DrawnCoordinate::Kind::place && own.point == point)
        place.components[own.axis].push_back({one_, own.name});
    if (std::any_of(place.components.begin(), place.components.end(), [](const Terms& t) { return t.empty(); }))
      return false;
    put(point, explicit_form(place), "", place);
    return true;
  }

  bool put_on_link(PointIndex point) {
    for (std::size_t l = 0; l < attitudes_.size(); ++l) {
      const auto link = static_cast<LinkIndex>(l);
      const auto& points = d_.link(link).points;
      if (std::find(points.begin(), points.end(), point) == points.end() || !shape(link).has(point)) continue;
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
      const Attitude& own = *attitudes_[l];
      if (own.triad && !own.by_shape && !shape(link).is_drawn()) refuse_about_axis(link, point);
      if (!own.frame.empty()) {
        for (const PointIndex base : bases)
          if (handle(base) == own.origin) {
            put(point, frame_form(own, shape(link).way(base, point)), comment);
            return true;
          }
      }
      PointIndex base = bases.front();
      for (const PointIndex other : bases)
        if (known(handle(other)).place) {
          base = other;
          break;
        }
      std::optional<WrittenVector> place;
      const Node form = form_at(handle(base), image(link, shape(link).way(base, point)), place);
      put(point, form, comment, std::move(place));
      return true;
    }
    return false;
  }

  /// Lengths fix a shape, and not where an axis passes it.
  [[noreturn]] void refuse_about_axis(LinkIndex link, PointIndex point) const {
    throw core::InputError(d_.link(link).where,
                           "the lengths of link " + d_.link(link).name + " do not tell how " + d_.name(point) +
                               " lies about the axis of its joint",
                           "give none, for the shape that is drawn, or write a construction of " + d_.name(point));
  }

  struct Stroke {
    const DrawnCoordinate* coordinate = nullptr;
    LinkIndex carried = ground, base = ground;
    std::optional<PointIndex> origin;
    Amounts axis;
  };
  std::vector<Stroke> strokes_at(PointIndex point) const {
    std::vector<Stroke> all;
    for (const DrawnCoordinate& own : d_.coordinates) {
      if (own.kind != DrawnCoordinate::Kind::stroke || d_.joint(own.joint).at != point) continue;
      const Joint& joint = d_.joint(own.joint);
      const auto axis = drawn_axis(own.joint);
      if (!axis || !d_.at(point).is_exact) continue;
      const bool to_holds = joint.to != ground && is_on_link(d_.mechanism, joint.at, joint.to);
      Stroke stroke{&own, to_holds ? joint.to : joint.from, ground, {}, *axis};
      stroke.base = other_of(joint, stroke.carried);
      if (stroke.base != ground) stroke.origin = d_.link(stroke.base).points.front();
      if (!stroke.origin || (is_known(*stroke.origin) && d_.at(*stroke.origin).is_exact))
        all.push_back(std::move(stroke));
    }
    return all;
  }

  bool put_by_stroke(PointIndex point) {
    for (const Stroke& own : strokes_at(point)) {
      if (!is_placed(own.base)) continue;
      const Amounts unit = (one_ / length(own.axis)) * own.axis;
      const Amounts way = own.origin ? d_.at(point).at - d_.at(*own.origin).at : d_.at(point).at;
      const Amounts beside = way - (dot(way, own.axis) / dot(own.axis, own.axis)) * own.axis;
      const WrittenVector by = image(own.base, beside) + times(own.coordinate->name, image(own.base, unit));
      const std::string comment = "out by " + own.coordinate->name;
      if (own.origin) {
        std::optional<WrittenVector> place;
        const Node form = form_at(handle(*own.origin), by, place);
        put(point, form, comment, std::move(place));
      } else {
        put(point, explicit_form(by), comment, by);
      }
      return true;
    }
    return false;
  }

  // --- spheres, circles and lines

  std::vector<SpaceLocus> loci(PointIndex point) {
    std::vector<SpaceLocus> all;
    for (std::size_t l = 0; l < attitudes_.size(); ++l) {
      const auto link = static_cast<LinkIndex>(l);
      const auto& points = d_.link(link).points;
      if (std::find(points.begin(), points.end(), point) == points.end() || !shape(link).has(point)) continue;
      if (is_turned(link)) {
        if (known_points(link).empty()) add_line(link, point, all);
        continue;
      }
      if (!add_circle(link, point, all)) add_sphere(link, point, all);
    }
    for (const Stroke& own : strokes_at(point))
      if (own.origin && !is_turned(own.base) && is_parallel(own.axis, d_.at(point).at - d_.at(*own.origin).at)) {
        SpaceLocus leg;
        leg.base = [this, origin = *own.origin] { return handle(origin); };
        leg.radius = own.coordinate->name;
        leg.source = own.coordinate->name;
        all.push_back(std::move(leg));
      }
    return all;
  }

  void add_sphere(LinkIndex link, PointIndex point, std::vector<SpaceLocus>& all) {
    const std::vector<PointIndex> bases = known_points(link);
    if (bases.empty() || !is_apart(bases[0], point)) return;
    SpaceLocus own;
    own.base = [this, base = bases[0]] { return handle(base); };
    own.radius = shape(link).distance(bases[0], point).text();
    own.source = d_.link(link).name;
    all.push_back(std::move(own));
  }

  /// About the axis of a hinge on a known link, or about two known points of the link.
  bool add_circle(LinkIndex link, PointIndex point, std::vector<SpaceLocus>& all) {
    SpaceLocus own;
    own.kind = Kind::circle;
    own.source = d_.link(link).name;
    const std::vector<PointIndex> bases = known_points(link);
    if (const auto hinge = hinge_of(link);
        hinge && is_known(d_.joint(*hinge).at) && turns_with_drawing(link, *hinge, point)) {
      const PointIndex at = d_.joint(*hinge).at;
      own.direction = *drawn_axis(*hinge);
      const LinkIndex base = other_of(d_.joint(*hinge), link);
      own.axis = base == ground ? written_axis(*hinge) : direction_text(base, own.direction);
      if (!shape(link).is_drawn()) {
        own.radius = shape(link).distance(at, point).text();
        own.base = [this, at] { return handle(at); };
      } else {
        set_circle(own, at, d_.at(point).at - d_.at(at).at,
                   [this, base, at](const Amounts& along) { return shifted(at, image(base, along), along); });
      }
    } else if (bases.size() > 1) {
      const std::string p = known(handle(bases[0])).name, q = known(handle(bases[1])).name;
      own.direction = shape(link).way(bases[0], bases[1]);
      own.axis = q + " - " + p;
      set_circle(own, bases[0], shape(link).way(bases[0], point),
                 [this, p, q, at = bases[0], axis = own.direction](const Amounts& along) {
                   const Amount part = dot(along, axis) / dot(axis, axis);
                   return shifted(at, part * way_between(p, q), along);
                 });
    } else {
      return false;
    }
    all.push_back(std::move(own));
    return true;
  }

  /// Whether the circle of a point about a hinge is told: of lengths that are given where it lies across the axis.
  bool turns_with_drawing(LinkIndex link, JointIndex hinge, PointIndex point) const {
    const PointIndex at = d_.joint(hinge).at;
    if (!d_.at(at).is_exact || !d_.at(point).is_exact) return false;
    if (shape(link).is_drawn()) return true;
    const Amounts axis = *drawn_axis(hinge), way = d_.at(point).at - d_.at(at).at;
    return shape(link).has(at) && shape(link).has(point) &&
           std::abs(dot(axis, way).value()) <= meant * size_of(axis) * size_of(way);
  }

  std::string written_axis(JointIndex joint) const {
    const Node& written = d_.axes[static_cast<std::size_t>(joint)].front();
    if (written.IsScalar()) return written.Scalar();
    std::string words;
    for (const Node& item : written.items()) words += (words.empty() ? "[" : ", ") + item.Scalar();
    return words + "]";
  }

  template <typename Shift>
  void set_circle(SpaceLocus& own, PointIndex at, const Amounts& way, const Shift& shift) {
    const Amounts along = (dot(way, own.direction) / dot(own.direction, own.direction)) * own.direction;
    own.radius = length(way - along).text();
    const bool in_plane = size_of(along) <= aligned * size_of(way);
    own.base = [this, at, along, shift, in_plane] { return in_plane ? handle(at) : shift(along); };
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

  Handle base_of_line(LinkIndex guide, PointIndex point, const Amounts& axis, const std::string& joint) {
    const auto on_line = [&](PointIndex other) {
      return other != point && is_known(other) && d_.at(other).is_exact &&
             (!is_apart(other, point) || is_parallel(axis, d_.at(other).at - d_.at(point).at));
    };
    if (guide == ground) {
      for (PointIndex other = 0; other < static_cast<PointIndex>(d_.points.size()); ++other)
        if (fixed_[static_cast<std::size_t>(other)] && on_line(other)) return handle(other);
      const WrittenVector place = constant_vector(d_.at(point).at);
      return put_extra(d_.name(point) + "_guide", explicit_form(place), d_.place(point), "on the guide of " + joint,
                       place);
    }
    for (const PointIndex other : known_points(guide))
      if (on_line(other)) return handle(other);
    const PointIndex base = known_points(guide).front();
    std::optional<WrittenVector> place;
    const Node form = form_at(handle(base), image(guide, d_.at(point).at - d_.at(base).at), place);
    return put_extra(d_.name(point) + "_guide", form, d_.place(point), "on the guide of " + joint, std::move(place));
  }

  bool put_where_loci_meet(PointIndex point) {
    const std::vector<SpaceLocus> all = loci(point);
    for (const SpaceLocus& first : all)
      for (const SpaceLocus& second : all)
        if (first.kind != Kind::sphere && second.source != first.source && meet(point, first, second)) return true;
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
      if (std::abs(ahead) <= aligned * std::sqrt(product(rod, rod) * product(n, n)))
        refuse_stretched(point, first, sphere);
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
    if (std::abs(turn) <= aligned * std::sqrt(product(n, n) * product(way, way) * product(arm, arm)))
      refuse_stretched(point, first, sphere);
    put(point,
        map({{"dyad", list({known(base).name, known(from).name})},
             {"lengths", list({first.radius, sphere.radius})},
             {"axis", vector_node(first.axis)},
             {"side", text(turn > 0 ? "left" : "right")}}),
        comment);
    return true;
  }

  [[noreturn]] void refuse_stretched(PointIndex point, const SpaceLocus& a, const SpaceLocus& b) const {
    throw core::InputError(d_.mechanism.points[static_cast<std::size_t>(point)].where,
                           "point " + d_.name(point) + " is drawn where " + a.source + " and " + b.source +
                               " are at the end of their reach, which chooses no side",
                           "draw the mechanism in another posture");
  }

  // --- axes

  /// Two points between which a link, or the leg that it is a part of, goes.
  std::optional<std::array<PointIndex, 2>> way_of(LinkIndex link) const {
    const std::vector<PointIndex> own = known_points(link);
    if (own.size() > 1) return std::array<PointIndex, 2>{own[0], own[1]};
    for (const Joint& joint : d_.mechanism.joints) {
      if (!traits(joint).slides || !joins(joint, link) || own.empty()) continue;
      const std::vector<PointIndex> there = known_points(other_of(joint, link));
      if (!there.empty() && is_apart(own[0], there[0])) return std::array<PointIndex, 2>{own[0], there[0]};
    }
    return std::nullopt;
  }

  void write_axes(JointIndex index) {
    const Joint& joint = d_.joint(index);
    std::vector<std::string> written(joint.axes.size());
    for (std::size_t which = 0; which < joint.axes.size(); ++which) written[which] = axis_in_all_poses(index, which);
    if (std::any_of(written.begin(), written.end(), [](const std::string& own) { return !own.empty(); }))
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
      if (!is_turned(link) || (attitudes_[static_cast<std::size_t>(link)]->by_shape)) continue;
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
      return std::any_of(d_.coordinates.begin(), d_.coordinates.end(), [&](const DrawnCoordinate& own) {
        return own.kind == DrawnCoordinate::Kind::place && own.point == point;
      });
    };
    const auto is_built = [&](PointIndex point) { return d_.at(point).built && d_.at(point).moves; };
    const auto& points = d_.link(link).points;
    return std::any_of(points.begin(), points.end(), is_built) &&
           std::all_of(points.begin(), points.end(), [&](PointIndex p) { return is_built(p) || is_told(p); });
  }

  std::string words_of_axis(JointIndex joint, std::size_t which) const {
    const Node& written = d_.axes[static_cast<std::size_t>(joint)][which];
    if (written.IsScalar()) return "(" + written.Scalar() + ")";
    std::string words;
    for (const Node& item : written.items()) words += (words.empty() ? "[" : ", ") + item.Scalar();
    return words + "]";
  }

  std::vector<std::optional<Attitude>> attitudes_;
  std::map<std::string, std::string> extras_;
  Amount one_;
};

}  // namespace

FoundConstruction construct_in_space(const Drawing& drawing) { return SpatialConstruction(drawing).run(); }

}  // namespace clearloci::mechanism
