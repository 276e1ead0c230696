// The construction of a planar drawing, part by part: what a coordinate or two known points turn is oriented, a point
// is where two of the lines and circles meet on which its links keep it.
//
//   link with one known point P          circle about P                    R of RRR, RRP
//   link that slides on a known one      line along the guide              P of RRP, PRP
//   two pins and a guide between them    both links turn with P -> Q       RPR
#include <algorithm>
#include <cmath>

#include "mechanism/assembly/construction.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

/// How a link is turned: where a vector of the drawing is in a pose.
struct Orientation {
  enum class Means {
    vectors,  ///< by the images of the reference's direction and of its left
    points,   ///< two points of a link, a constant distance apart
    way       ///< two points whose distance varies
  };
  Means means = Means::vectors;
  /// The same direction in the link's shape and in the drawing.
  Amounts reference = {Amount(core::Rational(1)), {}, {}}, drawn = reference;
  WrittenVector first, second;  ///< unit vectors, of `vectors`
  int from = -1, to = -1;       ///< handles, of `points` and `way`
  std::string angle;            ///< where `first` is (cos angle, sin angle)
};

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

class PlanarConstruction : public Construction {
 public:
  explicit PlanarConstruction(const Drawing& drawing)
      : Construction(drawing), orientations_(drawing.mechanism.links.size()) {
    one_ = Amount(core::Rational(1));
    ground_.first = constant_vector(Amounts{one_, Amount(), Amount()});
    ground_.second = constant_vector(Amounts{Amount(), one_, Amount()});
  }

