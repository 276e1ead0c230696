#include "loci/curves/pose_zeros.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "loci/curves/pose_arcs.hpp"
#include "loci/curves/pose_contours.hpp"
#include "loci/curves/pose_gaps.hpp"

namespace clearloci::loci::pose {
namespace {

using core::Point2;
using core::Polyline;

/// Of the lattice along each coordinate.
int cells_for(std::size_t dimension) { return dimension == 2 ? 96 : 24; }

class Tracer {
 public:
  Tracer(const core::PoseStatics& statics, const Pose& lower, const Pose& upper, const PoseZerosEffort& effort)
      : statics_(statics),
        lower_(lower),
        upper_(upper),
        effort_(effort),
        contours_(statics, lower, upper, effort.cells > 0 ? effort.cells : cells_for(lower.size()), effort.deadline),
        lattice_(contours_.lattice()),
        quantities_(contours_.quantities()),
        field_(contours_.field()) {}

  PoseZeros trace() {
    if (lattice_.dimension() == 2) {
      add_arcs();
      add_points();
    } else {
      add_surfaces();
    }
    result_.open = open_poses(statics_, contours_, result_.points, effort_.most_proofs);
    result_.cells = lattice_.cells();
    result_.out_of_time = contours_.late();
    return std::move(result_);
  }

 private:
  PoseZero zero_of(std::size_t quantity) const {
    return {quantities_[quantity].doubt, quantities_[quantity].demand, false};
  }

  std::size_t cell_of(const Point2& at) const { return lattice_.node_below({at[0], at[1]}); }
  static Point2 point(const Pose& pose) { return {pose[0], pose[1]}; }
  static Polyline places(const PoseContour& contour, const std::vector<int>& chain) {
    Polyline arc;
    for (const int v : chain) arc.push_back(point(contour.vertices[static_cast<std::size_t>(v)].at));
    return arc;
  }

  void add_arcs() {
    PoseArcs arcs(field_, lower_, upper_, effort_.tolerance);
    for (std::size_t q = 0; q < quantities_.size(); ++q) {
      const PoseContour& contour = contours_.of(q);
      PoseLocus locus{.zero = zero_of(q), .arcs = {}, .vertices = {}, .triangles = {}};
      for (const std::vector<int>& chain : chains_of(contour.segments, contour.vertices.size())) {
        if (contours_.late()) break;
        const auto sample_at = [&](int v) -> const FieldSample& {
          return contours_.sample(contour.vertices[static_cast<std::size_t>(v)].node);
        };
        Polyline arc = places(contour, chain);
        for (const bool backwards : {false, true}) {
          const int end = backwards ? chain.front() : chain.back();
          if (std::find(contour.dangling.begin(), contour.dangling.end(), end) == contour.dangling.end()) continue;
          if (backwards) std::reverse(arc.begin(), arc.end());
          go_on(arcs, arc, quantities_[q], sample_at(end));
          if (backwards) std::reverse(arc.begin(), arc.end());
        }
        locus.arcs.push_back(arcs.refined(arc, quantities_[q], sample_at(chain.front())));
      }
      if (!locus.arcs.empty()) result_.loci.push_back(std::move(locus));
    }
    add_outline(arcs);
  }

  void go_on(PoseArcs& arcs, Polyline& arc, const FieldQuantity& quantity, const FieldSample& nearby) {
    const std::size_t start = cell_of(arc.back());
    const Polyline more =
        arcs.beyond(arc[arc.size() - 2], arc.back(), 0.5 / lattice_.cells(), quantity, nearby, [&](const Point2& at) {
          const std::size_t cell = cell_of(at);
          return cell == start || !contours_.is_reached(cell);
        });
    arc.insert(arc.end(), more.begin(), more.end());
  }

  bool on_one_side(const Point2& p, const Point2& q) const {
    for (std::size_t c = 0; c < 2; ++c)
      if (p[c] == q[c] && (p[c] == lower_[c] || p[c] == upper_[c])) return true;
    return false;
  }

