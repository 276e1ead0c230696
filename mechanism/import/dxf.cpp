// DXF of R12 or R2000, as text: pairs of lines, a group code and a value. Lines and polylines on a layer are a link, of
// the layer's name; the layer `ground` is the ground. A circle is a pin of all links that end or pass where its centre
// is; on the layer `motor` it marks the motor there. The unit is that of $INSUNITS. Circles and polylines have a plane
// of their own: if its normal is -z, as where a drawing was mirrored, their x is -x of the drawing (DXF Reference,
// Object Coordinate Systems); vertices of meshes and of polylines in space are those of the drawing.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "core/errors.hpp"
#include "mechanism/import/common.hpp"
#include "mechanism/import/formats.hpp"

namespace clearloci::mechanism::imports {
namespace {

using core::InputError;

constexpr std::string_view binary_start = "AutoCAD Binary DXF";

struct Pair {
  int code;
  std::string value;
  int line;
};

struct Layer {
  std::string name;
  std::vector<std::pair<Vec, Vec>> pieces;
};

struct Circle {
  std::string layer;
  Vec at{};
  double radius = 0;
  int line = 0;
};

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

class Reader {
 public:
  explicit Reader(const SourceText& given) : file_(given.file) { split(given.text); }

  Source read() {
    s_.planar = true;
    header();
    entities();
    connect();
    return std::move(s_);
  }

 private:
  [[noreturn]] void refuse(int line, const std::string& problem, const std::string& mend) const {
    throw InputError({file_, line}, problem, mend);
  }

  void split(const std::string& text) {
    if (text.starts_with(binary_start)) refuse(0, "the DXF file is a binary one", "write it as text: ASCII DXF");
    int line = 0;
    std::size_t at = 0;
    const auto next = [&](std::string_view& part) {
      if (at >= text.size()) return false;
      std::size_t end = text.find('\n', at);
      if (end == std::string::npos) end = text.size();
      part = trimmed(std::string_view(text).substr(at, end - at));
      at = end + 1;
      ++line;
      return true;
    };
    std::string_view code, value;
    while (next(code)) {
      if (code.empty() && at >= text.size()) break;
      double number = 0;
      if (!number_of(code, number) || number != std::floor(number) || std::abs(number) > 10000)
        refuse(line, "'" + std::string(code.substr(0, 20)) + "' is no group code of DXF",
               "write the file as DXF R12 or R2000, as text");
      if (!next(value)) refuse(line, "the DXF file ends within a pair", "write the file again");
      pairs_.push_back({static_cast<int>(number), std::string(value), line});
      if (pairs_.back().code == 0 && value == "EOF") break;
    }
  }

  double number(const Pair& pair) const {
    double value = 0;
    if (!number_of(pair.value, value) || std::abs(value) > 1e12)
      refuse(pair.line, "'" + pair.value.substr(0, 30) + "' is no number", "write the DXF file again");
    return value;
  }

  void header() {
    int unit = 0;
    for (std::size_t i = 0; i + 1 < pairs_.size(); ++i)
      if (pairs_[i].code == 9 && pairs_[i].value == "$INSUNITS" && pairs_[i + 1].code == 70)
        unit = static_cast<int>(number(pairs_[i + 1]));
    static const std::map<int, std::pair<const char*, double>> units = {{0, {"mm", 1}}, {1, {"in", 1}}, {2, {"in", 12}},
                                                                        {4, {"mm", 1}}, {5, {"cm", 1}}, {6, {"m", 1}}};
    const auto found = units.find(unit);
    if (found == units.end())
      refuse(0, "the unit of the DXF file ($INSUNITS " + std::to_string(unit) + ") is not known here",
             "draw in mm, cm, m, in or ft");
    s_.unit = found->second.first;
    scale_ = found->second.second;
    if (unit == 0) s_.note("the file has no unit of length ($INSUNITS): mm were taken");
  }

  Layer& layer(const std::string& name) {
    for (Layer& layer : layers_)
      if (lower(layer.name) == lower(name)) return layer;
    layers_.push_back({name, {}});
    return layers_.back();
  }

  void entities() {
    std::size_t i = 0;
    bool inside = false;
    while (i < pairs_.size()) {
      const Pair& pair = pairs_[i];
      if (pair.code != 0) {
        ++i;
        continue;
      }
      if (pair.value == "SECTION")
        inside = i + 1 < pairs_.size() && pairs_[i + 1].code == 2 && pairs_[i + 1].value == "ENTITIES";
      if (pair.value == "ENDSEC") inside = false;
      if (!inside || pair.value == "SECTION") {
        ++i;
        continue;
      }
      i = entity(i);
    }
    std::string text;
    for (const auto& [what, count] : others_)
      text += (text.empty() ? "" : ", ") + what + " (" + std::to_string(count) + ")";
    if (!text.empty()) s_.note("left out: " + text);
  }

