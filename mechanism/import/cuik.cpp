// World files of the CUIK suite (Institut de Robòtica i Informàtica Industrial): constants, links and joints. A joint
// has a point, or two points of an axis, on each of its links, in the link's own frame; where the links are is for the
// program to find. The first link stands still. `.samples` files are not read.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "core/errors.hpp"
#include "mechanism/import/common.hpp"
#include "mechanism/import/formats.hpp"

namespace clearloci::mechanism::imports {
namespace {

using core::InputError;

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// The text without comments, lines kept.
std::string bare(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%') {
      while (i < text.size() && text[i] != '\n') ++i;
      if (i < text.size()) result += '\n';
    } else if (text.compare(i, 2, "/*") == 0) {
      const std::size_t end = text.find("*/", i + 2);
      const std::size_t last = end == std::string::npos ? text.size() : end + 2;
      for (; i < last; ++i)
        if (text[i] == '\n') result += '\n';
      --i;
    } else {
      result += text[i];
    }
  }
  return result;
}

struct Section {
  std::string text;
  int line = 0;
  bool found = false;
};

/// What stands between [NAME] and the next one.
Section section_of(const std::string& text, const std::string& name) {
  Section section;
  const std::string small = lower(text);
  std::size_t at = small.find("[" + name);
  if (at == std::string::npos) return section;
  at = small.find(']', at);
  if (at == std::string::npos) return section;
  // A bracket at the beginning of a line opens the next section; others belong to ranges.
  std::size_t end = text.size();
  for (std::size_t i = text.find('\n', at); i != std::string::npos; i = text.find('\n', i + 1)) {
    const std::size_t first = text.find_first_not_of(" \t\r\n", i);
    if (first != std::string::npos && text[first] == '[' && first + 1 < text.size() &&
        std::isalpha(static_cast<unsigned char>(text[first + 1])) != 0 && text.find(']', first) != std::string::npos &&
        text.find(',', first) > text.find(']', first)) {
      end = first;
      break;
    }
  }
  section.text = text.substr(at + 1, end - at - 1);
  section.line = static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')) + 1;
  section.found = true;
  return section;
}

class Parser {
 public:
  Parser(const std::string& file, const Section& section, std::map<std::string, double>& constants)
      : file_(file), text_(section.text), line_(section.line), constants_(constants) {}

