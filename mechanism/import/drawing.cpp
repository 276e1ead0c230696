#include "mechanism/import/drawing.hpp"

#include <cctype>

namespace clearloci::mechanism::imports {

using core::Rational;

std::string plain_name(const std::string& name, const char* prefix) {
  std::string plain;
  for (const char c : name) plain += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  while (!plain.empty() && plain.back() == '_') plain.pop_back();
  constexpr std::size_t longest = 48;
  if (plain.size() > longest) plain.resize(longest);
  static const std::set<std::string> meant = {"sqrt", "cos", "sin", "atan", "pi", "deg", "ground", "cross"};
  if (plain.empty() || std::isdigit(static_cast<unsigned char>(plain.front())) != 0 || meant.contains(plain))
    plain = prefix + plain;
  return plain;
}

std::string unused(std::string name, std::set<std::string>& used) {
  std::string candidate = name;
  for (int i = 2; used.contains(candidate); ++i) candidate = name + "_" + std::to_string(i);
  used.insert(candidate);
  return candidate;
}

void Drawing::name_links() {
  std::set<std::string> used = {"ground"};
  for (SourceLink& link : s_.links) link_names_.push_back(link.dropped ? "" : unused(plain_name(link.name, "L"), used));
}

const std::string& Drawing::link_name(int link) const {
  static const std::string ground = "ground";
  return link == ground_link ? ground : link_names_[static_cast<std::size_t>(link)];
}

std::optional<PlaceIndex> Drawing::found(int link, const Vec& at) const {
  for (PlaceIndex p = 0; p < places_.size(); ++p)
    if (!places_[p].dropped && places_[p].links.contains(link) && same(places_[p].at, at)) return p;
  return std::nullopt;
}

PlaceIndex Drawing::place_of(int link, const Vec& at, const std::string& name) {
  if (const auto existing = found(link, at)) return *existing;
  DrawnPlace place;
  place.name = unused(plain_name(name, "P"), point_names_);
  place.at = at;
  for (std::size_t i = 0; i < dimension_; ++i) place.exact[i] = core::rational_from_decimal(number(at[i]));
  place.links.insert(link);
  places_.push_back(std::move(place));
  if (link != ground_link) order_[link].push_back(places_.size() - 1);
  return places_.size() - 1;
}

PlaceIndex Drawing::pin(const SourceJoint& joint) {
  const auto a = found(joint.from, joint.at()), b = found(joint.to, joint.at());
  if (a && b && *a != *b) {
    places_[*b].dropped = true;
    for (const int link : places_[*b].links) {
      places_[*a].links.insert(link);
      std::replace(order_[link].begin(), order_[link].end(), *b, *a);
    }
    std::replace(at_.begin(), at_.end(), *b, *a);
    return *a;
  }
  const PlaceIndex place = a   ? *a
                           : b ? *b
                               : place_of(joint.from, joint.at(), joint.point.empty() ? joint.name : joint.point);
  for (const int link : {joint.from, joint.to})
    if (places_[place].links.insert(link).second && link != ground_link) order_[link].push_back(place);
  return place;
}

void Drawing::make_places() {
  point_names_.insert("ground");
  at_.assign(s_.joints.size(), 0);
  for (std::size_t j = 0; j < s_.joints.size(); ++j)
    if (!s_.joints[j].dropped && !slides(s_.joints[j])) at_[j] = pin(s_.joints[j]);
  for (std::size_t j = 0; j < s_.joints.size(); ++j)
    if (!s_.joints[j].dropped && slides(s_.joints[j])) {
      turn_to_links(s_.joints[j]);
      at_[j] = slider_place(s_.joints[j]);
    }
  for (const SourcePoint& point : s_.points)
    if (point.link != ground_link) place_of(point.link, point.at, point.name);
  for (std::size_t l = 0; l < s_.links.size(); ++l)
    if (!s_.links[l].dropped && s_.links[l].mass > 0 && s_.links[l].centre)
      centres_[static_cast<int>(l)] = centre_place(static_cast<int>(l));
  for (const SourceLoad& load : s_.loads)
    if (load.link != ground_link) {
      place_of(load.link, load.at, load.name.empty() ? "Q" : "Q_" + load.name);
      if (load.turns) place_of(load.link, load_end(load), "R_" + load.name);
    }
  for (const SourceSpring& spring : s_.springs)
    for (std::size_t i = 0; i < 2; ++i) place_of(spring.links[i], spring.at[i], spring.name + "_end");
  for (const SourceMesh& mesh : s_.meshes)
    for (std::size_t i = 0; i < 2; ++i) place_of(mesh.links[i], mesh.at[i], mesh.name + "_centre");
  for (const SourceJoint& joint : s_.joints)
    if (!joint.dropped && joint.actuated && !slides(joint) && s_.planar)
      for (const int link : {joint.from, joint.to}) give_direction(link, joint);
}

void Drawing::turn_to_links(SourceJoint& joint) {
  if (joint.to != ground_link || joint.kind == SourceKind::slot) return;
  std::swap(joint.from, joint.to);
  std::swap(joint.on_from, joint.on_to);
  joint.along.reset();
  if (joint.range && !joint.range_is_distance)
    joint.range = std::array<double, 2>{-(*joint.range)[1], -(*joint.range)[0]};
  if (joint.speed) joint.speed = -*joint.speed;
}

void Drawing::give_direction(int link, const SourceJoint& joint) {
  const auto points = order_.find(link);
  if (link == ground_link || points == order_.end() || points->second.size() != 1) return;
  Vec way = {1, 0, 0};
  for (const SourceJoint& source_joint : s_.joints)
    if (!source_joint.dropped && slides(source_joint) && (source_joint.from == link || source_joint.to == link))
      way = source_joint.axis();
  const SourceLink& source_link = s_.links[static_cast<std::size_t>(link)];
  const PlaceIndex first = points->second.front();
  if (source_link.mass > 0 && !source_link.centre) centres_[link] = first;  // otherwise the middle of the first two
  place_of(link, places_[first].at + (0.1 * size_) * way, joint.name + "_way");
}

PlaceIndex Drawing::slider_place(const SourceJoint& joint) {
  if (joint.half_length || joint.kind == SourceKind::slot)
    return place_of(joint.to, joint.at(), joint.point.empty() ? joint.name : joint.point);
  const auto& places = order_[joint.to];
  if (places.empty()) return place_of(joint.to, joint.at(), joint.name);
  return *std::min_element(places.begin(), places.end(), [&](PlaceIndex p, PlaceIndex q) {
    return distance(places_[p].at, joint.at()) < distance(places_[q].at, joint.at());
  });
}

std::optional<PlaceIndex> Drawing::centre_place(int link) {
  const Vec& centre = *s_.links[static_cast<std::size_t>(link)].centre;
  const auto& places = order_[link];
  if (places.size() > 1 && same(centre, 0.5 * (places_[places[0]].at + places_[places[1]].at))) return std::nullopt;
  return place_of(link, centre, "G_" + link_name(link));
}

void Drawing::put_on_guides() {
  for (std::size_t j = 0; j < s_.joints.size(); ++j) {
    const SourceJoint& joint = s_.joints[j];
    if (joint.dropped || !joint.along) continue;
    const auto a = found(joint.from, joint.along->first), b = found(joint.from, joint.along->second);
    if (!a || !b || *a == *b) continue;
    const Vec way = places_[*b].at - places_[*a].at, out = places_[at_[j]].at - places_[*a].at;
    if (is_on_line(*a, *b, at_[j])) continue;
    const double part = dot(out, way) / dot(way, way);
    if (distance(out, part * way) > 1e-5 * size_ || std::abs(part) < 1e-12) continue;
    const Rational exact = core::rational_from_decimal(shortest_decimal(part, exactness * size_ / norm(way)));
    for (std::size_t i = 0; i < dimension_; ++i)
      places_[at_[j]].exact[i] = places_[*a].exact[i] + exact * (places_[*b].exact[i] - places_[*a].exact[i]);
  }
}

bool Drawing::is_on_line(PlaceIndex a, PlaceIndex b, PlaceIndex p) const {
  const auto way = [&](PlaceIndex to, std::size_t i) { return Rational(places_[to].exact[i] - places_[a].exact[i]); };
  for (std::size_t i = 0; i < dimension_; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (way(b, i) * way(p, j) != way(b, j) * way(p, i)) return false;
  return true;
}
}  // namespace clearloci::mechanism::imports
