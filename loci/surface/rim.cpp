#include "loci/surface/rim.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace clearloci::loci::surface {
namespace {

/// Relative to the size of Q_j on the box: rounding, with room.
constexpr double rounding = 1e-11;
/// A point is moved onto the rim within this part of the edge that crosses it.
constexpr double near_point = 0.25;

/// A size of Q_j over the box.
double size_of_square(Field& field, int root) {
  double size = 0;
  for (const double x : {0.1, 0.35, 0.6, 0.85})
    for (const double y : {0.15, 0.4, 0.65, 0.9})
      for (const double z : {0.05, 0.3, 0.55, 0.8}) size = std::max(size, std::abs(field.square({x, y, z}, root)));
  return size;
}

class Clipper {
 public:
  Clipper(Field& field, Mesh mesh, int root) : field_(field), mesh_(std::move(mesh)), root_(root) {
    const double none = rounding * size_of_square(field, root);
    for (const Point& point : mesh_.points) {
      const double square = field.square(point, root);
      sign_.push_back(square < -none ? -1 : square > none ? 1 : 0);
    }
  }

  Mesh run() {
    if (std::none_of(sign_.begin(), sign_.end(), [](int sign) { return sign < 0; })) return std::move(mesh_);
    move_points();
    Mesh result;
    const std::vector<Triangle> before = std::move(mesh_.triangles);
    for (const Triangle& triangle : before) add(triangle, result.triangles);
    result.points = std::move(mesh_.points);
    return compact(result);
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
    const auto [known, fresh] = cuts_.try_emplace(static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint64_t>(b));
    if (fresh) {
      Cut& own = known->second;
      own.at = solve(at(a), at(b));
      const Point way = at(b) - at(a);
      own.part = std::clamp(dot(own.at - at(a), way) / std::max(dot(way, way), 1e-300), 0.0, 1.0);
    }
    return known->second;
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
      const Cut own = cut(edge.from, edge.to);
      const auto offer = [&](int i, double part) {
        const auto place = static_cast<std::size_t>(i);
        if (part >= least[place] || !same_faces(at(i), own.at)) return;
        least[place] = part;
        target[place] = own.at;
      };
      offer(edge.from, own.part);
      offer(edge.to, 1 - own.part);
    }
    for (std::size_t i = 0; i < target.size(); ++i)
      if (least[i] < near_point) sign_[i] = 0;
    mesh_.points = std::move(target);
  }

  int point_at(int a, int b) {
    Cut& own = cut(a, b);
    if (own.point < 0) {
      own.point = static_cast<int>(mesh_.points.size());
      mesh_.points.push_back(own.at);
    }
    return own.point;
  }

  /// The part of a triangle on the side of Q_j >= 0.
  void add(const Triangle& t, std::vector<Triangle>& kept) {
    const int inside = static_cast<int>(std::count_if(t.begin(), t.end(), [&](int i) { return sign(i) > 0; }));
    const int outside = static_cast<int>(std::count_if(t.begin(), t.end(), [&](int i) { return sign(i) < 0; }));
    if (outside == 0 && inside > 0) kept.push_back(t);
    if (outside == 0 || inside == 0) return;
    std::vector<int> polygon;
    for (std::size_t i = 0; i < 3; ++i) {
      const int own = t[i], next = t[(i + 1) % 3];
      if (sign(own) >= 0) polygon.push_back(own);
      if (sign(own) * sign(next) < 0) polygon.push_back(point_at(own, next));
    }
    for (std::size_t i = 2; i < polygon.size(); ++i) kept.push_back({polygon[0], polygon[i - 1], polygon[i]});
  }

  Field& field_;
  Mesh mesh_;
  int root_;
  std::vector<int> sign_;  ///< of Q_j at the points
  std::unordered_map<std::uint64_t, Cut> cuts_;
};

}  // namespace

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

Mesh within_workspace(Field& field, Mesh mesh, std::optional<int> boundary) {
  for (int root = 0; root < field.roots(); ++root)
    if (root != boundary) mesh = Clipper(field, std::move(mesh), root).run();
  return mesh;
}

}  // namespace clearloci::loci::surface