  [[noreturn]] void refuse(const std::string& problem, const std::string& mend) const {
    throw InputError({file_, line()}, problem, mend);
  }
  int line() const {
    return line_ + static_cast<int>(std::count(
                       text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size())), '\n'));
  }
  void skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  bool done() {
    skip();
    return at_ >= text_.size();
  }
  char peek() {
    skip();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool eat(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  void expect(char c, const std::string& where) {
    if (!eat(c)) refuse("'" + std::string(1, c) + "' is missing in " + where, "write it as the CUIK suite does");
  }
  std::string word() {
    skip();
    std::size_t end = at_;
    while (end < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[end])) != 0 || text_[end] == '_'))
      ++end;
    std::string word = text_.substr(at_, end - at_);
    at_ = end;
    return word;
  }
  std::size_t place() const { return at_; }
  void back_to(std::size_t place) { at_ = place; }
  void pass() { ++at_; }

  double expression(int depth = 0) {
    double value = term(depth);
    while (peek() == '+' || peek() == '-') {
      // (p)+(v) of an axis is no sum.
      const std::size_t before = at_;
      const char sign = text_[at_++];
      if (depth == 0 && peek() == '(' && holds_comma()) {
        at_ = before;
        return value;
      }
      const double other = term(depth);
      value = sign == '+' ? value + other : value - other;
    }
    return value;
  }

  Vec point(const std::string& where) {
    expect('(', where);
    Vec v{};
    for (std::size_t i = 0; i < 3; ++i) {
      v[i] = expression(1);
      if (!std::isfinite(v[i]) || std::abs(v[i]) > 1e12)
        refuse("a coordinate of " + where + " is no finite number", "correct it");
      expect(i < 2 ? ',' : ')', where);
    }
    return v;
  }

 private:
  bool holds_comma() const {
    int depth = 0;
    for (std::size_t i = at_; i < text_.size(); ++i) {
      if (text_[i] == '(') ++depth;
      if (text_[i] == ')' && --depth == 0) return false;
      if (text_[i] == ',' && depth == 1) return true;
    }
    return false;
  }

  double term(int depth) {
    double value = power(depth);
    while (peek() == '*' || peek() == '/') {
      const char sign = text_[at_++];
      const double other = power(depth);
      value = sign == '*' ? value * other : value / other;
    }
    return value;
  }
  double power(int depth) {
    if (eat('-')) return -power(deeper(depth));
    if (eat('+')) return power(deeper(depth));
    const double base = atom(depth);
    return eat('^') ? std::pow(base, power(deeper(depth))) : base;
  }
  int deeper(int depth) const {
    constexpr int deepest = 100;
    if (depth > deepest) refuse("an expression is nested too deeply", "write it with constants of its parts");
    return depth + 1;
  }
  double atom(int depth) {
    if (eat('(')) {
      const double value = expression(deeper(depth));
      expect(')', "an expression");
      return value;
    }
    const char c = peek();
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') {
      std::size_t end = text_.find_first_not_of("0123456789.", at_);
      if (end == std::string::npos) end = text_.size();
      if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
        std::size_t digits = end + 1;
        if (digits < text_.size() && (text_[digits] == '+' || text_[digits] == '-')) ++digits;
        const std::size_t last = text_.find_first_not_of("0123456789", digits);
        if (last != digits) end = last == std::string::npos ? text_.size() : last;
      }
      double value = 0;
      if (!number_of(std::string_view(text_).substr(at_, end - at_), value))
        refuse("'" + text_.substr(at_, end - at_) + "' is no number", "correct it");
      at_ = end;
      return value;
    }
    const std::string name = word();
    if (name.empty()) refuse("a number or a name is missing in an expression", "correct it");
    if (peek() == '(') {
      using Function = double (*)(double);
      static const std::map<std::string, Function> functions = {
          {"sin", std::sin}, {"cos", std::cos},  {"tan", std::tan},   {"sqrt", std::sqrt}, {"exp", std::exp},
          {"log", std::log}, {"abs", std::fabs}, {"asin", std::asin}, {"acos", std::acos}, {"atan", std::atan}};
      const auto found = functions.find(lower(name));
      if (found != functions.end()) {
        expect('(', name);
        const double value = found->second(expression(deeper(depth)));
        expect(')', name);
        return value;
      }
    }
    if (lower(name) == "pi") return std::numbers::pi;
    if (lower(name) == "inf") return std::numeric_limits<double>::infinity();
    const auto found = constants_.find(name);
    if (found == constants_.end()) refuse("'" + name + "' is no constant of the file", "define it under [CONSTANTS]");
    return found->second;
  }

  const std::string& file_;
  const std::string& text_;
  int line_;
  std::map<std::string, double>& constants_;
  std::size_t at_ = 0;
};

class Reader {
 public:
  explicit Reader(const SourceText& given) : file_(given.file), text_(bare(given.text)) {}

  Source read() {
    const Section constants = section_of(text_, "constants"), links = section_of(text_, "links"),
                  joints = section_of(text_, "joints");
    if (constants.found) read_constants(constants);
    read_links(links);
    read_joints(joints);
    s_.open_posture = true;
    s_.note("the file has no unit of length: m were taken");
    s_.note("the file has no masses and no loads");
    s_.note("link " + first_ + " is the first one and stands still; shapes, colours and obstacles were left out");
    std::string text;
    for (const auto& [what, count] : left_)
      text += (text.empty() ? "" : ", ") + what + " (" + std::to_string(count) + ")";
    if (!text.empty()) s_.note("left out of joints: " + text);
    return std::move(s_);
  }

 private:
  void read_constants(const Section& section) {
    Parser p(file_, section, constants_);
    while (!p.done()) {
      const std::string name = p.word();
      if (name.empty()) p.refuse("a constant has no name", "write such as l1:=1.25");
      p.expect(':', "constant " + name);
      p.expect('=', "constant " + name);
      const double value = p.expression();
      constants_[name] = value;
    }
  }

  /// The first one alone matters: the others are named by joints.
  void read_links(const Section& section) {
    Parser p(file_, section, constants_);
    if (!p.done()) first_ = p.word();
    if (first_.empty())
      throw InputError({file_, section.line}, "the file has no [LINKS]", "name a world file of the CUIK suite");
    index_[first_] = ground_link;
  }

  int link_named(Parser& p) {
    const std::string name = p.word();
    if (name.empty()) p.refuse("a joint names no link", "write two links");
    const auto [found, fresh] = index_.emplace(name, static_cast<int>(s_.links.size()));
    if (fresh) s_.links.push_back({name, p.line(), 0, {}, {}, false, false});
    return found->second;
  }

