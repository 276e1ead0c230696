// What the free coordinates of a drawing measure, as the workspace says it. Private to mechanism/.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/assembly/drawing.hpp"

namespace clearloci::mechanism {

Node text_node(const std::string& text, const core::SourcePosition& where);

class CoordinateReader {
 public:
  /// `workspace`, `joints`: of the file. Lists the coordinates in the drawing.
  CoordinateReader(const std::optional<Value>& workspace, const Value& joints, const core::SourcePosition& file,
                   Drawing& drawing);

  /// The workspace without what its coordinates are of; the motors' own where there is none.
  const Node& plain_workspace() const { return workspace_; }

  /// "x" and the point's name where a coordinate is a place.
  std::optional<std::pair<std::string, std::string>> place_of(std::size_t coordinate) const;
  /// Number of an axis by its name: 3 and more where there is none.
  static std::size_t axis_of(const std::string& name);

  /// Finds the links, points and joints that coordinates are of: once the drawing has them.
  void resolve() const;

 private:
  Node plain_coordinate(const Entry& entry);
  void add_motors(const Value& joints, std::vector<Node::Pair>& pairs);
  LinkIndex link_named(const Value& value, const DrawnCoordinate& coordinate, bool or_ground) const;
  JointIndex joint_named(const Value& of, const DrawnCoordinate& coordinate) const;
  void resolve(DrawnCoordinate& coordinate, const Value& written) const;
  static void read_turn(const Value& turn, DrawnCoordinate& coordinate);
  void check_order_of_turns() const;

  Drawing& drawing_;
  core::SourcePosition file_;
  std::vector<Entry> written_;
  Node workspace_;
};

}  // namespace clearloci::mechanism
