// PMKS+ (Worcester Polytechnic Institute, github.com/PMKS-Web/PMKSWeb): an address, or what follows its question mark.
// Sections end with a dot: flags, decimals, integers and enumerations of the settings; joints; links; forces; what is
// selected; and, in newer ones, tagged references. Integers are written to base 64 with the digits below, a leading 0
// is a minus, decimals are integers over 1000. The last letter is the length of the rest, modulo 62.
#include <cmath>
#include <map>
#include <numbers>

#include "core/errors.hpp"
#include "mechanism/import/common.hpp"
#include "mechanism/import/formats.hpp"

namespace clearloci::mechanism::imports {
namespace {

using core::InputError;

constexpr std::string_view digits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-";

std::string_view payload_of(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with("http")) {
    const std::size_t mark = text.find('?');
    text = mark == std::string_view::npos ? std::string_view() : text.substr(mark + 1);
  }
  return text;
}

struct Units {
  std::string length = "m";
  double mass = 1, inertia = 1, force = 1, metres = 1;
};

struct Joint {
  std::string id, name;
  int place = 0;  ///< letter of the text, for messages
  bool slides = false, input = false, grounded = false, welded = false;
  Vec at{};
  double angle = 0, speed = 0;
  std::string carrier, slot_a, slot_b;
};

struct Link {
  std::string id;
  std::vector<std::string> joints;
};

class Reader {
 public:
  explicit Reader(const SourceText& given) : file_(given.file), text_(payload_of(given.text)) {
    const std::string_view all = given.text;
    base_ = static_cast<int>(text_.data() - all.data());
  }

  Source read() {
    check_length();
    text_.remove_suffix(1);
    settings();
    while (more()) joint(section());
    end_of("joints");
    while (more()) link(section());
    end_of("links");
    check_joints_of_links();
    while (more()) force(section());
    if (at_ < text_.size() && text_[at_] == '.') ++at_;
    if (at_ < text_.size()) (void)section();  // what is selected
    tagged();
    connect();
    s_.planar = true;
    return std::move(s_);
  }

 private:
  [[noreturn]] void refuse(std::size_t place, const std::string& problem, const std::string& mend) const {
    throw InputError({file_.size() > 60 ? "the address" : file_, 1, base_ + static_cast<int>(place) + 1}, problem,
                     mend);
  }

  void check_length() const {
    constexpr std::string_view letters = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
    if (text_.size() < 2 || text_.back() != letters[(text_.size() - 1) % letters.size()])
      refuse(text_.empty() ? 0 : text_.size() - 1,
             "this PMKS+ text is not whole: its last letter should be " +
                 std::string(1, letters[(text_.empty() ? 0 : text_.size() - 1) % letters.size()]),
             "copy the whole address from PMKS+ again");
  }

  // --- words