  struct Axis {
    Vec at{}, along{0, 0, 1};
  };
  /// (p) (q), or (p)+(v).
  static Axis axis(Parser& p, const std::string& where) {
    Axis axis;
    axis.at = p.point(where);
    if (p.eat('+'))
      axis.along = p.point(where);
    else
      axis.along = p.point(where) - axis.at;
    if (!(norm(axis.along) > 0)) p.refuse("the axis of " + where + " has no direction", "write two points apart");
    return axis;
  }

  void read_joints(const Section& section) {
    if (!section.found) throw InputError({file_}, "the file has no [JOINTS]", "name a world file of the CUIK suite");
    Parser p(file_, section, constants_);
    std::set<std::string> used;
    while (!p.done()) {
      const int line = p.line();
      const std::string type = lower(p.word());
      if (!is_type(type))
        p.refuse("'" + type + "' is no type of joint of the CUIK suite",
                 "write revolute, prismatic, spherical, universal, fix, sph_sph or sph_prs_sph");
      std::string name = p.word();
      p.expect(':', "joint " + (name.empty() ? type : name));
      if (name.empty()) name = type.substr(0, 1) + std::to_string(++count_);
      joint(p, type, name, line);
      options(p, name);
    }
  }

  static bool is_type(const std::string& word) {
    static const std::set<std::string> types = {"revolute", "prismatic", "spherical",   "universal", "fix",
                                                "free",     "sph_sph",   "sph_prs_sph", "in_patch"};
    return types.contains(word);
  }

  SourceJoint& add(SourceKind kind, const std::string& name, int line, int from, int to, const Axis& a, const Axis& b) {
    SourceJoint joint;
    joint.name = name;
    joint.line = line;
    joint.kind = kind;
    joint.from = from;
    joint.to = to;
    joint.on_from = {a.at, frame_along(unit(a.along))};
    joint.on_to = {b.at, frame_along(unit(b.along))};
    s_.joints.push_back(std::move(joint));
    return s_.joints.back();
  }

  void joint(Parser& p, const std::string& type, const std::string& name, int line) {
    const std::string where = "joint " + name;
    const int from = link_named(p);
    Axis a, b;
    if (type == "in_patch")
      p.refuse(where + " keeps a point in a patch", "leave it out, or write the joint that it stands for");
    if (type == "free") {
      (void)link_named(p);
      return;
    }
    if (type == "fix") {
      const int to = link_named(p);
      const Pose pose = transform(p, where);
      SourceJoint& joint = add(SourceKind::fixed, name, line, from, to, a, b);
      joint.on_from = {pose.at, pose.turned};
      joint.on_to = {{}, {}};
      return;
    }
    const bool axes = type == "revolute" || type == "prismatic" || type == "universal";
    if (axes)
      a = axis(p, where);
    else
      a.at = p.point(where);
    const int to = link_named(p);
    if (axes)
      b = axis(p, where);
    else
      b.at = p.point(where);
    if (from == to) p.refuse(where + " joins a link to itself", "name two links");
    if (type == "revolute") add(SourceKind::revolute, name, line, from, to, a, b);
    if (type == "prismatic") add(SourceKind::prismatic, name, line, from, to, a, b);
    if (type == "universal") add(SourceKind::universal, name, line, from, to, a, b);
    if (type == "spherical") add(SourceKind::spherical, name, line, from, to, a, b);
    if (type == "sph_sph") rod_ = {name, line, from, to, a.at, b.at};
    if (type == "sph_prs_sph") leg(name, line, from, to, a, b);
  }

  struct Rod {
    std::string name;
    int line, from, to;
    Vec at_from, at_to;
  };

  int new_link(const std::string& name, int line) {
    s_.links.push_back({name, line, 0, {}, {}, false, true});
    return static_cast<int>(s_.links.size()) - 1;
  }

  /// A rod of a length between two balls.
  void add_rod(double length) {
    const Rod rod = *rod_;
    rod_.reset();
    const int link = new_link(rod.name, rod.line);
    add(SourceKind::spherical, rod.name + "_a", rod.line, rod.from, link, {rod.at_from, {0, 0, 1}}, {{}, {0, 0, 1}});
    add(SourceKind::spherical, rod.name + "_b", rod.line, rod.to, link, {rod.at_to, {0, 0, 1}},
        {{length, 0, 0}, {0, 0, 1}});
  }