  std::size_t end_of(std::size_t i) const {
    ++i;
    while (i < pairs_.size() && pairs_[i].code != 0) ++i;
    return i;
  }

  std::size_t entity(std::size_t start) {
    const std::string type = pairs_[start].value;
    std::size_t end = end_of(start);
    std::string name = "0";
    std::vector<Vec> vertices;
    std::map<int, double> values;
    bool bulges = false;
    for (std::size_t i = start + 1; i < end; ++i) {
      const Pair& pair = pairs_[i];
      if (pair.code == 8) name = pair.value;
      if (type == "LWPOLYLINE" && pair.code == 10) vertices.push_back({scale_ * number(pair), 0, 0});
      if (type == "LWPOLYLINE" && pair.code == 20 && !vertices.empty()) vertices.back()[1] = scale_ * number(pair);
      if (pair.code == 42 && number(pair) != 0) bulges = true;
      if (pair.code == 10 || pair.code == 20 || pair.code == 30 || pair.code == 11 || pair.code == 21 ||
          pair.code == 31 || pair.code == 40 || pair.code == 70 || pair.code == 210 || pair.code == 220 ||
          pair.code == 230)
        values[pair.code] = number(pair);
    }
    const auto at = [&](int code) { return values.contains(code) ? values.at(code) : 0; };
    constexpr double turned = 1e-6;  // of a normal
    const int flags = static_cast<int>(std::clamp(at(70), 0.0, 1e6));
    constexpr int in_space = 8 | 16 | 64;  // of a POLYLINE
    const bool of_plane = type != "LINE" && !(type == "POLYLINE" && (flags & in_space) != 0);
    const bool inclined = of_plane && std::max(std::abs(at(210)), std::abs(at(220))) > turned * std::abs(at(230));
    const double mirrored = of_plane && values.contains(230) && at(230) < 0 ? -1 : 1;
    const bool closed = (flags & 1) != 0;
    if (type == "LINE") {
      vertices = {{scale_ * at(10), scale_ * at(20), 0}, {scale_ * at(11), scale_ * at(21), 0}};
    } else if (type == "POLYLINE") {
      while (end < pairs_.size() && pairs_[end].value == "VERTEX") {
        const std::size_t last = end_of(end);
        Vec vertex{};
        for (std::size_t i = end + 1; i < last; ++i) {
          if (pairs_[i].code == 10) vertex[0] = scale_ * number(pairs_[i]);
          if (pairs_[i].code == 20) vertex[1] = scale_ * number(pairs_[i]);
          if (pairs_[i].code == 42 && number(pairs_[i]) != 0) bulges = true;
        }
        vertices.push_back(vertex);
        end = last;
      }
      if (end < pairs_.size() && pairs_[end].value == "SEQEND") end = end_of(end);
    } else if (type != "LWPOLYLINE" && type != "CIRCLE") {
      ++others_[type];
      return end;
    }
    if (inclined) {
      ++others_[type + " in an inclined plane"];
      return end;
    }
    if (type == "CIRCLE") {
      const Vec centre = {mirrored * scale_ * at(10), scale_ * at(20), 0};
      circles_.push_back({name, centre, scale_ * std::abs(at(40)), pairs_[start].line});
      return end;
    }
    for (Vec& vertex : vertices) vertex[0] *= mirrored;
    if (bulges) ++others_["arcs of polylines, read as straight"];
    if (lower(name) == "defpoints") {
      ++others_["lines on Defpoints"];
      return end;
    }
    Layer& found = layer(name);
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i) found.pieces.emplace_back(vertices[i], vertices[i + 1]);
    if (closed && vertices.size() > 2) found.pieces.emplace_back(vertices.back(), vertices.front());
    return end;
  }

  static double from_piece(const Vec& p, const std::pair<Vec, Vec>& piece) {
    const Vec way = piece.second - piece.first;
    const double length = dot(way, way);
    const double part = length > 0 ? std::clamp(dot(p - piece.first, way) / length, 0.0, 1.0) : 0;
    return distance(p, piece.first + part * way);
  }

