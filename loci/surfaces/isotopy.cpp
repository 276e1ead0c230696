#include "loci/surfaces/isotopy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/errors.hpp"
#include "loci/surfaces/mesh.hpp"

namespace clearloci::loci::surface {
namespace {

using core::Interval;

constexpr int clock_every = 64;  // cells between two looks at the clock
constexpr int face_cuts = 4;     // of a face to cells out of reach
constexpr std::size_t side_by_side = sheet::IntervalBatch::size;
constexpr std::size_t many_doubts = 2 * side_by_side;  // enough to be looked at together

/// A corner of a tetrahedron and the value of g there.
struct Node {
  Point at{};
  double value = 0;
};
using Nodes = std::array<Node, 4>;
/// Six times the volume of a tetrahedron with the sign of its orientation, and as many times the gradient of g.
struct Slope {
  Interval volume;
  Vector gradient;
};

Slope slope_of(const Nodes& nodes) {
  const Vector a = way(nodes[0].at, nodes[1].at), b = way(nodes[0].at, nodes[2].at), c = way(nodes[0].at, nodes[3].at);
  const Vector bc = cross_product(b, c), ca = cross_product(c, a), ab = cross_product(a, b);
  const auto rise = [&](std::size_t i) { return Interval(nodes[i].value) - Interval(nodes[0].value); };
  Slope result;
  result.volume = product(a, bc);
  for (std::size_t k = 0; k < 3; ++k) result.gradient[k] = rise(1) * bc[k] + rise(2) * ca[k] + rise(3) * ab[k];
  return result;
}

/// A part of a tetrahedron: itself, or what lies in some of the cube's sides.
struct TetrahedronPart {
  std::array<int, 3> sides{};  ///< along each axis: -1 below, +1 above, 0 not held
  std::vector<Node> nodes;
};

bool lies_on(const Point& at, const std::array<int, 3>& sides) {
  for (std::size_t k = 0; k < 3; ++k)
    if (sides[k] != 0 && at[k] != (sides[k] < 0 ? 0 : 1)) return false;
  return true;
}

/// Those that are as large as the sides allow: a face of the tetrahedron in one, an edge in two, a corner in three.
std::vector<TetrahedronPart> parts_of(const Nodes& nodes) {
  const auto beside_a_side = [](const Node& node) {
    return std::any_of(node.at.begin(), node.at.end(), [](double x) { return x == 0 || x == 1; });
  };
  if (std::none_of(nodes.begin(), nodes.end(), beside_a_side)) return {{{}, {nodes.begin(), nodes.end()}}};
  std::vector<TetrahedronPart> result;
  std::array<int, 3> sides{};
  for (sides[0] = -1; sides[0] <= 1; ++sides[0])
    for (sides[1] = -1; sides[1] <= 1; ++sides[1])
      for (sides[2] = -1; sides[2] <= 1; ++sides[2]) {
        TetrahedronPart part{sides, {}};
        std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(part.nodes),
                     [&](const Node& node) { return lies_on(node.at, sides); });
        const auto held = 3 - std::count(sides.begin(), sides.end(), 0);
        if (static_cast<std::ptrdiff_t>(part.nodes.size()) >= 4 - held) result.push_back(std::move(part));
      }
  return result;
}

template <class Range>
Box box_of(const Range& nodes) {
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    box[i] = Interval(nodes[0].at[i]);
    for (const Node& node : nodes) box[i] = hull(box[i], Interval(node.at[i]));
  }
  return box;
}

/// +1 or -1 where all nodes have that sign.
int sign_of(const std::vector<Node>& nodes) {
  const auto sign = [](const Node& node) { return node.value > 0 ? 1 : node.value < 0 ? -1 : 0; };
  const int first = sign(nodes.front());
  return std::all_of(nodes.begin(), nodes.end(), [&](const Node& node) { return sign(node) == first; }) ? first : 0;
}

/// Parts of a vector within the sides.
Vector within(const std::array<int, 3>& sides, Vector v) {
  for (std::size_t k = 0; k < 3; ++k)
    if (sides[k] != 0) v[k] = Interval(0.0);
  return v;
}

/// Of one chart, where the surface ends: the homotopy is regular within the surfaces on which a clip is constant too.
bool is_regular_at_its_end(const Vector& way, const std::array<int, 3>& sides, const Field::Over& f) {
  const Field::Clip* ends = nullptr;
  for (const Field::Clip& clip : f.clips) {
    if (clip.value.lower() > 0) continue;
    if (ends != nullptr) return false;
    ends = &clip;
  }
  if (ends == nullptr) return true;
  return f.rises_across(within(sides, ends->gradient), way);
}

