#include "mechanism/assembly/planar_groups.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <set>

#include "mechanism/joint_traits.hpp"

namespace clearloci::mechanism {

const std::string& PlanarGroups::name_of(PointIndex point) const {
  return is_known(point) ? known(handle(point)).name : d_.name(point);
}

/// Unknown points that more than one link has, or that something else holds.
bool PlanarGroups::is_shared(PointIndex point) const {
  if (is_known(point) || d_.at(point).built || !d_.at(point).has_place) return false;
  std::size_t links = 0;
  for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l)
    links += has_point(static_cast<LinkIndex>(l), point) ? 1 : 0;
  const auto& joints = d_.mechanism.joints;
  const bool is_joint =
      std::any_of(joints.begin(), joints.end(), [&](const Joint& joint) { return joint.at == point; });
  return links > 1 || is_joint || place_coordinate(point, 0) != nullptr || place_coordinate(point, 1) != nullptr;
}

bool PlanarGroups::put_group() {
  Parts parts;
  for (PointIndex p = 0; p < static_cast<PointIndex>(d_.points.size()); ++p)
    if (is_shared(p)) parts.use[p] = Use::free;
  std::vector<LinkIndex> links = links_with_shared_points(parts);
  while (!links.empty()) {
    const auto next = next_link(links, parts);
    if (!add_link(*next, parts)) return false;
    links.erase(next);
  }
  add_known_guides(parts);
  add_moving_guides(parts.held);
  return put_smallest(parts);
}

/// Links whose direction is known first, since each has but one point that others may place; then those with most
/// points. The order in the file says nothing.
std::vector<LinkIndex> PlanarGroups::links_with_shared_points(const Parts& parts) const {
  struct Ranked {
    LinkIndex link;
    bool turned;
    std::vector<PointIndex> points;
  };
  std::vector<Ranked> ranked;
  for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l) {
    const auto link = static_cast<LinkIndex>(l);
    Ranked next{link, orientation(link) != nullptr, shared_of(link, parts)};
    std::sort(next.points.begin(), next.points.end());
    if (!next.points.empty()) ranked.push_back(std::move(next));
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    if (a.turned != b.turned) return a.turned;
    if (a.points.size() != b.points.size()) return a.points.size() > b.points.size();
    return a.points < b.points;
  });
  std::vector<LinkIndex> links;
  for (const Ranked& next : ranked) links.push_back(next.link);
  return links;
}

/// Of links whose direction is known one that begins at a point already placed, so that only those in a closed loop
/// find two points of theirs placed.
std::vector<LinkIndex>::const_iterator PlanarGroups::next_link(const std::vector<LinkIndex>& links,
                                                               const Parts& parts) const {
  const auto begins = std::find_if(links.begin(), links.end(), [&](LinkIndex link) {
    const std::vector<PointIndex> points = shared_of(link, parts);
    return orientation(link) != nullptr &&
           std::any_of(points.begin(), points.end(), [&](PointIndex p) { return parts.use.at(p) != Use::free; });
  });
  return begins == links.end() ? links.begin() : begins;
}

std::vector<PointIndex> PlanarGroups::shared_of(LinkIndex link, const Parts& parts) const {
  std::vector<PointIndex> points;
  for (const PointIndex p : d_.link(link).points)
    if (parts.use.contains(p) && has_point(link, p)) points.push_back(p);
  return points;
}

void PlanarGroups::add_distance(LinkIndex link, PointIndex a, PointIndex b, Parts& parts) const {
  Held held;
  for (const PointIndex p : {a, b})
    if (!is_known(p)) held.points.push_back(p);
  held.first = name_of(a);
  held.second = name_of(b);
  held.length = shape(link).distance(a, b).text();
  parts.held.push_back(std::move(held));
}

/// Lengths that are given say more than what follows from them, where they hold a point well: off the line of two
/// others.
bool PlanarGroups::is_held_by_lengths(LinkIndex link, PointIndex a, PointIndex b, PointIndex point) const {
  constexpr double least_sine = 0.05;
  if (shape(link).is_drawn()) return false;
  const Amounts u = shape(link).way(a, b), v = shape(link).way(a, point);
  return std::abs(mechanism::cross(u, v)[2].value()) > least_sine * size_of(u) * size_of(v);
}