  void connect() {
    constexpr std::size_t most = 2000;
    std::size_t pieces = 0;
    for (const Layer& layer : layers_) pieces += layer.pieces.size();
    if (pieces > most || circles_.size() > most)
      refuse(0,
             "the drawing has " + std::to_string(pieces) + " lines and " + std::to_string(circles_.size()) + " circles",
             "draw a line or two a link, and a circle a pin");
    std::map<std::string, int> index;
    for (const Layer& layer : layers_) {
      if (lower(layer.name) == "ground") continue;
      index[layer.name] = static_cast<int>(s_.links.size());
      s_.links.push_back({layer.name, 0, 0, {}, {}, false, false});
    }
    double size = 0;
    for (const Circle& a : circles_)
      for (const Circle& b : circles_) size = std::max(size, distance(a.at, b.at));
    std::vector<Vec> motors;
    std::vector<const Circle*> pins;
    for (const Circle& circle : circles_) {
      if (lower(circle.layer) == "motor") motors.push_back(circle.at);
      const bool doubled = std::any_of(
          pins.begin(), pins.end(), [&](const Circle* other) { return distance(other->at, circle.at) <= 1e-6 * size; });
      if (!doubled) pins.push_back(&circle);
    }
    std::vector<std::string> shared, off, alone;
    int count = 0;
    for (const Circle* pin : pins) {
      const std::string name = "P" + std::to_string(++count);
      const double tolerance = std::max(1e-6 * size, 0.05 * pin->radius);
      std::vector<int> links;
      std::set<std::string> marks;  // layers of circles here
      for (const Circle& circle : circles_)
        if (distance(circle.at, pin->at) <= 1e-6 * size) marks.insert(lower(circle.layer));
      bool grounded = marks.contains("ground");
      for (const Layer& layer : layers_) {
        double least = -1;
        for (const auto& piece : layer.pieces) {
          const double d = from_piece(pin->at, piece);
          if (least < 0 || d < least) least = d;
        }
        const bool on_layer = marks.contains(lower(layer.name));
        if (!on_layer && (least < 0 || least > tolerance)) continue;
        if (!on_layer && least > 1e-9 * size) off.push_back(layer.name + " at " + name);
        if (lower(layer.name) == "ground")
          grounded = true;
        else
          links.push_back(index.at(layer.name));
      }
      const bool motor = std::any_of(motors.begin(), motors.end(),
                                     [&](const Vec& at) { return distance(at, pin->at) <= 1e-6 * size; });
      if (links.size() + (grounded ? 1 : 0) < 2) {
        if (links.empty())
          alone.push_back(name + " (line " + std::to_string(pin->line) + ")");
        else
          s_.points.push_back({name, links.front(), pin->at, true});
        continue;
      }
      const int base = grounded ? ground_link : links.front();
      bool driven = false;
      for (const int link : links) {
        if (link == base) continue;
        SourceJoint& joint = add_joint(s_, name, pin->line, SourceKind::revolute, base, link, pin->at, {0, 0, 1});
        joint.actuated = motor && !driven;
        driven = driven || joint.actuated;
      }
      if (links.size() + (grounded ? 1 : 0) > 2) shared.push_back(name);
    }
    if (!alone.empty()) s_.note("circles where no link is were left out: " + enumerated(alone));
    if (!off.empty()) s_.note("slightly off the centre of its circle, and moved to it: " + enumerated(off));
    if (!shared.empty())
      s_.note("more than two links meet at " + enumerated(shared) +
              ": all are pinned to the ground or to the first of them; other pairings share the forces differently");
    s_.note("a DXF file has no masses and no loads");
  }

  std::string file_;
  std::vector<Pair> pairs_;
  Source s_;
  double scale_ = 1;
  std::vector<Layer> layers_;
  std::vector<Circle> circles_;
  std::map<std::string, int> others_;
};

}  // namespace

bool is_dxf(std::string_view text) {
  if (text.starts_with(binary_start)) return true;
  // The first pair that is no comment begins a section.
  for (int pairs = 0; pairs < 50; ++pairs) {
    const std::size_t first = text.find('\n');
    if (first == std::string_view::npos) return false;
    const std::string_view code = trimmed(text.substr(0, first));
    text = text.substr(first + 1);
    const std::size_t second = text.find('\n');
    const std::string_view value = trimmed(text.substr(0, second));
    if (code == "0") return value == "SECTION";
    if (code != "999" || second == std::string_view::npos) return false;
    text = text.substr(second + 1);
  }
  return false;
}

Source read_dxf(const SourceText& text) { return Reader(text).read(); }

}  // namespace clearloci::mechanism::imports