bool is_beyond_the_boundary(const Field::Over& f) {
  return f.known &&
         std::any_of(f.clips.begin(), f.clips.end(), [](const Field::Clip& clip) { return clip.value.upper() < 0; });
}

/// Whether the homotopy has no zero on a part within the workspace, or is regular there. `over`: f on a box that holds
/// it. `orientation`: of the tetrahedron.
bool is_regular(const TetrahedronPart& part, const Slope& g, const std::vector<Field::Over>& over, int orientation) {
  const int sign = sign_of(part.nodes);
  Vector way = within(part.sides, g.gradient);
  for (Interval& interval : way) interval = Interval(orientation) * interval;
  return std::all_of(over.begin(), over.end(), [&](const Field::Over& f) {
    if (sign != 0 && f.value.sign() == sign) return true;
    if (is_beyond_the_boundary(f)) return true;
    return g.volume.sign() == orientation && f.rises(way) && is_regular_at_its_end(way, part.sides, f);
  });
}

/// A part of which more has to be known than over its whole cell.
struct Doubt {
  TetrahedronPart part{};
  Slope g{};
  int orientation = 0;  ///< of the tetrahedron
};

/// A cell and its tetrahedra, [first, last).
struct Tetrahedral {
  int cell = 0;
  std::size_t first = 0, last = 0;
};

class Homotopy {
 public:
  Homotopy(Field& field, const Cells& cells, Complex complex)
      : field_(field), cells_(cells), complex_(std::move(complex)) {}

  std::vector<int> run(const std::function<bool()>& stop) {
    add_tetrahedra(cells_, cells_beside_moved_corners(), complex_.cut);
    place_corners();
    const Tetrahedra& all = complex_.cut;
    std::vector<int> open;
    std::vector<Tetrahedral> cells;
    for (std::size_t first = 0, last = 0; first < all.tetrahedra.size(); first = last) {
      const int cell = all.cell_of[first];
      while (last < all.tetrahedra.size() && all.cell_of[last] == cell) ++last;
      cells.push_back({cell, first, last});
      if (cells.size() < side_by_side && last < all.tetrahedra.size()) continue;
      std::vector<Box> boxes;
      for (const Tetrahedral& tetrahedral_cell : cells) boxes.push_back(box_of(all, tetrahedral_cell));
      const std::vector<std::vector<Field::Over>> over = field_.over(boxes);
      for (std::size_t k = 0; k < cells.size(); ++k) {
        if (stop && ++examined_ % clock_every == 0 && stop()) throw core::LimitReached("the time limit was reached");
        if (!is_regular_in(all, cells[k], over[k])) open.push_back(cells[k].cell);
      }
      cells.clear();
    }
    std::sort(open.begin(), open.end());
    return open;
  }

