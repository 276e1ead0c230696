// Links of a group that slide on each other: how they are turned together, and the lines that hold their points.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/rational.hpp"
#include "mechanism/assembly/planar_groups.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {

bool PlanarGroups::Carried::is_on_point() const {
  return stroke.empty() && std::all_of(way.begin(), way.end(), [](const Amount& part) { return part.is_zero(); });
}

std::string PlanarGroups::Carried::text() const {
  return std::to_string(link) + " " + std::to_string(point) + " " + way[0].text() + " " + way[1].text() + " " + stroke;
}

bool PlanarGroups::is_drawn_exactly(LinkIndex link) const {
  return link == ground || (shape(link).is_drawn() &&
                            std::all_of(d_.link(link).points.begin(), d_.link(link).points.end(),
                                        [&](PointIndex p) { return !d_.at(p).has_place || d_.at(p).is_exact; }));
}

std::vector<PointIndex> PlanarGroups::points_in_use(LinkIndex link, const Parts& parts) const {
  std::vector<PointIndex> points = known_points(link);
  const std::vector<PointIndex> shared = shared_of(link, parts);
  points.insert(points.end(), shared.begin(), shared.end());
  return points;
}

std::optional<PartByPart::Stroke> PlanarGroups::moving_stroke(const DrawnCoordinate& coordinate) const {
  if (coordinate.kind != DrawnCoordinate::Kind::stroke) return std::nullopt;
  const Joint& joint = d_.joint(coordinate.joint);
  const auto axis = drawn_axis(coordinate.joint);
  if (!axis || !d_.at(joint.at).is_exact) return std::nullopt;
  const bool to_holds = joint.to != ground && is_on_link(d_.mechanism, joint.at, joint.to);
  Stroke stroke{&coordinate, coordinate.joint, to_holds ? joint.to : joint.from, ground, {}, *axis};
  stroke.base = other_of(joint, stroke.carried);
  if (is_placed(stroke.base)) return std::nullopt;
  stroke.origin = d_.link(stroke.base).points.front();
  return d_.at(*stroke.origin).is_exact ? std::optional(stroke) : std::nullopt;
}

/// Its motor says how far its ends are apart.
bool PlanarGroups::is_leg(const Stroke& stroke) const {
  const Amounts way = d_.at(d_.joint(stroke.joint).at).at - d_.at(*stroke.origin).at;
  return !is_turned(stroke.base) &&
         std::abs(cross(stroke.axis, way)[2].value()) <= 1e-12 * size_of(stroke.axis) * size_of(way);
}

/// What is measured between, and a point of each link that slides.
void PlanarGroups::use_points_of_slides(Parts& parts) const {
  const auto use = [&](PointIndex point) {
    if (!is_known(point) && d_.at(point).has_place && !d_.at(point).built) parts.use.emplace(point, Use::free);
  };
  for (const DrawnCoordinate& coordinate : d_.coordinates)
    if (const auto stroke = moving_stroke(coordinate)) {
      use(d_.joint(stroke->joint).at);
      use(*stroke->origin);
    }
  for (const Joint& joint : d_.mechanism.joints)
    for (const LinkIndex link : {joint.from, joint.to}) {
      if (!is_guide(d_.mechanism, joint) || is_placed(link) || !points_in_use(link, parts).empty()) continue;
      const auto& points = d_.link(link).points;
      if (has_point(link, joint.at))
        use(joint.at);
      else if (!points.empty() && has_point(link, points.front()))
        use(points.front());
    }
}

std::vector<std::vector<LinkIndex>> PlanarGroups::links_that_turn_together() const {
  std::vector<std::size_t> of(d_.mechanism.links.size());
  std::iota(of.begin(), of.end(), std::size_t{0});
  const auto join = [&](LinkIndex a, LinkIndex b) {
    if (a == ground || b == ground) return;
    const std::size_t from = of[static_cast<std::size_t>(a)], to = of[static_cast<std::size_t>(b)];
    std::replace(of.begin(), of.end(), from, to);
  };
  for (const Joint& joint : d_.mechanism.joints)
    if (is_guide(d_.mechanism, joint)) join(joint.from, joint.to);
  for (const DrawnMesh& mesh : d_.meshes)
    if (turn_alike(mesh)) join(mesh.joint.from, mesh.joint.to);
  std::map<std::size_t, std::vector<LinkIndex>> together;
  for (std::size_t l = 0; l < of.size(); ++l) together[of[l]].push_back(static_cast<LinkIndex>(l));
  std::vector<std::vector<LinkIndex>> all;
  for (auto& [first, links] : together) all.push_back(std::move(links));
  return all;
}

