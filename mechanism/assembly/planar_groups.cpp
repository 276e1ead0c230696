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

const std::string& PlanarGroups::name_of(PointIndex point, const Parts& parts) const {
  const auto index = static_cast<std::size_t>(point);
  return index < d_.points.size() ? name_of(point) : parts.pointers[index - d_.points.size()].name;
}

/// Unknown points that more than one link has, or that something else holds. A point on a guide is not held by it
/// alone.
bool PlanarGroups::is_shared(PointIndex point, const Parts& parts) const {
  if (is_known(point) || d_.at(point).built || !d_.at(point).has_place) return false;
  std::size_t links = 0;
  for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l)
    links += has_point(static_cast<LinkIndex>(l), point) ? 1 : 0;
  const auto& joints = d_.mechanism.joints;
  const bool is_joint = std::any_of(joints.begin(), joints.end(), [&](const Joint& joint) {
    const bool of_drawn_links = parts.drawn.contains(joint.from == ground ? joint.to : joint.from);
    return joint.at == point && !(is_guide(d_.mechanism, joint) && of_drawn_links);
  });
  return links > 1 || is_joint || place_coordinate(point, 0) != nullptr || place_coordinate(point, 1) != nullptr;
}

bool PlanarGroups::put_group() {
  Parts parts;
  for (const std::vector<LinkIndex>& links : links_that_turn_together())
    if (std::all_of(links.begin(), links.end(), [&](LinkIndex link) { return is_drawn_exactly(link); }))
      parts.drawn.insert(links.begin(), links.end());
  for (PointIndex p = 0; p < static_cast<PointIndex>(d_.points.size()); ++p)
    if (is_shared(p, parts)) parts.use[p] = Use::free;
  use_points_of_slides(parts);
  find_frames(parts);
  std::vector<LinkIndex> links = links_with_shared_points(parts);
  while (!links.empty()) {
    const auto next = next_link(links, parts);
    add_link(*next, parts);
    links.erase(next);
  }
  add_known_guides(parts);
  add_moving_guides(parts);
  add_strokes(parts);
  return put_smallest(parts);
}

/// Links whose direction is known first, since each has but one point that others may place; then frames and what turns
/// with them; then those with most points. The order in the file says nothing.
std::vector<LinkIndex> PlanarGroups::links_with_shared_points(const Parts& parts) const {
  struct Ranked {
    LinkIndex link;
    int rank;
    std::vector<PointIndex> points;
  };
  std::vector<Ranked> ranked;
  for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l) {
    const auto link = static_cast<LinkIndex>(l);
    Ranked next{link, rank(link, parts), shared_of(link, parts)};
    std::sort(next.points.begin(), next.points.end());
    if (!next.points.empty()) ranked.push_back(std::move(next));
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    if (a.rank != b.rank) return a.rank < b.rank;
    if (a.points.size() != b.points.size()) return a.points.size() > b.points.size();
    return a.points < b.points;
  });
  std::vector<LinkIndex> links;
  for (const Ranked& next : ranked) links.push_back(next.link);
  return links;
}