  /// Up to the next dot, with the place of its first letter.
  struct Section {
    std::string_view text;
    std::size_t place;
  };
  Section section() {
    const std::size_t start = at_, end = text_.find('.', at_);
    at_ = end == std::string_view::npos ? text_.size() : end + 1;
    return {text_.substr(start, (end == std::string_view::npos ? text_.size() : end) - start), start};
  }
  bool more() const { return at_ < text_.size() && text_[at_] != '.'; }
  void end_of(const std::string& what) {
    if (at_ >= text_.size())
      refuse(at_, "the PMKS+ text ends within its " + what, "copy the whole address from PMKS+ again");
    ++at_;
  }
  static Section word(Section& rest) {
    const std::size_t comma = rest.text.find(',');
    Section section{rest.text.substr(0, comma), rest.place};
    if (comma == std::string_view::npos) {
      rest = {{}, rest.place + rest.text.size()};
    } else {
      rest = {rest.text.substr(comma + 1), rest.place + comma + 1};
    }
    return section;
  }
  double integer(const Section& section, const std::string& what) const {
    std::string_view word = section.text;
    bool minus = false;
    if (!word.empty() && word.front() == '0') {
      minus = true;
      word.remove_prefix(1);
    }
    double value = 0;
    constexpr std::size_t longest = 8;  // 48 bits: exact in a double
    if (word.size() > longest)
      refuse(section.place, what + " '" + std::string(section.text) + "' has more than 8 digits",
             "correct it in PMKS+");
    for (std::size_t i = 0; i < word.size(); ++i) {
      const std::size_t digit = digits.find(word[i]);
      if (digit == std::string_view::npos)
        refuse(section.place + i, what + " '" + std::string(section.text) + "' is no number to base 64",
               "copy the address from PMKS+ again");
      value = value * 64 + static_cast<double>(digit);
    }
    return minus ? -value : value;
  }
  double decimal(const Section& section, const std::string& what) const { return integer(section, what) / 1000; }
  unsigned flags(std::string_view letters, std::size_t place, const std::string& what) const {
    unsigned value = 0;
    for (const char letter : letters) {
      const std::size_t digit = digits.find(letter);
      if (digit == std::string_view::npos)
        refuse(place, "the flags '" + std::string(letters) + "' of " + what + " are no number to base 64",
               "copy the address from PMKS+ again");
      value = value * 64 + static_cast<unsigned>(digit);
    }
    return value;
  }

  // --- sections

  void settings() {
    const Section booleans = section(), decimals = section(), integers = section(), enumerations = section();
    if (booleans.text.empty() || booleans.text.size() > 4)
      refuse(booleans.place, "the settings of the PMKS+ text are missing", "copy the whole address from PMKS+ again");
    const unsigned flag = flags(booleans.text, booleans.place, "the settings");
    clockwise_ = (flag & 1U) != 0;
    const bool weightless = (flag & 256U) != 0;
    Section rest = decimals;
    (void)word(rest);  // how large symbols are drawn
    linear_speed_ = rest.text.empty() ? 0 : decimal(word(rest), "the speed of sliders");
    rest = integers;
    speed_ = integer(word(rest), "the speed");
    const auto chosen = [&](std::size_t i) {
      return i < enumerations.text.size() ? digits.find(enumerations.text[i]) : std::size_t{1};
    };
    const std::size_t length = chosen(0), force = chosen(2);
    constexpr double pound = 0.45359237, inch = 0.0254, pound_force = 4.4482216152605;
    if (length == 0)
      units_ = {"in", pound, pound * inch * inch, pound_force, inch};
    else if (length == 1)
      units_ = {"cm", 1e-3, 1e-4, 1, 1e-2};
    else if (length == 2)
      units_ = {"m", 1, 1, 1, 1};
    else
      refuse(enumerations.place, "the unit of length of the PMKS+ text is unknown",
             "copy the address from PMKS+ again");
    units_.force = force == 0 ? pound_force : 1;
    s_.unit = units_.length;
    constexpr double g = 9.81;
    if (!weightless) s_.gravity = Vec{0, -g, 0};
    s_.note("masses are in " +
            std::string(length == 0   ? "lb"
                        : length == 1 ? "g"
                                      : "kg") +
            " and moments of inertia in " +
            (length == 0   ? "lb in^2"
             : length == 1 ? "kg cm^2"
                           : "kg m^2") +
            ", as PMKS+ has them with lengths in " + units_.length);
  }

