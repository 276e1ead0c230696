// Points that close together: {group: [C, E], lengths: {B-C: 263, ...}, near: {at: {theta: 40 deg}, C: [291, 204],
// ...}}.
#include <algorithm>
#include <cmath>

#include "core/shown_units.hpp"
#include "mechanism/group_closing.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;

class GroupReader {
 public:
  GroupReader(Mechanism& mechanism, const Entry& entry)
      : m_(mechanism),
        where_(entry.where),
        what_("group " + entry.key),
        value_(named(entry.value, what_)),
        mapping_(value_, {"group", "with", "lengths", "lines", "near"}) {
    group_.name = entry.key;
    group_.where = entry.where;
  }

  void read() {
    check_label(group_.name, where_, "a group");
    add_points();
    if (const auto lengths = mapping_.find("lengths")) read_lengths(*lengths);
    if (const auto lines = mapping_.find("lines")) read_lines(*lines);
    check_count();
    read_near(mapping_.at("near"));
    m_.groups.push_back(std::move(group_));
    close();
  }

 private:
  static Value named(Value value, const std::string& what) {
    value.what = what;
    return value;
  }

  void add(const std::string& name, const core::SourcePosition& where, PointForm form) {
    check_label(name, where, "a point");
    for (const Point& point : m_.points)
      if (point.name == name)
        throw InputError(
            where, "point " + name + " of " + what_ + " is already placed in line " + std::to_string(point.where.line),
            "place it once");
    m_.points.push_back({name, std::move(form), false, where});
  }

  void add_points() {
    const Value list = mapping_.at("group");
    const std::vector<Value> names = elements(list);
    if (names.empty()) throw InputError(list.where, what_ + " has no points", "write such as group: [C, E, F]");
    group_.first = static_cast<PointIndex>(m_.points.size());
    group_.count = names.size();
    const GroupPoint form{static_cast<int>(m_.groups.size())};
    for (const Value& name : names) add(text_of(name), name.where, form);
    group_.last = static_cast<PointIndex>(m_.points.size()) - 1;
    const std::optional<Value> with = mapping_.find("with");
    if (!with) return;
    for (const Entry& further : entries(*with)) {
      Value form_of_it = further.value;
      form_of_it.what = "point " + further.key;
      if (form_of_it.is_sequence() ||
          !(form_of_it.node.has("on") || form_of_it.node.has("mean") || form_of_it.node.has("by")))
        throw InputError(further.where, "point " + further.key + " of " + what_ + " is not fixed in one of its links",
                         "write {on: [B, C], offset: [0.1, 0]}, {mean: [B, C]} or {from: B, by: [0, 0.06]}");
      add(further.key, further.where, read_point_form(m_, form_of_it));
    }
    group_.last = static_cast<PointIndex>(m_.points.size()) - 1;
  }

  bool is_own(PointIndex point) const { return point >= group_.first && point <= group_.last; }
  const std::string& name(PointIndex point) const { return m_.points[static_cast<std::size_t>(point)].name; }

  /// "B-C". Names of points have no hyphens.
  std::pair<PointIndex, PointIndex> pair_of(const Entry& entry) const {
    const std::size_t at = entry.key.find('-');
    if (at == std::string::npos)
      throw InputError(entry.where, "'" + entry.key + "' among the lengths of " + what_ + " names no two points",
                       "write such as B-C: 0.263");
    const auto point = [&](const std::string& name) {
      return read_point_name(m_, {Node::scalar(name, entry.where), "the lengths of " + what_, entry.where});
    };
    const auto trimmed = [](std::string text) {
      text.erase(0, text.find_first_not_of(' '));
      text.erase(text.find_last_not_of(' ') + 1);
      return text;
    };
    return {point(trimmed(entry.key.substr(0, at))), point(trimmed(entry.key.substr(at + 1)))};
  }

