#include "loci/surfaces/march.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

namespace clearloci::loci::surface {
namespace {

/// A corner is moved onto a crossing within this part of the edge between.
constexpr double near_corner = 0.22;
/// Rounds of giving corners back their places where moving them made the surface meet itself.
constexpr int most_repairs = 8;

/// Illinois' rule between two points where a function has two signs.
class SignChange {
 public:
  SignChange(const Point& from, const Point& to, double at_from, double at_to)
      : from_(from), way_(to - from), at_low_(at_from), at_high_(at_to) {}

  /// Where the value is to be known next. Required: not done.
  Point next() {
    const double before = part_;
    part_ = halve_ ? 0.5 * (low_ + high_) : low_ + (high_ - low_) * (at_low_ / (at_low_ - at_high_));
    // Two estimates alike are no proof: next to the workspace boundary the slope is unbounded. The sign behind is.
    settled_ = std::abs(part_ - before) < enough;
    if (settled_) part_ += part_ < 0.5 * (low_ + high_) ? enough : -enough;
    if (!(part_ > low_ && part_ < high_)) part_ = 0.5 * (low_ + high_);
    return place();
  }

  void learn(double value) {
    if (value == 0) {
      done_ = true;
      return;
    }
    halve_ = settled_ || step_ % 8 == 7;
    if ((value < 0) == (at_low_ < 0)) {
      low_ = part_;
      at_low_ = value;
      at_high_ *= 0.5;
    } else {
      high_ = part_;
      at_high_ = value;
      at_low_ *= 0.5;
    }
    done_ = ++step_ == most || high_ - low_ <= enough;
    if (done_) part_ = 0.5 * (low_ + high_);
  }

  bool done() const { return done_; }
  double part() const { return part_; }
  Point place() const { return from_ + part_ * way_; }

 private:
  static constexpr double enough = 1e-12;  // of the way
  static constexpr int most = 100;         // steps

  Point from_, way_;
  double low_ = 0, high_ = 1, at_low_, at_high_, part_ = 0;
  bool halve_ = false, settled_ = false, done_ = false;
  int step_ = 0;
};

class Marcher {
 public:
  Marcher(Field& field, const Cells& cells) : field_(field), cells_(cells), cut_(tetrahedra_of(cells)) {
    std::vector<Point> points;
    for (const LatticePlace& place : cut_.corners) points.push_back(unit_of(place));
    const std::vector<double> values = field_.values(points);
    for (std::size_t i = 0; i < points.size(); ++i) corners_.emplace_back(points[i], values[i]);
  }

  Marched run() {
    find_crossings();
    move_corners();
    Mesh mesh = triangles();
    for (int round = 0; round < most_repairs && repair(mesh); ++round) mesh = triangles();
    return {compact(mesh), {std::move(cut_), std::move(corners_), std::move(crossings_), std::move(crossing_of_)}};
  }

 private:
  using Corner = Complex::Corner;
  using Crossing = Complex::Crossing;

  Corner& corner(int i) { return corners_[static_cast<std::size_t>(i)]; }

  int crossing(int a, int b) {
    const auto [found, fresh] = crossing_of_.try_emplace(Complex::key(a, b), static_cast<int>(crossings_.size()));
    if (fresh) crossings_.push_back({std::min(a, b), std::max(a, b)});
    return found->second;
  }

  /// Places the crossings that are new, all of them side by side.
  void place_crossings() {
    std::vector<SignChange> searches;
    std::vector<std::size_t> active;
    for (std::size_t c = placed_; c < crossings_.size(); ++c) {
      const auto a = static_cast<std::size_t>(crossings_[c].a), b = static_cast<std::size_t>(crossings_[c].b);
      active.push_back(searches.size());
      searches.emplace_back(unit_of(cut_.corners[a]), unit_of(cut_.corners[b]), corners_[a].value, corners_[b].value);
    }
    while (!active.empty()) {
      std::vector<Point> points;
      for (const std::size_t search : active) points.push_back(searches[search].next());
      const std::vector<double> values = field_.values(points);
      for (std::size_t k = 0; k < active.size(); ++k) searches[active[k]].learn(values[k]);
      std::erase_if(active, [&](std::size_t search) { return searches[search].done(); });
    }
    for (const SignChange& search : searches) {
      Crossing& crossing = crossings_[placed_++];
      crossing.part = search.part();
      crossing.at = search.place();
    }
  }

