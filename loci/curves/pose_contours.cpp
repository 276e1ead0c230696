#include "loci/curves/pose_contours.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "loci/search/search.hpp"

namespace clearloci::loci::pose {

PoseContours::PoseContours(const core::PoseStatics& statics, const Pose& lower, const Pose& upper, int cells,
                           const Deadline& deadline)
    : statics_(statics),
      lattice_(lower, upper, cells),
      deadline_(deadline),
      quantities_(PoseField(statics).quantities()),
      samples_(lattice_.nodes()),
      contours_(quantities_.size() + 1) {
  sample_nodes();
  find_vertices();
  join();
}

bool PoseContours::late() {
  if (!late_ && deadline_ && std::chrono::steady_clock::now() >= *deadline_) late_ = true;
  return late_;
}

/// Rows of nodes, each on a thread.
template <class Work>
void PoseContours::by_rows(const Work& work) {
  run_in_order(lattice_.nodes() / lattice_.along(), [&](std::size_t row) {
    if (late()) return;
    PoseField pose_field = field();
    for (std::size_t i = 0; i < lattice_.along(); ++i) work(row, pose_field, row * lattice_.along() + i);
  });
}

void PoseContours::sample_nodes() {
  PoseField first(statics_);
  for (std::size_t node = 0; node < lattice_.nodes(); ++node)
    if (!lattice_.outside(node) && first.at(lattice_.at(node))) {
      scale_ = first.logarithm();
      break;
    }
  by_rows([&](std::size_t, PoseField& field, std::size_t node) {
    if (!lattice_.outside(node)) samples_[node] = field.at(lattice_.at(node));
  });
  fill();
}

/// What the proof of the groups' sheet stops short of, beside dead centres: reached from neighbours, one layer after
/// the other.
void PoseContours::fill() {
  if (statics_.program.blocks.empty()) return;
  PoseField pose_field = field();
  bool more = true;
  constexpr int layers = 4;
  for (int layer = 0; layer < layers && more; ++layer) {
    std::vector<std::pair<std::size_t, FieldSample>> found;
    for (std::size_t node = 0; node < lattice_.nodes(); ++node)
      for (unsigned direction = 1; direction < lattice_.directions(); ++direction) {
        if (!lattice_.has(node, direction)) continue;
        const std::size_t other = lattice_.end(node, direction);
        if (samples_[node].has_value() == samples_[other].has_value()) continue;
        const std::size_t sampled = samples_[node] ? node : other, open = samples_[node] ? other : node;
        if (lattice_.outside(open)) continue;
        const Pose at = lattice_.at(open);
        std::optional<FieldSample> sample = pose_field.at(at, *samples_[sampled]);
        if (!sample)
          sample = pose_field.at(at, end_between(pose_field, lattice_.at(sampled), *samples_[sampled], at).sample);
        if (sample) found.emplace_back(open, std::move(*sample));
      }
    more = !found.empty();
    for (auto& [node, sample] : found) samples_[node] = std::move(sample);
  }
}

void PoseContours::find_vertices() {
  std::vector<Found> rows(lattice_.nodes() / lattice_.along());
  by_rows([&](std::size_t row, PoseField& field, std::size_t node) {
    for (unsigned direction = 1; direction < lattice_.directions(); ++direction)
      if (lattice_.has(node, direction)) find_vertices(field, node, direction, rows[row]);
  });
  for (Found& row : rows)
    for (auto& [contour, vertex] : row) {
      PoseContour& pose_contour = contours_[contour];
      pose_contour.on_edge.emplace(vertex.edge, static_cast<int>(pose_contour.vertices.size()));
      pose_contour.vertices.push_back(std::move(vertex));
    }
}

void PoseContours::find_vertices(PoseField& field, std::size_t node, unsigned direction, Found& found) const {
  const std::size_t other = lattice_.end(node, direction), edge = lattice_.edge(node, direction);
  const auto &a = samples_[node], &b = samples_[other];
  if (!a && !b) return;
  const bool whole = a && b;
  const std::size_t inside = a ? node : other;
  const Pose from = lattice_.at(inside), to = lattice_.at(inside == node ? other : node);
  const FieldSample& at_from = *samples_[inside];
  FieldEnd end;
  if (!whole) {
    if (from != to) end = end_between(field, from, at_from, to);
    found.push_back({quantities_.size(), {edge, from == to ? from : end.at, inside, from != to && !end.closure}});
    if (from == to) return;
  }
  for (std::size_t q = 0; q < quantities_.size(); ++q)
    if (auto at = zero_between(field, quantities_[q], from, at_from, whole ? to : end.at, whole ? *b : end.sample))
      found.push_back({q, {edge, std::move(*at), inside, false}});
}

std::size_t PoseContours::edge_between(std::size_t node, unsigned one, unsigned other) const {
  const unsigned low = std::min(one, other), high = std::max(one, other);
  return lattice_.edge(lattice_.end(node, low), high & ~low);
}

void PoseContours::join() {
  for (std::size_t node = 0; node < lattice_.nodes(); ++node) {
    if (!lattice_.has_cell(node)) continue;
    for (const std::vector<unsigned>& simplex : lattice_.simplices())
      for (std::size_t c = 0; c < contours_.size(); ++c)
        if (!contours_[c].vertices.empty()) join(node, simplex, c);
  }
}

void PoseContours::join(std::size_t node, const std::vector<unsigned>& simplex, std::size_t contour) {
  struct Crossed {
    std::size_t first = 0, second = 0;  // corners
    int vertex = 0;
  };
  PoseContour& pose_contour = contours_[contour];
  std::vector<Crossed> crossed;
  for (std::size_t i = 0; i < simplex.size(); ++i)
    for (std::size_t j = i + 1; j < simplex.size(); ++j)
      if (const auto at = pose_contour.on_edge.find(edge_between(node, simplex[i], simplex[j]));
          at != pose_contour.on_edge.end())
        crossed.push_back({i, j, at->second});
  if (lattice_.dimension() == 2) {
    if (crossed.size() == 2) pose_contour.segments.push_back({crossed[0].vertex, crossed[1].vertex});
    if (crossed.size() == 1 && !is_reached(node, simplex)) pose_contour.dangling.push_back(crossed[0].vertex);
    return;
  }
  if (crossed.size() == 3)
    add_triangle(node, simplex, contour, {crossed[0].vertex, crossed[1].vertex, crossed[2].vertex});
  if (crossed.size() != 4) return;
  // Two corners on either side: round the four edges between them, a corner in common from each to the next.
  const auto meets = [](const Crossed& a, const Crossed& b) {
    return a.first == b.first || a.first == b.second || a.second == b.first || a.second == b.second;
  };
  if (!meets(crossed[0], crossed[1])) std::swap(crossed[1], crossed[2]);
  if (!meets(crossed[1], crossed[2])) std::swap(crossed[2], crossed[3]);
  // Where a corner is not reached they may be no ring.
  if (!meets(crossed[0], crossed[1]) || !meets(crossed[2], crossed[3]) || !meets(crossed[3], crossed[0])) return;
  add_triangle(node, simplex, contour, {crossed[0].vertex, crossed[1].vertex, crossed[2].vertex});
  add_triangle(node, simplex, contour, {crossed[0].vertex, crossed[2].vertex, crossed[3].vertex});
}

/// What tells the two sides of a contour apart: above zero where a quantity is positive. The sides of a force of
/// several components have no order: one is chosen for all poses at which its directions are less than a quarter turn
/// apart.
double PoseContours::height(std::size_t contour, std::size_t node) const {
  if (contour == quantities_.size()) return samples_[node] ? 1 : -1;
  if (!samples_[node]) return 0;
  constexpr std::array<double, 3> ahead = {1, 0.37, 0.73};
  const FieldQuantity& quantity = quantities_[contour];
  double sum = 0;
  for (std::size_t k = 0; k < quantity.count; ++k) sum += ahead[k] * samples_[node]->values[quantity.first + k];
  return sum;
}

void PoseContours::add_triangle(std::size_t node, const std::vector<unsigned>& simplex, std::size_t contour,
                                std::array<int, 3> corners) {
  PoseContour& pose_contour = contours_[contour];
  const auto at = [&](std::size_t k) -> const Pose& {
    return pose_contour.vertices[static_cast<std::size_t>(corners[k])].at;
  };
  std::array<double, 3> u{}, v{}, rise{};
  for (std::size_t c = 0; c < 3; ++c) {
    u[c] = at(1)[c] - at(0)[c];
    v[c] = at(2)[c] - at(0)[c];
  }
  for (const unsigned corner : simplex) {
    const std::size_t end = lattice_.end(node, corner);
    const double sign = height(contour, end) > 0 ? 1 : -1;
    const Pose place = lattice_.at(end);
    for (std::size_t c = 0; c < 3; ++c) rise[c] += sign * (place[c] - at(0)[c]);
  }
  const double ahead = rise[0] * (u[1] * v[2] - u[2] * v[1]) + rise[1] * (u[2] * v[0] - u[0] * v[2]) +
                       rise[2] * (u[0] * v[1] - u[1] * v[0]);
  if (ahead < 0) std::swap(corners[1], corners[2]);
  pose_contour.triangles.push_back(corners);
}

bool PoseContours::is_reached(std::size_t node, const std::vector<unsigned>& corners) const {
  return std::all_of(corners.begin(), corners.end(),
                     [&](unsigned corner) { return samples_[lattice_.end(node, corner)].has_value(); });
}

bool PoseContours::is_reached(std::size_t node) const {
  return std::all_of(lattice_.simplices().begin(), lattice_.simplices().end(),
                     [&](const std::vector<unsigned>& simplex) { return is_reached(node, simplex); });
}

bool PoseContours::is_crossed(std::size_t node) const {
  for (const std::vector<unsigned>& simplex : lattice_.simplices())
    for (std::size_t i = 0; i < simplex.size(); ++i)
      for (std::size_t j = i + 1; j < simplex.size(); ++j) {
        const std::size_t edge = edge_between(node, simplex[i], simplex[j]);
        for (const PoseContour& contour : contours_)
          if (contour.on_edge.count(edge) != 0) return true;
      }
  return false;
}

}  // namespace clearloci::loci::pose