/// Equations in which the direction of these links is.
std::size_t PlanarGroups::lines_between(const std::vector<LinkIndex>& links) const {
  const auto has = [&](LinkIndex link) { return std::find(links.begin(), links.end(), link) != links.end(); };
  std::size_t count = 0;
  for (const Joint& joint : d_.mechanism.joints)
    if (has(joint.from) && (is_guide(d_.mechanism, joint) || is_slot(d_.mechanism, joint))) ++count;
  for (const DrawnCoordinate& coordinate : d_.coordinates)
    if (const auto stroke = moving_stroke(coordinate); stroke && has(stroke->base) && !is_leg(*stroke)) ++count;
  return count;
}

/// One line alone says how its links are turned, and two points of a link do so too. Else the direction is an unknown
/// of the group, by a second point of one of the links.
void PlanarGroups::find_frames(Parts& parts) const {
  for (const std::vector<LinkIndex>& links : links_that_turn_together()) {
    const std::size_t lines = lines_between(links);
    if (is_turned(links.front()) || !parts.drawn.contains(links.front()) || (links.size() == 1 && lines == 0)) continue;
    Frame frame;
    frame.links = links;
    std::size_t most = 0;
    for (const LinkIndex link : links)
      if (const std::size_t count = points_in_use(link, parts).size(); count > most) {
        most = count;
        frame.link = link;
      }
    if (most == 0 || (most == 1 && lines < 2)) continue;
    if (most == 1 && !give_second_point(links, frame, parts)) add_pointer(frame.link, frame, parts);
    parts.frames.push_back(std::move(frame));
  }
}

bool PlanarGroups::give_second_point(const std::vector<LinkIndex>& links, Frame& frame, Parts& parts) const {
  for (const LinkIndex link : links) {
    const std::vector<PointIndex> used = points_in_use(link, parts);
    if (used.empty()) continue;
    for (const PointIndex p : d_.link(link).points)
      if (p != used.front() && has_point(link, p) && !d_.at(p).built && is_apart(p, used.front())) {
        parts.use[p] = Use::free;
        frame.link = link;
        return true;
      }
  }
  return false;
}

void PlanarGroups::add_pointer(LinkIndex link, Frame& frame, Parts& parts) const {
  frame.from = points_in_use(link, parts).front();
  frame.to = static_cast<PointIndex>(d_.points.size() + parts.pointers.size());
  const Rational size(d_.size / core::to_double(d_.unit));
  frame.way = {Amount(core::simplest_rational_near(size, Rational(size / 4))), {}, {}};
  Pointer pointer{"", d_.place(frame.from)};
  pointer.posture[0] += frame.way[0].value() * core::to_double(d_.unit);
  parts.pointers.push_back(std::move(pointer));
  parts.use[frame.to] = Use::base;
  if (auto use = parts.use.find(frame.from); use != parts.use.end()) use->second = Use::base;
  Held held;
  if (!is_known(frame.from)) held.points.push_back(frame.from);
  held.points.push_back(frame.to);
  held.first = name_of(frame.from);
  held.length = frame.way[0].text();
  parts.held.push_back(std::move(held));
}

void PlanarGroups::name_pointer(PointIndex pointer, Parts& parts) {
  for (const Frame& frame : parts.frames)
    if (frame.to == pointer)
      parts.pointers[static_cast<std::size_t>(pointer) - d_.points.size()].name =
          new_name(name_of(frame.from) + "_" + d_.name_of(frame.link));
}