  void joint(Section rest) {
    const Section section = rest;
    if (rest.text.size() < 2)
      refuse(section.place, "a joint of the PMKS+ text has no name", "copy the address from PMKS+ again");
    const unsigned flag = flags(rest.text.substr(0, 1), rest.place, "a joint");
    rest = {rest.text.substr(1), rest.place + 1};
    Joint j;
    j.place = static_cast<int>(section.place);
    j.slides = (flag & 1U) != 0;
    j.input = (flag & 2U) != 0;
    j.grounded = (flag & 4U) != 0;
    j.welded = (flag & 8U) != 0;
    j.id = std::string(word(rest).text);
    j.name = std::string(word(rest).text);
    const std::string what = "joint " + j.id;
    j.at[0] = decimal(word(rest), "x of " + what);
    j.at[1] = decimal(word(rest), "y of " + what);
    j.angle = decimal(word(rest), "the angle of " + what);
    j.carrier = std::string(word(rest).text);
    j.slot_a = std::string(word(rest).text);
    j.slot_b = std::string(word(rest).text);
    if (!rest.text.empty()) j.speed = decimal(word(rest), "the speed of " + what);
    if (!rest.text.empty())
      refuse(rest.place, what + " has more words than are known: '" + std::string(rest.text) + "'",
             "open it in PMKS+ and share it again");
    if (!index_.emplace(j.id, joints_.size()).second)
      refuse(section.place, "two joints are called " + j.id, "copy the address from PMKS+ again");
    if (!j.carrier.empty() && !j.slides)
      refuse(section.place, what + " does not slide but has a slot", "copy the address from PMKS+ again");
    joints_.push_back(std::move(j));
  }

  void link(Section rest) {
    const Section section = rest;
    if (rest.text.size() < 3)
      refuse(section.place, "a link of the PMKS+ text is cut short", "copy the address from PMKS+ again");
    static constexpr std::string_view roots = "YAMG0123", others = "Namg4567";
    const char root = rest.text[0], type = rest.text[1];
    if (roots.find(root) == std::string_view::npos && others.find(root) == std::string_view::npos)
      refuse(section.place, "'" + std::string(1, root) + "' begins no link that is known",
             "open it in PMKS+ and share it again");
    if (type != 'R' && type != 'P')
      refuse(section.place + 1, "'" + std::string(1, type) + "' is no type of link",
             "open it in PMKS+ and share it again");
    rest = {rest.text.substr(2), rest.place + 2};
    Link l;
    SourceLink link;
    l.id = std::string(word(rest).text);
    const std::string what = "link " + l.id;
    link.name = std::string(word(rest).text);
    if (link.name.empty()) link.name = l.id;
    link.mass = units_.mass * decimal(word(rest), "the mass of " + what);
    const double inertia = units_.inertia * decimal(word(rest), "the moment of inertia of " + what);
    Vec centre{};
    centre[0] = decimal(word(rest), "x of the centre of mass of " + what);
    centre[1] = decimal(word(rest), "y of the centre of mass of " + what);
    if (link.mass < 0 || inertia < 0)
      refuse(section.place, what + " has a negative mass or moment of inertia", "correct it in PMKS+");
    (void)word(rest);  // its colour
    while (true) {
      const Section id = word(rest);
      if (id.text.empty()) break;
      if (!index_.contains(std::string(id.text)))
        refuse(id.place, what + " has the joint '" + std::string(id.text) + "', which is not there",
               "copy the address from PMKS+ again");
      l.joints.emplace_back(id.text);
    }
    if (roots.find(root) == std::string_view::npos) return;  // a part of a welded link
    if (l.joints.empty()) refuse(section.place, what + " has no joints", "correct it in PMKS+");
    if (type == 'R') {
      link.centre = centre;
      Tensor tensor;
      tensor.zz = inertia;
      link.inertia = tensor;
    } else {
      link.centre = joints_[index_.at(l.joints.front())].at;
      link.inertia = Tensor{};
    }
    if (!link_index_.emplace(l.id, links_.size()).second)
      refuse(section.place, "two links are called " + l.id, "copy the address from PMKS+ again");
    links_.push_back(std::move(l));
    s_.links.push_back(std::move(link));
  }

