#include "loci/surfaces/measure.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace clearloci::loci::surface {
namespace {

constexpr int most_examined = 200000;
/// Of the cells that are left over then: further halvings, and boxes looked at in one of them and in all.
constexpr int further_cuts = 2, most_in_one = 20000, most_further = 100000;

Point place_of(const Frame& frame, const Mesh& mesh, int point) {
  return frame.place(mesh.points[static_cast<std::size_t>(point)]);
}

/// Whether no zero is in the box, within the workspace; cut into eight so many times. `proof`: what is known of the box
/// as a whole. `budget`: boxes left to look at.
bool is_free(Field& field, const Box& box, const Proof& proof, int cuts, int& budget) {
  if (--budget < 0) return false;
  if (proof.outside || proof.zero_free) return true;
  if (cuts == 0) return false;
  std::vector<Box> parts(8);
  for (std::size_t part = 0; part < 8; ++part)
    for (std::size_t i = 0; i < 3; ++i) {
      const double middle = box[i].middle();
      parts[part][i] =
          (part >> i & 1) != 0 ? core::Interval(middle, box[i].upper()) : core::Interval(box[i].lower(), middle);
    }
  const std::vector<Proof> proofs = field.examine(parts);
  for (std::size_t part = 0; part < 8; ++part)
    if (!is_free(field, parts[part], proofs[part], cuts - 1, budget)) return false;
  return true;
}

}  // namespace

double area(const Mesh& mesh) {
  double sum = 0;
  const auto at = [&](int point) { return mesh.points[static_cast<std::size_t>(point)]; };
  for (const Triangle& t : mesh.triangles) {
    const Point normal = cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
    sum += 0.5 * std::sqrt(dot(normal, normal));
  }
  return sum;
}

double deviation(Field& field, const Mesh& mesh) {
  const Frame& frame = field.frame();
  double most = 0;
  std::vector<Point> middles;
  for (const Triangle& t : mesh.triangles) middles.push_back(middle_of(mesh, t));
  const std::vector<Field::Sight> sights = field.look_at(middles);
  for (std::size_t k = 0; k < sights.size(); ++k) {
    if (!sights[k].inside) continue;
    const Triangle& t = mesh.triangles[k];
    const double value = sights[k].value;
    Point slopes = sights[k].slopes;
    for (std::size_t i = 0; i < 3; ++i) slopes[i] /= frame.width(i);
    const double slope = std::sqrt(dot(slopes, slopes));
    if (!(slope > 0) || !std::isfinite(slope)) continue;
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point side = place_of(frame, mesh, t[i]) - place_of(frame, mesh, t[(i + 1) % 3]);
      longest = std::max(longest, std::sqrt(dot(side, side)));
    }
    // Where the gradient vanishes nearby, first order says nothing: the triangle's own size bounds what can be meant.
    most = std::max(most, std::min(std::abs(value) / slope, longest));
  }
  return most;
}

std::vector<int> unexplained(Field& field, const Cells& cells, int level, const Mesh& mesh, int cuts,
                             const std::function<bool()>& stop) {
  const int side = 1 << level;
  const auto bin = [&](double unit) { return std::clamp(static_cast<int>(unit * side), 0, side - 1); };
  std::vector<bool> near(static_cast<std::size_t>(side) * side * side, false);
  const auto flag = [&](int x, int y, int z) { return (static_cast<std::size_t>(x) * side + y) * side + z; };
  for (const Triangle& t : mesh.triangles) {
    // Triangles are no larger than a cell: their middles are as near as need be.
    const Point middle = middle_of(mesh, t);
    const int x = bin(middle[0]), y = bin(middle[1]), z = bin(middle[2]);
    for (int i = std::max(0, x - 1); i <= std::min(side - 1, x + 1); ++i)
      for (int j = std::max(0, y - 1); j <= std::min(side - 1, y + 1); ++j)
        for (int k = std::max(0, z - 1); k <= std::min(side - 1, z + 1); ++k) near[flag(i, j, k)] = true;
  }
  std::vector<int> result;
  int budget = most_examined;
  for (std::size_t c = 0; c < cells.cells().size(); ++c) {
    const OctreeCell& cell = cells.cells()[c];
    if (!cell.active()) continue;
    const Point middle = unit_of(cell.middle());
    if (cell.level >= level && near[flag(bin(middle[0]), bin(middle[1]), bin(middle[2]))]) continue;
    if (stop && stop()) throw core::LimitReached("the time limit was reached");
    if (!is_free(field, cell.box(), cell.proof, cuts, budget)) result.push_back(static_cast<int>(c));
  }
  int further = most_further;
  std::erase_if(result, [&](int c) {
    if (stop && stop()) throw core::LimitReached("the time limit was reached");
    const OctreeCell& cell = cells.cells()[static_cast<std::size_t>(c)];
    const int before = std::min(further, most_in_one);
    int left = before;
    const bool is_known = is_free(field, cell.box(), cell.proof, cuts + further_cuts, left);
    further -= before - std::max(left, 0);
    return is_known;
  });
  return result;
}

}  // namespace clearloci::loci::surface
