#include "check/task.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "check/curves.hpp"
#include "mechanism/guide.hpp"

namespace clearloci::check {
namespace {

using core::Point2;
using core::Quantity;

constexpr std::size_t most_cells = 400'000;

class TaskCheck {
 public:
  TaskCheck(const mechanism::Mechanism& m, const CertificateFile& c, const Orders& orders)
      : m_(m), c_(c), task_(*c.task), orders_(orders), sides_(sides_of(c, task_.mode)), sheet_(sheet()) {
    for (const auto& p : task_.points) points_.push_back({p[0].get_d(), p[1].get_d()});
    if (task_.shape == "box") {
      const Point2 a = points_.at(0), b = points_.at(1);
      points_ = {a, {b[0], a[1]}, b, {a[0], b[1]}};
    }
    collect_conditions();
  }

  std::size_t run() {
    const double reach = reach_of_all();
    std::array<double, 4> bound = {points_[0][0], points_[0][0], points_[0][1], points_[0][1]};
    for (const Point2& p : points_)
      bound = {std::min(bound[0], p[0]), std::max(bound[1], p[0]), std::min(bound[2], p[1]), std::max(bound[3], p[1])};
    std::vector<Rectangle> open = {{bound[0] - reach, bound[1] + reach, bound[2] - reach, bound[3] + reach}};
    std::size_t cells = 0;
    for (std::size_t count = 0; !open.empty(); ++count) {
      const Rectangle cell = open.back();
      open.pop_back();
      if (is_apart(cell, reach)) continue;
      if (holds(cell)) {
        ++cells;
        continue;
      }
      if (count > most_cells || cell.size() < 1e-9 * (bound[1] - bound[0] + bound[3] - bound[2] + reach))
        throw FalseClaim("task: that it keeps clear is not shown in " + describe(cell));
      for (const Rectangle& half : halves(cell)) open.push_back(half);
    }
    return cells;
  }

 private:
  Sheet sheet() {
    for (int j = 0; j < static_cast<int>(c_.squares.size()); ++j) {
      core::StraightLineBuilder builder;
      roots_.push_back(builder.line(builder.variable(2 + j)));
    }
    std::vector<const core::StraightLine*> programs;
    for (const Function& f : c_.functions) programs.push_back(&f.program);
    for (const core::StraightLine& root : roots_) programs.push_back(&root);
    return Sheet(parts_of(c_, task_.mode), programs);
  }

  /// The margin, the radius of a circle and rounding.
  double reach_of_all() const {
    double size = 0;
    for (const Point2& p : points_) size = std::max({size, std::abs(p[0]), std::abs(p[1])});
    return (task_.margin.get_d() + (task_.shape == "circle" ? task_.radius.get_d() : 0.0) + 1e-15 * size) * (1 + 1e-12);
  }

  /// No place of the cell is within reach of the task, for certain.
  bool is_apart(const Rectangle& cell, double reach) const {
    const Point2 middle = {0.5 * (cell.x0 + cell.x1), 0.5 * (cell.y0 + cell.y1)};
    const double half = 0.5 * std::hypot(cell.x1 - cell.x0, cell.y1 - cell.y0) * (1 + 1e-12);
    const bool filled = task_.shape == "box" || task_.shape == "polygon";
    double nearest = std::hypot(middle[0] - points_[0][0], middle[1] - points_[0][1]);
    bool in = false;
    for (std::size_t i = filled ? 0 : 1; i < points_.size(); ++i) {
      const Point2 &a = points_[i == 0 ? points_.size() - 1 : i - 1], &b = points_[i];
      nearest = std::min(nearest, distance_to_segment(middle, a, b));
      if (filled && (a[1] > middle[1]) != (b[1] > middle[1]) &&
          middle[0] < a[0] + (middle[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
        in = !in;
    }
    return !in && nearest - half > reach;
  }

  /// Sets of functions: of each one condition's alternatives, one has to be free of zeros.
  void collect_conditions() {
    std::vector<int> regular;
    const int functions = static_cast<int>(c_.functions.size());
    for (int f = 0; f < functions; ++f)
      if (orders_.determinant[static_cast<std::size_t>(f)] != 0) regular.push_back(f);
    conditions_.push_back({regular});
    const std::vector<mechanism::Unknown> unknowns = reactions_of(m_);
    const auto wanted = [&](Quantity q) {
      return std::find(c_.quantities.begin(), c_.quantities.end(), q) != c_.quantities.end();
    };
    for (const std::string& joint : c_.joints) {
      const auto own = std::find_if(m_.joints.begin(), m_.joints.end(), [&](const auto& j) { return j.name == joint; });
      const std::vector<Quantity> parts = mechanism::contact_components(m_, *own);
      std::vector<std::vector<int>> force;
      for (std::size_t k = 0; k < unknowns.size(); ++k) {
        if (unknowns[k].joint != own - m_.joints.begin() || !orders_.reactions[k]) continue;
        std::vector<int> zeros;
        for (int f = 0; f < functions; ++f)
          if ((*orders_.reactions[k])[static_cast<std::size_t>(f)] > 0) zeros.push_back(f);
        const bool part = std::find(parts.begin(), parts.end(), unknowns[k].quantity) != parts.end();
        if (part) force.push_back(zeros);
        if (!part && wanted(unknowns[k].quantity)) conditions_.push_back({zeros});
      }
      if (wanted(Quantity::f) && !force.empty()) conditions_.push_back(force);
    }
  }

  bool holds(const Rectangle& cell) {
    const Interval x(cell.x0, cell.x1, cell_bits), y(cell.y0, cell.y1, cell_bits);
    // The closure of the model itself, and what the certificate's functions say.
    const std::optional<Posture> here = posture(m_, sides_, x, y);
    if (!here || !std::all_of(here->squares.begin(), here->squares.end(), [](const auto& q) { return q.sign() > 0; }))
      return false;
    if (!sheet_.enter(x, y) || !sheet_.is_inner()) return false;
    bool differentiated = false;
    std::vector<int> known(c_.functions.size(), -1);
    const auto is_free = [&](int f) {
      int& free = known[static_cast<std::size_t>(f)];
      if (free >= 0) return free == 1;
      free = sheet_.value(f).contains_zero() ? 0 : 1;
      if (free == 1) return true;
      if (!differentiated) sheet_.differentiate();
      differentiated = true;
      free = sheet_.centred(f).contains_zero() ? 0 : 1;
      return free == 1;
    };
    return std::all_of(conditions_.begin(), conditions_.end(), [&](const auto& alternatives) {
      return std::any_of(alternatives.begin(), alternatives.end(), [&](const std::vector<int>& functions) {
        return std::all_of(functions.begin(), functions.end(), is_free);
      });
    });
  }

  const mechanism::Mechanism& m_;
  const CertificateFile& c_;
  const TaskClaim& task_;
  const Orders& orders_;
  Sides sides_;
  std::vector<core::StraightLine> roots_;
  Sheet sheet_;
  std::vector<Point2> points_;
  std::vector<std::vector<std::vector<int>>> conditions_;
};

}  // namespace

void check_task(const mechanism::Mechanism& m, const CertificateFile& certificate, const Orders& orders,
                Examination& examination) {
  examination.task_cells = TaskCheck(m, certificate, orders).run();
  for (const std::string& what : certificate.task->unchecked)
    examination.unchecked.push_back("task: " + what.substr(0, 200));
}

}  // namespace clearloci::check
