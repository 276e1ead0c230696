// The pose of a drawing: least squares by Gauss and Newton.
#include <cmath>

#include "mechanism/assembly/drawn_pose.hpp"
#include "mechanism/dependence.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;

double distance_between(const std::array<double, 3>& p, const std::array<double, 3>& q) {
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

class PoseOfDrawing {
 public:
  PoseOfDrawing(Drawing& drawing, const CoordinateReader& coordinates) : drawing_(drawing), coordinates_(coordinates) {}

  std::vector<double> run() {
    Mechanism as_built = drawing_.mechanism;
    std::vector<std::size_t> both;
    for (std::size_t p = 0; p < drawing_.points.size(); ++p) {
      if (!drawing_.points[p].built || !drawing_.points[p].is_exact) continue;
      Value form{drawing_.points[p].form, "point " + as_built.points[p].name, drawing_.points[p].form.where(),
                 "points"};
      if (!form.is_sequence() && !form.node.has("in")) continue;
      PointForm point_form = read_point_form(drawing_.mechanism, form);
      if (!std::holds_alternative<ExplicitPoint>(point_form)) continue;
      as_built.points[p].form = std::move(point_form);
      drawing_.points[p].held = true;
      drawing_.points[p].moves = !coordinates_of(as_built, static_cast<PointIndex>(p)).empty();
      if (drawing_.points[p].moves) both.push_back(p);
    }
    std::vector<double> middle = spread_poses(as_built, 1).front();
    const bool all_placed = put_drawn_places(middle);
    if (both.empty()) {
      if (all_placed)
        for (DrawnPoint& point : drawing_.points) point.has_place = true;
      return middle;
    }
    std::vector<double> best;
    double least = 0;
    for (std::vector<double> pose : spread_poses(as_built, 8)) {
      (void)put_drawn_places(pose);
      const double off = fit(as_built, both, pose);
      if (best.empty() || off < least) best = std::move(pose), least = off;
    }
    check_fit(as_built, both, best);
    for (DrawnPoint& point : drawing_.points) point.has_place = true;
    return best;
  }

 private:
  /// Coordinates that are the place of a drawn point; returns whether all of them are.
  bool put_drawn_places(std::vector<double>& pose) const {
    bool all = true;
    const auto& points = drawing_.mechanism.points;
    for (std::size_t c = 0; c < drawing_.coordinates.size() && c < pose.size(); ++c) {
      bool found = false;
      if (const auto place = coordinates_.place_of(c)) {
        const std::size_t axis = CoordinateReader::axis_of(place->first);
        for (const Point& point : points) {
          const auto* form = std::get_if<ExplicitPoint>(&point.form);
          if (point.name != place->second || form == nullptr || axis >= form->coordinates.size()) continue;
          pose[c] = core::to_double(value_of(form->coordinates[axis], drawing_.mechanism));
          found = true;
        }
      }
      all = all && found;
    }
    return all;
  }

  using Places = std::vector<double>;
  /// Drawn places minus those of the constructions.
  Places offsets(const Mechanism& as_built, const std::vector<std::size_t>& both,
                 const std::vector<double>& pose) const {
    const auto built = sample_points(as_built, pose), drawn = sample_points(drawing_.mechanism, pose);
    Places all;
    for (const std::size_t p : both)
      for (std::size_t i = 0; i < 3; ++i) all.push_back((*drawn[p])[i] - (*built[p])[i]);
    return all;
  }

  double fit(const Mechanism& as_built, const std::vector<std::size_t>& both, std::vector<double>& pose) const {
    constexpr int steps = 40;
    constexpr double difference = 1e-6;  // m and rad: of a quotient that only points the way
    const std::size_t n = pose.size();
    const auto square = [](const Places& places) {
      double sum = 0;
      for (const double part : places) sum += part * part;
      return sum;
    };
    double off = square(offsets(as_built, both, pose));
    for (int step = 0; step < steps && off > 0; ++step) {
      const Places now = offsets(as_built, both, pose);
      std::vector<Places> slopes;
      for (std::size_t c = 0; c < n; ++c) {
        std::vector<double> near = pose;
        near[c] += difference;
        slopes.push_back(offsets(as_built, both, near));
        for (std::size_t r = 0; r < now.size(); ++r) slopes[c][r] = (now[r] - slopes[c][r]) / difference;
      }
      Matrix a(n, std::vector<double>(n + 1));
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j)
          for (std::size_t r = 0; r < now.size(); ++r) a[i][j] += slopes[i][r] * slopes[j][r];
        for (std::size_t r = 0; r < now.size(); ++r) a[i][n] += slopes[i][r] * now[r];
        a[i][i] += 1e-14;  // coordinates that move none of these points stay
      }
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < n; ++i) {
          if (i == k || a[k][k] == 0) continue;
          const double factor = a[i][k] / a[k][k];
          for (std::size_t j = k; j <= n; ++j) a[i][j] -= factor * a[k][j];
        }
      std::vector<double> next = pose;
      for (std::size_t k = 0; k < n; ++k)
        if (a[k][k] != 0) next[k] += a[k][n] / a[k][k];
      const double then = square(offsets(as_built, both, next));
      if (!(then < off)) break;
      pose = std::move(next);
      off = then;
    }
    return off;
  }

  void check_fit(const Mechanism& as_built, const std::vector<std::size_t>& both,
                 const std::vector<double>& pose) const {
    const auto built = sample_points(as_built, pose), drawn = sample_points(drawing_.mechanism, pose);
    double size = 0;
    for (const auto& p : drawn)
      for (const auto& q : drawn)
        if (p && q) size = std::max(size, distance_between(*p, *q));
    for (const std::size_t p : both)
      if (distance_between(*built[p], *drawn[p]) > 1e-6 * size)
        throw InputError(as_built.points[p].where,
                         "point " + as_built.points[p].name + " is not drawn where its construction can put it",
                         "correct one of them, or leave it out of drawn or points");
  }

  Drawing& drawing_;
  const CoordinateReader& coordinates_;
};

}  // namespace

std::vector<double> pose_of_drawing(Drawing& drawing, const CoordinateReader& coordinates) {
  return PoseOfDrawing(drawing, coordinates).run();
}

}  // namespace clearloci::mechanism