void PlanarGroups::turn_frames(const std::vector<PointIndex>& points, const Parts& parts, const Writing& writing) {
  for (const auto& [key, name] : writing.lefts) extras_.emplace(key, name);
  for (const Frame& frame : parts.frames) {
    const auto index = static_cast<std::size_t>(frame.to);
    if (index < d_.points.size() || std::find(points.begin(), points.end(), frame.to) == points.end()) continue;
    const Pointer& pointer = parts.pointers[index - d_.points.size()];
    Orientation turned;
    turned.means = Means::points;
    turned.from = handle(frame.from);
    turned.to = know(pointer.name, pointer.posture);
    turned.reference = turned.drawn = frame.way;
    set_turned(frame.link, std::move(turned));
  }
}

const PlanarGroups::Frame* PlanarGroups::frame_of(LinkIndex link, const Parts& parts) const {
  for (const Frame& frame : parts.frames)
    if (std::find(frame.links.begin(), frame.links.end(), link) != frame.links.end()) return &frame;
  return nullptr;
}

int PlanarGroups::rank(LinkIndex link, const Parts& parts) const {
  if (is_turned(link)) return 0;
  const Frame* frame = frame_of(link, parts);
  return frame == nullptr ? 3 : frame->link == link ? 1 : 2;
}

/// The line through a point along an axis, carried by a link that turns on its own or with others.
std::optional<PlanarGroups::Carried> PlanarGroups::line_on(LinkIndex carrier, PointIndex point, const Amounts& axis,
                                                           const Parts& parts) const {
  const double close = 1e-12 * d_.size / core::to_double(d_.unit);
  const std::vector<PointIndex> bases = points_in_use(carrier, parts);
  if (bases.empty()) return std::nullopt;
  Carried line;
  line.link = carrier;
  line.axis = axis;
  const auto on_line = std::find_if(bases.begin(), bases.end(), [&](PointIndex base) {
    return size_of(cross(axis, d_.at(base).at - d_.at(point).at)) <= close * size_of(axis);
  });
  line.point = on_line == bases.end() ? bases.front() : *on_line;
  if (on_line == bases.end()) line.way = d_.at(point).at - d_.at(line.point).at;
  return line;
}

void PlanarGroups::hold(PointIndex point, Carried line, Parts& parts) const {
  Held held;
  held.points = {point, line.point};
  if (const Frame* frame = frame_of(line.link, parts)) held.points.insert(held.points.end(), {frame->from, frame->to});
  held.line = std::move(line);
  parts.held.push_back(std::move(held));
}

/// Slides between links that are not placed yet, and pins in slots of such a link.
void PlanarGroups::add_moving_guides(Parts& parts) const {
  for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j) {
    const auto index = static_cast<JointIndex>(j);
    const Joint& joint = d_.mechanism.joints[j];
    const bool in_slot = is_slot(d_.mechanism, joint);
    if (!in_slot && !is_guide(d_.mechanism, joint)) continue;
    if (is_placed(joint.from) || (!in_slot && is_placed(joint.to))) continue;
    if (in_slot && is_turned(joint.from) && is_known(joint.at)) continue;  // a known line
    if (!is_turned(joint.from) && frame_of(joint.from, parts) == nullptr) {
      add_moving_guide(index, parts);
      continue;
    }
    const auto axis = drawn_axis(index);
    if (!axis) continue;
    std::vector<std::pair<PointIndex, LinkIndex>> ways;  // a point, and the link that carries its line
    if (in_slot) {
      if ((is_known(joint.at) || parts.use.contains(joint.at)) && d_.at(joint.at).is_exact)
        ways.emplace_back(joint.at, joint.from);
    } else {
      for (const auto& [carrier, rider] : {std::pair(joint.from, joint.to), std::pair(joint.to, joint.from)}) {
        const std::vector<PointIndex> points = points_in_use(rider, parts);
        if (points.empty()) continue;
        const bool has_own = std::find(points.begin(), points.end(), joint.at) != points.end();
        ways.emplace_back(has_own ? joint.at : points.front(), carrier);
      }
    }
    std::optional<Carried> best;
    PointIndex held = 0;
    for (const auto& [point, carrier] : ways) {
      if (!is_drawn_exactly(carrier) || (!in_slot && !is_drawn_exactly(other_of(joint, carrier)))) continue;
      auto line = line_on(carrier, point, *axis, parts);
      if (!line || (best && (best->is_on_point() || !line->is_on_point()))) continue;
      best = std::move(line);
      held = point;
    }
    if (best) hold(held, std::move(*best), parts);
  }
}