  void read_lengths(const Value& value) {
    for (const Entry& entry : entries(value)) {
      const auto [first, second] = pair_of(entry);
      if (first == second || (!is_own(first) && !is_own(second)))
        throw InputError(entry.where, "the length " + entry.key + " holds no point of " + what_,
                         "name a point of the group and another one");
      for (const Group::Distance& distance : group_.distances)
        if ((distance.first == first && distance.second == second) ||
            (distance.first == second && distance.second == first))
          throw InputError(entry.where, "the length " + entry.key + " of " + what_ + " is given twice",
                           "leave one out");
      Value length = entry.value;
      length.what = "the length " + entry.key + " of " + what_;
      length.field = "lengths";
      group_.distances.push_back({first, second, read_length(m_, length), entry.where});
    }
  }

  void read_lines(const Value& value) {
    if (m_.space == Space::spatial)
      throw InputError(value.where, what_ + " has points on lines, but the space is spatial",
                       "hold its points by lengths");
    for (const Entry& entry : entries(value)) {
      Group::Line line;
      line.point = read_point_name(m_, {Node::scalar(entry.key, entry.where), "the lines of " + what_, entry.where});
      const std::vector<Value> parts = elements(entry.value, 2);
      line.base = read_point_name(m_, parts[0]);
      Value along = parts[1];
      along.what = "the direction of the line of " + entry.key;
      along.field = "slider";
      line.along = read_vector_expression(m_, along, Scope::parameters_and_coordinates);
      const std::set<PointIndex> of_direction = points_of(line.along);
      if (!is_own(line.point) && !is_own(line.base) &&
          std::none_of(of_direction.begin(), of_direction.end(), [&](PointIndex p) { return is_own(p); }))
        throw InputError(entry.where, "the line of " + entry.key + " holds no point of " + what_,
                         "write such as E: [Q, [1, 0]] for a point E of the group");
      line.where = entry.where;
      group_.lines.push_back(std::move(line));
    }
  }

  void check_count() const {
    const std::size_t unknowns = group_.count * dimension(m_), held = group_.distances.size() + group_.lines.size();
    if (unknowns == held) return;
    const std::string each = m_.space == Space::spatial ? "three" : "two";
    std::string points;
    for (std::size_t i = 0; i < group_.count; ++i)
      points += (i == 0 ? "" : ", ") + name(group_.first + static_cast<PointIndex>(i));
    throw InputError(where_,
                     what_ + " has " + std::to_string(held) + (held == 1 ? " length" : " lengths") +
                         (group_.lines.empty() ? "" : " and lines") + " for its points " + points + ", and " +
                         std::to_string(unknowns) + " hold them, " + each + " for each",
                     held < unknowns ? "give the lengths of all links between them and what is known"
                                     : "leave out " + std::to_string(held - unknowns) +
                                           ": further points of a link are placed by with: {E: {on: [B, C], ...}}");
  }

  void read_near(const Value& value) {
    std::vector<std::string> keys = {"at"};
    for (std::size_t i = 0; i < group_.count; ++i) keys.push_back(name(group_.first + static_cast<PointIndex>(i)));
    const Mapping near(value, keys);
    std::vector<std::string> names;
    for (const Coordinate& coordinate : m_.coordinates) names.push_back(coordinate.name);
    const Value at = near.at("at");
    const Mapping pose(at, names);
    std::vector<Rational> values;
    for (const Coordinate& coordinate : m_.coordinates)
      values.push_back(read_number(m_, of_coordinate(pose.at(coordinate.name), coordinate), Sign::any).value);
    if (m_.near.empty()) m_.near = values;
    if (m_.near != values)
      throw InputError(at.where,
                       "the posture of " + what_ + " is at another pose than that of group " + m_.groups.front().name,
                       "give the postures of all groups at one pose");
    for (std::size_t i = 1; i < keys.size(); ++i) {
      const Value place = near.at(keys[i]);
      std::array<Rational, 3> written{};
      std::vector<Value> parts = components(m_, place);
      for (std::size_t c = 0; c < parts.size(); ++c) {
        parts[c].field = "points";
        written[c] = read_number(m_, parts[c], Sign::any).value;
      }
      group_.near.push_back(written);
    }
  }

  std::string told(double length) const { return core::told(length, "m", m_.units, 6); }