/// Of links that one point holds one that begins at a point already placed, so that only those in a closed loop find
/// two points of theirs placed.
std::vector<LinkIndex>::const_iterator PlanarGroups::next_link(const std::vector<LinkIndex>& links,
                                                               const Parts& parts) const {
  const int first = rank(links.front(), parts);
  if (first != 0 && first != 2) return links.begin();
  const auto begins = std::find_if(links.begin(), links.end(), [&](LinkIndex link) {
    const std::vector<PointIndex> points = shared_of(link, parts);
    return rank(link, parts) == first &&
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

/// Two points of a link, one of a link that turns as others do, are held by others; the further ones are built on them,
/// or where another link builds them held by their distances.
void PlanarGroups::add_link(LinkIndex link, Parts& parts) {
  if (is_placed(link)) return;
  std::vector<PointIndex> points = shared_of(link, parts);
  std::stable_sort(points.begin(), points.end(), [&](PointIndex a, PointIndex b) {
    return (parts.use[a] == Use::free ? 1 : 0) < (parts.use[b] == Use::free ? 1 : 0);
  });
  const std::vector<PointIndex> bases = known_points(link);
  if (!bases.empty()) points.insert(points.begin(), bases.front());
  const int its_rank = rank(link, parts);
  if (its_rank == 0 || its_rank == 2) return add_turned_link(link, std::move(points), parts);
  for (std::size_t k = 0; k < std::min<std::size_t>(2, points.size()); ++k)
    if (auto use = parts.use.find(points[k]); use != parts.use.end() && use->second == Use::free)
      use->second = Use::base;
  for (Frame& frame : parts.frames)
    if (frame.link == link && points.size() > 1) {
      frame.from = points[0];
      frame.to = points[1];
      frame.way = shape(link).way(points[0], points[1]);
    }
  if (points.size() > 1) add_distance(link, points[0], points[1], parts);
  for (std::size_t k = 2; k < points.size(); ++k) {
    const PointIndex p = points[k];
    if (parts.use[p] == Use::free && is_held_by_lengths(link, points[0], points[1], p)) parts.use[p] = Use::base;
    if (parts.use[p] != Use::free) {
      for (std::size_t i = 0; i < 2; ++i) add_distance(link, points[i], p, parts);
      continue;
    }
    parts.use[p] = Use::derived;
    const auto [along, beside] =
        PlanarTurning::parts(shape(link).way(points[0], p), shape(link).way(points[0], points[1]), false);
    parts.derived.push_back({p,
                             {points[0], points[1]},
                             map({{"on", list({name_of(points[0]), name_of(points[1])})},
                                  {"offset", list({along.text(), beside.text()})}})});
  }
}

/// One point is held by others; two that others place are as far apart along x and y as the link says.
void PlanarGroups::add_turned_link(LinkIndex link, std::vector<PointIndex> points, Parts& parts) const {
  if (auto use = parts.use.find(points[0]); use != parts.use.end() && use->second == Use::free) use->second = Use::base;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const PointIndex p = points[k];
    Carried at;
    at.link = link;
    at.point = points[0];
    at.way = shape(link).way(points[0], p);
    at.is_of_shape = true;
    if (parts.use[p] == Use::free) {
      parts.use[p] = Use::derived;
      Derived derived{p, {points[0]}, {}, at};
      if (const Frame* frame = frame_of(link, parts))
        derived.bases.insert(derived.bases.end(), {frame->from, frame->to});
      parts.derived.push_back(std::move(derived));
      continue;
    }
    for (const char* axis : {"[1, 0]", "[0, 1]"}) {
      at.along = axis;
      hold(p, at, parts);
    }
  }
}

/// What is known holds a point by itself: guides and coordinates. Of a link that only moves along with one of its
/// points one is held so.
void PlanarGroups::add_known_guides(Parts& parts) {
  const auto is_first_of = [&](LinkIndex link, PointIndex point) {
    if (link == ground) return false;
    const std::vector<PointIndex> points = shared_of(link, parts);
    return !points.empty() && points.front() == point;
  };
  parts.loci.resize(parts.use.size());
  std::size_t at = 0;
  for (const auto& use : parts.use) {
    std::vector<Locus>& all = parts.loci[at++];
    for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l)
      if (const auto link = static_cast<LinkIndex>(l);
          is_turned(link) && known_points(link).empty() && is_first_of(link, use.first))
        add_lines(link, use.first, all);
    for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j)
      if (const Joint& joint = d_.mechanism.joints[j];
          is_slot(d_.mechanism, joint) && (joint.at == use.first || is_first_of(joint.from, use.first)))
        if (auto line = line_of_slot(static_cast<JointIndex>(j), use.first)) all.push_back(std::move(*line));
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

/// A point that slides along the way between two points of a link of given lengths, or of one that turns on its own.
void PlanarGroups::add_moving_guide(JointIndex index, Parts& parts) const {
  const double close = 1e-12 * d_.size / core::to_double(d_.unit);
  const Joint& joint = d_.joint(index);
  const auto axis = drawn_axis(index);
  const auto is_in_use = [&](PointIndex p) { return is_known(p) || parts.use.contains(p); };
  if (!axis || !d_.at(joint.at).is_exact || !is_in_use(joint.at)) return;
  std::vector<LinkIndex> guides = {joint.from};
  if (is_guide(d_.mechanism, joint)) guides.push_back(joint.to);
  for (const LinkIndex guide : guides) {
    std::vector<PointIndex> on_line;
    for (const PointIndex p : d_.link(guide).points)
      if (p != joint.at && d_.at(p).is_exact &&
          size_of(cross(*axis, d_.at(p).at - d_.at(joint.at).at)) <= close * size_of(*axis))
        on_line.push_back(p);
    if (on_line.size() < 2) continue;
    if (!std::all_of(on_line.begin(), on_line.begin() + 2, is_in_use)) continue;
    Held line;
    for (const PointIndex p : {joint.at, on_line[0], on_line[1]})
      if (!is_known(p)) line.points.push_back(p);
    if (line.points.empty()) return;
    line.first = name_of(joint.at);
    line.second = name_of(on_line[0]);
    line.along = "[" + name_of(on_line[0]) + ", " + name_of(on_line[1]) + "]";
    parts.held.push_back(std::move(line));
    return;
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

bool PlanarGroups::put_smallest(Parts& parts) {
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
                               Parts& parts) {
  std::vector<std::string> names;
  std::vector<PointIndex> placed;
  for (const PointIndex p : points) {
    const auto index = static_cast<std::size_t>(p);
    if (index < d_.points.size())
      placed.push_back(p);
    else
      name_pointer(p, parts);
    names.push_back(name_of(p, parts));
  }
  Writing writing;
  for (const Derived& derived : parts.derived) {
    std::vector<PointIndex> used;
    for (const PointIndex base : derived.bases) expand(base, parts, used);
    if (!std::all_of(used.begin(), used.end(),
                     [&](PointIndex p) { return std::find(points.begin(), points.end(), p) != points.end(); }))
      continue;
    const Node form = derived.at ? from_point(*derived.at, parts, writing) : derived.form;
    writing.with.emplace_back(d_.name(derived.point), form);
    placed.push_back(derived.point);
  }
  std::vector<std::pair<std::string, Node>> lengths, lines;
  for (const std::size_t e : equations) {
    const Held& held = parts.held[e];
    if (held.line) continue;
    if (held.locus != nullptr && held.locus->is_circle)
      lengths.emplace_back(known(held.locus->base()).name + "-" + d_.name(held.points.front()),
                           text(radius_of(*held.locus)));
    else if (held.locus != nullptr)
      lines.emplace_back(d_.name(held.points.front()), line(held.locus->base(), *held.locus));
    else if (held.along.empty())
      lengths.emplace_back(held.first + "-" + (held.second.empty() ? name_of(held.points.back(), parts) : held.second),
                           text(held.length));
    else
      lines.emplace_back(held.first, Node::sequence({text(held.second), vector_node(held.along)}, {}));
  }
  for (const std::size_t e : equations)
    if (parts.held[e].line) add_line(parts.held[e], parts, writing, lines);
  std::vector<std::pair<std::string, Node>> form = {{"group", list(names)}};
  if (!writing.with.empty()) form.emplace_back("with", map(writing.with));
  if (!lengths.empty()) form.emplace_back("lengths", map(lengths));
  if (!lines.empty()) form.emplace_back("lines", map(lines));
  form.emplace_back("near", near_of(points, parts));
  std::string name = "group";
  for (const std::string& suffix : names) name += "_" + suffix;
  constexpr std::size_t longest = 40;
  put_together(name.size() > longest ? "group" : name, map(form), "close together", placed);
  turn_frames(points, parts, writing);
}

/// The drawn posture, in the file's lengths.
Node PlanarGroups::near_of(const std::vector<PointIndex>& points, const Parts& parts) const {
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
  for (const PointIndex p : points) {
    const auto index = static_cast<std::size_t>(p);
    const std::array<double, 3>& place =
        index < d_.points.size() ? d_.place(p) : parts.pointers[index - d_.points.size()].posture;
    near.emplace_back(name_of(p, parts), list({number_text(place[0] / unit), number_text(place[1] / unit)}));
  }
  return map(near);
}

std::string PlanarGroups::number_text(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

}  // namespace clearloci::mechanism
