// A random mechanism file before it is text: the sections as they will stand, and what forms (design_forms.hpp) need to
// know of them. Numbers are texts already, in the file's unit of length.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/rational.hpp"

namespace clearloci::test {

struct Place {
  core::Rational x, y;
};

std::string text_of(const core::Rational& value);
std::string text_of(const Place& place);

struct PointText {
  std::string name, form;
  std::optional<Place> fixed = {};  ///< of the ground, in the file's unit; the form is not used then
};

struct LinkText {
  std::string name;
  std::vector<std::string> points;
  std::string more = {};  ///< ", mass: 1"
};

struct JointText {
  std::string name, type, from, to, at;
  std::string axis = {};  ///< of a prismatic one
  bool actuated = false;
  std::string effort = {};                  ///< of a motor of known effort
  std::vector<std::string> clearance = {};  ///< "radial: 10e-6"
};

struct DesignParts {
  std::string name, workspace;
  std::vector<std::string> coordinates;
  bool lengths = true;  ///< the coordinates are x and y of the end effector
  std::vector<PointText> points;
  std::vector<LinkText> links;
  std::vector<JointText> joints;
  std::string end_link, end_point, relative_to;
  std::vector<std::string> loads, springs, limits;  ///< one in a line, "{...}"
  std::string units, parameters, frames, repeat, gravity;
  core::Rational size = 1;  ///< of the design, in the file's unit of length
  core::Rational unit = 1;  ///< of the file: how many are a metre
  Place origin;             ///< in the file's unit: about where it stands
  /// Of every dyad and slider the words of its sides: +1, -1.
  std::vector<std::array<const char*, 2>> sides;
};

/// The mechanism file.
std::string text_of(const DesignParts& parts);

/// A length that is given in micrometres.
std::string micrometres(int value, const core::Rational& unit);

}  // namespace clearloci::test
