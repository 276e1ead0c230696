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
    for (const std::string& joint : c_.joints) {
      const auto found =
          std::find_if(m_.joints.begin(), m_.joints.end(), [&](const auto& j) { return j.name == joint; });
      const std::vector<Quantity> parts = mechanism::contact_components(m_, *found);
      std::vector<std::vector<int>> force;
      for (std::size_t k = 0; k < unknowns.size(); ++k) {
        if (unknowns[k].joint != found - m_.joints.begin() || !orders_.reactions[k]) continue;
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