/// The length of a leg, or how far a point is out along the guide that carries it.
void PlanarGroups::add_strokes(Parts& parts) const {
  for (const DrawnCoordinate& coordinate : d_.coordinates) {
    const auto stroke = moving_stroke(coordinate);
    if (!stroke) continue;
    const PointIndex at = d_.joint(stroke->joint).at, origin = *stroke->origin;
    if (is_leg(*stroke)) {
      Held held;
      for (const PointIndex p : {origin, at})
        if (!is_known(p)) held.points.push_back(p);
      held.first = name_of(origin);
      held.second = name_of(at);
      held.length = coordinate.name;
      if (!held.points.empty()) parts.held.push_back(std::move(held));
      continue;
    }
    if (!is_turned(stroke->base) && frame_of(stroke->base, parts) == nullptr) continue;
    Carried line;
    line.link = stroke->base;
    line.point = origin;
    line.stroke = coordinate.name;
    line.unit = (one_ / length(stroke->axis)) * stroke->axis;
    line.axis = left(stroke->axis);
    hold(at, std::move(line), parts);
  }
}

/// A vector of the drawing that turns with a link of the group.
WrittenVector PlanarGroups::turned_with(LinkIndex link, const Amounts& v, bool is_of_shape, const Parts& parts,
                                        Writing& writing) {
  if (is_turned(link)) return is_of_shape ? image_of_shape(link, v) : image(link, v);
  const Frame& frame = *frame_of(link, parts);
  const std::string from = name_of(frame.from, parts), to = name_of(frame.to, parts);
  const auto [along, beside] = PlanarTurning::parts(v, frame.way, true);
  WrittenVector result = along * way_between(from, to);
  if (beside.is_zero()) return result;
  std::string& name = writing.lefts[from + " " + to + " _left"];
  if (name.empty()) {
    name = new_name(from + to + "_left");
    writing.with.emplace_back(name, map({{"on", list({from, to})}, {"offset", list({"0", length(frame.way).text()})}}));
  }
  return result += beside * way_between(from, name);
}

Node PlanarGroups::from_point(const Carried& line, const Parts& parts, Writing& writing) {
  WrittenVector by = turned_with(line.link, line.way, line.is_of_shape, parts, writing);
  if (!line.stroke.empty()) by += times(line.stroke, turned_with(line.link, line.unit, false, parts, writing));
  return map({{"from", text(name_of(line.point, parts))}, {"by", vector_node(text_of(by, 2))}});
}

std::string PlanarGroups::begin_of(const Carried& line, const Parts& parts, Writing& writing) {
  if (line.is_on_point()) return name_of(line.point, parts);
  std::string& name = writing.points[line.text()];
  if (name.empty()) {
    const Node form = from_point(line, parts, writing);
    name = new_name(name_of(line.point, parts) + "_guide");
    writing.with.emplace_back(name, form);
  }
  return name;
}

/// A group has one line for each point: of a point that has one already, the line begins there.
void PlanarGroups::add_line(const Held& held, const Parts& parts, Writing& writing,
                            std::vector<std::pair<std::string, Node>>& lines) {
  const auto has_line = [&](const std::string& name) {
    return std::any_of(lines.begin(), lines.end(), [&](const auto& other) { return other.first == name; });
  };
  const Carried& carried = *held.line;
  std::string point = name_of(held.points.front(), parts), begin = begin_of(carried, parts, writing);
  std::string along = carried.along;
  if (along.empty()) along = text_of(turned_with(carried.link, carried.axis, false, parts, writing), 2);
  if (has_line(point)) std::swap(point, begin);
  if (has_line(point)) {
    const std::string same = new_name(point + "_again");
    writing.with.emplace_back(same, map({{"from", text(point)}, {"by", list({"0", "0"})}}));
    point = same;
  }
  lines.emplace_back(point, Node::sequence({text(begin), vector_node(along)}, {}));
}

}  // namespace clearloci::mechanism
