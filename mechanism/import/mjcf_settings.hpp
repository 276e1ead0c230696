// What an MJCF model says once for its elements: units of angles, orders of turns, gravity, default classes; and its
// elements' values read with them. Private to mechanism/.
#pragma once

#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/import/source.hpp"
#include "mechanism/import/xml.hpp"

namespace clearloci::mechanism::imports {

class MjcfSettings {
 protected:
  explicit MjcfSettings(std::string file) : file_(std::move(file)) {}

  [[noreturn]] void refuse(const XmlElement& at, const std::string& problem, const std::string& mend) const;
  void compiler(const XmlElement& at);
  void option(const XmlElement& at);
  void defaults(const XmlElement& at, const std::string& name,
                std::map<std::string, std::vector<const XmlElement*>> outer);
  /// What an element says itself, or its class.
  std::optional<std::string> value(const XmlElement& at, const std::string& attribute,
                                   const std::string& childclass) const;
  std::vector<double> numbers(const XmlElement& at, const std::string& attribute, const std::string& text,
                              std::size_t least, std::size_t most) const;
  Vec vector(const XmlElement& at, const std::string& attribute, const Vec& otherwise,
             const std::string& childclass) const;
  double angle(double v) const { return degrees_ ? v * std::numbers::pi / 180 : v; }
  Rotation orientation(const XmlElement& at, const std::string& childclass) const;
  Pose pose_of(const XmlElement& at, const std::string& childclass) const;

  /// Adds the mass of a shape, uniform. False where it has none that is known.
  bool shape(const XmlElement& at, const Pose& pose, const std::string& childclass, SourceLink& link) const;

  std::string file_;
  bool degrees_ = true, limits_by_range_ = true;
  std::string order_ = "xyz", from_shapes_ = "auto";
  Vec gravity_{0, 0, -9.81};
  std::map<std::string, std::map<std::string, std::vector<const XmlElement*>>> classes_;
};

}  // namespace clearloci::mechanism::imports