  void find_crossings() {
    for (const auto& t : cut_.tetrahedra)
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = i + 1; k < 4; ++k)
          if (corner(t[i]).sign * corner(t[k]).sign < 0) crossing(t[i], t[k]);
    place_crossings();
  }

  /// Faces of the cube that hold a must hold b: a then stays in them on its way to b.
  bool may_move_towards(int a, int b) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t corner = cut_.corners[static_cast<std::size_t>(a)][i];
      if ((corner == 0 || corner == lattice) && cut_.corners[static_cast<std::size_t>(b)][i] != corner) return false;
    }
    return true;
  }

  /// Cells outside the workspace are not cut, though the surface goes on in them: a corner of theirs that moved would
  /// take a piece of the surface away.
  bool touches_outside(const LatticePlace& place) const {
    bool result = false;
    cells_.each_leaf_at(
        place, [&](int leaf) { result = result || cells_.cells()[static_cast<std::size_t>(leaf)].proof.outside; });
    return result;
  }

  void move_corners() {
    std::vector<int> nearest(corners_.size(), -1);
    std::vector<double> least(corners_.size(), near_corner);
    for (std::size_t c = 0; c < crossings_.size(); ++c) {
      const Crossing& crossing = crossings_[c];
      const auto offer = [&](int moved_corner, int other, double part) {
        const auto i = static_cast<std::size_t>(moved_corner);
        if (part >= least[i] || !may_move_towards(moved_corner, other)) return;
        least[i] = part;
        nearest[i] = static_cast<int>(c);
      };
      offer(crossing.a, crossing.b, crossing.part);
      offer(crossing.b, crossing.a, 1 - crossing.part);
    }
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (nearest[i] < 0 || touches_outside(cut_.corners[i])) continue;
      corners_[i].at = crossings_[static_cast<std::size_t>(nearest[i])].at;
      corners_[i].sign = 0;
    }
    // A tetrahedron needs a corner off the surface.
    for (const auto& t : cut_.tetrahedra)
      if (std::all_of(t.begin(), t.end(), [&](int c) { return corner(c).sign == 0; })) put_back(t[0]);
  }

  void put_back(int c) {
    Corner& corner_data = corner(c);
    corner_data.at = unit_of(cut_.corners[static_cast<std::size_t>(c)]);
    corner_data.sign = corner_data.value < 0 ? -1 : 1;
    corner_data.stays = true;
  }

  Mesh triangles() {
    mesh_ = {};
    point_of_corner_.assign(corners_.size(), -1);
    point_of_crossing_.assign(crossings_.size(), -1);
    corner_of_point_.clear();
    flat_.clear();
    for (const auto& t : cut_.tetrahedra) add(t);
    for (const auto& [face, sides] : flat_) add_flat(face, sides);
    return std::move(mesh_);
  }

  int point_at_corner(int c) {
    int& point = point_of_corner_[static_cast<std::size_t>(c)];
    if (point < 0) point = add_point(corner(c).at, c);
    return point;
  }

  int point_at_crossing(int a, int b) {
    const auto c = static_cast<std::size_t>(crossing(a, b));
    place_crossings();
    if (point_of_crossing_.size() <= c) point_of_crossing_.resize(c + 1, -1);
    if (point_of_crossing_[c] < 0) point_of_crossing_[c] = add_point(crossings_[c].at, -1);
    return point_of_crossing_[c];
  }

  int add_point(const Point& at, int of_corner) {
    mesh_.points.push_back(at);
    corner_of_point_.push_back(of_corner);
    return static_cast<int>(mesh_.points.size()) - 1;
  }

  void add(const std::array<int, 4>& t) {
    std::vector<int> zero, positive, negative;
    for (const int c : t) (corner(c).sign == 0 ? zero : corner(c).sign > 0 ? positive : negative).push_back(c);
    if (zero.size() == 3) {
      std::sort(zero.begin(), zero.end());
      auto& sides = flat_[{zero[0], zero[1], zero[2]}];
      (positive.empty() ? sides[0] : sides[1]) = positive.empty() ? negative[0] : positive[0];
      return;
    }
    if (positive.empty() || negative.empty()) return;
    const int above = positive[0];
    std::vector<int> polygon;
    for (const int c : zero) polygon.push_back(point_at_corner(c));
    if (positive.size() == 2 && negative.size() == 2) {
      for (const auto& [p, n] : {std::pair{0, 0}, {0, 1}, {1, 1}, {1, 0}})
        polygon.push_back(
            point_at_crossing(positive[static_cast<std::size_t>(p)], negative[static_cast<std::size_t>(n)]));
      const auto length = [&](int i, int k) {
        const Point way = mesh_.points[static_cast<std::size_t>(polygon[static_cast<std::size_t>(i)])] -
                          mesh_.points[static_cast<std::size_t>(polygon[static_cast<std::size_t>(k)])];
        return dot(way, way);
      };
      if (length(1, 3) < length(0, 2)) std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
      add_triangle({polygon[0], polygon[1], polygon[2]}, above);
      add_triangle({polygon[0], polygon[2], polygon[3]}, above);
      return;
    }
    for (const int p : positive)
      for (const int n : negative) polygon.push_back(point_at_crossing(p, n));
    add_triangle({polygon[0], polygon[1], polygon[2]}, above);
  }

  /// A face whose corners all lie on the surface, between a tetrahedron below and one above; -1 in `sides` where there
  /// is none: then the function decides beyond it.
  void add_flat(const std::array<int, 3>& face, const std::array<int, 2>& sides) {
    const Point a = corner(face[0]).at, b = corner(face[1]).at, c = corner(face[2]).at;
    if (sides[0] < 0 || sides[1] < 0) {
      const int side = sides[0] < 0 ? sides[1] : sides[0];
      const Point middle = 1.0 / 3 * (a + b + c);
      const Point beyond = middle - 0.1 * (corner(side).at - middle);
      for (const double coordinate : beyond)
        if (coordinate < 0 || coordinate > 1) return;
      if ((field_.value(beyond) < 0 ? -1 : 1) == corner(side).sign) return;
    }
    const Triangle triangle = {point_at_corner(face[0]), point_at_corner(face[1]), point_at_corner(face[2])};
    if (sides[1] >= 0)
      add_triangle(triangle, sides[1]);
    else
      add_triangle(triangle, sides[0], -1);
  }

  /// `above`: a corner where the function has the sign.
  void add_triangle(Triangle t, int above, int sign = 1) {
    const auto at = [&](int i) { return mesh_.points[static_cast<std::size_t>(t[static_cast<std::size_t>(i)])]; };
    const Point normal = cross(at(1) - at(0), at(2) - at(0));
    if (sign * dot(normal, corner(above).at - at(0)) < 0) std::swap(t[1], t[2]);
    mesh_.triangles.push_back(t);
  }

  /// Puts back corners at edges of more than two triangles. False: there are none.
  bool repair(const Mesh& mesh) {
    bool any = false;
    for (const MeshEdge& edge : edges_of(mesh)) {
      if (edge.triangles <= 2) continue;
      for (const int point : {edge.from, edge.to}) {
        const int corner_index = corner_of_point_[static_cast<std::size_t>(point)];
        if (corner_index < 0 || corner(corner_index).stays) continue;
        put_back(corner_index);
        any = true;
      }
    }
    return any;
  }

  Field& field_;
  const Cells& cells_;
  Tetrahedra cut_;
  std::vector<Corner> corners_;
  std::vector<Crossing> crossings_;
  std::size_t placed_ = 0;  ///< of the crossings
  std::unordered_map<std::uint64_t, int> crossing_of_;
  Mesh mesh_;
  std::vector<int> point_of_corner_, point_of_crossing_, corner_of_point_;
  struct Sides : std::array<int, 2> {
    Sides() : std::array<int, 2>{-1, -1} {}
  };
  std::map<std::array<int, 3>, Sides> flat_;  ///< a corner below and one above
};

}  // namespace

Marched march(Field& field, const Cells& cells) { return Marcher(field, cells).run(); }

}  // namespace clearloci::loci::surface
