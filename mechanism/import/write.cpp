// A source as a mechanism file in the drawn form. Numbers are the shortest decimals within a billionth of the source's
// size; a pin is one point of all its links, so that loops close exactly; what slides along two points of a link is put
// exactly between them.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "core/errors.hpp"
#include "mechanism/import/drawing.hpp"

namespace clearloci::mechanism::imports {
namespace {

using core::InputError;

constexpr double degree = std::numbers::pi / 180;
/// What a source means to be in line or at a right angle, and to how much it is then written.
constexpr double meant = 1e-6, precise = 1e-14;

class Writer : private Drawing {
 public:
  Writer(Source& source, const std::string& file, const std::string& clearance)
      : Drawing(source), file_(file), clearance_(clearance) {}

  std::string text() {
    check();
    name_links();
    make_places();
    put_on_guides();
    const std::string links = links_text(), joints = joints_text() + meshes_text();
    const std::string loads = loads_text(), springs = springs_text();
    const std::string workspace = workspace_text(), effector = effector_text();
    const std::string default_load = loads.empty() && springs.empty() && !has_weight() ? default_load_text() : "";
    std::string out = "# From " + core_name(file_) + ", " + s_.format + ".\n";
    for (const std::string& note : s_.notes) out += "# - " + one_line(note) + "\n";
    out += "format: 1\nname: '" + quoted(s_.name.empty() ? s_.format : s_.name) + "'\n";
    if (!s_.planar) out += "space: spatial\n";
    out += "units: {length: " + s_.unit + "}\n";
    out += "workspace:\n" + workspace + "drawn:\n";
    for (const DrawnPlace& place : places_)
      if (!place.dropped) out += "  " + place.name + ": " + list_of(place.exact) + "\n";
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
    if (s_.joints.empty())
      throw InputError({file_}, "the " + s_.format + " file has no joints", "name a file with a mechanism");
    constexpr double largest = 1e12;
    if (!(size_ > 0) || size_ > largest)
      throw InputError({file_}, "the " + s_.format + " file has its joints in one place",
                       "name a file with a mechanism");
    for (const SourceJoint& joint : s_.joints)
      if (!joint.dropped) return;
    throw InputError({file_}, "the " + s_.format + " file has no joint that moves", "name a file with a mechanism");
  }

