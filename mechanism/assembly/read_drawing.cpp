// The drawn form of mechanism-file.md, as far as its words go.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "mechanism/assembly/drawing.hpp"
#include "mechanism/dependence.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/reader.hpp"
#include "mechanism/units.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using CoordinateKind = DrawnCoordinate::Kind;

const std::vector<std::string> axis_names = {"x", "y", "z"};

Node text_node(const std::string& text, const core::SourcePosition& where) { return Node::scalar(text, where); }

Node list_node(const std::vector<std::string>& texts, const core::SourcePosition& where) {
  std::vector<Node> items;
  for (const std::string& text : texts) items.push_back(text_node(text, where));
  return Node::sequence(std::move(items), where);
}

/// Every word in a node's values that could be a name.
void add_words(const Node& node, std::set<std::string>& words) {
  if (node.IsScalar()) {
    std::string word;
    for (const char c : node.Scalar() + " ") {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_')
        word += c;
      else if (!word.empty())
        words.insert(std::exchange(word, ""));
    }
  }
  for (const Node& item : node.items()) add_words(item, words);
  for (const auto& [key, content] : node.pairs()) add_words(content, words);
}

class DrawingReader {
 public:
  DrawingReader(const Value& document, const std::vector<Override>& overrides, PlainSections& plain)
      : document_(document), plain_(plain) {
    for (const Entry& entry : entries(document)) sections_.emplace(entry.key, entry.value);
    Mechanism& m = result_.mechanism;
    m.file = document.where.file;
    m.units = read_units(section("units"));
    if (const auto space = section("space")) m.space = text_of(*space) == "spatial" ? Space::spatial : Space::planar;
    read_parameters(m, section("parameters"), free_effort_parameters(required("joints")), overrides);
    result_.unit = length_unit();
    read_coordinates();
    read_points();
    read_links();
    read_joints(m, required("joints"));
    check_size();
    place_axes();
    for (DrawnCoordinate& coordinate : result_.coordinates) resolve(coordinate);
    check_order_of_turns();
  }

  Drawing take() { return std::move(result_); }

 private:
  std::optional<Value> section(const std::string& name) const {
    const auto found = sections_.find(name);
    if (found == sections_.end()) return std::nullopt;
    Value value = found->second;
    if (is_field(name)) value.field = name;
    return value;
  }
  Value required(const std::string& name) const {
    if (const auto found = section(name)) return *found;
    throw InputError(document_.where, "the key '" + name + "' is missing in the file", "add " + name + ": ...");
  }

  Rational length_unit() const {
    const Value one{Node("1"), "a length", document_.where, "length"};
    return read_number(result_.mechanism, one, Sign::any).value;
  }

  /// Freedoms are counted in matrices as wide as there are links; nobody draws more by hand.
  void check_size() const {
    constexpr std::size_t most_links = 60, most_points = 200;
    if (result_.mechanism.links.size() > most_links || result_.points.size() > most_points)
      throw InputError(required("drawn").where,
                       "the drawing has " + std::to_string(result_.mechanism.links.size()) + " links and " +
                           std::to_string(result_.points.size()) + " points",
                       "draw 60 links and 200 points at most, or write constructions");
  }

  // --- coordinates

  /// The workspace without what its coordinates are of; the motors' own where there is none.
  void read_coordinates() {
    std::vector<Node::Pair> pairs;
    const auto workspace = section("workspace");
    if (!workspace || workspace->node.IsNull()) {
      add_motors(pairs);
    } else {
      for (const Entry& entry : entries(*workspace)) {
        written_.push_back(entry);
        pairs.emplace_back(text_node(entry.key, entry.where), plain_coordinate(entry));
      }
    }
    plain_.workspace = Node::map(std::move(pairs), workspace ? workspace->where : document_.where);
    Value value{plain_.workspace, "'workspace'", plain_.workspace.where(), "workspace"};
    read_workspace(result_.mechanism, value);
  }