 private:
  /// Cells free of zeros into which the tetrahedra of moved corners reach.
  std::vector<int> cells_beside_moved_corners() const {
    std::vector<int> result;
    for (std::size_t i = 0; i < complex_.corners.size(); ++i)
      if (complex_.corners[i].on_surface())
        cells_.each_leaf_at(complex_.cut.corners[i], [&](int cell) {
          if (!cells_.cells()[static_cast<std::size_t>(cell)].active()) result.push_back(cell);
        });
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  /// The marcher's corners come first, in its order.
  void place_corners() {
    for (const Complex::Corner& corner : complex_.corners) nodes_.push_back({corner.at, corner.signed_value()});
    std::vector<Point> others;
    for (std::size_t i = nodes_.size(); i < complex_.cut.corners.size(); ++i)
      others.push_back(unit_of(complex_.cut.corners[i]));
    const std::vector<double> values = field_.values(others);
    for (std::size_t i = 0; i < others.size(); ++i)
      nodes_.push_back({others[i], Complex::Corner(others[i], values[i]).signed_value()});
  }

  /// Of a cell with all its tetrahedra, whose corners may have left it.
  Box box_of(const Tetrahedra& all, const Tetrahedral& cell) const {
    Box box = cells_.cells()[static_cast<std::size_t>(cell.cell)].box();
    for (std::size_t t = cell.first; t < cell.last; ++t) {
      const Box part = surface::box_of(nodes_of(all.tetrahedra[t]));
      for (std::size_t i = 0; i < 3; ++i) box[i] = hull(box[i], part[i]);
    }
    return box;
  }

  /// With f over the whole cell, `over`, then, where that does not do, over the parts' own boxes.
  bool is_regular_in(const Tetrahedra& all, const Tetrahedral& cell, const std::vector<Field::Over>& over) {
    if (!is_regular_where_likeliest_not(all, cell, over)) return false;
    std::vector<Doubt> doubts;
    for (std::size_t t = cell.first; t < cell.last; ++t) {
      if (!find_doubts(all.tetrahedra[t], over, orientation(all, all.tetrahedra[t]), doubts)) return false;
      if (doubts.size() < many_doubts && t + 1 < cell.last) continue;
      if (!are_regular(doubts)) return false;
      doubts.clear();
    }
    if (std::all_of(over.begin(), over.end(), [](const Field::Over& f) { return f.known && f.clips.empty(); }))
      return true;
    for (std::size_t t = cell.first; t < cell.last; ++t)
      if (!keeps_inside(all, t)) return false;
    return true;
  }

  /// False: one of a few parts is not regular. They are the likeliest ones, which the triangles run through, or else
  /// those where the function is the least: most of the cells that stay open are known for it here. True tells nothing.
  bool is_regular_where_likeliest_not(const Tetrahedra& all, const Tetrahedral& cell,
                                      const std::vector<Field::Over>& over) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t t = cell.first; t < cell.last; ++t) order.emplace_back(least_value(all.tetrahedra[t]), t);
    std::vector<Doubt> doubts;
    const auto taken = static_cast<std::ptrdiff_t>(std::min(order.size(), many_doubts));
    std::partial_sort(order.begin(), order.begin() + taken, order.end());
    const bool runs_through = order.front().first == 0;
    for (std::ptrdiff_t i = 0; i < taken && doubts.size() < side_by_side; ++i) {
      const auto& [least, t] = order[static_cast<std::size_t>(i)];
      if (runs_through && least != 0) break;
      if (!find_doubts(all.tetrahedra[t], over, orientation(all, all.tetrahedra[t]), doubts)) return false;
      if (runs_through) std::erase_if(doubts, [](const Doubt& doubt) { return sign_of(doubt.part.nodes) != 0; });
    }
    if (doubts.size() > side_by_side) doubts.resize(side_by_side);
    std::vector<const Doubt*> chosen;
    for (const Doubt& doubt : doubts) chosen.push_back(&doubt);
    return are_regular_by_slopes(chosen);
  }

  /// The least size of g at a tetrahedron's corners; 0 where it does not have one sign.
  double least_value(const std::array<int, 4>& corners) const {
    const auto value = [&](std::size_t i) { return nodes_[static_cast<std::size_t>(corners[i])].value; };
    const auto [least, most] = std::minmax({value(0), value(1), value(2), value(3)});
    return least > 0 ? least : most < 0 ? -most : 0;
  }

  /// No zero of the homotopy leaves the cells within the workspace. Beyond the boundary there are cells that are not
  /// cut into tetrahedra, though the surface goes on in them: on a face to one of them g and f have one sign, or a clip
  /// is negative.
  bool keeps_inside(const Tetrahedra& all, std::size_t tetrahedron) const {
    const std::array<int, 4>& corners = all.tetrahedra[tetrahedron];
    const OctreeCell& cell = cells_.cells()[static_cast<std::size_t>(all.cell_of[tetrahedron])];
    // The first corner is the cell's middle, the others lie on a face of it.
    const auto place = [&](std::size_t i) { return all.corners[static_cast<std::size_t>(corners[i])]; };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int32_t at = place(1)[axis];
      if (place(2)[axis] != at || place(3)[axis] != at) continue;
      LatticePlace beside;
      for (std::size_t k = 0; k < 3; ++k) beside[k] = (place(1)[k] + place(2)[k] + place(3)[k]) / 3;
      beside[axis] = at == cell.corner[axis] ? at - 1 : at;
      const int other = cells_.at(beside, deepest);
      if (other < 0 || !cells_.cells()[static_cast<std::size_t>(other)].proof.outside) return true;
      return face_keeps_inside(corners, axis, unit_of(place(1))[axis]);
    }
    return true;
  }

  /// `plane`: of the face, across an axis.
  bool face_keeps_inside(const std::array<int, 4>& corners, std::size_t axis, double plane) const {
    std::vector<Nodes> pieces = {nodes_of(corners)};
    const std::optional<std::vector<int>> crossings = crossings_of(corners);
    if (!crossings) return lies_beyond(corners);
    for (const int crossing : *crossings) cut(pieces, complex_.crossings[static_cast<std::size_t>(crossing)]);
    return std::all_of(pieces.begin(), pieces.end(), [&](const Nodes& piece) {
      std::vector<Node> face;
      std::copy_if(piece.begin(), piece.end(), std::back_inserter(face),
                   [&](const Node& node) { return node.at[axis] == plane; });
      return face.size() < 3 || (face.size() == 3 && have_no_zero_within({face}, face_cuts));
    });
  }

  /// Of the homotopy on triangles, each cut into four so many times.
  bool have_no_zero_within(const std::vector<std::vector<Node>>& faces, int cuts) const {
    std::vector<Box> boxes;
    std::vector<int> signs;
    for (const std::vector<Node>& face : faces) {
      boxes.push_back(surface::box_of(face));
      signs.push_back(sign_of(face));
    }
    const std::vector<std::vector<Field::Over>> over = field_.over(boxes, signs);
    for (std::size_t k = 0; k < faces.size(); ++k)
      if (!has_no_zero_within(faces[k], over[k], cuts)) return false;
    return true;
  }

  bool has_no_zero_within(const std::vector<Node>& face, const std::vector<Field::Over>& over, int cuts) const {
    const int sign = sign_of(face);
    if (std::all_of(over.begin(), over.end(), [&](const Field::Over& f) {
          return (sign != 0 && f.value.sign() == sign) || is_beyond_the_boundary(f);
        }))
      return true;
    if (cuts == 0) return false;
    const auto between = [&](std::size_t i, std::size_t k) {
      return Node{0.5 * (face[i].at + face[k].at), 0.5 * (face[i].value + face[k].value)};
    };
    const std::array<Node, 3> middles = {between(1, 2), between(0, 2), between(0, 1)};
    std::vector<std::vector<Node>> parts = {{middles[0], middles[1], middles[2]}};
    for (std::size_t i = 0; i < 3; ++i) parts.push_back({face[i], middles[(i + 1) % 3], middles[(i + 2) % 3]});
    return have_no_zero_within(parts, cuts - 1);
  }

  Nodes nodes_of(const std::array<int, 4>& corners) const {
    Nodes nodes;
    for (std::size_t i = 0; i < 4; ++i) nodes[i] = nodes_[static_cast<std::size_t>(corners[i])];
    return nodes;
  }

  /// Of a tetrahedron before its corners were moved: on the lattice, exactly.
  static int orientation(const Tetrahedra& all, const std::array<int, 4>& corners) {
    const auto way = [&](std::size_t to) {
      std::array<std::int64_t, 3> result{};
      for (std::size_t k = 0; k < 3; ++k)
        result[k] = all.corners[static_cast<std::size_t>(corners[to])][k] -
                    all.corners[static_cast<std::size_t>(corners[0])][k];
      return result;
    };
    const auto a = way(1), b = way(2), c = way(3);
    const std::int64_t volume =
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    return volume > 0 ? 1 : volume < 0 ? -1 : 0;
  }

  /// The parts of a tetrahedron for which f over a box that holds it does not do. False: one is not regular.
  bool find_doubts(const std::array<int, 4>& corners, const std::vector<Field::Over>& over, int orientation,
                   std::vector<Doubt>& doubts) const {
    std::vector<Nodes> pieces = {nodes_of(corners)};
    const std::optional<std::vector<int>> crossings = crossings_of(corners);
    if (!crossings) return lies_beyond(corners);
    for (const int crossing : *crossings) cut(pieces, complex_.crossings[static_cast<std::size_t>(crossing)]);
    for (const Nodes& piece : pieces) {
      const Slope g = slope_of(piece);
      for (TetrahedronPart& part : parts_of(piece))
        if (!is_regular(part, g, over, orientation)) doubts.push_back({std::move(part), g, orientation});
    }
    return true;
  }

  /// With f over their own boxes: first, where f and g have one sign, its value alone.
  bool are_regular(const std::vector<Doubt>& doubts) {
    std::vector<Box> boxes;
    std::vector<int> signs;
    for (const Doubt& doubt : doubts)
      if (const int sign = sign_of(doubt.part.nodes); sign != 0) {
        boxes.push_back(surface::box_of(doubt.part.nodes));
        signs.push_back(sign);
      }
    const std::vector<bool> kept = field_.keeps_signs(boxes, signs);
    std::vector<const Doubt*> open;
    std::size_t next = 0;
    for (const Doubt& doubt : doubts)
      if (sign_of(doubt.part.nodes) == 0 || !kept[next++]) open.push_back(&doubt);
    return are_regular_by_slopes(open);
  }

  bool are_regular_by_slopes(const std::vector<const Doubt*>& doubts) {
    for (std::size_t first = 0; first < doubts.size(); first += side_by_side) {
      std::vector<Box> boxes;
      std::vector<int> signs;
      for (std::size_t k = first; k < std::min(doubts.size(), first + side_by_side); ++k) {
        boxes.push_back(surface::box_of(doubts[k]->part.nodes));
        signs.push_back(sign_of(doubts[k]->part.nodes));
      }
      const std::vector<std::vector<Field::Over>> closer = field_.over(boxes, signs);
      for (std::size_t k = 0; k < closer.size(); ++k) {
        const Doubt& doubt = *doubts[first + k];
        if (!is_regular(doubt.part, doubt.g, closer[k], doubt.orientation)) return false;
      }
    }
    return true;
  }

  /// In cells free of zeros beside moved corners the surface may go on beyond the boundary, though it is not meshed.
  bool lies_beyond(const std::array<int, 4>& corners) const {
    const std::vector<Field::Over> over = field_.over(surface::box_of(nodes_of(corners)));
    return std::all_of(over.begin(), over.end(), is_beyond_the_boundary);
  }

  /// Of its edges, ascending: tetrahedra that share a face then cut it alike. Nothing where the marcher knows of none.
  std::optional<std::vector<int>> crossings_of(const std::array<int, 4>& corners) const {
    std::vector<int> result;
    const auto below = [&](std::size_t i) { return nodes_[static_cast<std::size_t>(corners[i])].value < 0; };
    const auto above = [&](std::size_t i) { return nodes_[static_cast<std::size_t>(corners[i])].value > 0; };
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = i + 1; k < 4; ++k) {
        if (!(below(i) && above(k)) && !(above(i) && below(k))) continue;
        const auto found = complex_.crossing_of.find(Complex::key(corners[i], corners[k]));
        if (found == complex_.crossing_of.end()) return std::nullopt;
        result.push_back(found->second);
      }
    std::sort(result.begin(), result.end());
    return result;
  }

  /// Cuts every piece that has the crossing's edge in two.
  void cut(std::vector<Nodes>& pieces, const Complex::Crossing& crossing) const {
    const Point& a = nodes_[static_cast<std::size_t>(crossing.a)].at;
    const Point& b = nodes_[static_cast<std::size_t>(crossing.b)].at;
    const std::size_t before = pieces.size();
    for (std::size_t p = 0; p < before; ++p) {
      const auto place_of = [&](const Point& at) {
        std::size_t i = 0;
        while (i < 4 && pieces[p][i].at != at) ++i;
        return i;
      };
      const std::size_t from = place_of(a), to = place_of(b);
      if (from == 4 || to == 4) continue;
      Nodes other = pieces[p];
      pieces[p][from] = other[to] = {crossing.at, 0};
      pieces.push_back(other);
    }
  }

  Field& field_;
  const Cells& cells_;
  Complex complex_;
  std::vector<Node> nodes_;
  int examined_ = 0;
};

}  // namespace

std::vector<int> unproven(Field& field, const Cells& cells, Complex complex, const std::function<bool()>& stop) {
  return Homotopy(field, cells, std::move(complex)).run(stop);
}

std::vector<std::vector<int>> groups_of(const Cells& cells, const std::vector<int>& leaves) {
  std::vector<std::vector<int>> groups;
  std::vector<bool> taken(leaves.size(), false);
  const auto position = [&](int leaf) {
    const auto found = std::lower_bound(leaves.begin(), leaves.end(), leaf);
    return found != leaves.end() && *found == leaf ? found - leaves.begin() : std::ptrdiff_t{-1};
  };
  for (std::size_t first = 0; first < leaves.size(); ++first) {
    if (taken[first]) continue;
    std::vector<int> group = {leaves[first]};
    taken[first] = true;
    for (std::size_t i = 0; i < group.size(); ++i)
      cells.each_neighbour(group[i], [&](int neighbour) {
        const std::ptrdiff_t place = position(neighbour);
        if (place < 0 || taken[static_cast<std::size_t>(place)]) return;
        taken[static_cast<std::size_t>(place)] = true;
        group.push_back(neighbour);
      });
    std::sort(group.begin(), group.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace clearloci::loci::surface