  std::string name_of_equation(const Group& group, std::size_t i) const {
    if (i < group.distances.size()) return name(group.distances[i].first) + "-" + name(group.distances[i].second);
    return "the line of " + name(group.lines[i - group.distances.size()].point);
  }

  /// The posture, as it closes.
  void close() {
    constexpr double far = 0.15;      // of the longest length: farther off it is another posture
    constexpr double noticed = 1e-3;  // of the longest length
    Group& group = m_.groups.back();
    GroupClosing closing(m_, working_mode(m_));
    const GroupClosing::Posture found = closing.posture();
    double longest = 0;
    for (std::size_t i = 0; i < found.wanted.size(); ++i) {
      if (found.wanted[i] < 0) refuse_length(name_of_equation(group, i), found.wanted[i]);
      longest = std::max(longest, found.wanted[i]);
    }
    for (const auto& point : group.near)
      for (const Rational& c : point)
        if (found.wanted.empty()) longest = std::max(longest, std::abs(core::to_double(c)));
    const Value near = mapping_.at("near");
    if (!found.built)
      throw InputError(near.where, "the points that " + what_ + " is built on do not close at its posture's pose",
                       "give a posture at a pose that the mechanism reaches, with the sides of the file");
    const bool is_open = !found.closed || found.moved > far * longest;
    if (is_open && (!found.lengths.empty() || found.dependent.empty())) refuse_open(group, found, near);
    if (!found.dependent.empty()) {
      std::string names;
      for (const std::size_t equation : found.dependent)
        names += (names.empty() ? "" : ", ") + name_of_equation(group, equation);
      throw InputError(
          near.where, what_ + " is at a dead centre in its posture: " + names + " do not hold its points there",
          "give a posture at another pose, or lengths that hold every point; of a link whose points are on "
          "one line place the further ones by with: {E: {on: [B, C], ...}}");
    }
    std::size_t k = found.closed->size() - group.count * dimension(m_);
    for (auto& place : group.near)
      for (std::size_t c = 0; c < dimension(m_); ++c) place[c] = Rational((*found.closed)[k++]);
    if (found.moved > noticed * longest)
      m_.notes.push_back("the posture of " + what_ + " is off by up to " + told(found.moved) +
                         ": it is closed by Newton's iteration");
  }

  [[noreturn]] void refuse_length(const std::string& name, double length) const {
    throw InputError(mapping_.at("lengths").where,
                     "the length of " + name + " in " + what_ + " is " + told(length) + " at the posture's pose",
                     "write a length that is positive all over the workspace");
  }

  [[noreturn]] void refuse_open(const Group& group, const GroupClosing::Posture& found, const Value& near) const {
    if (found.lengths.empty())
      throw InputError(near.where,
                       "the posture of " + what_ +
                           (found.closed ? " does not close: its points move by " + told(found.moved) + " until they do"
                                         : " does not close: its points are on their lines nowhere near it"),
                       "give places nearer to an assembly, at the pose under at, or change the lines");
    std::size_t worst = 0;
    for (std::size_t i = 0; i < found.lengths.size(); ++i)
      if (std::abs(found.lengths[i] - found.wanted[i]) > std::abs(found.lengths[worst] - found.wanted[worst]))
        worst = i;
    throw InputError(near.where,
                     "the posture of " + what_ + " does not close: " + name_of_equation(group, worst) + " is " +
                         told(found.lengths[worst]) + " in it and has to be " + told(found.wanted[worst]) +
                         ", off by " + told(std::abs(found.lengths[worst] - found.wanted[worst])),
                     "give places nearer to an assembly, at the pose under at, or change the lengths");
  }

  Mechanism& m_;
  core::SourcePosition where_;
  std::string what_;
  Value value_;
  Mapping mapping_;
  Group group_;
};

}  // namespace

bool is_group(const Value& value) { return value.is_map() && value.node.has("group"); }

void read_group(Mechanism& mechanism, const Entry& entry) { GroupReader(mechanism, entry).read(); }

}  // namespace clearloci::mechanism
