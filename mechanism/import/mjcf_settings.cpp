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
  const std::string class_name = at.get("class", name);
  for (const XmlElement& child : at.children) {
    if (child.name == "default") continue;
    child.read = true;
    auto& chain = outer[child.name];
    chain.insert(chain.begin(), &child);
  }
  classes_[class_name] = outer;
  for (const XmlElement* child : at.all("default")) defaults(*child, "", outer);
}

std::optional<std::string> MjcfSettings::value(const XmlElement& at, const std::string& attribute,
                                               const std::string& childclass) const {
  if (auto written = at.get(attribute)) return written;
  const std::string name = at.get("class", childclass);
  auto found = classes_.find(name);
  if (found == classes_.end()) {
    if (name != "main")
      refuse(at, "<" + at.name + "> is of class '" + name + "', which is not there", "add the default class");
    return std::nullopt;
  }
  const auto chain = found->second.find(at.name);
  if (chain == found->second.end()) return std::nullopt;
  for (const XmlElement* written : chain->second)
    if (auto text = written->get(attribute)) return text;
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
bool MjcfSettings::shape(const XmlElement& at, const Pose& pose, const std::string& childclass,
                         SourceLink& link) const {
  const std::string type = value(at, "type", childclass).value_or("sphere");
  std::vector<double> size;
  if (const auto text = value(at, "size", childclass)) size = numbers(at, "size", *text, 1, 3);
  Pose frame = pose * pose_of(at, childclass);
  double half = size.size() > 1 ? size[1] : 0;
  if (const auto text = value(at, "fromto", childclass)) {
    const auto v = numbers(at, "fromto", *text, 6, 6);
    const Vec a = pose * Vec{v[0], v[1], v[2]}, b = pose * Vec{v[3], v[4], v[5]};
    frame = {frame_along(unit(b - a)), 0.5 * (a + b)};
    half = distance(a, b) / 2;
  }
  const double r = size.empty() ? 0 : std::abs(size[0]), pi = std::numbers::pi;
  double volume = 0;
  Tensor unit_inertia;  // of mass 1
  const auto box = [](double x, double y, double z) {
    return Tensor{(y * y + z * z) / 3, (x * x + z * z) / 3, (x * x + y * y) / 3, 0, 0, 0};
  };
  if (type == "sphere") {
    volume = 4 * pi / 3 * r * r * r;
    unit_inertia = {0.4 * r * r, 0.4 * r * r, 0.4 * r * r, 0, 0, 0};
  } else if (type == "box" && (size.size() == 3 || (size.size() > 1 && at.has("fromto")))) {
    const double y = size.size() == 3 ? size[1] : r, z = size.size() == 3 ? size[2] : half;
    volume = 8 * r * y * z;
    unit_inertia = box(r, y, z);
  } else if (type == "ellipsoid" && size.size() == 3) {
    volume = 4 * pi / 3 * size[0] * size[1] * size[2];
    const auto q = [&](std::size_t i, std::size_t j) { return (size[i] * size[i] + size[j] * size[j]) / 5; };
    unit_inertia = {q(1, 2), q(0, 2), q(0, 1), 0, 0, 0};
  } else if (type == "cylinder" || type == "capsule") {
    const double barrel = pi * r * r * 2 * half, across = r * r / 4 + half * half / 3;
    volume = barrel;
    unit_inertia = {across, across, r * r / 2, 0, 0, 0};
    if (type == "capsule") {
      // Two half balls at the ends: of mass m_s in all, with 0.4 r² each about its own centre, shifted by h and 3r/8.
      const double ball = 4 * pi / 3 * r * r * r, whole = barrel + ball, m_b = whole > 0 ? barrel / whole : 0,
                   m_s = 1 - m_b;
      const double ends = 0.4 * r * r + half * half + 0.75 * half * r;
      unit_inertia = {
          m_b * across + m_s * ends, m_b * across + m_s * ends, m_b * r * r / 2 + m_s * 0.4 * r * r, 0, 0, 0};
      volume = whole;
    }
  } else {
    return false;
  }
  double mass = 0;
  if (const auto text = value(at, "mass", childclass))
    mass = numbers(at, "mass", *text, 1, 1).front();
  else
    mass = volume * numbers(at, "density", value(at, "density", childclass).value_or("1000"), 1, 1).front();
  if (!(mass > 0)) return mass == 0;
  Tensor tensor = turned(frame.turned, unit_inertia);
  tensor = {mass * tensor.xx, mass * tensor.yy, mass * tensor.zz, mass * tensor.xy, mass * tensor.xz, mass * tensor.yz};
  const Vec before = link.centre.value_or(frame.at);
  const double sum = link.mass + mass;
  const Vec centre = (1 / sum) * (link.mass * before + mass * frame.at);
  link.inertia = link.inertia.value_or(Tensor{}) + point_inertia(link.mass, before - centre) + tensor +
                 point_inertia(mass, frame.at - centre);
  link.mass = sum;
  link.centre = centre;
  return true;
}

}  // namespace clearloci::mechanism::imports