  void force(Section rest) {
    const Section section = rest;
    const unsigned flag = flags(rest.text.substr(0, 1), rest.place, "a force");
    rest = {rest.text.substr(std::min<std::size_t>(1, rest.text.size())), rest.place + 1};
    SourceLoad load;
    load.name = std::string(word(rest).text);
    const std::string what = "force " + load.name;
    const Section id = word(rest);
    (void)word(rest);  // its label
    Vec end{};
    load.at[0] = decimal(word(rest), "x of " + what);
    load.at[1] = decimal(word(rest), "y of " + what);
    end[0] = decimal(word(rest), "x of the end of " + what);
    end[1] = decimal(word(rest), "y of the end of " + what);
    const double size = units_.force * decimal(word(rest), "the size of " + what);
    const auto link = link_index_.find(std::string(id.text));
    if (link == link_index_.end())
      refuse(id.place, what + " acts on link '" + std::string(id.text) + "', which is not there",
             "correct it in PMKS+");
    if (size == 0) return s_.note(what + " is 0 and was left out");
    if (!(distance(end, load.at) > 0)) refuse(section.place, what + " has no direction", "draw its arrow in PMKS+");
    load.link = static_cast<int>(link->second);
    load.force = ((flag & 2U) != 0 ? size : -size) * unit(end - load.at);
    load.turns = (flag & 1U) != 0;
    s_.loads.push_back(std::move(load));
  }

  void tagged() {
    Section rest{text_.substr(at_), at_};
    std::map<char, int> counts;
    while (!rest.text.empty()) {
      const Section section = word(rest);
      if (section.text.empty()) continue;
      if (std::string_view("JLFCSKP").find(section.text.front()) == std::string_view::npos)
        refuse(section.place,
               "'" + std::string(section.text.substr(0, 20)) + "' is no entry of a PMKS+ text that is known",
               "open it in PMKS+ and share it again");
      ++counts[section.text.front()];
    }
    const std::map<char, std::string> words = {{'J', "locks of joints"},          {'L', "locks of links"},
                                               {'F', "locks of forces"},          {'C', "anchors of centres of mass"},
                                               {'S', "designs by synthesis"},     {'K', "colours"},
                                               {'P', "digits beyond thousandths"}};
    for (const auto& [tag, count] : counts) s_.note("left out: " + words.at(tag) + " (" + std::to_string(count) + ")");
  }

  void check_joints_of_links() const {
    if (s_.links.empty()) refuse(at_, "the PMKS+ text has no links", "draw a link in PMKS+");
  }

  // --- what is connected

  std::vector<int> links_at(const std::string& id) const {
    std::vector<int> links;
    for (std::size_t l = 0; l < links_.size(); ++l)
      for (const std::string& joint : links_[l].joints)
        if (joint == id) {
          links.push_back(static_cast<int>(l));
          break;
        }
    return links;
  }

  SourceJoint& add(const Joint& j, SourceKind kind, int from, int to, const Vec& axis) {
    return add_joint(s_, j.name.empty() ? j.id : j.name, 1, kind, from, to, j.at, axis);
  }

  void drive(SourceJoint& joint, const Joint& j) const {
    joint.actuated = true;
    const double sign = clockwise_ ? -1 : 1, rpm = j.speed != 0 ? j.speed : sign * speed_;
    if (joint.kind == SourceKind::revolute && rpm != 0) joint.speed = rpm * std::numbers::pi / 30;
    const double speed = j.speed != 0 ? j.speed : linear_speed_;
    if (joint.kind == SourceKind::prismatic && speed != 0) joint.speed = speed * units_.metres;
  }

  void connect() {
    std::vector<std::string> shared;
    for (const Joint& j : joints_) {
      const std::vector<int> links = links_at(j.id);
      if (links.empty()) {
        s_.note("joint " + j.id + " belongs to no link and was left out");
        continue;
      }
      if (j.slides) {
        slider(j, links);
        continue;
      }
      const int base = j.grounded ? ground_link : links.front();
      bool driven = false;
      for (std::size_t i = j.grounded ? 0 : 1; i < links.size(); ++i) {
        SourceJoint& joint = add(j, j.welded && i > 0 ? SourceKind::fixed : SourceKind::revolute,
                                 j.welded && i > 0 ? links.front() : base, links[i], {0, 0, 1});
        if (j.input && !driven && joint.kind == SourceKind::revolute) drive(joint, j);
        driven = true;
      }
      if (links.size() + (j.grounded ? 1 : 0) > 2) shared.push_back(j.id);
      if (links.size() == 1 && !j.grounded)
        s_.points.push_back({j.name.empty() ? j.id : j.name, links.front(), j.at, true});
    }
    if (!shared.empty())
      s_.note("more than two links meet at " + enumerated(shared) + ": all are pinned to " +
              "the ground or to the first of them; other pairings share the forces differently");
  }

