#include "mechanism/import/mjcf_settings.hpp"

#include <cmath>

#include "core/errors.hpp"

namespace clearloci::mechanism::imports {

using core::InputError;

void MjcfSettings::refuse(const XmlElement& at, const std::string& problem, const std::string& mend) const {
  throw InputError({file_, at.line}, problem, mend);
}

void MjcfSettings::compiler(const XmlElement& at) {
  degrees_ = at.get("angle", degrees_ ? "degree" : "radian") == "degree";
  if (at.get("coordinate", "local") != "local")
    refuse(at, "the model has global coordinates", "write it with coordinate=\"local\"");
  order_ = at.get("eulerseq", order_);
  from_shapes_ = at.get("inertiafromgeom", from_shapes_);
  limits_by_range_ = at.get("autolimits", "true") == "true";
  if (order_.size() != 3 || order_.find_first_not_of("xyzXYZ") != std::string::npos)
    refuse(at, "eulerseq is '" + order_ + "'", "write such as xyz");
}

void MjcfSettings::option(const XmlElement& at) {
  if (const auto text = at.get("gravity")) {
    const auto v = numbers_of(*text, at, "gravity", file_, 3, 3);
    gravity_ = Vec{v[0], v[1], v[2]};
  }
}

void MjcfSettings::defaults(const XmlElement& at, const std::string& name,
                            std::map<std::string, std::vector<const XmlElement*>> outer) {
  const std::string own = at.get("class", name);
  for (const XmlElement& child : at.children) {
    if (child.name == "default") continue;
    child.read = true;
    auto& chain = outer[child.name];
    chain.insert(chain.begin(), &child);
  }
  classes_[own] = outer;
  for (const XmlElement* child : at.all("default")) defaults(*child, "", outer);
}

std::optional<std::string> MjcfSettings::value(const XmlElement& at, const std::string& attribute,
                                               const std::string& childclass) const {
  if (auto own = at.get(attribute)) return own;
  const std::string name = at.get("class", childclass);
  auto found = classes_.find(name);
  if (found == classes_.end()) {
    if (name != "main")
      refuse(at, "<" + at.name + "> is of class '" + name + "', which is not there", "add the default class");
    return std::nullopt;
  }
  const auto chain = found->second.find(at.name);
  if (chain == found->second.end()) return std::nullopt;
  for (const XmlElement* own : chain->second)
    if (auto text = own->get(attribute)) return text;
  return std::nullopt;
}

std::vector<double> MjcfSettings::numbers(const XmlElement& at, const std::string& attribute, const std::string& text,
                                          std::size_t least, std::size_t most) const {
  return numbers_of(text, at, attribute + " of <" + at.name + ">", file_, least, most);
}

Vec MjcfSettings::vector(const XmlElement& at, const std::string& attribute, const Vec& otherwise,
                         const std::string& childclass) const {
  const auto text = value(at, attribute, childclass);
  if (!text) return otherwise;
  const auto v = numbers(at, attribute, *text, 3, 3);
  return {v[0], v[1], v[2]};
}

Rotation MjcfSettings::orientation(const XmlElement& at, const std::string& childclass) const {
  if (const auto text = value(at, "quat", childclass)) {
    const auto q = numbers(at, "quat", *text, 4, 4);
    return quaternion(q[0], q[1], q[2], q[3]);
  }
  if (const auto text = value(at, "axisangle", childclass)) {
    const auto v = numbers(at, "axisangle", *text, 4, 4);
    return turn(unit({v[0], v[1], v[2]}), angle(v[3]));
  }
  if (const auto text = value(at, "euler", childclass)) {
    const auto v = numbers(at, "euler", *text, 3, 3);
    Rotation r;
    for (std::size_t i = 0; i < 3; ++i) {
      Vec e{};
      const bool fixed = order_[i] >= 'X' && order_[i] <= 'Z';
      e[static_cast<std::size_t>(order_[i] - (fixed ? 'X' : 'x'))] = 1;
      r = fixed ? turn(e, angle(v[i])) * r : r * turn(e, angle(v[i]));
    }
    return r;
  }
  if (const auto text = value(at, "xyaxes", childclass)) {
    const auto v = numbers(at, "xyaxes", *text, 6, 6);
    const Vec x = unit({v[0], v[1], v[2]}), y = {v[3], v[4], v[5]};
    const Vec straight = unit(y - dot(x, y) * x);
    return {x, straight, cross(x, straight)};
  }
  if (const auto text = value(at, "zaxis", childclass)) {
    const auto v = numbers(at, "zaxis", *text, 3, 3);
    const Vec z = unit({v[0], v[1], v[2]}), way = cross({0, 0, 1}, z);
    const double sine = norm(way);
    return sine > 1e-12 ? turn((1 / sine) * way, std::atan2(sine, z[2]))
           : z[2] < 0   ? turn({1, 0, 0}, std::numbers::pi)
                        : Rotation{};
  }
  return {};
}

Pose MjcfSettings::pose_of(const XmlElement& at, const std::string& childclass) const {
  return {orientation(at, childclass), vector(at, "pos", {}, childclass)};
}
}  // namespace clearloci::mechanism::imports
