#include "check/certificate.hpp"

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/errors.hpp"

namespace clearloci::check {
namespace {

using Json = nlohmann::json;
using core::CellNode;
using core::StraightLine;

// Far beyond what the program writes; a file that asks for more is damaged.
constexpr std::size_t most_steps = 100'000, most_digits = 4'000, most_roots = 16, most_depth = 400,
                      most_functions = 500;

class Reader {
 public:
  explicit Reader(const std::string& file) : file_(file) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw core::InputError({file_}, "this is no certificate that can be read: " + what,
                           "write it anew with --certificate");
  }

  /// What every certificate begins with.
  void check_format(const Json& root) const {
    if (text(root, "format") != "clearloci-certificate") fail("'format' is not clearloci-certificate");
    if (integer(root, "version", 0, 1000) != 1) fail("its version is not 1");
  }

  CertificateFile read(const Json& root) {
    CertificateFile c;
    c.command = text(root, "command");
    c.model = text(at(root, "model"), "text");
    for (const Json& pair : array(at(root, "model"), "set")) c.overrides.emplace_back(text(pair, 0), text(pair, 1));
    for (const Json& name : array(root, "coordinates")) c.coordinates.push_back(text(name));
    if (c.coordinates.size() != 2) fail("it is not about two coordinates");
    for (std::size_t i = 0; i < 2; ++i) c.from[i] = rational(text(array(at(root, "frame"), "from"), i));
    c.scale = rational(text(at(root, "frame"), "scale"));
    if (!(c.scale > 0)) fail("the scale of its frame is not above 0");
    for (std::size_t i = 0; i < 4; ++i) c.box[i] = rational(text(at(array(root, "box"), i / 2), i % 2));
    c.tolerance = number(at(root, "tolerance"));
    for (const Json& name : array(root, "joints")) c.joints.push_back(text(name));
    for (const Json& name : array(root, "quantities")) c.quantities.push_back(quantity(text(name)));
    for (const Json& entry : array(root, "roots")) {
      c.root_points.push_back(text(entry, "point"));
      const std::string role = text(entry, "role");
      if (role == "limit") c.limit_roots.push_back(static_cast<int>(c.root_roles.size()));
      c.root_roles.push_back(role == "length" || role == "limit" ? core::RootRole::length
                                                                 : core::RootRole::working_mode);
      c.squares.push_back(program(text(entry, "square"), 2 + c.squares.size()));
    }
    if (c.squares.size() > most_roots) fail("too many roots");
    for (const Json& entry : array(root, "functions"))
      c.functions.push_back(
          {role(text(entry, "role")), text(entry, "name"), program(text(entry, "program"), 2 + c.squares.size())});
    if (c.functions.size() > most_functions) fail("too many functions");
    for (const Json& entry : array(root, "modes")) {
      core::WorkingMode mode;
      for (const Json& sign : entry) mode.push_back(integer(sign, -1, 1));
      if (mode.size() != c.squares.size()) fail("a mode needs a sign for every root");
      for (const int sign : mode)
        if (sign == 0) fail("a sign is 1 or -1");
      c.modes.push_back(mode);
    }
    for (const Json& entry : array(root, "sheets")) c.sheets.push_back(sheet(entry, c));
    for (const Json& entry : array(root, "open")) c.open.push_back({mode(entry, c), function(entry, c)});
    for (const Json& entry : array(root, "curves")) c.curves.push_back(curve(entry, c));
    for (const Json& entry : array(root, "points"))
      c.points.push_back({mode(entry, c), kind(text(entry, "kind")), vanishing(entry), boolean(entry, "certified"),
                          point(at(entry, "at"))});
    if (c.command == "zones" || root.contains("zones"))
      for (const Json& entry : array(root, "zones")) c.zones.push_back(zone(entry, c));
    c.in_doubt.assign(c.modes.size(), 0);
    if (root.contains("in_doubt"))
      for (std::size_t mode = 0; mode < c.modes.size(); ++mode) {
        c.in_doubt[mode] = number(at(array(root, "in_doubt"), mode));
        if (c.in_doubt[mode] < 0) fail("an area is negative");
      }
    if (c.command == "verify" || root.contains("task")) c.task = task(at(root, "task"), c);
    return c;
  }