  Node plain_coordinate(const Entry& entry) {
    DrawnCoordinate& own = result_.coordinates.emplace_back();
    own.name = entry.key;
    own.where = entry.where;
    if (!entry.value.is_map()) return entry.value.node;
    Value value = entry.value;
    value.what = "coordinate " + entry.key;
    const auto range_of = [&](const Mapping& mapping, const char* key) {
      Value range = mapping.at(key);
      (void)elements(range, 2);
      return range.node;
    };
    const auto angle = [&](const Node& range) {
      return Node::map({{text_node("angle", entry.where), range}}, entry.value.where);
    };
    if (value.node.has("place")) {
      own.kind = CoordinateKind::place;
      return range_of(Mapping(value, {"place", "of", "within"}), "within");
    }
    if (value.node.has("stroke")) {
      own.kind = CoordinateKind::stroke;
      return range_of(Mapping(value, {"stroke", "of"}), "stroke");
    }
    if (value.node.has("turn")) {
      own.kind = CoordinateKind::turn;
      return angle(range_of(Mapping(value, {"turn", "of", "within"}), "within"));
    }
    if (!value.node.has("of")) return entry.value.node;
    own.kind = CoordinateKind::direction;
    return angle(range_of(Mapping(value, {"angle", "of"}), "angle"));
  }

  void add_motors(std::vector<Node::Pair>& pairs) {
    const Value joints = required("joints");
    for (const Entry& entry : entries(joints)) {
      if (!entry.value.is_map()) continue;
      bool actuated = false;
      std::string type;
      Node links;
      for (const Entry& part : entries(entry.value)) {
        if (part.key == "actuated" && part.value.is_scalar()) actuated = boolean_of(part.value);
        if (part.key == "revolute" || part.key == "prismatic" || part.key == "cylindrical") {
          type = part.key;
          links = part.value.node;
        }
      }
      if (!actuated) continue;
      if (type != "revolute")
        throw InputError(entry.where, "the motor " + entry.key + " is a coordinate without a range",
                         "write workspace: {" + entry.key + ": {stroke: [least, greatest], of: " + entry.key + "}}");
      DrawnCoordinate& own = result_.coordinates.emplace_back();
      own.name = entry.key;
      own.where = entry.where;
      own.kind = CoordinateKind::direction;
      written_.push_back(
          {entry.key,
           entry.where,
           {Node::map({{text_node("of", entry.where), links}}, entry.where), "coordinate " + entry.key, entry.where}});
      pairs.emplace_back(
          text_node(entry.key, entry.where),
          Node::map({{text_node("angle", entry.where), list_node({"0", "360 deg"}, entry.where)}}, entry.where));
    }
    if (pairs.empty())
      throw InputError(document_.where, "there is no workspace, and no joint is actuated",
                       "write workspace: {theta: {angle: [0, 360 deg], of: a link}}, or actuated: true at a joint");
  }

  LinkIndex link_named(const Value& value, const DrawnCoordinate& own, bool or_ground) const {
    Value name = value;
    name.what = "coordinate " + own.name;
    const LinkIndex link = read_link_name(result_.mechanism, name, or_ground);
    if (link != ground && result_.mechanism.space == Space::planar && result_.link(link).points.size() < 2)
      throw InputError(value.where,
                       "coordinate " + own.name + " is the direction of link " + result_.link(link).name +
                           ", which has a single point",
                       "name a link of two points, or add a second point to it");
    return link;
  }

  void resolve(DrawnCoordinate& own) const {
    if (own.kind == CoordinateKind::plain) return;
    const auto index = static_cast<std::size_t>(&own - result_.coordinates.data());
    Value value = written_[index].value;
    value.what = "coordinate " + own.name;
    const Mapping mapping(value, {"angle", "place", "stroke", "turn", "of", "within"});
    Value of = mapping.at("of");
    if (own.kind == CoordinateKind::direction) {
      if (of.is_sequence()) {
        const std::vector<Value> pair = elements(of, 2);
        own.other = link_named(pair[0], own, true);
        own.link = link_named(pair[1], own, true);
        if (own.link == ground) std::swap(own.link, own.other);
        if (own.link == own.other)
          throw InputError(of.where, "coordinate " + own.name + " is the angle of a link from itself",
                           "name two different links");
      } else {
        own.link = link_named(of, own, false);
      }
    } else if (own.kind == CoordinateKind::place) {
      const Value axis = mapping.at("place");
      const auto found = std::find(axis_names.begin(), axis_names.end(), text_of(axis));
      own.axis = static_cast<std::size_t>(found - axis_names.begin());
      if (own.axis >= dimension(result_.mechanism))
        throw InputError(axis.where, "coordinate " + own.name + ": the place is '" + text_of(axis) + "'",
                         dimension(result_.mechanism) == 2 ? "write place: x or y" : "write place: x, y or z");
      own.point = read_point_name(result_.mechanism, of);
    } else if (own.kind == CoordinateKind::stroke) {
      own.joint = joint_named(of, own);
    } else {
      own.link = link_named(of, own, false);
      read_turn(mapping.at("turn"), own);
    }
  }

