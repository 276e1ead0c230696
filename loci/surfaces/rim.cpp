#include "loci/surfaces/rim.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace clearloci::loci::surface {
namespace {

using core::Interval;

/// Relative to the size of Q_j on the box: rounding, with room.
constexpr double rounding = 1e-11;
/// A point is moved onto the rim within this part of the edge that crosses it.
constexpr double near_point = 0.25;
/// Triangles looked at side by side.
constexpr std::size_t taken_together = 64;

/// A size of Q_j over the box.
double size_of_square(Field& field, int root) {
  double size = 0;
  for (const double x : {0.1, 0.35, 0.6, 0.85})
    for (const double y : {0.15, 0.4, 0.65, 0.9})
      for (const double z : {0.05, 0.3, 0.55, 0.8}) size = std::max(size, std::abs(field.square({x, y, z}, root)));
  return size;
}

}  // namespace

class Clipping::Clipper {
 public:
  Clipper(Field& field, Mesh mesh, int root) : field_(field), mesh_(std::move(mesh)), root_(root) {
    const double none = rounding * size_of_square(field, root);
    for (const double square : field.squares(mesh_.points, root))
      sign_.push_back(square < -none ? -1 : square > none ? 1 : 0);
  }

  /// The mesh cut off.
  Mesh run() {
    before_ = mesh_.points;
    if (std::none_of(sign_.begin(), sign_.end(), [](int sign) { return sign < 0; })) return mesh_;
    move_points();
    Mesh result;
    for (const Triangle& triangle : mesh_.triangles) add(triangle, result.triangles);
    result.points = mesh_.points;
    return compact(result);
  }

