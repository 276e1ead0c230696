#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

using core::Quantity;

std::vector<Unknown> unknowns(const Mechanism& mechanism) {
  std::vector<Unknown> columns;
  const int joints = static_cast<int>(mechanism.joints.size());
  for (JointIndex joint = 0; joint < joints; ++joint)
    for (const Quantity quantity : {Quantity::fx, Quantity::fy}) columns.push_back({joint, quantity});
  for (JointIndex joint = 0; joint < joints; ++joint)
    if (mechanism.joints[static_cast<std::size_t>(joint)].actuated) columns.push_back({joint, Quantity::M});
  return columns;
}

std::string unknown_name(const Mechanism& mechanism, const Unknown& unknown) {
  const std::string& joint = mechanism.joints.at(static_cast<std::size_t>(unknown.joint)).name;
  const std::string quantity = core::to_string(unknown.quantity);
  return quantity.substr(0, 1) + joint + quantity.substr(1);
}

std::vector<PointIndex> dyad_points(const Mechanism& mechanism) {
  std::vector<PointIndex> indices;
  for (std::size_t i = 0; i < mechanism.points.size(); ++i)
    if (std::holds_alternative<DyadPoint>(mechanism.points[i].form)) indices.push_back(static_cast<PointIndex>(i));
  return indices;
}

std::vector<int> working_mode(const Mechanism& mechanism) {
  std::vector<int> signs;
  for (const Point& point : mechanism.points)
    if (const auto* dyad = std::get_if<DyadPoint>(&point.form)) signs.push_back(dyad->side == Side::left ? 1 : -1);
  return signs;
}

}  // namespace clearloci::mechanism