/// Two points of a link, one of a link that does not turn on its own, are held by others; the further ones are built on
/// them, or where another link builds them held by their distances.
bool PlanarGroups::add_link(LinkIndex link, Parts& parts) {
  std::vector<PointIndex> points = shared_of(link, parts);
  std::stable_sort(points.begin(), points.end(), [&](PointIndex a, PointIndex b) {
    return (parts.use[a] == Use::free ? 1 : 0) < (parts.use[b] == Use::free ? 1 : 0);
  });
  const bool turned = orientation(link) != nullptr;
  const std::vector<PointIndex> bases = known_points(link);
  if (turned && !bases.empty()) return true;
  if (!turned && !bases.empty()) points.insert(points.begin(), bases.front());
  const std::size_t fixed = turned ? 1 : 2;
  for (std::size_t k = 0; k < std::min(fixed, points.size()); ++k)
    if (auto use = parts.use.find(points[k]); use != parts.use.end() && use->second == Use::free)
      use->second = Use::base;
  if (!turned && points.size() > 1) add_distance(link, points[0], points[1], parts);
  for (std::size_t k = fixed; k < points.size(); ++k) {
    const PointIndex p = points[k];
    if (!turned && parts.use[p] == Use::free && is_held_by_lengths(link, points[0], points[1], p))
      parts.use[p] = Use::base;
    if (parts.use[p] != Use::free) {
      if (turned) return false;  // two points of it that others place
      for (std::size_t i = 0; i < 2; ++i) add_distance(link, points[i], p, parts);
      continue;
    }
    parts.use[p] = Use::derived;
    Derived derived{p, {points[0]}, {}};
    if (turned) {
      derived.form = map({{"from", text(name_of(points[0]))},
                          {"by", vector_node(text_of(image_of_shape(link, shape(link).way(points[0], p)), 2))}});
    } else {
      derived.bases.push_back(points[1]);
      const auto [along, beside] =
          PlanarTurning::parts(shape(link).way(points[0], p), shape(link).way(points[0], points[1]), false);
      derived.form = map(
          {{"on", list({name_of(points[0]), name_of(points[1])})}, {"offset", list({along.text(), beside.text()})}});
    }
    parts.derived.push_back(std::move(derived));
  }
  return true;
}

/// What is known holds a point by itself: guides, motors' strokes, coordinates.
void PlanarGroups::add_known_guides(Parts& parts) {
  parts.loci.resize(parts.use.size());
  std::size_t at = 0;
  for (const auto& use : parts.use) {
    std::vector<Locus>& all = parts.loci[at++];
    for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l)
      if (const auto link = static_cast<LinkIndex>(l);
          has_point(link, use.first) && orientation(link) != nullptr && known_points(link).empty())
        add_lines(link, use.first, all);
    add_slots(use.first, all);
    for (const Stroke& stroke : strokes_at(use.first)) add_leg(stroke, use.first, all);
    for (std::size_t axis = 0; axis < 2; ++axis)
      if (const DrawnCoordinate* c = place_coordinate(use.first, axis)) add_coordinate_line(use.first, axis, *c, all);
    for (const Locus& locus : all) {
      Held held;
      held.points = {use.first};
      held.locus = &locus;
      parts.held.push_back(std::move(held));
    }
  }
}