  void leg(const std::string& name, int line, int from, int to, const Axis& a, const Axis& b) {
    const int cylinder = new_link(name + "_body", line), rod = new_link(name + "_rod", line);
    add(SourceKind::spherical, name + "_a", line, from, cylinder, a, {});
    add(SourceKind::spherical, name + "_b", line, to, rod, b, {});
    add(SourceKind::prismatic, name, line, cylinder, rod, {{}, {1, 0, 0}}, {{}, {1, 0, 0}}).either_way = true;
  }

  Pose transform(Parser& p, const std::string& where) {
    Pose pose;
    do {
      const std::size_t before = p.place();
      const std::string step = lower(p.word());
      if (step == "id") continue;
      if (step.size() != 2 || (step[0] != 't' && step[0] != 'r') || step[1] < 'x' || step[1] > 'z' || p.peek() != '(') {
        p.back_to(before);
        return pose;
      }
      p.expect('(', where);
      const double value = p.expression(1);
      p.expect(')', where);
      if (!std::isfinite(value) || std::abs(value) > 1e12)
        p.refuse("a number of " + where + " is not finite", "correct it");
      Vec e{};
      e[static_cast<std::size_t>(step[1] - 'x')] = 1;
      pose = pose * (step[0] == 't' ? Pose{{}, value * e} : Pose{turn(e, value), {}});
    } while (p.eat('*'));
    return pose;
  }

  /// "red", "0.25*white".
  static bool is_colour(Parser& p, const std::string& word) {
    static const std::set<std::string> colours = {"red",   "green", "blue", "yellow",  "white", "black",
                                                  "brown", "grey",  "cyan", "magenta", "purple"};
    if (word.empty() || word.find_first_not_of("0123456789") != std::string::npos) return colours.contains(word);
    const std::size_t before = p.place();
    if (p.eat('.')) (void)p.word();
    if (p.eat('*') && colours.contains(lower(p.word()))) return true;
    p.back_to(before);
    return false;
  }

  /// What follows the links of a joint, up to the next one.
  void options(Parser& p, const std::string& name) {
    while (!p.done()) {
      const std::size_t before = p.place();
      const std::string word = p.word();
      const std::string small = lower(word);
      if (is_type(small)) {
        p.back_to(before);
        break;
      }
      if (small == "length" && rod_) {
        const double length = p.expression();
        if (!(length > 0) || length > 1e12) p.refuse("the length of joint " + name + " is not above 0", "correct it");
        add_rod(length);
      } else if (small == "range") {
        p.expect('[', "the range of joint " + name);
        const double low = p.expression(1);
        p.expect(',', "the range of joint " + name);
        const double high = p.expression(1);
        p.expect(']', "the range of joint " + name);
        SourceJoint& joint = s_.joints.back();
        if (!s_.joints.empty() && joint.kind == SourceKind::prismatic && low < high && std::isfinite(low) &&
            std::isfinite(high)) {
          joint.range = std::array<double, 2>{low, high};
          joint.range_is_distance = true;
        } else {
          ++left_["range"];
        }
        while (p.eat('+')) (void)p.point("the range of joint " + name);  // from where turns are counted
      } else if (small == "coupled") {
        p.refuse("joint " + name + " follows another one (coupled)", "close the loop that makes it follow");
      } else if (small == "color") {
        (void)p.point("the colour of joint " + name);
      } else if (is_colour(p, small)) {
        continue;
      } else if (small == "radius") {
        (void)p.expression();
      } else if (word.empty()) {
        p.pass();
      } else {
        ++left_[word];
      }
    }
    if (rod_) p.refuse("joint " + name + " has no length", "write length and a number");
  }

  std::string file_, text_, first_;
  Source s_;
  std::map<std::string, double> constants_;
  std::map<std::string, int> index_;
  std::map<std::string, int> left_;
  std::optional<Rod> rod_;
  int count_ = 0;
};

}  // namespace

bool is_cuik(std::string_view text) {
  // A mechanism file has neither section at the beginning of a line.
  const auto has = [&](const char* name) {
    const std::string small = lower(text.substr(0, std::min<std::size_t>(text.size(), 1U << 20)));
    const std::size_t at = small.find(name);
    if (at == std::string::npos) return false;
    const std::size_t line = small.find_last_of('\n', at);
    return trimmed(std::string_view(small).substr(line == std::string::npos ? 0 : line,
                                                  at - (line == std::string::npos ? 0 : line)))
        .empty();
  };
  return text.find('[') != std::string_view::npos && has("[links]") && has("[joints]");
}

Source read_cuik(const SourceText& text) { return Reader(text).read(); }

}  // namespace clearloci::mechanism::imports