  /// Rings, and those of their stretches that are not the box's sides.
  void add_outline(PoseArcs& arcs) {
    const PoseContour& contour = contours_.outline();
    std::array<PoseLocus, 2> ends;  // at limits, and at dead centres
    for (const std::vector<int>& chain : chains_of(contour.segments, contour.vertices.size())) {
      if (chain.front() != chain.back()) continue;
      const auto vertex = [&](std::size_t i) -> const PoseContour::Vertex& {
        return contour.vertices[static_cast<std::size_t>(chain[i])];
      };
      Polyline ring;
      std::vector<std::size_t> stretch;
      const auto close = [&] {
        if (stretch.size() > 1) {
          std::size_t dead = 0;
          Polyline arc;
          for (const std::size_t i : stretch) {
            arc.push_back(point(vertex(i).at));
            dead += vertex(i).dead_centre ? 1U : 0U;
          }
          arc = arcs.refined(arc, std::nullopt, contours_.sample(vertex(stretch.front()).node));
          const bool dead_centre = 2 * dead > stretch.size();
          PoseLocus& end = ends[dead_centre ? 1 : 0];
          end.zero = {Doubt::workspace, -1, dead_centre};
          if (!ring.empty()) ring.pop_back();
          ring.insert(ring.end(), arc.begin(), arc.end());
          end.arcs.push_back(std::move(arc));
        }
        stretch.clear();
      };
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const Point2 from = point(vertex(i).at), to = point(vertex(i + 1).at);
        if (on_one_side(from, to) || from == to) {
          close();
          if (ring.empty()) ring.push_back(from);
          ring.push_back(to);
          continue;
        }
        if (stretch.empty()) stretch.push_back(i);
        stretch.push_back(i + 1);
      }
      close();
      if (ring.size() > 3) result_.rings.push_back(std::move(ring));
    }
    for (PoseLocus& end : ends)
      if (!end.arcs.empty()) result_.loci.push_back(std::move(end));
  }

  /// Where a force of two components turns round all directions along a triangle it vanishes within.
  void add_points() {
    for (std::size_t q = 0; q < quantities_.size(); ++q) {
      if (quantities_[q].count != 2) continue;
      for (std::size_t node = 0; node < lattice_.nodes(); ++node) {
        if (!lattice_.has_cell(node)) continue;
        for (const std::vector<unsigned>& simplex : lattice_.simplices())
          if (contours_.is_reached(node, simplex) && winds(q, node, simplex)) add_point(q, node, simplex);
      }
    }
  }

  bool winds(std::size_t q, std::size_t node, const std::vector<unsigned>& simplex) const {
    const std::size_t first = quantities_[q].first;
    double turned = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if (contours_.of(q).on_edge.count(contours_.edge_between(node, simplex[i], simplex[j])) != 0) return false;
      const std::vector<double>&a = contours_.sample(lattice_.end(node, simplex[i])).values,
            &b = contours_.sample(lattice_.end(node, simplex[j])).values;
      turned += std::atan2(a[first] * b[first + 1] - a[first + 1] * b[first],
                           a[first] * b[first] + a[first + 1] * b[first + 1]);
    }
    return std::abs(turned) > std::numbers::pi;
  }

