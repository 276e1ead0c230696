// Zeros of a field (pose_field.hpp) on the edges of a lattice of poses (pose_lattice.hpp), joined within its triangles
// or tetrahedra: segments over two coordinates, triangles over three. Private to curves/.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "loci/curves/pose_field.hpp"
#include "loci/curves/pose_lattice.hpp"

namespace clearloci::loci::pose {

/// The zeros of one quantity, or the outline of what is reached.
struct PoseContour {
  struct Vertex {
    std::size_t edge = 0;
    Pose at;
    std::size_t node = 0;      ///< of the edge, reached
    bool dead_centre = false;  ///< of the outline
  };
  std::vector<Vertex> vertices;
  std::unordered_map<std::size_t, int> on_edge;
  std::vector<std::array<int, 2>> segments;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from where the quantity is positive, or reached
  /// Over two coordinates: vertices from which nothing goes on in a triangle that is not reached all over.
  std::vector<int> dangling;
};

class PoseContours {
 public:
  using Deadline = std::optional<std::chrono::steady_clock::time_point>;

  PoseContours(const core::PoseStatics& statics, const Pose& lower, const Pose& upper, int cells,
               const Deadline& deadline);

  const PoseLattice& lattice() const { return lattice_; }
  const std::vector<FieldQuantity>& quantities() const { return quantities_; }
  const PoseContour& of(std::size_t quantity) const { return contours_[quantity]; }
  const PoseContour& outline() const { return contours_.back(); }
  PoseField field() const { return PoseField(statics_, scale_); }

  /// Of a node that is reached.
  const FieldSample& sample(std::size_t node) const { return *samples_[node]; }
  bool is_reached(std::size_t node, const std::vector<unsigned>& corners) const;
  /// The cell above a node.
  bool is_reached(std::size_t node) const;
  /// Whether a quantity vanishes, or the workspace ends, on an edge of the cell above a node.
  bool is_crossed(std::size_t node) const;
  /// Between two corners of a simplex above a node.
  std::size_t edge_between(std::size_t node, unsigned one, unsigned other) const;
  bool late();

 private:
  template <class Work>
  void by_rows(const Work& work);
  void sample_nodes();
  void fill();
  void find_vertices();
  using Found = std::vector<std::pair<std::size_t, PoseContour::Vertex>>;
  void find_vertices(PoseField& field, std::size_t node, unsigned direction, Found& found) const;
  void join();
  void join(std::size_t node, const std::vector<unsigned>& simplex, std::size_t contour);
  void add_triangle(std::size_t node, const std::vector<unsigned>& simplex, std::size_t contour,
                    std::array<int, 3> corners);
  double height(std::size_t contour, std::size_t node) const;

  const core::PoseStatics& statics_;
  PoseLattice lattice_;
  Deadline deadline_;
  std::vector<FieldQuantity> quantities_;
  double scale_ = 0;
  std::vector<std::optional<FieldSample>> samples_;
  std::vector<PoseContour> contours_;  ///< one a quantity, and the outline
  std::atomic<bool> late_ = false;
};

}  // namespace clearloci::loci::pose
