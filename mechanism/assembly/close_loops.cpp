// Lengths that are given beat the drawing: Newton's method from the drawn posture on the places of the points, each
// step the shortest that solves the linear equations.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <queue>

#include "mechanism/assembly/drawing.hpp"
#include "mechanism/assembly/shape.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/posture_sample.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using PointAt = std::array<double, 3>;

double length_between(const PointAt& p, const PointAt& q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

/// A distance to keep, or where `along` is set a part of a point's way to keep: along . (p - start) = 0.
struct Kept {
  LinkIndex link = ground;
  std::size_t first = 0, second = 0;
  double length = 0;
  std::optional<PointAt> along = {};
};

class LoopClosure {
 public:
  explicit LoopClosure(Drawing& drawing) : d_(drawing), start_(drawing.posture), fixed_(fixed_points(drawing)) {
    for (std::size_t l = 0; l < d_.mechanism.links.size(); ++l) add_link(static_cast<LinkIndex>(l));
    for (const Joint& joint : d_.mechanism.joints) add_guide(joint);
    unknown_.assign(d_.points.size(), -1);
    for (std::size_t p = 0; p < d_.points.size(); ++p)
      if (!fixed_[p] && d_.points[p].has_place) unknown_[p] = static_cast<int>(unknowns_++);
  }

  void run() {
    constexpr int most_steps = 60;
    const double closed = 1e-12 * d_.size;
    for (int step = 0; step < most_steps && worst() > closed; ++step) advance();
    if (worst() > 1e-9 * d_.size) {
      settle();
      refuse();
    }
    note();
  }

 private:
  bool placed(PointIndex point) const { return d_.at(point).has_place; }

  void add_link(LinkIndex index) {
    const Link& link = d_.link(index);
    const std::vector<GivenLength>& given = d_.lengths[static_cast<std::size_t>(index)];
    for (const GivenLength& length : given)
      if (placed(length.first) && placed(length.second))
        kept_.push_back(
            {index, static_cast<std::size_t>(length.first), static_cast<std::size_t>(length.second), length.metres});
    // What is built on them keeps its drawn distances from points of given lengths: its construction puts it right.
    const auto keeps = [&](PointIndex a, PointIndex b) { return given.empty() || d_.at(a).built || d_.at(b).built; };
    const auto is_given = [&](PointIndex a, PointIndex b) {
      return std::any_of(given.begin(), given.end(), [&](const GivenLength& length) {
        return std::minmax(length.first, length.second) == std::minmax(a, b);
      });
    };
    constexpr std::size_t enough = 3;  // points from which the others are told, in space on one of two sides
    for (std::size_t i = 0; i < link.points.size(); ++i)
      for (std::size_t j = 0; j < std::min(i, enough); ++j)
        if (placed(link.points[i]) && placed(link.points[j]) && keeps(link.points[i], link.points[j]) &&
            !is_given(link.points[i], link.points[j]))
          kept_.push_back({index, static_cast<std::size_t>(link.points[j]), static_cast<std::size_t>(link.points[i]),
                           length_between(d_.place(link.points[i]), d_.place(link.points[j]))});
  }

  /// What slides along the ground stays on its line, what turns about an axis in its plane.
  void add_guide(const Joint& joint) {
    if ((joint.from != ground && joint.to != ground) || joint.axes.empty()) return;
    const bool in_slot = is_slot(d_.mechanism, joint);
    if (in_slot && joint.from != ground) return;
    const LinkIndex link = joint.from == ground ? joint.to : joint.from;
    const auto u = sample_vector(d_.mechanism, joint.axes.front(), spread_poses(d_.mechanism, 1).front());
    if (!u || link == ground) return;
    // Given lengths move the other points of a block across its guide.
    const bool is_drawn = d_.lengths[static_cast<std::size_t>(link)].empty();
    std::vector<PointAt> across;
    if (joint.type == JointType::prismatic || in_slot) {
      if (!d_.is_spatial())
        across = {{-(*u)[1], (*u)[0], 0}};
      else
        across = {{0, -(*u)[2], (*u)[1]}, {(*u)[2], 0, -(*u)[0]}, {-(*u)[1], (*u)[0], 0}};
    } else if (joint.type == JointType::revolute && d_.is_spatial()) {
      across = {*u};
    }
    for (const PointAt& v : across) {
      const double size = std::hypot(v[0], v[1], v[2]);
      if (!(size > 0)) continue;
      for (const PointIndex point : d_.link(link).points)
        if (point == joint.at || (is_drawn && !in_slot) || joint.type == JointType::revolute)
          kept_.push_back({link, static_cast<std::size_t>(point), static_cast<std::size_t>(point), 0,
                           PointAt{v[0] / size, v[1] / size, v[2] / size}});
    }
  }

  double residual(const Kept& kept) const {
    const PointAt &p = d_.posture[kept.first], &q = d_.posture[kept.second];
    if (!kept.along) return length_between(p, q) - kept.length;
    const PointAt &u = *kept.along, &from = start_[kept.first];
    return u[0] * (p[0] - from[0]) + u[1] * (p[1] - from[1]) + u[2] * (p[2] - from[2]);
  }

  double worst() const {
    double most = 0;
    for (const Kept& kept : kept_) most = std::max(most, std::abs(residual(kept)));
    return most;
  }

  /// Where the lengths do not close: the posture of least squares, by Levenberg's steps.
  void settle() {
    const auto squares = [&] {
      double sum = 0;
      for (const Kept& kept : kept_) sum += residual(kept) * residual(kept);
      return sum;
    };
    constexpr int most_steps = 300;
    double damping = 1e-3, sum = squares();
    for (int step = 0; step < most_steps && damping < 1e6; ++step) {
      const std::vector<PointAt> before = d_.posture;
      advance(damping);
      const double now = squares();
      if (now < sum) {
        sum = now;
        damping = std::max(damping / 3, 1e-6);
      } else {
        d_.posture = before;
        damping *= 10;
      }
    }
  }

  void advance(double damping = 1e-11) {
    const std::size_t rows = kept_.size(), columns = 3 * unknowns_;
    std::vector<std::vector<double>> jacobian(rows, std::vector<double>(columns));
    std::vector<double> right(rows);
    for (std::size_t r = 0; r < rows; ++r) {
      const Kept& kept = kept_[r];
      right[r] = -residual(kept);
      PointAt u = kept.along.value_or(PointAt{});
      if (!kept.along) {
        const PointAt &p = d_.posture[kept.first], &q = d_.posture[kept.second];
        const double now = length_between(p, q);
        if (!(now > 0)) continue;
        u = {(p[0] - q[0]) / now, (p[1] - q[1]) / now, (p[2] - q[2]) / now};
      }
      for (std::size_t i = 0; i < 3; ++i) {
        if (unknown_[kept.first] >= 0) jacobian[r][3 * static_cast<std::size_t>(unknown_[kept.first]) + i] += u[i];
        if (!kept.along && unknown_[kept.second] >= 0)
          jacobian[r][3 * static_cast<std::size_t>(unknown_[kept.second]) + i] -= u[i];
      }
    }
    const std::vector<double> force = solved(jacobian, right, damping);
    double most = 0;
    std::vector<double> step(columns);
    for (std::size_t c = 0; c < columns; ++c) {
      for (std::size_t r = 0; r < rows; ++r) step[c] += jacobian[r][c] * force[r];
      most = std::max(most, std::abs(step[c]));
    }
    const double shorter = most > 0.2 * d_.size ? 0.2 * d_.size / most : 1;
    for (std::size_t p = 0; p < unknown_.size(); ++p)
      if (unknown_[p] >= 0)
        for (std::size_t i = 0; i < 3; ++i)
          d_.posture[p][i] += shorter * step[3 * static_cast<std::size_t>(unknown_[p]) + i];
  }

  /// (J J^T + little) x = b by Cholesky's method. `little`: of rows of length one: what keeps dependent rows apart.
  static std::vector<double> solved(const std::vector<std::vector<double>>& jacobian, std::vector<double> right,
                                    double little) {
    const std::size_t n = right.size();
    std::vector<std::vector<double>> a(n, std::vector<double>(n));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = i == j ? little : 0;
        for (std::size_t c = 0; c < jacobian[i].size(); ++c) sum += jacobian[i][c] * jacobian[j][c];
        for (std::size_t k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
        a[i][j] = i == j ? std::sqrt(std::max(sum, little)) : sum / a[j][j];
      }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < i; ++k) right[i] -= a[i][k] * right[k];
      right[i] /= a[i][i];
    }
    for (std::size_t i = n; i-- > 0;) {
      for (std::size_t k = i + 1; k < n; ++k) right[i] -= a[k][i] * right[k];
      right[i] /= a[i][i];
    }
    return right;
  }

  std::string in_units(double metres) const {
    char text[48];
    std::snprintf(text, sizeof text, "%.4g %s", metres / core::to_double(d_.unit),
                  d_.mechanism.units.length.name.c_str());
    return text;
  }

  /// The links on the way round through one of them.
  std::vector<std::string> loop_of(LinkIndex through) const {
    std::map<LinkIndex, LinkIndex> before;
    std::vector<JointIndex> joints;
    for (std::size_t j = 0; j < d_.mechanism.joints.size(); ++j)
      if (d_.mechanism.joints[j].from == through || d_.mechanism.joints[j].to == through)
        joints.push_back(static_cast<JointIndex>(j));
    const auto other = [&](const Joint& joint, LinkIndex link) { return joint.from == link ? joint.to : joint.from; };
    if (joints.size() < 2) return {d_.name_of(through)};
    const LinkIndex start = other(d_.joint(joints[0]), through), end = other(d_.joint(joints[1]), through);
    std::queue<LinkIndex> next;
    next.push(start);
    before[start] = start;
    while (!next.empty() && !before.contains(end)) {
      const LinkIndex link = next.front();
      next.pop();
      for (const Joint& joint : d_.mechanism.joints) {
        if (joint.from != link && joint.to != link) continue;
        const LinkIndex to = other(joint, link);
        if (to == through || before.contains(to)) continue;
        before[to] = link;
        next.push(to);
      }
    }
    std::vector<std::string> names = {d_.name_of(through)};
    if (!before.contains(end)) return names;
    for (LinkIndex link = end;; link = before[link]) {
      names.push_back(d_.name_of(link));
      if (link == start) break;
    }
    return names;
  }

  [[noreturn]] void refuse() const {
    // Where the lengths do not close, all links give way a little: the fault is one of a link of given lengths.
    const auto fault = [&](const Kept& kept) {
      const double off = std::abs(residual(kept));
      return std::pair(off > 1e-9 * d_.size && !d_.lengths[static_cast<std::size_t>(kept.link)].empty(), off);
    };
    const auto found =
        std::max_element(kept_.begin(), kept_.end(), [&](const Kept& a, const Kept& b) { return fault(a) < fault(b); });
    const auto name = [&](std::size_t point) { return d_.name(static_cast<PointIndex>(point)); };
    // All links of the loop give way: what is missing is the sum.
    const std::vector<std::string> loop = loop_of(found->link);
    double missing = 0;
    for (const Kept& kept : kept_)
      if (!kept.along && std::find(loop.begin(), loop.end(), d_.name_of(kept.link)) != loop.end())
        missing += std::abs(residual(kept));
    const std::string what = found->along
                                 ? name(found->first) + " leaves its guide by " + in_units(std::abs(residual(*found)))
                                 : name(found->first) + " and " + name(found->second) + " come " + in_units(missing) +
                                       (residual(*found) > 0 ? " too far" : " too near");
    const auto& given = d_.lengths[static_cast<std::size_t>(found->link)];
    throw InputError(given.empty() ? d_.link(found->link).where : given.front().where,
                     "the loop of " + listed(loop) + " does not close with the lengths given: " + what,
                     "correct the lengths, or leave out those that the drawing has");
  }

  void note() {
    double most = 0;
    std::size_t farthest = 0, moved = 0;
    for (std::size_t p = 0; p < d_.points.size(); ++p) {
      const double way = length_between(start_[p], d_.posture[p]);
      if (way > 1e-9 * d_.size) ++moved;
      if (way > most) most = way, farthest = p;
    }
    if (moved == 0) return;
    d_.mechanism.notes.push_back("the drawing is closed anew with the lengths given: " + std::to_string(moved) +
                                 (moved == 1 ? " point moves, " : " points move, ") +
                                 d_.name(static_cast<PointIndex>(farthest)) + " most, by " + in_units(most));
  }

  Drawing& d_;
  std::vector<PointAt> start_;
  std::vector<bool> fixed_;
  std::vector<Kept> kept_;
  std::vector<int> unknown_;
  std::size_t unknowns_ = 0;
};

}  // namespace

void close_loops(Drawing& drawing) {
  const bool any =
      std::any_of(drawing.lengths.begin(), drawing.lengths.end(), [](const auto& length) { return !length.empty(); });
  if (!any) return;
  for (std::size_t l = 0; l < drawing.mechanism.links.size(); ++l)
    (void)Shape(drawing, static_cast<LinkIndex>(l));  // throws where lengths make no triangle
  LoopClosure(drawing).run();
}

}  // namespace clearloci::mechanism