/// A point that slides along the way between two points of a link that closes with it.
void PlanarGroups::add_moving_guides(std::vector<Held>& held) const {
  const double close = 1e-12 * d_.size / core::to_double(d_.unit);
  for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j) {
    const Joint& joint = d_.mechanism.joints[j];
    const bool in_slot = is_slot(d_.mechanism, joint);
    if (!traits(joint).slides || joint.from == ground || (joint.to == ground && !in_slot)) continue;
    const auto axis = drawn_axis(static_cast<JointIndex>(j));
    if (!axis || !d_.at(joint.at).is_exact) continue;
    if (orientation(joint.from) != nullptr || (!in_slot && orientation(joint.to) != nullptr)) continue;
    std::vector<LinkIndex> guides = {joint.from};
    if (!in_slot) guides.push_back(joint.to);
    for (const LinkIndex guide : guides) {
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

void PlanarGroups::expand(PointIndex point, const Parts& parts, std::vector<PointIndex>& into) const {
  if (is_known(point)) return;
  const auto derived = std::find_if(parts.derived.begin(), parts.derived.end(),
                                    [&](const Derived& other) { return other.point == point; });
  if (derived == parts.derived.end()) {
    into.push_back(point);
    return;
  }
  for (const PointIndex base : derived->bases) expand(base, parts, into);
}

bool PlanarGroups::put_smallest(const Parts& parts) {
  std::vector<PointIndex> points;
  for (const auto& use : parts.use) points.push_back(use.first);
  std::vector<std::vector<std::size_t>> equations;
  for (const Held& held : parts.held) {
    std::vector<PointIndex> used;
    for (const PointIndex p : held.points) expand(p, parts, used);
    std::set<std::size_t> places;
    for (const PointIndex p : used)
      if (const auto found = std::find(points.begin(), points.end(), p); found != points.end())
        places.insert(static_cast<std::size_t>(found - points.begin()));
    equations.emplace_back(places.begin(), places.end());
  }
  const SmallestGroup group = smallest_group(points.size(), 2, equations);
  if (group.points.empty()) return false;
  std::vector<PointIndex> unknowns;
  for (const std::size_t p : group.points) unknowns.push_back(points[p]);
  write_group(unknowns, group.equations, parts);
  return true;
}

void PlanarGroups::write_group(const std::vector<PointIndex>& points, const std::vector<std::size_t>& equations,
                               const Parts& parts) {
  std::vector<std::string> names;
  std::vector<PointIndex> placed = points;
  for (const PointIndex p : points) names.push_back(d_.name(p));
  std::vector<std::pair<std::string, Node>> with, lengths, lines;
  for (const Derived& derived : parts.derived) {
    std::vector<PointIndex> used;
    for (const PointIndex base : derived.bases) expand(base, parts, used);
    if (!std::all_of(used.begin(), used.end(),
                     [&](PointIndex p) { return std::find(points.begin(), points.end(), p) != points.end(); }))
      continue;
    with.emplace_back(d_.name(derived.point), derived.form);
    placed.push_back(derived.point);
  }
  for (const std::size_t e : equations) {
    const Held& held = parts.held[e];
    if (held.locus != nullptr && held.locus->is_circle)
      lengths.emplace_back(known(held.locus->base()).name + "-" + d_.name(held.points.front()),
                           text(radius_of(*held.locus)));
    else if (held.locus != nullptr)
      lines.emplace_back(d_.name(held.points.front()), line(held.locus->base(), *held.locus));
    else if (held.along.empty())
      lengths.emplace_back(held.first + "-" + held.second, text(held.length));
    else
      lines.emplace_back(held.first, Node::sequence({text(held.second), vector_node(held.along)}, {}));
  }
  std::vector<std::pair<std::string, Node>> form = {{"group", list(names)}};
  if (!with.empty()) form.emplace_back("with", map(with));
  if (!lengths.empty()) form.emplace_back("lengths", map(lengths));
  if (!lines.empty()) form.emplace_back("lines", map(lines));
  form.emplace_back("near", near_of(points));
  std::string name = "group";
  for (const std::string& suffix : names) name += "_" + suffix;
  constexpr std::size_t longest = 40;
  put_together(name.size() > longest ? "group" : name, map(form), "close together", placed);
}

/// The drawn posture, in the file's lengths.
Node PlanarGroups::near_of(const std::vector<PointIndex>& points) const {
  const double unit = core::to_double(d_.unit);
  std::vector<std::pair<std::string, Node>> pose, near;
  for (std::size_t c = 0; c < d_.coordinates.size(); ++c) {
    const mechanism::Coordinate& coordinate = d_.mechanism.coordinates[c];
    double value = drawn_value(c);
    // Of the values of an angle a turn apart one in its range.
    constexpr double turn = 2 * std::numbers::pi;
    if (coordinate.angle && value < core::to_double(coordinate.lower))
      value += turn * std::ceil((core::to_double(coordinate.lower) - value) / turn);
    if (coordinate.angle && value > core::to_double(coordinate.upper))
      value -= turn * std::ceil((value - core::to_double(coordinate.upper)) / turn);
    pose.emplace_back(d_.coordinates[c].name,
                      text(number_text(value / (coordinate.angle ? 1 : unit)) + (coordinate.angle ? " rad" : "")));
  }
  near.emplace_back("at", map(pose));
  for (const PointIndex p : points)
    near.emplace_back(d_.name(p), list({number_text(d_.place(p)[0] / unit), number_text(d_.place(p)[1] / unit)}));
  return map(near);
}

std::string PlanarGroups::number_text(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

}  // namespace clearloci::mechanism
