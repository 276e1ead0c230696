// Loci of poses over two or three coordinates without formulas (groups of points that close together): zeros of a field
// (pose_field.hpp) on the edges of a lattice of triangles or tetrahedra, joined within each of them, and refined. They
// are followed in floating point: nothing is certified. What is proven is what lies beside them: cells between them are
// proven free of every locus (pose_cell.hpp), or are told as open.
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <vector>

#include "core/locus_map.hpp"
#include "core/pose_statics.hpp"
#include "loci/sheet/sheet.hpp"

namespace clearloci::loci::pose {

/// What may vanish, or the end of the workspace.
struct PoseZero {
  Doubt doubt = Doubt::singularity;
  int demand = -1;           ///< of core::PoseStatics, with Doubt::demand
  bool dead_centre = false;  ///< with Doubt::workspace: of groups

  friend bool operator==(const PoseZero&, const PoseZero&) = default;
};

/// Over two coordinates arcs, a closed one with its first point repeated; over three triangles.
struct PoseLocus {
  PoseZero zero;
  std::vector<core::Polyline> arcs;
  std::vector<core::Point3> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// Over two coordinates: a force of two components vanishes there alone.
struct PoseZeroPoint {
  int demand = 0;
  core::Point2 at{};
};

/// Neither proven to be free of loci nor crossed by one that was followed.
struct OpenPoses {
  PoseZero zero;  ///< the first that may vanish there
  Pose lower, upper;
};

struct PoseZeros {
  std::vector<PoseLocus> loci;
  std::vector<PoseZeroPoint> points;
  std::vector<core::Polyline> rings;  ///< over two coordinates: around the poses that are reached, by the even-odd rule
  std::vector<OpenPoses> open;
  int cells = 0;  ///< of the lattice along each coordinate
  bool out_of_time = false;
};

struct PoseZerosEffort {
  int cells = 0;            ///< of the lattice along each coordinate; 0: 96 over two, 24 over three
  double tolerance = 1e-5;  ///< of the box: the largest distance of a chord from its arc
  long most_proofs = 60'000;
  std::optional<std::chrono::steady_clock::time_point> deadline = {};
};

/// `lower`, `upper`: of two or three coordinates.
PoseZeros pose_zeros(const core::PoseStatics& statics, const Pose& lower, const Pose& upper,
                     const PoseZerosEffort& effort = {});

}  // namespace clearloci::loci::pose