  void slider(const Joint& j, const std::vector<int>& links) {
    for (std::size_t i = 1; i < links.size(); ++i) add(j, SourceKind::fixed, links.front(), links[i], {0, 0, 1});
    int from = ground_link;
    std::optional<std::pair<Vec, Vec>> along;
    Vec axis = guide_of(j);
    if (!j.carrier.empty()) {
      const auto carrier = link_index_.find(j.carrier);
      const auto a = index_.find(j.slot_a), b = index_.find(j.slot_b);
      if (carrier == link_index_.end() || a == index_.end() || b == index_.end())
        refuse(static_cast<std::size_t>(j.place),
               "joint " + j.id + " slides in a slot of link " + j.carrier + ", which is not whole",
               "draw the slot in PMKS+ again");
      from = static_cast<int>(carrier->second);
      along = std::pair{joints_[a->second].at, joints_[b->second].at};
      if (!(distance(along->first, along->second) > 0))
        refuse(static_cast<std::size_t>(j.place), "the slot of joint " + j.id + " has no length",
               "draw the slot in PMKS+ again");
      axis = unit(along->second - along->first);
    } else if (!j.grounded) {
      refuse(static_cast<std::size_t>(j.place), "joint " + j.id + " slides on nothing",
             "ground it in PMKS+, or give it a slot");
    }
    SourceJoint& joint = add(j, SourceKind::prismatic, from, links.front(), axis);
    joint.along = along;
    if (j.input) drive(joint, j);
  }

  /// Angles are rounded to thousandths of a radian: one so near to a multiple of 15 degrees is meant to be it.
  Vec guide_of(const Joint& j) {
    constexpr double step = std::numbers::pi / 12, rounding = 6e-4;
    const double near = std::round(j.angle / step) * step;
    const bool round = std::abs(near - j.angle) < rounding;
    if (round && near != j.angle && j.carrier.empty())
      s_.note("the guide of joint " + j.id + " is taken at " + shortest_decimal(near * 180 / std::numbers::pi, 1e-9) +
              " deg, of which the text has thousandths of a radian");
    const double angle = round ? near : j.angle;
    const auto whole = [](double v) { return std::abs(v) < 1e-15 ? 0 : v; };
    return unit({whole(std::cos(angle)), whole(std::sin(angle)), 0});
  }

  std::string file_;
  std::string_view text_;
  int base_ = 0;
  std::size_t at_ = 0;
  Source s_;
  Units units_;
  bool clockwise_ = false;
  double speed_ = 0, linear_speed_ = 0;
  std::vector<Joint> joints_;
  std::vector<Link> links_;
  std::map<std::string, std::size_t> index_, link_index_;
};

}  // namespace

bool is_pmks(std::string_view text) {
  const bool address = trimmed(text).starts_with("http");
  const std::string_view payload = payload_of(text);
  if (payload.empty() || payload.find_first_of(" \t\r\n:{}") != std::string_view::npos)
    return address && payload.find('.') != std::string_view::npos && payload.find(',') != std::string_view::npos;
  // Flags, decimals, integers and enumerations of letters to base 64, and at least the two empty sections behind joints
  // and links.
  std::size_t dots = 0;
  for (const char c : payload) {
    if (c == '.') ++dots;
    if (dots < 4 && c != '.' && c != ',' && digits.find(c) == std::string_view::npos) return false;
  }
  const std::size_t first = payload.find('.');
  return dots >= 6 && first > 0 && first <= 4 && payload.find("..") != std::string_view::npos;
}

Source read_pmks(const SourceText& text) { return Reader(text).read(); }

}  // namespace clearloci::mechanism::imports