  FoundConstruction run() {
    while (!is_complete()) {
      while (orient_one()) {
      }
      if (!place_one()) refuse_rest(d_, open_links());
    }
    while (orient_one()) {
    }
    for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j) write_axis(static_cast<JointIndex>(j));
    return std::move(found_);
  }

 private:
  using Means = Orientation::Means;

  const Orientation* orientation(LinkIndex link) const {
    if (link == ground) return &ground_;
    const auto& own = orientations_[static_cast<std::size_t>(link)];
    return own ? &*own : nullptr;
  }
  bool is_placed(LinkIndex link) const {
    return link == ground || (orientation(link) != nullptr && !known_points(link).empty());
  }
  static Amounts left(const Amounts& v) { return {-v[1], v[0], {}}; }

  // --- vectors that turn with a link

  /// v by its parts along the reference and to its left, each over `length` of the reference where `over_square`.
  static std::array<Amount, 2> parts(const Amounts& v, const Amounts& reference, bool over_square) {
    const Amount size = length(reference);
    if (reference[1].is_zero() && reference[0].value() > 0)
      return over_square ? std::array<Amount, 2>{v[0] / size, v[1] / size} : std::array<Amount, 2>{v[0], v[1]};
    const bool same = v[0].text() == reference[0].text() && v[1].text() == reference[1].text();
    if (same) return {over_square ? Amount(core::Rational(1)) : size, Amount()};
    const Amount below = over_square ? dot(reference, reference) : size;
    return {dot(v, reference) / below, cross(reference, v)[2] / below};
  }

  WrittenVector image(const Orientation& own, const Amounts& v, const Amounts& reference) {
    const auto [along, beside] = parts(v, reference, own.means == Means::points);
    if (own.means == Means::vectors) return along * own.first + beside * own.second;
    const std::string from = known(own.from).name, to = known(own.to).name;
    const std::string tail = own.means == Means::way ? extra(own, "_along", 0) : to;
    WrittenVector result = along * way_between(from, tail);
    if (!beside.is_zero()) result += beside * way_between(from, extra(own, "_left", 1));
    return result;
  }
  WrittenVector image_of_shape(LinkIndex link, const Amounts& v) {
    return image(*orientation(link), v, orientation(link)->reference);
  }
  WrittenVector image_of_drawn(LinkIndex link, const Amounts& v) {
    return image(*orientation(link), v, orientation(link)->drawn);
  }

  /// The point at a unit along the way of an orientation, or as far to its left as it is long.
  std::string extra(const Orientation& own, const std::string& suffix, std::size_t which) {
    const std::string from = known(own.from).name, to = known(own.to).name;
    const std::string key = from + " " + to + " " + suffix;
    const auto found = extras_.find(key);
    if (found != extras_.end()) return found->second;
    const std::string size = own.means == Means::points ? length(own.reference).text() : "1";
    const auto &p = known(own.from).posture, &q = known(own.to).posture;
    std::array<double, 3> way = {q[0] - p[0], q[1] - p[1], 0};
    if (own.means == Means::way) {
      const double unit = core::to_double(d_.unit) / std::hypot(way[0], way[1]);
      way = {way[0] * unit, way[1] * unit, 0};
    }
    if (which == 1) way = {-way[1], way[0], 0};
    const Handle handle =
        put_extra(from + to + suffix,
                  map({{"on", list({from, to})}, {"offset", which == 0 ? list({size, "0"}) : list({"0", size})}}),
                  {p[0] + way[0], p[1] + way[1], 0}, "a direction that turns with " + from + to);
    return extras_.emplace(key, known(handle).name).first->second;
  }

  // --- orientations

  bool orient_one() {
    for (std::size_t l = 0; l < orientations_.size(); ++l)
      if (!orientations_[l] && orient(static_cast<LinkIndex>(l))) return true;
    return false;
  }

  bool orient(LinkIndex link) {
    for (const DrawnCoordinate& own : d_.coordinates)
      if (own.kind == DrawnCoordinate::Kind::direction && (own.link == link || own.other == link) &&
          orient_by_angle(link, own))
        return true;
    return orient_by_points(link) || orient_by_guide(link) || orient_by_way(link);
  }

  /// The way from the first to the second point of a link, in its shape.
  std::optional<Amounts> pointer(LinkIndex link) const {
    if (link == ground) return Amounts{one_, {}, {}};
    const auto& points = d_.link(link).points;
    if (points.size() < 2 || !shape(link).has(points[0]) || !shape(link).has(points[1])) return std::nullopt;
    return shape(link).way(points[0], points[1]);
  }
  Amounts drawn_pointer(LinkIndex link) const {
    const auto& points = d_.link(link).points;
    return d_.at(points[1]).at - d_.at(points[0]).at;
  }

  bool orient_by_angle(LinkIndex link, const DrawnCoordinate& c) {
    const bool forward = c.link == link;
    const LinkIndex other = forward ? c.other : c.link;
    const Orientation* base = orientation(other);
    const auto own_pointer = pointer(link), base_pointer = pointer(other);
    if (base == nullptr || !own_pointer || !base_pointer) return false;
    Orientation own;
    own.reference = *own_pointer;
    own.drawn = shape(link).is_drawn() ? own.reference : drawn_pointer(link);
    const bool from_x =
        other == ground || (!base->angle.empty() && base->reference[0].text() == (*base_pointer)[0].text() &&
                            base->reference[1].text() == (*base_pointer)[1].text());
    if (from_x) {
      own.angle =
          other == ground ? (forward ? c.name : "-" + c.name) : base->angle + (forward ? " + " : " - ") + c.name;
      own.first.components[0].push_back({one_, "cos(" + own.angle + ")"});
      own.first.components[1].push_back({one_, "sin(" + own.angle + ")"});
      own.second = left_of(own.first);
    } else {
      const Amount over = one_ / length(*base_pointer);
      const WrittenVector ahead = image_of_shape(other, over * *base_pointer),
                          beside = image_of_shape(other, over * left(*base_pointer));
      const Amount sign = forward ? one_ : -one_;
      const std::string cosine = "cos(" + c.name + ")", sine = "sin(" + c.name + ")";
      own.first = times(cosine, ahead) + sign * times(sine, beside);
      own.second = times(cosine, beside) + -sign * times(sine, ahead);
    }
    orientations_[static_cast<std::size_t>(link)] = std::move(own);
    return true;
  }

  bool orient_by_points(LinkIndex link) {
    const std::vector<PointIndex> points = known_points(link);
    if (points.size() < 2) return false;
    Orientation own;
    own.means = Means::points;
    own.from = handle(points[0]);
    own.to = handle(points[1]);
    own.reference = shape(link).way(points[0], points[1]);
    own.drawn = d_.at(points[0]).is_exact && d_.at(points[1]).is_exact ? d_.at(points[1]).at - d_.at(points[0]).at
                                                                       : own.reference;
    orientations_[static_cast<std::size_t>(link)] = std::move(own);
    return true;
  }

  bool slides(const Joint& joint, LinkIndex link) const {
    return traits(joint).slides && (joint.from == link || joint.to == link);
  }
  static LinkIndex other_of(const Joint& joint, LinkIndex link) { return joint.from == link ? joint.to : joint.from; }

  /// What slides on a link turns with it.
  bool orient_by_guide(LinkIndex link) {
    for (const Joint& joint : d_.mechanism.joints) {
      if (!slides(joint, link)) continue;
      const LinkIndex guide = other_of(joint, link);
      const Orientation* base = orientation(guide);
      if (base == nullptr) continue;
      Orientation own = *base;
      own.reference = own.drawn;
      if (!shape(link).is_drawn()) {
        const Amounts direction = (one_ / length(drawn_pointer(link))) * drawn_pointer(link);
        Orientation turned;
        turned.reference = *pointer(link);
        turned.drawn = drawn_pointer(link);
        turned.first = image_of_drawn(guide, direction);
        turned.second = image_of_drawn(guide, left(direction));
        own = std::move(turned);
      }
      orientations_[static_cast<std::size_t>(link)] = std::move(own);
      return true;
    }
    return false;
  }

  /// Two links, each with one known point, and a guide between them along the way from the one to the other.
  bool orient_by_way(LinkIndex link) {
    for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j) {
      const Joint& joint = d_.mechanism.joints[j];
      if (!slides(joint, link) || joint.from == ground || joint.to == ground) continue;
      const std::vector<PointIndex> here = known_points(link), there = known_points(other_of(joint, link));
      if (here.empty() || there.empty() || !is_apart(here[0], there[0])) continue;
      if (!shape(joint.from).is_drawn() || !shape(joint.to).is_drawn()) continue;
      const auto axis = drawn_axis(static_cast<JointIndex>(j));
      if (!axis) continue;
      const Amounts way = d_.at(there[0]).at - d_.at(here[0]).at;
      const double beside = cross(*axis, way)[2].value() / length(*axis).value();
      Orientation own;
      own.from = handle(here[0]);
      own.to = handle(there[0]);
      if (std::abs(beside) * core::to_double(d_.unit) <= 1e-12 * d_.size) {
        own.means = Means::way;
        own.reference = own.drawn = way;
      } else {
        // The guide passes beside the pins: its foot F below the first one has a right angle in it.
        const Amount part = cross(*axis, way)[2] / dot(*axis, *axis);
        const Amounts foot = part * left(*axis);
        std::array<double, 3> place = known(own.from).posture;
        for (std::size_t i = 0; i < 2; ++i) place[i] += foot[i].value() * core::to_double(d_.unit);
        const auto &p = known(own.from).posture, &q = known(own.to).posture;
        const double turn = (q[0] - p[0]) * (place[1] - p[1]) - (q[1] - p[1]) * (place[0] - p[0]);
        const std::string side = turn > 0 ? "left" : "right";
        own.to = put_extra(
            joint.name + "_foot",
            map({{"foot", list({known(own.from).name, known(own.to).name})},
                 {"length", text(length(foot).text())},
                 {"side", text(side)}}),
            place, "the guide of " + joint.name + " passes " + length(foot).text() + " beside " + known(own.from).name);
        own.means = Means::points;
        own.reference = own.drawn = foot;
      }
      orientations_[static_cast<std::size_t>(link)] = std::move(own);
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
    if (put_by_coordinates(point) || put_on_link(point) || put_by_stroke(point)) return true;
    return put_where_loci_meet(point);
  }

  const DrawnCoordinate* place_coordinate(PointIndex point, std::size_t axis) const {
    for (const DrawnCoordinate& own : d_.coordinates)
      if (own.kind == DrawnCoordinate::Kind::place && own.point == point && own.axis == axis) return &own;
    return nullptr;
  }

  bool put_by_coordinates(PointIndex point) {
    const DrawnCoordinate *x = place_coordinate(point, 0), *y = place_coordinate(point, 1);
    if (x == nullptr || y == nullptr) return false;
    WrittenVector place;
    place.components[0].push_back({one_, x->name});
    place.components[1].push_back({one_, y->name});
    put(point, explicit_form(place), "", place);
    return true;
  }

  bool put_on_link(PointIndex point) {
    for (std::size_t l = 0; l < orientations_.size(); ++l) {
      const auto link = static_cast<LinkIndex>(l);
      const auto& points = d_.link(link).points;
      if (std::find(points.begin(), points.end(), point) == points.end() || !shape(link).has(point)) continue;
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
      PointIndex base = bases.front();
      for (const PointIndex other : bases)
        if (known(handle(other)).place) {
          base = other;
          break;
        }
      const WrittenVector by = image_of_shape(link, shape(link).way(base, point));
      std::optional<WrittenVector> place;
      const Node form = form_at(handle(base), by, place);
      put(point, form, comment, std::move(place));
      return true;
    }
    return false;
  }

  /// The link that carries the point of a prismatic joint along, the other one, and where that is measured from.
  struct Stroke {
    const DrawnCoordinate* coordinate = nullptr;
    JointIndex joint = 0;
    LinkIndex carried = ground, base = ground;
    std::optional<PointIndex> origin;  ///< none: of the ground
  };
  std::vector<Stroke> strokes() const {
    std::vector<Stroke> all;
    for (const DrawnCoordinate& own : d_.coordinates) {
      if (own.kind != DrawnCoordinate::Kind::stroke) continue;
      const Joint& joint = d_.joint(own.joint);
      const auto holds = [&](LinkIndex link) { return link != ground && is_on_link(d_.mechanism, joint.at, link); };
      Stroke stroke{&own, own.joint, holds(joint.to) ? joint.to : joint.from, ground, {}};
      stroke.base = other_of(joint, stroke.carried);
      if (stroke.base != ground) stroke.origin = d_.link(stroke.base).points.front();
      all.push_back(stroke);
    }
    return all;
  }

  bool put_by_stroke(PointIndex point) {
    for (const Stroke& own : strokes()) {
      if (d_.joint(own.joint).at != point || !is_placed(own.base)) continue;
      const auto axis = drawn_axis(own.joint);
      if (!axis || !d_.at(point).is_exact) continue;
      if (own.origin && (!is_known(*own.origin) || !d_.at(*own.origin).is_exact)) continue;
      const Amounts unit = (one_ / length(*axis)) * *axis;
      const Amounts way = own.origin ? d_.at(point).at - d_.at(*own.origin).at : d_.at(point).at;
      const Amounts beside = dot(way, left(unit)) * left(unit);
      const WrittenVector by =
          image_of_drawn(own.base, beside) + times(own.coordinate->name, image_of_drawn(own.base, unit));
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

  // --- circles and lines

  std::vector<Locus> loci(PointIndex point, int depth = 0) {
    std::vector<Locus> all;
    for (std::size_t l = 0; l < orientations_.size(); ++l) {
      const auto link = static_cast<LinkIndex>(l);
      const auto& points = d_.link(link).points;
      if (std::find(points.begin(), points.end(), point) == points.end() || !shape(link).has(point)) continue;
      add_circle(link, point, all);
      if (orientation(link) != nullptr && known_points(link).empty()) {
        add_lines(link, point, all);
        if (depth == 0) add_translated(link, point, all);
      }
    }
    for (const Stroke& own : strokes()) add_leg(own, point, all);
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
    if (d_.joint(own.joint).at != point || !own.origin || !is_known(*own.origin) || orientation(own.base) != nullptr)
      return;
    const auto axis = drawn_axis(own.joint);
    if (!axis || !d_.at(point).is_exact || !d_.at(*own.origin).is_exact) return;
    const Amounts way = d_.at(point).at - d_.at(*own.origin).at;
    if (std::abs(cross(*axis, way)[2].value()) > 1e-12 * length(*axis).value() * length(way).value()) return;
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
      if (!is_placed(guide) || !axis || !d_.at(point).is_exact) continue;
      Locus line;
      line.way = turned_in_posture(guide, *axis);
      line.link = link;
      line.source = "guide " + joint.name;
      line.along = axis_text(static_cast<JointIndex>(j), guide, *axis);
      line.base = [this, guide, point, axis = *axis, name = joint.name] {
        return base_of_line(guide, point, axis, name);
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
    if (guide == ground && !d_.axes[static_cast<std::size_t>(joint)].empty()) {
      const Node& written = d_.axes[static_cast<std::size_t>(joint)].front();
      if (written.IsScalar()) return written.Scalar();
      std::string words;
      for (const Node& item : written.items()) words += (words.empty() ? "[" : ", ") + item.Scalar();
      return words + "]";
    }
    return text_of(image_of_drawn(guide, axis), 2);
  }

  /// A known point of the guide on the line, or else one in the drawn place.
  Handle base_of_line(LinkIndex guide, PointIndex point, const Amounts& axis, const std::string& joint) {
    const double close = 1e-12 * d_.size / core::to_double(d_.unit);
    const auto on_line = [&](PointIndex other) {
      return is_known(other) && d_.at(other).is_exact &&
             std::abs(cross(axis, d_.at(other).at - d_.at(point).at)[2].value()) <= close * length(axis).value();
    };
    if (guide == ground) {
      for (PointIndex other = 0; other < static_cast<PointIndex>(d_.points.size()); ++other)
        if (other != point && fixed_[static_cast<std::size_t>(other)] && on_line(other)) return handle(other);
      const WrittenVector place = constant_vector(d_.at(point).at);
      return put_extra(d_.name(point) + "_guide", explicit_form(place), d_.place(point), "on the guide of " + joint,
                       place);
    }
    for (const PointIndex other : known_points(guide))
      if (other != point && on_line(other)) return handle(other);
    const PointIndex base = known_points(guide).front();
    const WrittenVector by = image_of_drawn(guide, d_.at(point).at - d_.at(base).at);
    std::optional<WrittenVector> place;
    const Node form = form_at(handle(base), by, place);
    return put_extra(d_.name(point) + "_guide", form, d_.place(point), "on the guide of " + joint, std::move(place));
  }

  /// A link that does not turn on its own carries what keeps its other points over to this one.
  void add_translated(LinkIndex link, PointIndex point, std::vector<Locus>& all) {
    for (const PointIndex other : d_.link(link).points) {
      if (other == point || is_known(other) || !shape(link).has(other) || d_.at(other).built) continue;
      for (Locus& own : loci(other, 1)) {
        if (own.link == link) continue;
        const Amounts way = shape(link).way(other, point);
        own.base = [this, link, way, base = own.base, point, other] {
          const Handle from = base();
          const WrittenVector by = image_of_shape(link, way);
          std::optional<WrittenVector> place;
          const Node form = form_at(from, by, place);
          std::array<double, 3> posture = known(from).posture;
          for (std::size_t i = 0; i < 2; ++i) posture[i] += d_.place(point)[i] - d_.place(other)[i];
          return put_extra(known(from).name + "_" + d_.name(point), form, posture,
                           "carried along by " + d_.link(link).name, std::move(place));
        };
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

  bool put_where_loci_meet(PointIndex point) {
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
    if (std::abs(turn) <= 1e-9 * size) refuse_stretched(point, a, b);
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
      refuse_stretched(point, guide, circle);
    put(point,
        map({{"slider", line(base, guide)},
             {"from", text(known(from).name)},
             {"length", text(radius_of(circle))},
             {"side", text(along > 0 ? "ahead" : "behind")}}),
        comment);
  }

  [[noreturn]] void refuse_stretched(PointIndex point, const Locus& a, const Locus& b) const {
    throw core::InputError(d_.mechanism.points[static_cast<std::size_t>(point)].where,
                           "point " + d_.name(point) + " is drawn where " + a.source + " and " + b.source +
                               " are at the end of their reach, which chooses no side",
                           "draw the mechanism in another posture");
  }

  // --- axes

  void write_axis(JointIndex index) {
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
    const WrittenVector own = image_of_drawn(link, *axis);
    if (own.is_constant()) return;
    found_.axes[index] = {text_of(own, 2)};
  }

  Amount one_;
  Orientation ground_;
  std::vector<std::optional<Orientation>> orientations_;
  std::map<std::string, std::string> extras_;
};

}  // namespace

FoundConstruction construct_in_plane(const Drawing& drawing) { return PlanarConstruction(drawing).run(); }

}  // namespace clearloci::mechanism
