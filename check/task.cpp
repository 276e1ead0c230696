#include "check/task.hpp"

#include <algorithm>

#include "check/curves.hpp"
#include "mechanism/guide.hpp"

namespace clearloci::check {
namespace {

using core::Quantity;

class TaskCheck {
 public:
  TaskCheck(const mechanism::Mechanism& m, const CertificateFile& c, const Orders& orders)
      : m_(m), c_(c), task_(*c.task), orders_(orders), sides_(sides_of(c, task_.mode)), sheet_(sheet()) {
    collect_conditions();
  }

  std::size_t run() {
    const TaskRegion region(task_.shape, {1, 1}, {true, true});
    return covered(
        region.whole(), c_.coordinates, [&](const Cell& cell) { return region.is_apart(cell); },
        [&](const Cell& cell, std::vector<double>&) { return holds(cell); }, c_.deadline);
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
    const std::vector<bool> by_efforts = loaded_beside_efforts();
    for (const std::string& joint : c_.joints) {
      const auto found =
          std::find_if(m_.joints.begin(), m_.joints.end(), [&](const auto& j) { return j.name == joint; });
      const std::vector<Quantity> parts = mechanism::contact_components(m_, *found);
      std::vector<std::vector<int>> force;
      bool is_force_by_efforts = false;
      for (std::size_t k = 0; k < unknowns.size(); ++k) {
        if (unknowns[k].joint != found - m_.joints.begin()) continue;
        const bool part = std::find(parts.begin(), parts.end(), unknowns[k].quantity) != parts.end();
        if (!orders_.reactions[k]) {
          if (part) is_force_by_efforts = is_force_by_efforts || by_efforts[k];
          if (!part && wanted(unknowns[k].quantity) && by_efforts[k]) refuse_unloaded(joint);
          continue;
        }
        std::vector<int> zeros;
        for (int f = 0; f < functions; ++f)
          if ((*orders_.reactions[k])[static_cast<std::size_t>(f)] > 0) zeros.push_back(f);
        if (part) force.push_back(zeros);
        if (!part && wanted(unknowns[k].quantity)) conditions_.push_back({zeros});
      }
      if (!wanted(Quantity::f)) continue;
      if (force.empty() && is_force_by_efforts) refuse_unloaded(joint);
      if (!force.empty()) conditions_.push_back(force);
    }
  }

  [[noreturn]] static void refuse_unloaded(const std::string& joint) {
    throw FalseClaim("task: joint " + joint + " bears nothing under the given efforts, and would under others");
  }

  /// What a unit more of some given effort does not leave at zero, at a point of the task's shape or their mean.
  std::vector<bool> loaded_beside_efforts() const {
    std::vector<bool> loaded(reactions_of(m_).size(), false);
    std::vector<std::vector<core::Rational>> places = task_.shape.points;
    std::vector<core::Rational> mean(2);
    for (const std::vector<core::Rational>& at : task_.shape.points)
      for (std::size_t c = 0; c < mean.size(); ++c) mean[c] += at[c] / static_cast<long>(task_.shape.points.size());
    places.push_back(std::move(mean));
    for (std::size_t j = 0; j < m_.joints.size(); ++j) {
      if (!m_.joints[j].free_effort || !m_.joints[j].effort) continue;
      mechanism::Mechanism beside = m_;
      beside.joints[j].effort =
          core::Expression::apply(core::Expression::Kind::add, {*m_.joints[j].effort, core::Expression::number(1)});
      bool solved = false;
      for (const std::vector<core::Rational>& at : places) {
        const Interval x(at[0], cell_bits), y(at[1], cell_bits);
        const std::optional<Posture> here = posture(beside, sides_, x, y);
        const auto solution = here ? solve(beside, *here, x, y) : std::nullopt;
        solved = solved || solution.has_value();
        for (std::size_t k = 0; solution && k < loaded.size(); ++k)
          loaded[k] = loaded[k] || solution->reactions[k].sign() != 0;
      }
      if (!solved) throw FalseClaim("task: the reactions cannot be told at any of its points");
    }
    return loaded;
  }

  bool holds(const Cell& cell) {
    const Interval x(cell[0][0], cell[0][1], cell_bits), y(cell[1][0], cell[1][1], cell_bits);
    // The closure of the model itself, and what the certificate's functions say.
    const std::optional<Posture> here = posture(m_, sides_, x, y);
    if (!here || !std::all_of(here->squares.begin(), here->squares.end(), [](const auto& q) { return q.sign() > 0; }))
      return false;
    if (!sheet_.enter(x, y) || !sheet_.is_inner()) return false;
    bool differentiated = false;
    std::vector<int> places(c_.functions.size(), -1);
    const auto is_free = [&](int f) {
      int& free = places[static_cast<std::size_t>(f)];
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