  /// Gets a point of every triangle that is. Required: it has been run.
  void find_unproven(std::vector<Point>& unproven) {
    std::vector<Way> ways;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      ways.push_back(way_of(mesh_.triangles[t]));
      if (ways.size() < taken_together && t + 1 < mesh_.triangles.size()) continue;
      find_unproven(ways, unproven);
      ways.clear();
    }
  }

 private:
  struct Cut {
    Point at{};
    double part = 0;  ///< of the way from the smaller point
    int point = -1;
  };

  int sign(int i) const { return sign_[static_cast<std::size_t>(i)]; }
  const Point& at(int i) const { return mesh_.points[static_cast<std::size_t>(i)]; }

  Cut& cut(int a, int b) {
    if (a > b) std::swap(a, b);
    const auto [found, fresh] = cuts_.try_emplace(static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint64_t>(b));
    if (fresh) {
      Cut& cut = found->second;
      cut.at = solve(at(a), at(b));
      const Point way = at(b) - at(a);
      cut.part = std::clamp(dot(cut.at - at(a), way) / std::max(dot(way, way), 1e-300), 0.0, 1.0);
    }
    return found->second;
  }

  Point solve(const Point& a, const Point& b) {
    for (const double part : {0.5, 0.85, 0.15})
      if (const std::optional<Point> found = newton(a, b, a + part * (b - a))) return *found;
    return halved(a, b);
  }

  /// Newton's method of least moves for f = 0, Q_j = 0, with s_j at 0 in f: both are smooth there. Nothing where it
  /// does not end near the edge.
  std::optional<Point> newton(const Point& a, const Point& b, Point point) {
    const Point way = b - a;
    const double most = 4 * dot(way, way);
    std::array<bool, 3> held{};
    for (std::size_t i = 0; i < 3; ++i) held[i] = a[i] == b[i] && (a[i] == 0 || a[i] == 1);
    constexpr int steps = 30;
    constexpr double enough = 1e-13;
    for (int step = 0; step < steps; ++step) {
      Point f_slopes{}, q_slopes{};
      const double f = field_.gradient_on_rim(point, root_, f_slopes);
      const double q = field_.square_gradient(point, root_, q_slopes);
      for (std::size_t i = 0; i < 3; ++i)
        if (held[i]) f_slopes[i] = q_slopes[i] = 0;
      const double ff = dot(f_slopes, f_slopes), fq = dot(f_slopes, q_slopes), qq = dot(q_slopes, q_slopes);
      const double determinant = ff * qq - fq * fq;
      if (!(determinant > 1e-14 * ff * qq)) return std::nullopt;
      const Point move = (fq * q - qq * f) / determinant * f_slopes + (fq * f - ff * q) / determinant * q_slopes;
      point = point + move;
      if (!(dot(point - a, point - a) < most)) return std::nullopt;
      for (std::size_t i = 0; i < 3; ++i) {
        if (point[i] >= 0 && point[i] <= 1) continue;
        point[i] = std::clamp(point[i], 0.0, 1.0);
        held[i] = true;
      }
      if (dot(move, move) < enough * enough) return point;
    }
    return std::nullopt;
  }

  /// The place on the edge itself where Q_j = 0.
  Point halved(Point a, Point b) {
    if (field_.square(a, root_) < 0) std::swap(a, b);
    for (int step = 0; step < 50; ++step) {
      const Point middle = 0.5 * (a + b);
      (field_.square(middle, root_) >= 0 ? a : b) = middle;
    }
    return a;
  }

  static bool same_faces(const Point& a, const Point& b) {
    for (std::size_t i = 0; i < 3; ++i)
      if ((a[i] == 0 || a[i] == 1) && b[i] != a[i]) return false;
    return true;
  }

  /// Points next to the rim go onto it.
  void move_points() {
    std::vector<double> least(mesh_.points.size(), near_point);
    std::vector<Point> target = mesh_.points;
    for (const MeshEdge& edge : edges_of(mesh_)) {
      if (sign(edge.from) * sign(edge.to) >= 0) continue;
      const Cut edge_cut = cut(edge.from, edge.to);
      const auto offer = [&](int i, double part) {
        const auto place = static_cast<std::size_t>(i);
        if (part >= least[place] || !same_faces(at(i), edge_cut.at)) return;
        least[place] = part;
        target[place] = edge_cut.at;
      };
      offer(edge.from, edge_cut.part);
      offer(edge.to, 1 - edge_cut.part);
    }
    for (std::size_t i = 0; i < target.size(); ++i)
      if (least[i] < near_point) sign_[i] = 0;
    mesh_.points = std::move(target);
  }

  int point_at(int a, int b) {
    Cut& edge_cut = cut(a, b);
    if (edge_cut.point < 0) {
      edge_cut.point = static_cast<int>(mesh_.points.size());
      mesh_.points.push_back(edge_cut.at);
    }
    return edge_cut.point;
  }

  /// A vertex, or where the rim crosses an edge: before and after it was moved onto the rim.
  struct Moved {
    Point from{}, to{};

    bool operator==(const Moved&) const = default;
  };

  Moved moved(int i) const { return {before_[static_cast<std::size_t>(i)], at(i)}; }
  Moved moved_cut(int a, int b) {
    const Cut& edge_cut = cut(a, b);
    const Point &from = at(std::min(a, b)), &to = at(std::max(a, b));
    return {from + edge_cut.part * (to - from), edge_cut.at};
  }

  /// What a triangle is cut into, the parts on either side, in its own orientation.
  std::vector<std::array<Moved, 3>> parts_of(const Triangle& t) {
    std::vector<std::array<Moved, 3>> result;
    for (const int side : {1, -1}) {
      std::vector<Moved> polygon;
      bool any = false;
      for (std::size_t i = 0; i < 3; ++i) {
        const int corner = t[i], next = t[(i + 1) % 3];
        if (side * sign(corner) >= 0) polygon.push_back(moved(corner));
        any = any || side * sign(corner) > 0;
        if (sign(corner) * sign(next) < 0) polygon.push_back(moved_cut(corner, next));
      }
      for (std::size_t i = 2; any && i < polygon.size(); ++i)
        result.push_back({polygon[0], polygon[i - 1], polygon[i]});
    }
    return result;
  }

  /// A triangle, what it is cut into, and a box round it all the way.
  struct Way {
    Triangle triangle{};
    std::vector<std::array<Moved, 3>> parts;
    bool still = true;  ///< no corner moves
    Box box{};
  };

  Way way_of(const Triangle& t) {
    Way result{.triangle = t, .parts = parts_of(t)};
    result.box = box_of({moved(t[0]), moved(t[1]), moved(t[2])});
    for (const std::array<Moved, 3>& part : result.parts) {
      const Box box = box_of(part);
      for (std::size_t i = 0; i < 3; ++i) result.box[i] = hull(result.box[i], box[i]);
      result.still =
          result.still && std::all_of(part.begin(), part.end(), [](const Moved& m) { return m.from == m.to; });
    }
    return result;
  }

  bool all(const Triangle& t, int side) const {
    return std::all_of(t.begin(), t.end(), [&](int i) { return sign(i) == side; });
  }

  /// Triangles well within the workspace need no more than Q_j, the others the function and its slopes.
  void find_unproven(const std::vector<Way>& ways, std::vector<Point>& unproven) {
    const std::vector<Interval> squares = squares_over(ways);
    std::vector<const Way*> near;
    std::vector<Box> boxes;
    for (std::size_t k = 0; k < ways.size(); ++k) {
      const Way& way = ways[k];
      if (squares[k].lower() > 0 && way.still && all(way.triangle, 1)) continue;
      near.push_back(&way);
      boxes.push_back(way.box);
    }
    const std::vector<std::vector<Field::Over>> over = field_.over(boxes);
    for (std::size_t k = 0; k < near.size(); ++k)
      if (!is_proven(*near[k], over[k])) unproven.push_back(middle_of(mesh_, near[k]->triangle));
  }

  std::vector<Interval> squares_over(const std::vector<Way>& ways) {
    std::vector<Box> boxes;
    for (const Way& way : ways) boxes.push_back(way.box);
    return field_.squares_over(boxes, root_);
  }

  /// Whether the rim crosses a triangle as the signs of its corners say, and the triangle stays square enough to the
  /// slopes of the function while its corners move onto the rim.
  bool is_proven(const Way& way, const std::vector<Field::Over>& over) {
    const Triangle& t = way.triangle;
    return std::all_of(over.begin(), over.end(), [&](const Field::Over& f) {
      if (!f.known) return false;
      const Field::Clip* clip = nullptr;
      bool others = false;
      for (const Field::Clip& one : f.clips) {
        if (one.root == root_) {
          clip = &one;
          continue;
        }
        if (one.value.upper() < 0) return true;
        others = others || one.value.lower() <= 0;
      }
      if (clip == nullptr) return way.still && all(t, 1);
      if (way.still && clip->value.sign() != 0) return all(t, clip->value.sign());
      if (others || !ends_as_its_corners_say(t, *clip)) return false;
      return way.still || std::all_of(way.parts.begin(), way.parts.end(),
                                      [&](const std::array<Moved, 3>& part) { return stays_square(part, f); });
    });
  }

  static Box box_of(const std::array<Moved, 3>& part) {
    Box box;
    for (std::size_t i = 0; i < 3; ++i) {
      box[i] = Interval(part[0].from[i]);
      for (const Moved& moved : part) box[i] = hull(box[i], hull(Interval(moved.from[i]), Interval(moved.to[i])));
    }
    return box;
  }

  /// The side of the cube along an axis on which two points lie; both must have the same.
  static bool on_one_side(const Point& a, const Point& b, std::size_t axis) {
    return a[axis] == b[axis] && (a[axis] == 0 || a[axis] == 1);
  }

  /// Of the triangle before its corners were moved: the clip and the function that is linear in the triangle, with the
  /// signs that its corners have now, have slopes within a right angle of each other, in its edges on sides of the
  /// cube too. Their zeros are then isotopic.
  bool ends_as_its_corners_say(const Triangle& t, const Field::Clip& clip) {
    std::array<Point, 3> at;
    std::array<double, 3> value{};
    for (std::size_t i = 0; i < 3; ++i) {
      Point slopes{};
      at[i] = before_[static_cast<std::size_t>(t[i])];
      const double corner = clip.held ? field_.gradient_on_rim(at[i], root_, slopes) : field_.square(at[i], root_);
      value[i] = sign(t[i]) * std::max(std::abs(corner), std::numeric_limits<double>::min());
    }
    const Vector normal = cross_product(way(at[0], at[1]), way(at[0], at[2]));
    Vector rise{};  // across: of the corners' values times the edges opposite to them
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector edge = way(at[(i + 1) % 3], at[(i + 2) % 3]);
      for (std::size_t k = 0; k < 3; ++k) rise[k] = rise[k] + Interval(value[i]) * edge[k];
    }
    if (!(product(cross_product(normal, rise), clip.gradient).lower() > 0)) return false;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t next = (i + 1) % 3;
        if (!on_one_side(at[i], at[next], axis)) continue;
        const Interval rises = Interval(value[next]) - Interval(value[i]);
        if (!((rises * product(way(at[i], at[next]), clip.gradient)).lower() > 0)) return false;
      }
    return true;
  }

  /// While the corners move at even speed the triangle's normal is a square polynomial of the time, within the hull of
  /// its Bernstein coefficients: the function rises along all of them.
  static bool stays_square(const std::array<Moved, 3>& part, const Field::Over& f) {
    const Vector u0 = way(part[0].from, part[1].from), v0 = way(part[0].from, part[2].from);
    const Vector u1 = way(part[0].to, part[1].to), v1 = way(part[0].to, part[2].to);
    const Vector first = cross_product(u0, v0), last = cross_product(u1, v1), one = cross_product(u0, v1),
                 other = cross_product(u1, v0);
    Vector between;
    for (std::size_t k = 0; k < 3; ++k) between[k] = one[k] + other[k];  // twice the middle coefficient
    for (const Vector& normal : {first, between, last}) {
      if (!f.rises(normal)) return false;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const Moved &a = part[i], &b = part[(i + 1) % 3];
          if (!on_one_side(a.from, b.from, axis)) continue;
          Vector within = normal;
          within[axis] = Interval(0.0);
          if (!on_one_side(a.to, b.to, axis) || !f.rises(within)) return false;
        }
    }
    return true;
  }

  /// The part of a triangle on the side of Q_j >= 0.
  void add(const Triangle& t, std::vector<Triangle>& kept) {
    const int inside = static_cast<int>(std::count_if(t.begin(), t.end(), [&](int i) { return sign(i) > 0; }));
    const int outside = static_cast<int>(std::count_if(t.begin(), t.end(), [&](int i) { return sign(i) < 0; }));
    if (outside == 0 && inside > 0) kept.push_back(t);
    if (outside == 0 || inside == 0) return;
    std::vector<int> polygon;
    for (std::size_t i = 0; i < 3; ++i) {
      const int corner = t[i], next = t[(i + 1) % 3];
      if (sign(corner) >= 0) polygon.push_back(corner);
      if (sign(corner) * sign(next) < 0) polygon.push_back(point_at(corner, next));
    }
    for (std::size_t i = 2; i < polygon.size(); ++i) kept.push_back({polygon[0], polygon[i - 1], polygon[i]});
  }

  Field& field_;
  Mesh mesh_;
  int root_;
  std::vector<int> sign_;      ///< of Q_j at the points
  std::vector<Point> before_;  ///< the points before some were moved
  std::unordered_map<std::uint64_t, Cut> cuts_;
};

std::optional<int> boundary_of(Field& field, const Mesh& mesh) {
  if (mesh.points.empty()) return std::nullopt;
  for (int root = 0; root < field.roots(); ++root) {
    const double none = rounding * size_of_square(field, root);
    if (std::all_of(mesh.points.begin(), mesh.points.end(),
                    [&](const Point& point) { return std::abs(field.square(point, root)) <= none; }))
      return root;
  }
  return std::nullopt;
}

Clipping::Clipping(Field& field, Mesh mesh, std::optional<int> boundary) : mesh_(std::move(mesh)) {
  for (int root = 0; root < field.roots(); ++root) {
    if (root == boundary) continue;
    clippers_.push_back(std::make_unique<Clipper>(field, std::move(mesh_), root));
    mesh_ = clippers_.back()->run();
  }
}

Clipping::Clipping(Clipping&&) noexcept = default;
Clipping& Clipping::operator=(Clipping&&) noexcept = default;
Clipping::~Clipping() = default;

std::vector<Point> Clipping::unproven() {
  std::vector<Point> result;
  for (const auto& clipper : clippers_) clipper->find_unproven(result);
  return result;
}

}  // namespace clearloci::loci::surface
