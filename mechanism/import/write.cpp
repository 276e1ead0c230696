// A source as a mechanism file in the drawn form. Numbers are the shortest decimals within a billionth of the source's
// size; a pin is one point of all its links, so that loops close exactly; what slides along two points of a link is put
// exactly between them.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/errors.hpp"
#include "core/rational.hpp"
#include "mechanism/import/common.hpp"

namespace clearloci::mechanism::imports {
namespace {

using core::InputError;
using core::Rational;

constexpr double exactness = 1e-9;  ///< of the size of the source
constexpr double degree = std::numbers::pi / 180;

/// Letters, digits and _ of a name, such as expressions may contain.
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

/// A rational number as a decimal where it is one.
std::string exact_decimal(const Rational& value) {
  mpz_class denominator = value.get_den();
  std::size_t digits = 0;
  mpz_class power = 1;
  constexpr std::size_t most = 60;
  while (power % denominator != 0 && digits < most) {
    power *= 10;
    ++digits;
  }
  if (digits == most) return value.get_str();
  mpz_class whole = abs(value.get_num()) * (power / denominator);
  std::string text = whole.get_str();
  if (digits > 0) {
    if (text.size() <= digits) text.insert(0, digits + 1 - text.size(), '0');
    text.insert(text.size() - digits, ".");
  }
  return (sgn(value) < 0 ? "-" : "") + text;
}

struct DrawnPlace {
  std::string name;
  Vec at{};
  std::array<Rational, 3> exact;
  std::set<int> links;
  bool dropped = false;
};

using PlaceIndex = std::size_t;

class Writer {
 public:
  Writer(Source& source, const std::string& file, const std::string& clearance)
      : s_(source), file_(file), clearance_(clearance), size_(size_of(source)), dimension_(source.planar ? 2U : 3U) {}

  std::string text() {
    check();
    name_links();
    make_places();
    put_on_guides();
    const std::string links = links_text(), joints = joints_text();
    const std::string loads = loads_text(), springs = springs_text();
    const std::string workspace = workspace_text(), effector = effector_text();
    const std::string default_load = loads.empty() && springs.empty() && !has_weight() ? default_load_text() : "";
    std::string out = "# From " + core_name(file_) + ", " + s_.format + ".\n";
    for (const std::string& note : s_.notes) out += "# - " + one_line(note) + "\n";
    out += "format: 1\nname: '" + quoted(s_.name.empty() ? s_.format : s_.name) + "'\n";
    if (!s_.planar) out += "space: spatial\n";
    out += "units: {length: " + s_.unit + "}\n";
    out += "workspace:\n" + workspace + "drawn:\n";
    for (const DrawnPlace& own : places_)
      if (!own.dropped) out += "  " + own.name + ": " + list_of(own.exact) + "\n";
    out += "links:\n" + links + "joints:\n" + joints;
    out += "end_effector: " + effector + "\n";
    if (!springs.empty()) out += "springs:\n" + springs;
    if (!loads.empty() || !default_load.empty()) out += "loads:\n" + loads + default_load;
    if (has_weight()) out += "gravity: " + vector_text(*s_.gravity, 1e-9 * norm(*s_.gravity)) + "\n";
    return out;
  }

 private:
  static std::string core_name(const std::string& file) {
    const std::size_t slash = file.find_last_of('/');
    const std::string name = slash == std::string::npos ? file : file.substr(slash + 1);
    return one_line(name.size() > 60 ? "an address" : name);
  }
  static std::string one_line(std::string text) {
    for (char& c : text)
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) == 0x7f) c = ' ';
    return text;
  }
  static std::string quoted(const std::string& text) {
    std::string result;
    for (const char c : one_line(text)) result += c == '\'' ? std::string("''") : std::string(1, c);
    return result.size() > 150 ? result.substr(0, 150) : result;
  }

  void check() const {
    constexpr double largest = 1e12;
    if (!(size_ > 0) || size_ > largest)
      throw InputError({file_}, "the " + s_.format + " file has its joints in one place", "name a file with a mechanism");
    for (const SourceJoint& joint : s_.joints)
      if (!joint.dropped) return;
    throw InputError({file_}, "the " + s_.format + " file has no joint that moves", "name a file with a mechanism");
  }

