// Pyslvs (github.com/KmolYuan/pyslvs): M[J[R, color[Green], P[0.0, 0.0], L[ground, L1]], J[RP, A[0.0], P[..], L[..]],
// ...]. A joint of type R pins all its links; P slides the others along the first, in the direction A, deg; RP does so
// with a pin. The text names no masses, no inputs and no unit.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>

#include "core/errors.hpp"
#include "mechanism/import/common.hpp"
#include "mechanism/import/formats.hpp"

namespace clearloci::mechanism::imports {
namespace {

using core::InputError;

class Reader {
 public:
  explicit Reader(const SourceText& given) : file_(given.file), text_(given.text) {}

  Source read() {
    s_.planar = true;
    s_.unit = "mm";
    expect("M[");
    while (!eat("]")) {
      joint();
      (void)eat(",");
    }
    skip();
    if (at_ < text_.size()) refuse("more stands behind the mechanism", "leave it out");
    s_.note("the text has no unit of length: mm were taken");
    s_.note("the text has no masses and no loads");
    if (!shared_.empty())
      s_.note("more than two links meet at " + enumerated(shared_) +
              ": all are pinned to the ground or to the first of them; other pairings share the forces differently");
    return std::move(s_);
  }

 private:
  [[noreturn]] void refuse(const std::string& problem, const std::string& mend) const {
    int line = 1, column = 1;
    for (std::size_t i = 0; i < at_ && i < text_.size(); ++i) {
      column = text_[i] == '\n' ? 1 : column + 1;
      line += text_[i] == '\n' ? 1 : 0;
    }
    throw InputError({file_, line, column}, problem, mend);
  }

  void skip() {
    while (at_ < text_.size()) {
      if (std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
        ++at_;
      } else if (text_[at_] == '#') {
        const bool block = text_.compare(at_, 2, "#[") == 0;
        const std::size_t end = text_.find(block ? "#]" : "\n", at_ + 1);
        at_ = end == std::string::npos ? text_.size() : end + (block ? 2 : 1);
      } else {
        return;
      }
    }
  }
  bool eat(std::string_view word) {
    skip();
    if (text_.compare(at_, word.size(), word) != 0) return false;
    at_ += word.size();
    return true;
  }
  void expect(std::string_view word) {
    if (!eat(word))
      refuse("'" + std::string(word) + "' is missing in the Pyslvs text", "copy the whole expression from Pyslvs");
  }
  double number() {
    skip();
    const std::size_t end = text_.find_first_not_of("+-.0123456789eE", at_);
    double value = 0;
    if (!number_of(std::string_view(text_).substr(at_, (end == std::string::npos ? text_.size() : end) - at_), value) ||
        std::abs(value) > 1e12)
      refuse("a number is missing in the Pyslvs text", "write such as P[0.0, 12.5]");
    at_ = end == std::string::npos ? text_.size() : end;
    return value;
  }
  std::string name() {
    skip();
    std::size_t end = at_;
    while (end < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[end])) != 0 || text_[end] == '_'))
      ++end;
    if (end == at_) refuse("a name of a link is missing in the Pyslvs text", "write such as L[ground, L1]");
    std::string word = text_.substr(at_, end - at_);
    at_ = end;
    return word;
  }

  int link_named(const std::string& name) {
    if (name == "ground") return ground_link;
    const auto [found, fresh] = links_.emplace(name, static_cast<int>(s_.links.size()));
    if (fresh) s_.links.push_back({name, 0, 0, {}, {}, false, false});
    return found->second;
  }

  SourceJoint& add(const std::string& label, SourceKind kind, int from, int to, const Vec& at, const Vec& axis) {
    return add_joint(s_, label, 1, kind, from, to, at, axis);
  }

  void joint() {
    expect("J[");
    const std::string label = "P" + std::to_string(count_++);
    const std::string type = name();
    if (type != "R" && type != "P" && type != "RP")
      refuse("'" + type + "' is no type of joint of Pyslvs", "write R, P or RP");
    double angle = 0;
    Vec at{};
    std::vector<int> links;
    bool placed = false, linked = false, turned = false;
    while (eat(",")) {
      if (eat("color[")) {
        const std::size_t end = text_.find(']', at_);
        if (end == std::string::npos) refuse("a colour has no end", "write such as color[Green]");
        at_ = end + 1;
      } else if (eat("A[")) {
        angle = number();
        turned = true;
        expect("]");
      } else if (eat("P[")) {
        at[0] = number();
        expect(",");
        at[1] = number();
        placed = true;
        expect("]");
      } else if (eat("L[")) {
        while (!eat("]")) {
          const int link = link_named(name());
          if (std::find(links.begin(), links.end(), link) != links.end())
            refuse("joint " + label + " names a link twice", "name each once");
          links.push_back(link);
          (void)eat(",");
        }
        linked = true;
      } else {
        refuse("this is no part of a joint of Pyslvs that is known", "write A[..], color[..], P[..] or L[..]");
      }
    }
    expect("]");
    if (!placed || !linked) refuse("joint " + label + " has no place P[..] or no links L[..]", "write both");
    if (type != "R" && !turned)
      refuse("joint " + label + " slides, but has no direction A[..]", "write its angle in degrees");
    if (links.empty()) {
      s_.note("joint " + label + " has no links and was left out");
      return;
    }
    if (links.size() == 1 && type != "R")
      refuse("joint " + label + " slides, but has one link", "name what it slides on first");
    if (type == "R")
      pins(label, links, at);
    else
      slider(label, links, at, angle, type == "RP");
  }

  void pins(const std::string& label, const std::vector<int>& links, const Vec& at) {
    if (links.size() == 1) {
      if (links.front() != ground_link) s_.points.push_back({label, links.front(), at, true});
      return;
    }
    const bool grounded = std::find(links.begin(), links.end(), ground_link) != links.end();
    const int base = grounded ? ground_link : links.front();
    for (const int link : links)
      if (link != base) add(label, SourceKind::revolute, base, link, at, {0, 0, 1});
    if (links.size() > 2) shared_.push_back(label);
  }

  void slider(const std::string& label, const std::vector<int>& links, const Vec& at, double angle, bool pin) {
    const double turn = angle * std::numbers::pi / 180;
    const auto whole = [](double v) { return std::abs(v) < 1e-15 ? 0 : v; };
    const Vec axis = {whole(std::cos(turn)), whole(std::sin(turn)), 0};
    const int base = links.front();
    if (!pin) {
      for (std::size_t i = 1; i < links.size(); ++i) add(label, SourceKind::prismatic, base, links[i], at, axis);
      return;
    }
    for (std::size_t i = 2; i < links.size(); ++i)
      add(label + "_pin", SourceKind::revolute, links[1], links[i], at, {0, 0, 1}).point = label;
    add(label + "_slot", SourceKind::slot, base, links[1], at, axis).point = label;
    if (links.size() > 2) shared_.push_back(label);
  }

  const std::string& file_;
  const std::string& text_;
  std::size_t at_ = 0;
  int count_ = 0;
  Source s_;
  std::map<std::string, int> links_;
  std::vector<std::string> shared_;
};

}  // namespace

bool is_pyslvs(std::string_view text) {
  text = trimmed(text);
  while (text.starts_with('#')) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return false;
    text = trimmed(text.substr(end));
  }
  if (!text.starts_with("M[")) return false;
  const std::string_view rest = trimmed(text.substr(2));
  return rest.starts_with("J[") || rest.starts_with("]");
}

Source read_pyslvs(const SourceText& text) { return Reader(text).read(); }

}  // namespace clearloci::mechanism::imports