  std::string links_text() {
    std::string text;
    std::vector<std::string> uneven, unknown, strange;
    for (std::size_t l = 0; l < s_.links.size(); ++l) {
      const SourceLink& link = s_.links[l];
      if (link.dropped) continue;
      const auto& places = order_[static_cast<int>(l)];
      text += "  " + link_names_[l] + ": {points: [";
      std::set<PlaceIndex> seen;
      for (const PlaceIndex p : places)
        if (seen.insert(p).second) text += (seen.size() > 1 ? ", " : "") + places_[p].name;
      text += "]";
      if (link.mass > 0) {
        text += ", mass: " + shortest_decimal(link.mass, 1e-12 * link.mass);
        const auto centre = centres_.find(static_cast<int>(l));
        if (centre != centres_.end() && centre->second) text += ", com: " + places_[*centre->second].name;
        if (centre == centres_.end() && seen.size() == 1) text += ", com: " + places_[places.front()].name;
        if (link.inertia) {
          const Tensor& i = *link.inertia;
          const double mean = (i.xx + i.yy + i.zz) / 3, one = s_.planar ? i.zz : mean;
          const double off = std::max({std::abs(i.xx - mean), std::abs(i.yy - mean), std::abs(i.zz - mean),
                                       std::abs(i.xy), std::abs(i.xz), std::abs(i.yz)});
          if (!s_.planar && off > 0.01 * mean) uneven.push_back(link_names_[l]);
          text += ", inertia: " + shortest_decimal(std::max(one, 0.0), 1e-12 * std::abs(one));
          const double reach = std::sqrt(std::max(one, 0.0) / link.mass) / s_.metres();
          if (reach > 10 * size_)
            strange.push_back(link.name + " (radius of gyration " + shortest_decimal(reach, 0.01 * reach) + " " +
                              s_.unit + ")");
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
      if (const auto places = order_.find(joint.from); places != order_.end())
        for (const PlaceIndex p : places->second)
          if (std::string text = between(p, at); !text.empty()) return text;
    return direction_text(joint.axis(), written);
  }

  std::string direction_text(const Vec& axis, Vec& written, double within = exactness) const {
    std::size_t most = 0;
    for (std::size_t i = 1; i < dimension_; ++i)
      if (std::abs(axis[i]) > std::abs(axis[most]) + 1e-9) most = i;
    const double scale = std::abs(axis[most]) > 0 ? 1 / std::abs(axis[most]) : 1;
    written = scale * axis;
    return vector_text(written, within);
  }

  /// A rod between balls and crosses is turned by its two points and by axes across or along the way between them:
  /// these are so of the points as they are written, and not but for the roundings of both.
  std::string axes_text(const SourceJoint& joint) const {
    std::array<Vec, 2> axes = {joint.on_from.frame.z, joint.on_to.frame.z};
    const std::array<std::optional<Vec>, 2> ways = {way_of_rod(joint.from), way_of_rod(joint.to)};
    std::array<std::string, 2> texts;
    for (const std::size_t i : {0U, 1U})
      if (ways[i] && norm(cross(unit(*ways[i]), axes[i])) <= meant)
        texts[i] = direction_text((dot(*ways[i], axes[i]) > 0 ? 1 : -1) * *ways[i], axes[i], precise);
    for (const std::size_t i : {0U, 1U}) {
      if (!ways[i] || !texts[i].empty()) continue;
      if (std::abs(dot(unit(*ways[i]), axes[i])) > meant || std::abs(dot(axes[0], axes[1])) > meant) continue;
      Vec& other = axes[1 - i];
      if (texts[1 - i].empty()) {
        texts[1 - i] = direction_text(other, other);
        for (double& part : other) part = std::strtod(shortest_decimal(part, exactness).c_str(), nullptr);
      }
      const Vec across = unit(cross(other, *ways[i]));
      if (norm(cross(across, axes[i])) > meant) continue;  // the other is along this rod
      texts[i] = direction_text((dot(across, axes[i]) > 0 ? 1 : -1) * across, axes[i], precise);
    }
    for (const std::size_t i : {0U, 1U})
      if (texts[i].empty()) texts[i] = direction_text(axes[i], axes[i]);
    return "[" + texts[0] + ", " + texts[1] + "]";
  }

  /// As it is written, between two points of a link that balls and crosses alone hold, or of the two halves of a leg.
  std::optional<Vec> way_of_rod(int link) const {
    if (link == ground_link) return std::nullopt;
    std::set<int> leg = {link};
    for (const SourceJoint& joint : s_.joints)
      if (!joint.dropped && joint.kind == SourceKind::prismatic && (joint.from == link || joint.to == link))
        leg.insert(joint.from == link ? joint.to : joint.from);
    std::vector<PlaceIndex> ends;
    for (const int part : leg) {
      for (const SourceJoint& joint : s_.joints) {
        const bool inside = leg.contains(joint.from) && leg.contains(joint.to);
        const bool turns_freely = joint.kind == SourceKind::spherical || joint.kind == SourceKind::universal;
        if (!joint.dropped && (joint.from == part || joint.to == part) && !inside && !turns_freely) return std::nullopt;
      }
      if (const auto places = order_.find(part); places != order_.end())
        ends.insert(part == link ? ends.begin() : ends.end(), places->second.begin(), places->second.end());
    }
    if (leg.contains(ground_link) || ends.size() < 2) return std::nullopt;
    Vec way{};
    for (std::size_t i = 0; i < dimension_; ++i)
      way[i] = core::to_double(core::Rational(places_[ends[1]].exact[i] - places_[ends[0]].exact[i]));
    return norm(way) > meant * size_ ? std::optional(way) : std::nullopt;
  }

  std::string clearance_text(const SourceJoint& joint, bool& guide_without) const {
    if (joint.kind == SourceKind::prismatic) {
      if (s_.planar && joint.half_length)
        return ", clearance: {gap: " + clearance_ + ", half_length: " + number(*joint.half_length) + "}";
      guide_without = guide_without || s_.planar;
      return "";
    }
    if (joint.kind == SourceKind::slot) return ", clearance: {gap: " + clearance_ + "}";
    return ", clearance: {radial: " + clearance_ + "}";
  }

  /// Gears and belts: of what the source does not say, teeth of usual shape and a tension.
  std::string meshes_text() {
    std::string text;
    std::vector<std::string> gears, belts;
    for (const SourceMesh& mesh : s_.meshes) {
      // The pitch point of a gear has the name of the joint.
      std::string name = plain_name(mesh.name, "W");
      while (used_joint_names_.contains(name) || point_names_.contains(name)) name += "_mesh";
      used_joint_names_.insert(name);
      point_names_.insert(name);
      const auto pair = [](const std::string& a, const std::string& b) { return "[" + a + ", " + b + "]"; };
      const auto centre = [&](std::size_t i) { return places_[*found(mesh.links[i], mesh.at[i])].name; };
      text += "  " + name + ": {" + (mesh.belt ? "belt: " : "gear: ") +
              pair(link_name(mesh.links[0]), link_name(mesh.links[1])) + ", centres: " + pair(centre(0), centre(1));
      if (mesh.belt) {
        // Whole multiples of one decimal, so that the ratio is exact.
        const core::Rational one = core::rational_from_decimal(
            number(0.5 * distance(mesh.at[0], mesh.at[1]) / static_cast<double>(mesh.teeth[0] + mesh.teeth[1])));
        text += ", radii: " + pair(exact_decimal(mesh.teeth[0] * one), exact_decimal(mesh.teeth[1] * one)) +
                ", tension: 100 N}\n";
      } else {
        text += ", teeth: " + pair(std::to_string(mesh.teeth[0]), std::to_string(mesh.teeth[1])) + "}\n";
      }
      (mesh.belt ? belts : gears).push_back(name);
    }
    if (!gears.empty())
      s_.note("wheels of " + enumerated(gears) +
              ": the source gives only the ratio; numbers of teeth and a pressure angle of 20 deg were chosen; replace "
              "them by yours");
    if (!belts.empty())
      s_.note("belts " + enumerated(belts) +
              ": the source gives only the ratio; radii and a tension of 100 N were chosen; replace them by yours");
    return text;
  }

  std::string joints_text() {
    std::string text;
    std::set<std::string>& used = used_joint_names_;
    std::vector<std::string> chosen;
    bool guide_without = false;
    static const std::map<SourceKind, std::string> types = {
        {SourceKind::revolute, "revolute"},       {SourceKind::prismatic, "prismatic"},
        {SourceKind::spherical, "spherical"},     {SourceKind::universal, "universal"},
        {SourceKind::cylindrical, "cylindrical"}, {SourceKind::slot, "slot"}};
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
        text += ", axes: " + axes_text(joint);
      else if (!s_.planar && joint.kind == SourceKind::revolute)
        text += ", axis: " + direction_text(joint.axis(), axes_[j]);
      if (joint.actuated) text += ", actuated: true";
      if (joint.chosen) chosen.push_back(joint_names_[j]);
      text += clearance_text(joint, guide_without) + "}";
      if (joint.speed)
        text += slides(joint)
                    ? "  # runs at " + shortest_decimal(*joint.speed, 1e-9 * std::abs(*joint.speed)) + " m/s"
                    : "  # turns at " + shortest_decimal(*joint.speed / (6 * degree), 1e-9 * std::abs(*joint.speed)) +
                          " rpm";
      else if (joint.name != joint_names_[j])
        text += "  # " + one_line(joint.name);
      text += "\n";
    }
    if (!chosen.empty())
      s_.note("the source names no motor: " + enumerated(chosen) + (chosen.size() == 1 ? " drives" : " drive") +
              " the mechanism here; move `actuated: true` to where yours " + (chosen.size() == 1 ? "is" : "are"));
    s_.note("the source gives no clearances: pins and balls have " + clearance_ + " radially here" +
            (guide_without ? "; guides have none, since half their contact length is not known" : ""));
    return text;
  }

  double direction_of(int link) const {
    const auto places = order_.find(link);
    if (places == order_.end() || places->second.size() < 2) return 0;
    const Vec way = places_[places->second[1]].at - places_[places->second[0]].at;
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
      throw InputError({file_},
                       "nothing drives the " + s_.format + " mechanism: it has no motor, and no joint can be one",
                       "name an input in the program that wrote it");
    return text;
  }

  std::string turn_text(std::size_t j, const std::string& number_of_turn) {
    const SourceJoint& joint = s_.joints[j];
    const std::string name = unused("theta" + number_of_turn, point_names_);
    const bool reversed = joint.to == ground_link;
    const int base = reversed ? ground_link : joint.from;
    int link = reversed ? joint.from : joint.to;
    double turned = 1;
    if (base == ground_link && s_.planar) slow_down(link, turned);
    const double start = s_.planar ? direction_of(link) - direction_of(base) : 0;
    std::string low = s_.planar ? "0" : "-180 deg", high = s_.planar ? "360 deg" : "180 deg";
    if (joint.range) {
      const double sign = (reversed ? -1 : 1) * turned;
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

  /// Turns of wheels on the ground, by that of one of them.
  std::map<int, double> turns_with(int link) const {
    std::map<int, double> turns = {{link, 1}};
    for (bool more = true; more;) {
      more = false;
      for (const SourceMesh& mesh : s_.meshes) {
        if (carrier_of(s_, mesh) != ground_link) continue;
        const double forward =
            (mesh.belt ? 1 : -1) * static_cast<double>(mesh.teeth[0]) / static_cast<double>(mesh.teeth[1]);
        for (const std::size_t i : {0U, 1U}) {
          const auto found = turns.find(mesh.links[i]);
          if (found == turns.end() || turns.contains(mesh.links[1 - i])) continue;
          turns[mesh.links[1 - i]] = found->second * (i == 0 ? forward : 1 / forward);
          more = true;
        }
      }
    }
    return turns;
  }

  /// Only whole multiples of an angle are polynomials in its cosine and sine: of wheels that turn with each other the
  /// coordinate is the angle of one by which all that have a direction turn wholly.
  void slow_down(int& link, double& turned) {
    const std::map<int, double> turns = turns_with(link);
    const auto has_direction = [&](int link_index) {
      const auto points = order_.find(link_index);
      return points != order_.end() && points->second.size() > 1;
    };
    const auto turns_all = [&](const std::pair<const int, double>& one) {
      return has_direction(one.first) && std::all_of(turns.begin(), turns.end(), [&](const auto& other) {
               const double ratio = other.second / one.second;
               return !has_direction(other.first) || std::abs(ratio - std::round(ratio)) < 1e-9;
             });
    };
    if (turns_all({link, 1.0})) return;
    const auto slow = std::find_if(turns.begin(), turns.end(), turns_all);
    if (slow == turns.end()) return;
    link = slow->first;
    turned = slow->second;
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

  /// By a motor, or by teeth.
  bool is_driven(int link) const {
    const auto meshes = [&](const SourceMesh& mesh) { return mesh.links[0] == link || mesh.links[1] == link; };
    return std::any_of(s_.meshes.begin(), s_.meshes.end(), meshes) ||
           std::any_of(s_.joints.begin(), s_.joints.end(), [&](const SourceJoint& joint) {
             return !joint.dropped && joint.actuated && (joint.from == link || joint.to == link);
           });
  }
  bool has_driven(PlaceIndex p) const {
    const auto& links = places_[p].links;
    return std::any_of(links.begin(), links.end(), [&](int link) { return link != ground_link && is_driven(link); });
  }

  std::string effector_text() {
    int link = ground_link;
    std::optional<PlaceIndex> at;
    std::string why;
    const auto take = [&](int link_index, const Vec& place, const char* reason) {
      if (at || link_index == ground_link) return;
      at = found(link_index, place);
      link = link_index;
      why = reason;
    };
    for (const SourcePoint& point : s_.points)
      if (point.traced) take(point.link, point.at, "the source draws its path");
    for (const SourceLoad& load : s_.loads) take(load.link, load.at, "the source loads it");
    for (std::size_t l = s_.links.size(); l-- > 0 && !at;) {
      const auto places = order_.find(static_cast<int>(l));
      if (s_.links[l].dropped || s_.links[l].helper || places == order_.end()) continue;
      if (is_driven(static_cast<int>(l))) continue;
      // Where two legs meet rather than where one is driven.
      for (const bool far : {true, false})
        for (const PlaceIndex p : places->second)
          if (!at && !is_still(p) && !(far && has_driven(p)))
            take(static_cast<int>(l), places_[p].at, "the source says none");
    }
    for (std::size_t l = s_.links.size(); l-- > 0 && !at;)
      if (const auto places = order_.find(static_cast<int>(l));
          !s_.links[l].dropped && places != order_.end() && !places->second.empty())
        take(static_cast<int>(l), places_[places->second.back()].at, "the source says none");
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
        text += ", force: '" + shortest_decimal(force / (0.1 * size_), 1e-9 * force / size_) + "*(" +
                places_[end].name + " - " + places_[at].name + ")'";
      } else if (force > 0) {
        text += ", force: " + vector_text(load.force, 1e-9 * force);
      }
      if (couple > 0)
        text += ", couple: " +
                (s_.planar ? shortest_decimal(load.couple[2], 1e-9 * couple) : vector_text(load.couple, 1e-9 * couple));
      text += load.turns ? "}  # turns with the link\n" : "}\n";
    }
    return text;
  }

  std::string default_load_text() {
    s_.note("the source has no loads: 100 N downwards at the end effector were assumed; replace them by yours");
    return "  - {link: " + link_name(effector_.first) + ", at: " + places_[effector_.second].name +
           ", force: " + (s_.planar ? "[0, -100]" : "[0, 0, -100]") + "}  # put yours here\n";
  }

  std::string springs_text() {
    std::string text;
    std::set<std::string> used;
    for (const SourceSpring& spring : s_.springs) {
      if (spring.links[0] == spring.links[1]) continue;
      text += "  - {name: " + unused(plain_name(spring.name, "S"), used) + ", links: [" + link_name(spring.links[0]) +
              ", " + link_name(spring.links[1]) + "], at: [" + places_[*found(spring.links[0], spring.at[0])].name +
              ", " + places_[*found(spring.links[1], spring.at[1])].name +
              "], stiffness: " + shortest_decimal(spring.stiffness, 1e-9 * spring.stiffness) +
              ", free_length: " + number(spring.free_length) + "}\n";
    }
    return text;
  }

  std::string file_, clearance_;
  std::vector<std::string> joint_names_;
  std::set<std::string> used_joint_names_;
  std::vector<Vec> axes_;  ///< as written
  std::pair<int, PlaceIndex> effector_{ground_link, 0};
};

}  // namespace

std::string write_drawn(Source& source, const std::string& file, const std::string& clearance) {
  return Writer(source, file, clearance).text();
}

}  // namespace clearloci::mechanism::imports