 private:
  template <class Key>
  const Json& at(const Json& json, const Key& key) const {
    if constexpr (std::is_integral_v<Key>) {
      if (!json.is_array() || static_cast<std::size_t>(key) >= json.size()) fail("a list is too short");
      return json[static_cast<std::size_t>(key)];
    } else {
      const auto found = json.is_object() ? json.find(key) : json.end();
      if (!json.is_object() || found == json.end()) fail("'" + std::string(key) + "' is missing");
      return *found;
    }
  }
  const Json& array(const Json& json, const char* key) const {
    const Json& list = at(json, key);
    if (!list.is_array()) fail("'" + std::string(key) + "' is no list");
    return list;
  }
  std::string text(const Json& json) const {
    if (!json.is_string()) fail("a text is missing");
    return json.get<std::string>();
  }
  template <class Key>
  std::string text(const Json& json, const Key& key) const {
    return text(at(json, key));
  }
  bool boolean(const Json& json, const char* key) const {
    if (!at(json, key).is_boolean()) fail("'" + std::string(key) + "' is neither true nor false");
    return at(json, key).get<bool>();
  }
  double number(const Json& json) const {
    if (!json.is_number() || !std::isfinite(json.get<double>())) fail("a number is missing");
    return json.get<double>();
  }
  int integer(const Json& json, long least, long most) const {
    if (!json.is_number_integer() || json.get<double>() < static_cast<double>(least) ||
        json.get<double>() > static_cast<double>(most))
      fail("a number is out of range");
    return json.get<int>();
  }
  int integer(const Json& json, const char* key, long least, long most) const {
    return integer(at(json, key), least, most);
  }
  core::Rational rational(const std::string& digits) const {
    const std::optional<core::Rational> value = fraction_of(digits);
    if (!value) fail("'" + digits.substr(0, 40) + "' is no fraction");
    return *value;
  }
  double hex(const std::string& word) const {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (word.empty() || end != word.c_str() + word.size() || !std::isfinite(value)) fail("a number is damaged");
    return value;
  }
  int small(const std::string& digits, std::size_t most) const {
    if (digits.empty() || digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos ||
        static_cast<std::size_t>(std::atoi(digits.c_str())) > most)
      fail("'" + digits.substr(0, 40) + "' is out of range");
    return std::atoi(digits.c_str());
  }
  core::Point2 point(const Json& json) const { return {number(at(json, 0)), number(at(json, 1))}; }

  core::Quantity quantity(const std::string& name) const {
    for (const core::Quantity q : core::all_quantities)
      if (core::to_string(q) == name) return q;
    fail("an unknown quantity");
  }
  core::LocusKind kind(const std::string& name) const {
    using enum core::LocusKind;
    for (const core::LocusKind k :
         {contact_loss, backlash, component, margin, direct_singularity, workspace_boundary, no_limit})
      if (core::to_string(k) == name) return k;
    fail("an unknown kind of locus");
  }
  core::FactorRole role(const std::string& name) const {
    using enum core::FactorRole;
    if (name == "reaction") return reaction;
    if (name == "margin") return margin;
    if (name == "direct-singularity") return direct_singularity;
    if (name == "workspace-boundary") return workspace_boundary;
    if (name == "construction") return construction;
    fail("an unknown role");
  }
  int mode(const Json& entry, const CertificateFile& c) const {
    return integer(entry, "mode", 0, static_cast<long>(c.modes.size()) - 1);
  }
  int function(const Json& entry, const CertificateFile& c) const {
    return integer(entry, "function", 0, static_cast<long>(c.functions.size()) - 1);
  }

