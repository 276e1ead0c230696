// A mechanism's points in floating point, at poses spread over the box: for checks of the input and for the sizes that
// quantities have. No result rests on it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mechanism/mechanism.hpp"

namespace clearloci::mechanism {

using PosturePoints = std::vector<std::array<double, 3>>;  ///< one a point, m; z = 0 in the plane

/// Poses (one value a coordinate) spread evenly over the box: the first `count` of one fixed sequence.
std::vector<std::vector<double>> spread_poses(const Mechanism& mechanism, std::size_t count, std::size_t first = 0);

/// Every point at a pose; nothing for a point that cannot be built there. Without `sides` in the file's working mode.
std::vector<std::optional<std::array<double, 3>>> sample_points(const Mechanism& mechanism,
                                                                const std::vector<double>& pose,
                                                                const std::vector<int>& sides);
std::vector<std::optional<std::array<double, 3>>> sample_points(const Mechanism& mechanism,
                                                                const std::vector<double>& pose);

/// An expression in the coordinates and parameters at a pose, in its unit.
double sample_number(const Mechanism& mechanism, const Expression& number, const std::vector<double>& pose);

/// A vector at a pose; nothing where a point of it cannot be built.
std::optional<std::array<double, 3>> sample_vector(const Mechanism& mechanism, const VectorExpression& vector,
                                                   const std::vector<double>& pose);

/// Up to `count` complete postures; fewer where the mechanism closes in few of 4096 poses.
std::vector<PosturePoints> sample_postures(const Mechanism& mechanism, std::size_t count);

/// The complete posture at a pose in any working mode; nothing where it does not close.
std::optional<PosturePoints> sample_posture(const Mechanism& mechanism, const std::vector<double>& pose,
                                            const std::vector<int>& sides);

struct SampledPosture {
  std::vector<double> pose;
  PosturePoints points;
};

/// The same in any working mode, with their poses.
std::vector<SampledPosture> sample_poses(const Mechanism& mechanism, const std::vector<int>& sides, std::size_t count);

}  // namespace clearloci::mechanism