  JointIndex joint_named(const Value& of, const DrawnCoordinate& own) const {
    std::vector<std::string> known;
    for (std::size_t j = 0; j < result_.mechanism.joints.size(); ++j) {
      const Joint& joint = result_.mechanism.joints[j];
      if (joint.type != JointType::prismatic && joint.type != JointType::cylindrical) continue;
      if (joint.name == text_of(of)) return static_cast<JointIndex>(j);
      known.push_back(joint.name);
    }
    throw InputError(of.where, "coordinate " + own.name + ": there is no prismatic joint '" + text_of(of) + "'",
                     suggest(text_of(of), known, "prismatic joints"));
  }

  static void read_turn(const Value& turn, DrawnCoordinate& own) {
    const std::string text = text_of(turn);
    std::string sorted = text.substr(0, 3);
    std::sort(sorted.begin(), sorted.end());
    if (text.size() != 5 || sorted != "xyz" || text[3] != '.' || text[4] < '1' || text[4] > '3')
      throw InputError(turn.where, "coordinate " + own.name + ": the turn is '" + text + "'",
                       "write such as turn: zyx.1, the first angle of the order z, y, x");
    own.order = text.substr(0, 3);
    own.axis = static_cast<std::size_t>(text[4] - '1');
  }

  void check_order_of_turns() const {
    for (const DrawnCoordinate& own : result_.coordinates) {
      if (own.kind != CoordinateKind::turn) continue;
      if (!result_.is_spatial())
        throw InputError(own.where, "coordinate " + own.name + " is a turn in space, but the mechanism is planar",
                         "write {angle: [...], of: " + result_.name_of(own.link) + "}");
      for (const DrawnCoordinate& other : result_.coordinates)
        if (other.kind == CoordinateKind::turn && other.link == own.link && other.order != own.order)
          throw InputError(other.where,
                           "coordinates " + own.name + " and " + other.name + " turn link " +
                               result_.name_of(own.link) + " in two orders",
                           "write one order for all of its angles");
    }
  }

  // --- points

  void read_points() {
    Mechanism& m = result_.mechanism;
    const std::vector<Entry> drawn = entries(required("drawn"));
    if (drawn.empty()) throw InputError(required("drawn").where, "nothing is drawn", "write such as A: [0, 0]");
    std::map<std::string, Entry> built;
    std::vector<std::string> order;
    if (const auto points = section("points"); points && !points->node.IsNull())
      for (const Entry& entry : entries(*points)) {
        built.emplace(entry.key, entry);
        order.push_back(entry.key);
      }
    for (const Entry& entry : drawn) {
      add_drawn(entry, built);
      read_known_frames(m, section("frames"));
    }
    for (const std::string& name : order) add_built(built.at(name));
    for (const std::string& name : order) note_uses(built.at(name));
    place_built();
    double size = 0;
    for (std::size_t p = 0; p < result_.points.size(); ++p)
      for (std::size_t q = 0; q < p; ++q)
        if (result_.points[p].has_place && result_.points[q].has_place)
          size = std::max(size, distance(result_.posture[p], result_.posture[q]));
    if (!(size > 0)) throw InputError(drawn.front().where, "all points are drawn in one place", "draw them apart");
    result_.size = size;
    m.body_frames.clear();
  }

  static double distance(const std::array<double, 3>& p, const std::array<double, 3>& q) {
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }

  void add_drawn(const Entry& entry, const std::map<std::string, Entry>& built) {
    check_label(entry.key, entry.where, "a point");
    Value place = entry.value;
    place.what = "the drawn place of " + entry.key;
    place.field = "points";
    if (!place.is_sequence())
      throw InputError(place.where, place.what + " is no place",
                       result_.is_spatial() ? "write [x, y, z]; constructions stand under points"
                                            : "write [x, y]; constructions stand under points");
    DrawnPoint point;
    point.is_exact = true;
    point.form = place.node;
    ExplicitPoint form;
    const std::vector<Value> parts = elements(place, static_cast<int>(dimension(result_.mechanism)));
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Number number = read_number(result_.mechanism, parts[i], Sign::any);
      form.coordinates.push_back(number.expression);
      point.at[i] = amount(number, parts[i]);
    }
    if (const auto own = built.find(entry.key); own != built.end()) {
      point.built = true;
      point.form = own->second.value.node;
    }
    result_.mechanism.points.push_back({entry.key, std::move(form), false, entry.where});
    result_.points.push_back(std::move(point));
  }

  /// In the file's units: a rational number where no parameter is in it.
  Amount amount(const Number& number, const Value& value) const {
    const ExactValue exact = evaluate(number.expression, result_.mechanism.parameters);
    const Rational in_file = exact.value / result_.unit;
    if (symbols(number.expression).empty() && exact.exact) return Amount(in_file);
    return Amount::expression(text_of(value), core::to_double(in_file));
  }

  void add_built(const Entry& entry) {
    Mechanism& m = result_.mechanism;
    const auto drawn =
        std::find_if(m.points.begin(), m.points.end(), [&](const Point& p) { return p.name == entry.key; });
    if (drawn != m.points.end()) {
      read_known_frames(m, section("frames"));
      return;
    }
    check_label(entry.key, entry.where, "a point");
    Value form = entry.value;
    form.what = "point " + entry.key;
    DrawnPoint point;
    point.built = true;
    point.form = form.node;
    m.points.push_back({entry.key, read_point_form(m, form), false, entry.where});
    point.moves = !coordinates_of(m, static_cast<PointIndex>(m.points.size()) - 1).empty();
    point.held = form.is_sequence() || form.node.has("in");
    point.has_place = !point.moves;
    if (form.is_sequence() && !point.moves) {
      point.is_exact = true;
      std::vector<Value> parts = elements(form);
      for (std::size_t i = 0; i < parts.size() && i < 3; ++i) {
        parts[i].field = "points";
        point.at[i] = amount(read_number(m, parts[i], Sign::any), parts[i]);
      }
    }
    result_.points.push_back(std::move(point));
    read_known_frames(m, section("frames"));
  }

  void note_uses(const Entry& entry) {
    if (entry.value.is_sequence()) return;
    std::set<std::string> words;
    add_words(entry.value.node, words);
    if (const auto frames = section("frames"); frames && frames->is_map())
      for (const Entry& frame : entries(*frames))
        if (words.contains(frame.key)) add_words(frame.value.node, words);
    const auto& points = result_.mechanism.points;
    std::size_t own = 0;
    while (points[own].name != entry.key) ++own;
    for (std::size_t p = 0; p < points.size(); ++p)
      if (p != own && words.contains(points[p].name)) result_.points[own].uses.push_back(static_cast<PointIndex>(p));
  }

  /// Where constructions put their points, the others being drawn.
  void place_built() {
    const Mechanism& m = result_.mechanism;
    const std::vector<double> pose = drawn_pose();
    const auto placed = sample_points(m, pose);
    for (std::size_t p = 0; p < result_.points.size(); ++p) {
      if (!placed[p] && result_.points[p].has_place)
        throw InputError(m.points[p].where, "point " + m.points[p].name + " cannot be built in the drawn posture",
                         "draw its base points within reach of each other");
      result_.posture.push_back(placed[p].value_or(std::array<double, 3>{}));
    }
  }

  /// The pose in which points that are written over the coordinates are where they are drawn: least squares. Points
  /// that move with it have their places then.
  std::vector<double> drawn_pose() {
    Mechanism as_built = result_.mechanism;
    std::vector<std::size_t> both;
    for (std::size_t p = 0; p < result_.points.size(); ++p) {
      if (!result_.points[p].built || !result_.points[p].is_exact) continue;
      Value form{result_.points[p].form, "point " + as_built.points[p].name, result_.points[p].form.where(), "points"};
      if (!form.is_sequence() && !form.node.has("in")) continue;
      PointForm own = read_point_form(result_.mechanism, form);
      if (!std::holds_alternative<ExplicitPoint>(own)) continue;
      as_built.points[p].form = std::move(own);
      result_.points[p].held = true;
      result_.points[p].moves = !coordinates_of(as_built, static_cast<PointIndex>(p)).empty();
      if (result_.points[p].moves) both.push_back(p);
    }
    std::vector<double> middle = spread_poses(as_built, 1).front();
    const bool all_placed = put_drawn_places(middle);
    if (both.empty()) {
      if (all_placed)
        for (DrawnPoint& point : result_.points) point.has_place = true;
      return middle;
    }
    std::vector<double> best;
    double least = 0;
    for (std::vector<double> pose : spread_poses(as_built, 8)) {
      (void)put_drawn_places(pose);
      const double off = fit(as_built, both, pose);
      if (best.empty() || off < least) best = std::move(pose), least = off;
    }
    check_fit(as_built, both, best);
    for (DrawnPoint& point : result_.points) point.has_place = true;
    return best;
  }

  /// Coordinates that are the place of a drawn point; returns whether all of them are.
  bool put_drawn_places(std::vector<double>& pose) const {
    bool all = true;
    const auto& points = result_.mechanism.points;
    for (std::size_t c = 0; c < result_.coordinates.size() && c < pose.size(); ++c) {
      bool found = false;
      if (result_.coordinates[c].kind == CoordinateKind::place) {
        std::string axis, of;
        for (const Entry& part : entries(written_[c].value)) {
          if (part.key == "place") axis = text_of(part.value);
          if (part.key == "of") of = text_of(part.value);
        }
        const auto which =
            static_cast<std::size_t>(std::find(axis_names.begin(), axis_names.end(), axis) - axis_names.begin());
        for (const Point& point : points) {
          const auto* form = std::get_if<ExplicitPoint>(&point.form);
          if (point.name != of || form == nullptr || which >= form->coordinates.size()) continue;
          pose[c] = core::to_double(value_of(form->coordinates[which], result_.mechanism));
          found = true;
        }
      }
      all = all && found;
    }
    return all;
  }

  using Places = std::vector<double>;
  /// Drawn places minus those of the constructions.
  Places offsets(const Mechanism& as_built, const std::vector<std::size_t>& both,
                 const std::vector<double>& pose) const {
    const auto built = sample_points(as_built, pose), drawn = sample_points(result_.mechanism, pose);
    Places all;
    for (const std::size_t p : both)
      for (std::size_t i = 0; i < 3; ++i) all.push_back((*drawn[p])[i] - (*built[p])[i]);
    return all;
  }

  double fit(const Mechanism& as_built, const std::vector<std::size_t>& both, std::vector<double>& pose) const {
    constexpr int steps = 40;
    constexpr double difference = 1e-6;  // m and rad: of a quotient that only points the way
    const std::size_t n = pose.size();
    const auto square = [](const Places& own) {
      double sum = 0;
      for (const double part : own) sum += part * part;
      return sum;
    };
    double off = square(offsets(as_built, both, pose));
    for (int step = 0; step < steps && off > 0; ++step) {
      const Places now = offsets(as_built, both, pose);
      std::vector<Places> slopes;
      for (std::size_t c = 0; c < n; ++c) {
        std::vector<double> near = pose;
        near[c] += difference;
        slopes.push_back(offsets(as_built, both, near));
        for (std::size_t r = 0; r < now.size(); ++r) slopes[c][r] = (now[r] - slopes[c][r]) / difference;
      }
      Matrix a(n, std::vector<double>(n + 1));
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j)
          for (std::size_t r = 0; r < now.size(); ++r) a[i][j] += slopes[i][r] * slopes[j][r];
        for (std::size_t r = 0; r < now.size(); ++r) a[i][n] += slopes[i][r] * now[r];
        a[i][i] += 1e-14;  // coordinates that move none of these points stay
      }
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < n; ++i) {
          if (i == k || a[k][k] == 0) continue;
          const double factor = a[i][k] / a[k][k];
          for (std::size_t j = k; j <= n; ++j) a[i][j] -= factor * a[k][j];
        }
      std::vector<double> next = pose;
      for (std::size_t k = 0; k < n; ++k)
        if (a[k][k] != 0) next[k] += a[k][n] / a[k][k];
      const double then = square(offsets(as_built, both, next));
      if (!(then < off)) break;
      pose = std::move(next);
      off = then;
    }
    return off;
  }

  void check_fit(const Mechanism& as_built, const std::vector<std::size_t>& both,
                 const std::vector<double>& pose) const {
    const auto built = sample_points(as_built, pose), drawn = sample_points(result_.mechanism, pose);
    double size = 0;
    for (const auto& p : drawn)
      for (const auto& q : drawn)
        if (p && q) size = std::max(size, distance(*p, *q));
    for (const std::size_t p : both)
      if (distance(*built[p], *drawn[p]) > 1e-6 * size)
        throw InputError(as_built.points[p].where,
                         "point " + as_built.points[p].name + " is not drawn where its construction can put it",
                         "correct one of them, or leave it out of drawn or points");
  }

  // --- links

  void read_links() {
    std::vector<Node::Pair> pairs;
    std::vector<std::pair<std::optional<Value>, std::optional<Value>>> given;
    const Value links = required("links");
    for (const Entry& entry : entries(links)) {
      Node content = entry.value.node;
      std::optional<Value> one, several;
      if (entry.value.is_map()) {
        std::vector<Node::Pair> kept;
        for (const Entry& part : entries(entry.value)) {
          if (part.key == "length") one = part.value;
          if (part.key == "lengths") several = part.value;
        }
        for (const Node::Pair& pair : content.pairs())
          if (!pair.first.IsScalar() || (pair.first.Scalar() != "length" && pair.first.Scalar() != "lengths"))
            kept.push_back(pair);
        content = Node::map(std::move(kept), content.where());
      }
      pairs.emplace_back(text_node(entry.key, entry.where), content);
      given.emplace_back(one, several);
    }
    plain_.links = Node::map(std::move(pairs), links.where);
    mechanism::read_links(result_.mechanism, {plain_.links, links.what, links.where, links.field});
    for (std::size_t l = 0; l < given.size(); ++l)
      result_.lengths.push_back(lengths_of(static_cast<LinkIndex>(l), given[l].first, given[l].second));
  }

  GivenLength length_of(PointIndex first, PointIndex second, Value value) const {
    value.what = "the length " + result_.name(first) + "-" + result_.name(second);
    value.field = "length";
    const Number number = read_number(result_.mechanism, value, Sign::positive);
    return {first, second, amount(number, value), core::to_double(number.value), value.where};
  }

  std::vector<GivenLength> lengths_of(LinkIndex index, const std::optional<Value>& one,
                                      const std::optional<Value>& several) const {
    const Link& link = result_.link(index);
    std::vector<GivenLength> result;
    if (one) {
      if (link.points.size() != 2 || several)
        throw InputError(
            one->where,
            "link " + link.name + " has " + std::to_string(link.points.size()) + " points" +
                (several ? " and both length and lengths" : ", of which one length says too little or nothing"),
            "write lengths: {A-B: ..., ...} for the pairs of its points, or two points");
      result.push_back(length_of(link.points[0], link.points[1], *one));
      return result;
    }
    if (!several) return result;
    for (const Entry& entry : entries(*several)) {
      const std::size_t dash = entry.key.find('-');
      const auto point = [&](const std::string& name) {
        for (const PointIndex own : link.points)
          if (result_.name(own) == name) return own;
        throw InputError(entry.where,
                         "the lengths of link " + link.name + ": '" + entry.key + "' is no pair of its points",
                         "write such as " + result_.name(link.points[0]) + "-" + result_.name(link.points.back()));
      };
      if (dash == std::string::npos) (void)point(entry.key + "-");
      const PointIndex first = point(entry.key.substr(0, dash)), second = point(entry.key.substr(dash + 1));
      if (first == second) (void)point(entry.key);
      result.push_back(length_of(first, second, entry.value));
    }
    return result;
  }

  /// Axes as they are written, for the file that is made of the drawing.
  void place_axes() {
    for (const Entry& entry : entries(required("joints"))) {
      std::vector<Node> own;
      for (const Entry& part : entries(entry.value)) {
        if (part.key == "axis") own.push_back(part.value.node);
        if (part.key == "axes")
          for (const Value& axis : elements(part.value)) own.push_back(axis.node);
      }
      result_.axes.push_back(std::move(own));
    }
  }

  const Value& document_;
  PlainSections& plain_;
  std::map<std::string, Value> sections_;
  std::vector<Entry> written_;  ///< coordinates
  Drawing result_;
};

}  // namespace

Drawing read_drawing(const Value& document, const std::vector<Override>& overrides, PlainSections& plain) {
  return DrawingReader(document, overrides, plain).take();
}

}  // namespace clearloci::mechanism