  /// "v0 v1 c1/2 +0,1 *2,3 i4 a5,4": steps that use earlier ones.
  StraightLine program(const std::string& words, std::size_t variables) const {
    StraightLine line;
    std::istringstream stream(words);
    for (std::string word; stream >> word;) {
      if (line.steps.size() >= most_steps) fail("a program is too long");
      const std::string rest = word.substr(1);
      if (word[0] == 'c') {
        const std::size_t wave = rest.find('~');
        const core::Rational radius = wave == std::string::npos ? core::Rational(0) : rational(rest.substr(wave + 1));
        if (radius < 0) fail("a radius is negative");
        line.steps.push_back(core::constant_step(rational(rest.substr(0, wave)), radius));
        continue;
      }
      StraightLine::Step step;
      const std::size_t count_before = line.steps.size(), comma = rest.find(',');
      if (word[0] == 'v') {
        step.operation = StraightLine::Operation::variable;
        step.first = small(rest, variables - 1);
      } else {
        if (count_before == 0) fail("a program begins with nothing");
        step.first = small(rest.substr(0, comma), count_before - 1);
        if (word[0] == 'i') {
          step.operation = StraightLine::Operation::inverse;
        } else {
          if (comma == std::string::npos) fail("a step lacks a number");
          step.second = small(rest.substr(comma + 1), count_before - 1);
          const std::string operations = "+-*a";
          const std::size_t which = operations.find(word[0]);
          if (which == std::string::npos) fail("an unknown step");
          step.operation = std::array{StraightLine::Operation::add, StraightLine::Operation::subtract,
                                      StraightLine::Operation::multiply, StraightLine::Operation::angle}[which];
        }
      }
      line.steps.push_back(std::move(step));
    }
    if (line.steps.empty()) fail("a program is empty");
    return line;
  }

  /// "x:0x1p-1 . g0:2": the tree in preorder.
  std::vector<CellNode> cells(const std::string& words, std::size_t roots) const {
    using Kind = CellNode::Kind;
    std::vector<CellNode> nodes;
    std::vector<int> missing = {1};  // cells that are still to come, one entry a level
    std::istringstream stream(words);
    for (std::string word; stream >> word;) {
      while (!missing.empty() && missing.back() == 0) missing.pop_back();
      if (missing.empty()) throw FalseClaim("cells: there is one more than the cuts make");
      --missing.back();
      if (word == ".") {
        nodes.push_back({Kind::free, 0, 0, 0});
      } else if (word == "?") {
        nodes.push_back({Kind::open, 0, 0, 0});
      } else if (word[0] == 'g') {
        const std::size_t colon = word.find(':');
        if (colon == std::string::npos) fail("a cell is damaged");
        nodes.push_back(
            {Kind::graph, small(word.substr(1, colon - 1), 1 + roots), 0, small(word.substr(colon + 1), 100000)});
      } else if (word.size() > 2 && (word[0] == 'x' || word[0] == 'y') && word[1] == ':') {
        nodes.push_back({Kind::cut, word[0] == 'x' ? 0 : 1, hex(word.substr(2)), 0});
        missing.push_back(2);
        if (missing.size() > most_depth) fail("cells are cut too often");
      } else {
        fail("a cell is damaged");
      }
    }
    for (const int count : missing)
      if (count != 0) throw FalseClaim("cells: they do not cover the box, the tree of cells ends too early");
    return nodes;
  }

  SheetCells sheet(const Json& entry, const CertificateFile& c) const {
    SheetCells s;
    s.mode = mode(entry, c);
    s.function = function(entry, c);
    s.role = role(text(entry, "role"));
    for (const Json& root : array(entry, "at_zero"))
      s.at_zero.push_back(integer(root, 0, static_cast<long>(c.squares.size()) - 1));
    for (std::size_t i = 0; i < 4; ++i) s.domain[i] = hex(text(array(entry, "domain"), i));
    s.cells = cells(text(entry, "cells"), c.squares.size());
    return s;
  }

  std::vector<Reaction> vanishing(const Json& entry) const {
    std::vector<Reaction> list;
    for (const Json& pair : array(entry, "vanishing")) list.emplace_back(text(pair, 0), quantity(text(pair, 1)));
    return list;
  }