  double tolerance() const { return exactness * size_; }
  bool same(const Vec& a, const Vec& b) const {
    double most = 0;
    for (std::size_t i = 0; i < dimension_; ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most <= 1e-6 * size_;
  }
  std::string number(double value) const { return shortest_decimal(value, tolerance()); }

  std::string vector_text(const Vec& v, double within) const {
    std::string text = "[";
    for (std::size_t i = 0; i < dimension_; ++i) text += (i == 0 ? "" : ", ") + shortest_decimal(v[i], within);
    return text + "]";
  }
  std::string list_of(const std::array<Rational, 3>& exact) const {
    std::string text = "[";
    for (std::size_t i = 0; i < dimension_; ++i) text += (i == 0 ? "" : ", ") + exact_decimal(exact[i]);
    return text + "]";
  }

  // --- names and places

  void name_links() {
    std::set<std::string> used = {"ground"};
    for (SourceLink& link : s_.links) link_names_.push_back(link.dropped ? "" : unused(plain_name(link.name, "L"), used));
  }
  const std::string& link_name(int link) const {
    static const std::string ground = "ground";
    return link == ground_link ? ground : link_names_[static_cast<std::size_t>(link)];
  }

  std::optional<PlaceIndex> found(int link, const Vec& at) const {
    for (PlaceIndex p = 0; p < places_.size(); ++p)
      if (!places_[p].dropped && places_[p].links.contains(link) && same(places_[p].at, at)) return p;
    return std::nullopt;
  }
  PlaceIndex place_of(int link, const Vec& at, const std::string& name) {
    if (const auto own = found(link, at)) return *own;
    DrawnPlace place;
    place.name = unused(plain_name(name, "P"), point_names_);
    place.at = at;
    for (std::size_t i = 0; i < dimension_; ++i) place.exact[i] = core::rational_from_decimal(number(at[i]));
    place.links.insert(link);
    places_.push_back(std::move(place));
    if (link != ground_link) order_[link].push_back(places_.size() - 1);
    return places_.size() - 1;
  }
  /// One point of both links.
  PlaceIndex pin(const SourceJoint& joint) {
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
    const PlaceIndex own = a ? *a : b ? *b : place_of(joint.from, joint.at(), joint.point.empty() ? joint.name : joint.point);
    for (const int link : {joint.from, joint.to})
      if (places_[own].links.insert(link).second && link != ground_link) order_[link].push_back(own);
    return own;
  }

  static bool slides(const SourceJoint& joint) { return joint.slides(); }

  void make_places() {
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
  }

  /// A guide on the ground slides nothing: its link is `to`.
  static void turn_to_links(SourceJoint& joint) {
    if (joint.to != ground_link) return;
    std::swap(joint.from, joint.to);
    std::swap(joint.on_from, joint.on_to);
    joint.along.reset();
    if (joint.range && !joint.range_is_distance)
      joint.range = std::array<double, 2>{-(*joint.range)[1], -(*joint.range)[0]};
    if (joint.speed) joint.speed = -*joint.speed;
  }

  /// A point of `to`: one that is there, the nearest.
  PlaceIndex slider_place(const SourceJoint& joint) {
    if (joint.half_length) return place_of(joint.to, joint.at(), joint.name);
    const auto& own = order_[joint.to];
    if (own.empty()) return place_of(joint.to, joint.at(), joint.name);
    return *std::min_element(own.begin(), own.end(), [&](PlaceIndex p, PlaceIndex q) {
      return distance(places_[p].at, joint.at()) < distance(places_[q].at, joint.at());
    });
  }

  std::optional<PlaceIndex> centre_place(int link) {
    const Vec& centre = *s_.links[static_cast<std::size_t>(link)].centre;
    const auto& own = order_[link];
    if (own.size() > 1 && same(centre, 0.5 * (places_[own[0]].at + places_[own[1]].at))) return std::nullopt;
    return place_of(link, centre, "G_" + link_name(link));
  }

  Vec load_end(const SourceLoad& load) const { return load.at + (0.1 * size_) * unit(load.force); }

  /// What slides between two points of a link is exactly on the line through them.
  void put_on_guides() {
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

  bool is_on_line(PlaceIndex a, PlaceIndex b, PlaceIndex p) const {
    const auto way = [&](PlaceIndex to, std::size_t i) { return Rational(places_[to].exact[i] - places_[a].exact[i]); };
    for (std::size_t i = 0; i < dimension_; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (way(b, i) * way(p, j) != way(b, j) * way(p, i)) return false;
    return true;
  }

  // --- sections

  std::string links_text() {
    std::string text;
    std::vector<std::string> uneven, unknown, strange;
    for (std::size_t l = 0; l < s_.links.size(); ++l) {
      const SourceLink& link = s_.links[l];
      if (link.dropped) continue;
      const auto& own = order_[static_cast<int>(l)];
      text += "  " + link_names_[l] + ": {points: [";
      std::set<PlaceIndex> seen;
      for (const PlaceIndex p : own)
        if (seen.insert(p).second) text += (seen.size() > 1 ? ", " : "") + places_[p].name;
      text += "]";
      if (link.mass > 0) {
        text += ", mass: " + shortest_decimal(link.mass, 1e-12 * link.mass);
        const auto centre = centres_.find(static_cast<int>(l));
        if (centre != centres_.end() && centre->second) text += ", com: " + places_[*centre->second].name;
        if (centre == centres_.end() && seen.size() == 1) text += ", com: " + places_[own.front()].name;
        if (link.inertia) {
          const Tensor& i = *link.inertia;
          const double mean = (i.xx + i.yy + i.zz) / 3, one = s_.planar ? i.zz : mean;
          const double off = std::max({std::abs(i.xx - mean), std::abs(i.yy - mean), std::abs(i.zz - mean),
                                       std::abs(i.xy), std::abs(i.xz), std::abs(i.yz)});
          if (!s_.planar && off > 0.01 * mean) uneven.push_back(link_names_[l]);
          text += ", inertia: " + shortest_decimal(std::max(one, 0.0), 1e-12 * std::abs(one));
          const double reach = std::sqrt(std::max(one, 0.0) / link.mass) / s_.metres();
          if (reach > 10 * size_) strange.push_back(link.name + " (radius of gyration " + shortest_decimal(reach, 0.01 * reach) + " " + s_.unit + ")");
        } else if (seen.size() == 1) {
          text += ", inertia: 0";
          unknown.push_back(link_names_[l]);
        }
        constexpr double lightest = 1e-6, heaviest = 1e5;  // kg: of links that people build
        if (link.mass < lightest || link.mass > heaviest)
          strange.push_back(link.name + " (" + shortest_decimal(link.mass, 0.001 * link.mass) + " kg)");
      }
      text += "}" + (link.name == link_names_[l] ? "" : "  # " + one_line(link.name)) + "\n";
    }
    if (!strange.empty()) s_.note("implausible: " + enumerated(strange));
    if (!unknown.empty()) s_.note("no moment of inertia is known of " + enumerated(unknown) + ": 0 was written");
    if (!uneven.empty())
      s_.note("the moments of inertia of " + enumerated(uneven) +
              " differ with the axis: their mean was written, which counts along trajectories alone");
    return text;
  }

  /// Two points on a guide, or its direction in numbers.
  std::string axis_text(const SourceJoint& joint, PlaceIndex at, Vec& written) const {
    const auto between = [&](PlaceIndex a, PlaceIndex b) -> std::string {
      written = places_[b].at - places_[a].at;
      if (s_.planar) written[2] = 0;
      if (!(norm(written) > 1e-6 * size_) || norm(cross(unit(written), joint.axis())) > 1e-6) return "";
      return "[" + places_[a].name + ", " + places_[b].name + "]";
    };
    if (joint.along) {
      const auto a = found(joint.from, joint.along->first), b = found(joint.from, joint.along->second);
      if (a && b && *a != *b)
        if (std::string text = between(*a, *b); !text.empty()) return text;
    }
    if (joint.from != ground_link)
      if (const auto own = order_.find(joint.from); own != order_.end())
        for (const PlaceIndex p : own->second)
          if (std::string text = between(p, at); !text.empty()) return text;
    return direction_text(joint.axis(), written);
  }

  std::string direction_text(const Vec& axis, Vec& written) const {
    std::size_t most = 0;
    for (std::size_t i = 1; i < dimension_; ++i)
      if (std::abs(axis[i]) > std::abs(axis[most]) + 1e-9) most = i;
    const double scale = std::abs(axis[most]) > 0 ? 1 / std::abs(axis[most]) : 1;
    written = scale * axis;
    return vector_text(written, exactness);
  }

  std::string clearance_text(const SourceJoint& joint, bool& guide_without) const {
    if (joint.kind == SourceKind::prismatic) {
      if (s_.planar && joint.half_length) return ", clearance: {gap: " + clearance_ + ", half_length: " + number(*joint.half_length) + "}";
      guide_without = guide_without || s_.planar;
      return "";
    }
    return ", clearance: {radial: " + clearance_ + "}";
  }

  std::string joints_text() {
    std::string text;
    std::set<std::string> used;
    bool guide_without = false;
    static const std::map<SourceKind, std::string> types = {{SourceKind::revolute, "revolute"},
                                                            {SourceKind::prismatic, "prismatic"},
                                                            {SourceKind::spherical, "spherical"},
                                                            {SourceKind::universal, "universal"},
                                                            {SourceKind::cylindrical, "cylindrical"}};
    joint_names_.assign(s_.joints.size(), "");
    axes_.assign(s_.joints.size(), Vec{});
    for (std::size_t j = 0; j < s_.joints.size(); ++j) {
      const SourceJoint& joint = s_.joints[j];
      if (joint.dropped) continue;
      joint_names_[j] = unused(plain_name(joint.name, "J"), used);
      text += "  " + joint_names_[j] + ": {" + types.at(joint.kind) + ": [" + link_name(joint.from) + ", " +
              link_name(joint.to) + "], at: " + places_[at_[j]].name;
      if (slides(joint))
        text += ", axis: " + axis_text(joint, at_[j], axes_[j]);
      else if (joint.kind == SourceKind::universal)
        text += ", axes: [" + direction_text(joint.on_from.frame.z, axes_[j]) + ", " +
                direction_text(joint.on_to.frame.z, axes_[j]) + "]";
      else if (!s_.planar && joint.kind == SourceKind::revolute)
        text += ", axis: " + direction_text(joint.axis(), axes_[j]);
      if (joint.actuated) text += ", actuated: true";
      text += clearance_text(joint, guide_without) + "}";
      if (joint.speed)
        text += slides(joint) ? "  # runs at " + shortest_decimal(*joint.speed, 1e-9 * std::abs(*joint.speed)) + " m/s"
                              : "  # turns at " + shortest_decimal(*joint.speed / (6 * degree), 1e-9 * std::abs(*joint.speed)) + " rpm";
      else if (joint.name != joint_names_[j])
        text += "  # " + one_line(joint.name);
      text += "\n";
    }
    s_.note("the source says no clearances: pins and balls have " + clearance_ + " radially here" +
            (guide_without ? "; guides have none, since half their contact length is not known" : ""));
    return text;
  }

  double direction_of(int link) const {
    const auto own = order_.find(link);
    if (own == order_.end() || own->second.size() < 2) return 0;
    const Vec way = places_[own->second[1]].at - places_[own->second[0]].at;
    return std::atan2(way[1], way[0]);
  }

  std::string workspace_text() {
    std::string text;
    int turns = 0, strokes = 0;
    for (const SourceJoint& joint : s_.joints)
      if (!joint.dropped && joint.actuated) ++(slides(joint) ? strokes : turns);
    int turn = 0, stroke = 0;
    for (std::size_t j = 0; j < s_.joints.size(); ++j) {
      const SourceJoint& joint = s_.joints[j];
      if (joint.dropped || !joint.actuated) continue;
      text += slides(joint) ? stroke_text(j, strokes > 1 ? std::to_string(++stroke) : "")
                            : turn_text(j, turns > 1 ? std::to_string(++turn) : "");
    }
    if (text.empty())
      throw InputError({file_}, "nothing drives the " + s_.format + " mechanism: it has no motor, and no joint can be one",
                       "name an input in the program that wrote it");
    return text;
  }

  std::string turn_text(std::size_t j, const std::string& number_of_turn) {
    const SourceJoint& joint = s_.joints[j];
    const std::string name = unused("theta" + number_of_turn, point_names_);
    const bool reversed = joint.to == ground_link;
    const int link = reversed ? joint.from : joint.to, base = reversed ? ground_link : joint.from;
    const double start = s_.planar ? direction_of(link) - direction_of(base) : 0;
    std::string low = s_.planar ? "0" : "-180 deg", high = s_.planar ? "360 deg" : "180 deg";
    if (joint.range) {
      const double sign = reversed ? -1 : 1;
      const double from = start + std::min(sign * (*joint.range)[0], sign * (*joint.range)[1]),
                   to = start + std::max(sign * (*joint.range)[0], sign * (*joint.range)[1]);
      if (to - from < 2 * std::numbers::pi) {
        low = shortest_decimal(from / degree, exactness) + " deg";
        high = shortest_decimal(to / degree, exactness) + " deg";
      }
    }
    const std::string of = base == ground_link ? link_name(link) : "[" + link_name(base) + ", " + link_name(link) + "]";
    return "  " + name + ": {angle: [" + low + ", " + high + "], of: " + of + "}\n";
  }

  std::string stroke_text(std::size_t j, const std::string& number_of_stroke) {
    const SourceJoint& joint = s_.joints[j];
    const std::string name = unused("s" + number_of_stroke, point_names_);
    const Vec u = unit(axes_[j]);
    Vec base{};
    if (joint.from != ground_link && !order_[joint.from].empty()) base = places_[order_[joint.from].front()].at;
    Vec way = places_[at_[j]].at - base;
    if (s_.planar) way[2] = 0;
    const double start = dot(u, way), sign = dot(u, joint.axis()) < 0 ? -1 : 1;
    std::array<double, 2> range = {-size_ / 10, size_ / 10};
    if (joint.range) {
      range = *joint.range;
      if (joint.range_is_distance) {
        const double apart = dot(joint.axis(), joint.on_to.at - joint.on_from.at);
        range = {range[0] - apart, range[1] - apart};
      }
    } else
      s_.note("no stroke is known of " + joint.name + ": a tenth of the drawing to either side was written");
    const double low = start + std::min(sign * range[0], sign * range[1]),
                 high = start + std::max(sign * range[0], sign * range[1]);
    return "  " + name + ": {stroke: [" + number(low) + ", " + number(high) + "], of: " + joint_names_[j] + "}\n";
  }

  bool is_still(PlaceIndex p) const { return places_[p].links.contains(ground_link); }

  std::string effector_text() {
    int link = ground_link;
    std::optional<PlaceIndex> at;
    std::string why;
    const auto take = [&](int own, const Vec& place, const char* reason) {
      if (at || own == ground_link) return;
      at = found(own, place);
      link = own;
      why = reason;
    };
    for (const SourcePoint& point : s_.points)
      if (point.traced) take(point.link, point.at, "the source draws its path");
    for (const SourceLoad& load : s_.loads) take(load.link, load.at, "the source loads it");
    for (std::size_t l = s_.links.size(); l-- > 0 && !at;) {
      const auto own = order_.find(static_cast<int>(l));
      if (s_.links[l].dropped || s_.links[l].helper || own == order_.end()) continue;
      const bool driven = std::any_of(s_.joints.begin(), s_.joints.end(), [&](const SourceJoint& joint) {
        return !joint.dropped && joint.actuated && (joint.from == static_cast<int>(l) || joint.to == static_cast<int>(l));
      });
      if (driven) continue;
      for (const PlaceIndex p : own->second)
        if (!at && !is_still(p)) take(static_cast<int>(l), places_[p].at, "the source says none");
    }
    for (std::size_t l = s_.links.size(); l-- > 0 && !at;)
      if (const auto own = order_.find(static_cast<int>(l)); !s_.links[l].dropped && own != order_.end())
        take(static_cast<int>(l), places_[own->second.back()].at, "the source says none");
    if (!at) throw InputError({file_}, "no link of the " + s_.format + " file moves", "name a file with a mechanism");
    effector_ = {link, *at};
    s_.note("the end effector is " + places_[*at].name + " of " + link_name(link) + ": " + why);
    return "{link: " + link_name(link) + ", at: " + places_[*at].name + "}";
  }

  bool has_weight() const {
    return s_.gravity && norm(*s_.gravity) > 0 &&
           std::any_of(s_.links.begin(), s_.links.end(), [](const SourceLink& l) { return !l.dropped && l.mass > 0; });
  }

  std::string loads_text() {
    std::string text;
    for (const SourceLoad& load : s_.loads) {
      if (load.link == ground_link) {
        s_.note("load " + load.name + " acts on the ground and was left out");
        continue;
      }
      const PlaceIndex at = *found(load.link, load.at);
      const double force = norm(load.force), couple = norm(load.couple);
      text += "  - {link: " + link_name(load.link) + ", at: " + places_[at].name;
      if (load.turns && force > 0) {
        const PlaceIndex end = *found(load.link, load_end(load));
        text += ", force: '" + shortest_decimal(force / (0.1 * size_), 1e-9 * force / size_) + "*(" + places_[end].name +
                " - " + places_[at].name + ")'";
      } else if (force > 0) {
        text += ", force: " + vector_text(load.force, 1e-9 * force);
      }
      if (couple > 0)
        text += ", couple: " + (s_.planar ? shortest_decimal(load.couple[2], 1e-9 * couple) : vector_text(load.couple, 1e-9 * couple));
      text += load.turns ? "}  # turns with the link\n" : "}\n";
    }
    return text;
  }

  std::string default_load_text() {
    s_.note("the source has no loads: 100 N downwards at the end effector stand for yours");
    return "  - {link: " + link_name(effector_.first) + ", at: " + places_[effector_.second].name +
           ", force: " + (s_.planar ? "[0, -100]" : "[0, 0, -100]") + "}  # put yours here\n";
  }

  std::string springs_text() {
    std::string text;
    std::set<std::string> used;
    for (const SourceSpring& spring : s_.springs) {
      if (spring.links[0] == spring.links[1]) continue;
      text += "  - {name: " + unused(plain_name(spring.name, "S"), used) + ", links: [" + link_name(spring.links[0]) + ", " +
              link_name(spring.links[1]) + "], at: [" + places_[*found(spring.links[0], spring.at[0])].name + ", " +
              places_[*found(spring.links[1], spring.at[1])].name +
              "], stiffness: " + shortest_decimal(spring.stiffness, 1e-9 * spring.stiffness) +
              ", free_length: " + number(spring.free_length) + "}\n";
    }
    return text;
  }

  Source& s_;
  std::string file_, clearance_;
  double size_;
  std::size_t dimension_;
  std::vector<std::string> link_names_, joint_names_;
  std::set<std::string> point_names_;
  std::vector<DrawnPlace> places_;
  std::map<int, std::vector<PlaceIndex>> order_;           ///< of a link, its points
  std::map<int, std::optional<PlaceIndex>> centres_;       ///< nothing: the middle of the first two points
  std::vector<PlaceIndex> at_;                             ///< of joints
  std::vector<Vec> axes_;                                  ///< as written
  std::pair<int, PlaceIndex> effector_{ground_link, 0};
};

}  // namespace

std::string shortest_decimal(double value, double tolerance) {
  if (std::abs(value) <= tolerance || value == 0 || !std::isfinite(value)) return "0";
  constexpr int most = 17;
  char text[400];
  for (int digits = 0; digits <= most + 12; ++digits) {
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    if (std::abs(std::strtod(text, nullptr) - value) <= tolerance) break;
  }
  std::string result = text;
  if (result.find('.') != std::string::npos) {
    while (result.back() == '0') result.pop_back();
    if (result.back() == '.') result.pop_back();
  }
  return result == "-0" ? "0" : result;
}

std::string write_drawn(Source& source, const std::string& file, const std::string& clearance) {
  return Writer(source, file, clearance).text();
}

}  // namespace clearloci::mechanism::imports