  /// Newton's iteration with differences.
  void add_point(std::size_t q, std::size_t node, const std::vector<unsigned>& simplex) {
    const std::size_t first = quantities_[q].first;
    FieldSample nearby = contours_.sample(node);
    const PoseBox box = lattice_.box(node);
    Pose at(2, 0.0);
    for (const unsigned corner : simplex)
      for (std::size_t c = 0; c < 2; ++c) at[c] += lattice_.at(lattice_.end(node, corner))[c] / 3;
    const double size = nearby.size(quantities_[q]);
    constexpr int most = 30;
    constexpr double apart = 1e-6, vanishing = 1e-9;
    double left = size;
    for (int i = 0; i < most; ++i) {
      const auto here = field_.at(at, nearby);
      if (!here) return;
      std::array<std::array<double, 2>, 2> slopes{};
      for (std::size_t c = 0; c < 2; ++c) {
        Pose beside = at;
        const double by = apart * (upper_[c] - lower_[c]);
        beside[c] += by;
        const auto there = field_.at(beside, *here);
        if (!there) return;
        for (std::size_t k = 0; k < 2; ++k) slopes[k][c] = (there->values[first + k] - here->values[first + k]) / by;
      }
      left = here->size(quantities_[q]);
      nearby = *here;
      const double determinant = slopes[0][0] * slopes[1][1] - slopes[0][1] * slopes[1][0];
      if (determinant == 0) return;
      const double f = here->values[first], g = here->values[first + 1];
      const Point2 step = {(f * slopes[1][1] - g * slopes[0][1]) / determinant,
                           (g * slopes[0][0] - f * slopes[1][0]) / determinant};
      at = {at[0] - step[0], at[1] - step[1]};
      for (std::size_t c = 0; c < 2; ++c) {
        const double width = box[c][1] - box[c][0];
        if (at[c] < box[c][0] - width || at[c] > box[c][1] + width) return;
      }
      if (std::abs(step[0]) <= 1e-14 * (upper_[0] - lower_[0]) && std::abs(step[1]) <= 1e-14 * (upper_[1] - lower_[1]))
        break;
    }
    if (left > vanishing * size) return;
    for (std::size_t c = 0; c < 2; ++c)
      if (at[c] < lower_[c] || at[c] > upper_[c]) return;
    result_.points.push_back({quantities_[q].demand, point(at)});
  }

  void add_surfaces() {
    for (std::size_t c = 0; c <= quantities_.size(); ++c) {
      const PoseContour& contour = contours_.of(c);
      const bool end = c == quantities_.size();
      PoseLocus locus{.zero = end ? PoseZero{Doubt::workspace, -1, false} : zero_of(c),
                      .arcs = {},
                      .vertices = {},
                      .triangles = {}};
      std::vector<int> place(contour.vertices.size(), -1);
      std::size_t dead = 0;
      for (const std::array<int, 3>& corners : contour.triangles) {
        if (end && on_one_side(contour, corners)) continue;
        std::array<int, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
          const auto v = static_cast<std::size_t>(corners[k]);
          if (place[v] < 0) {
            place[v] = static_cast<int>(locus.vertices.size());
            const Pose& at = contour.vertices[v].at;
            locus.vertices.push_back({at[0], at[1], at[2]});
            dead += contour.vertices[v].dead_centre ? 1U : 0U;
          }
          triangle[k] = place[v];
        }
        locus.triangles.push_back(triangle);
      }
      locus.zero.dead_centre = end && 2 * dead > locus.vertices.size();
      if (!locus.triangles.empty()) result_.loci.push_back(std::move(locus));
    }
  }

  bool on_one_side(const PoseContour& contour, const std::array<int, 3>& corners) const {
    for (std::size_t c = 0; c < 3; ++c)
      for (const double side : {lower_[c], upper_[c]})
        if (std::all_of(corners.begin(), corners.end(),
                        [&](int v) { return contour.vertices[static_cast<std::size_t>(v)].at[c] == side; }))
          return true;
    return false;
  }

  const core::PoseStatics& statics_;
  const Pose &lower_, &upper_;
  const PoseZerosEffort& effort_;
  PoseContours contours_;
  const PoseLattice& lattice_;
  const std::vector<FieldQuantity>& quantities_;
  PoseField field_;
  PoseZeros result_;
};

}  // namespace

PoseZeros pose_zeros(const core::PoseStatics& statics, const Pose& lower, const Pose& upper,
                     const PoseZerosEffort& effort) {
  return Tracer(statics, lower, upper, effort).trace();
}

}  // namespace clearloci::loci::pose