  core::Polyline polyline(const Json& list) const {
    if (!list.is_array()) fail("a polyline is missing");
    core::Polyline line;
    for (const Json& p : list) line.push_back(point(p));
    return line;
  }

  CurveClaim curve(const Json& entry, const CertificateFile& c) const {
    CurveClaim curve{mode(entry, c), kind(text(entry, "kind")), vanishing(entry), boolean(entry, "certified"), {}};
    for (const Json& value : array(entry, "arcs")) {
      core::Arc arc;
      arc.closed = boolean(value, "closed");
      for (std::size_t i = 0; i < 2; ++i) arc.ends[i] = end(text(array(value, "ends"), i));
      arc.points = polyline(at(value, "points"));
      if (arc.points.size() < 2) fail("an arc needs two points");
      curve.arcs.push_back(std::move(arc));
    }
    return curve;
  }

  core::ArcEnd end(const std::string& name) const {
    using enum core::ArcEnd;
    for (const core::ArcEnd e : {none, boundary, direct_singularity, box, crossing})
      if (core::to_string(e) == name) return e;
    fail("an unknown end of an arc");
  }

  ZoneClaim zone(const Json& entry, const CertificateFile& c) const {
    ZoneClaim z;
    z.id = text(entry, "id");
    z.mode = mode(entry, c);
    z.assembly_mode = integer(entry, "assembly_mode", -1, 1);
    for (const Json& sign : array(entry, "signs"))
      z.signs.push_back({{text(sign, 0), quantity(text(sign, 1))}, integer(at(sign, 2), -1, 1)});
    z.area = number(at(entry, "area"));
    z.outer = polyline(at(entry, "outer"));
    for (const Json& hole : array(entry, "holes")) z.holes.push_back(polyline(hole));
    z.sample = point(at(entry, "sample"));
    z.certified = boolean(entry, "certified");
    return z;
  }

  TaskClaim task(const Json& entry, const CertificateFile& c) const {
    TaskClaim t;
    t.mode = mode(entry, c);
    t.shape.name = text(entry, "shape");
    for (const Json& p : array(entry, "points")) t.shape.points.push_back({rational(text(p, 0)), rational(text(p, 1))});
    t.shape.radius = rational(text(entry, "radius"));
    t.shape.margin = rational(text(entry, "margin"));
    for (const Json& what : array(entry, "unchecked")) t.unchecked.push_back(text(what));
    if (!t.shape.is_shape(2)) fail("the task has no shape");
    return t;
  }

  const std::string& file_;
};

}  // namespace

std::optional<core::Rational> fraction_of(const std::string& digits) {
  core::Rational value;
  if (digits.empty() || digits.size() > most_digits || digits.find_first_not_of("-0123456789/") != std::string::npos ||
      value.set_str(digits, 10) != 0 || value.get_den() == 0)
    return std::nullopt;
  value.canonicalize();
  return value;
}

bool same_text(const std::string& model, const std::string& in_certificate) {
  return Json(model).dump(-1, ' ', false, Json::error_handler_t::replace) == Json(in_certificate).dump();
}

Json parse_certificate(const std::string& text, const std::string& file) {
  const Reader reader(file);
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto each_once = [&](int, Json::parse_event_t event, const Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second)
      reader.fail("the key '" + parsed.get<std::string>().substr(0, 40) + "' is twice in one object");
    return true;
  };
  Json root = Json::parse(text, each_once, false);
  if (root.is_discarded()) reader.fail("it is not JSON");
  reader.check_format(root);
  return root;
}

CertificateFile read_certificate(const Json& root, const std::string& file) { return Reader(file).read(root); }

core::LocusKind gravest_kind(const std::vector<Reaction>& vanishing) {
  using core::Quantity;
  core::LocusKind kind = core::LocusKind::component;
  for (const auto& [joint, quantity] : vanishing) {
    if (quantity == Quantity::f || core::is_guide_end(quantity)) return core::LocusKind::contact_loss;
    if (quantity == Quantity::M || quantity == Quantity::F) kind = core::LocusKind::backlash;
  }
  return kind;
}

}  // namespace clearloci::check
