#include "check/points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "check/zeros.hpp"

namespace clearloci::check {
namespace {

using core::Point2;
using core::Quantity;

// Relative to the box: points were rounded to doubles.
constexpr double same_point = 1e-10;
constexpr std::size_t most_cells = 60'000;

class PointCheck {
 public:
  PointCheck(const mechanism::Mechanism& m, const CertificateFile& c, int mode, const Orders& orders,
             Examination& examination)
      : m_(m), c_(c), mode_(mode), orders_(orders), examination_(examination), claimed_(c.points.size()) {
    for (std::size_t i = 0; i < 4; ++i) box_[i] = c.box[i].get_d();
    size_ = std::max(box_[1] - box_[0], box_[3] - box_[2]);
  }

  void run() {
    if (std::find(c_.quantities.begin(), c_.quantities.end(), Quantity::f) != c_.quantities.end())
      for (const std::string& joint : c_.joints) check_joint(joint);
    for (std::size_t i = 0; i < c_.points.size(); ++i) {
      const PointClaim& point = c_.points[i];
      if (point.mode != mode_) continue;
      const std::string place = fmt::format("({}, {})", point.at[0], point.at[1]);
      // Of each joint asked for that is said to lose its contact.
      const bool all = std::all_of(point.vanishing.begin(), point.vanishing.end(), [&](const Reaction& reaction) {
        return reaction.second != Quantity::f || claimed_[i].contains(reaction.first) ||
               std::find(c_.joints.begin(), c_.joints.end(), reaction.first) == c_.joints.end();
      });
      if (!claimed_[i].empty() && all) continue;
      if (!point.certified || point.kind != core::LocusKind::contact_loss || undecided_)
        examination_.unchecked.push_back("the isolated point " + place);
      else
        throw FalseClaim("the isolated point " + place + ": no contact is lost there alone");
    }
  }

 private:
  void check_joint(const std::string& joint) {
    const auto found = std::find_if(m_.joints.begin(), m_.joints.end(), [&](const auto& j) { return j.name == joint; });
    const std::vector<mechanism::Unknown> unknowns = reactions_of(m_);
    std::vector<const std::vector<int>*> components;
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      if (unknowns[k].joint == found - m_.joints.begin() && orders_.reactions[k] &&
          (unknowns[k].quantity == Quantity::fx || unknowns[k].quantity == Quantity::fy))
        components.push_back(&*orders_.reactions[k]);
    if (components.size() != 2) return;
    for (int f = 0; f < static_cast<int>(c_.functions.size()); ++f)
      for (int g = 0; g < static_cast<int>(c_.functions.size()); ++g) {
        const auto order = [&](std::size_t component, int function) {
          return (*components[component])[static_cast<std::size_t>(function)];
        };
        if (order(0, f) > 0 && order(1, f) <= 0 && order(1, g) > 0 && order(0, g) <= 0) check_pair(joint, f, g);
      }
  }

  const CommonZeros& zeros_of(int f, int g) {
    const auto [found, fresh] = known_.try_emplace({std::min(f, g), std::max(f, g)});
    if (!fresh) return found->second;
    Sheet sheet(parts_of(c_, mode_), {&c_.functions[static_cast<std::size_t>(f)].program,
                                      &c_.functions[static_cast<std::size_t>(g)].program});
    found->second = common_zeros(sheet, {{box_[0], box_[1], box_[2], box_[3]}}, size_, most_cells);
    return found->second;
  }

  void check_pair(const std::string& joint, int f, int g) {
    const CommonZeros& found = zeros_of(f, g);
    if (!found.complete) {
      undecided_ = true;
      examination_.unchecked.push_back(
          fmt::format("isolated contact losses of {} in mode {}: too many cells", joint, mode_ + 1));
    }
    for (const Rectangle& cell : found.undecided) {
      const Point2 at = {0.5 * (cell.x0 + cell.x1), 0.5 * (cell.y0 + cell.y1)};
      if (cell.size() < 1e-6 * size_ && (at_divisor(cell) || on_contact_loss(joint, at))) continue;
      undecided_ = true;
      examination_.unchecked.push_back(
          fmt::format("isolated contact loss of {} in mode {} near ({}, {})", joint, mode_ + 1, at[0], at[1]));
      break;
    }
    for (const Place& place : found.zeros) {
      const Point2 at = place.at();
      const double reach = same_point * size_;
      if (at[0] < box_[0] - reach || box_[1] + reach < at[0] || at[1] < box_[2] - reach || box_[3] + reach < at[1])
        continue;
      if (!in_workspace(place)) continue;
      const bool on_side =
          at[0] < box_[0] + reach || box_[1] - reach < at[0] || at[1] < box_[2] + reach || box_[3] - reach < at[1];
      bool listed = false;
      for (std::size_t i = 0; i < c_.points.size(); ++i) {
        const PointClaim& point = c_.points[i];
        if (point.mode != mode_ || std::hypot(point.at[0] - at[0], point.at[1] - at[1]) > reach) continue;
        if (std::find(point.vanishing.begin(), point.vanishing.end(), Reaction{joint, Quantity::f}) ==
            point.vanishing.end())
          continue;
        if (listed) throw FalseClaim(fmt::format("two points are ({}, {}) in mode {}", at[0], at[1], mode_ + 1));
        listed = true;
        if (claimed_[i].empty()) ++examination_.points;
        claimed_[i].insert(joint);
      }
      if (!listed && !on_side && !on_contact_loss(joint, at))
        throw FalseClaim(fmt::format("{} loses contact at ({}, {}) in mode {}, but no point says so", joint, at[0],
                                     at[1], mode_ + 1));
    }
  }

  /// The closure may be undefined there: every numerator vanishes, which says nothing.
  bool at_divisor(const Rectangle& cell) const {
    return !posture(m_, sides_of(c_, mode_), Interval(cell.x0 - 1e-9 * size_, cell.x1 + 1e-9 * size_, cell_bits),
                    Interval(cell.y0 - 1e-9 * size_, cell.y1 + 1e-9 * size_, cell_bits));
  }

  /// Every root is real and |A| is not zero.
  bool in_workspace(const Place& place) const {
    const std::optional<Posture> here = posture(m_, sides_of(c_, mode_), place.x, place.y);
    return here && solve(m_, *here, place.x, place.y);
  }

  bool on_contact_loss(const std::string& joint, const Point2& at) const {
    for (const CurveClaim& curve : c_.curves) {
      if (curve.mode != mode_ || std::find(curve.vanishing.begin(), curve.vanishing.end(),
                                           Reaction{joint, Quantity::f}) == curve.vanishing.end())
        continue;
      for (const core::Arc& arc : curve.arcs)
        if (passes_near(arc.points, at, 2.5 * c_.tolerance)) return true;
    }
    return false;
  }

  const mechanism::Mechanism& m_;
  const CertificateFile& c_;
  int mode_;
  const Orders& orders_;
  Examination& examination_;
  std::vector<std::set<std::string>> claimed_;  // by whom each was found
  std::array<double, 4> box_{};
  double size_ = 0;
  bool undecided_ = false;
  std::map<std::pair<int, int>, CommonZeros> known_;
};

}  // namespace

void check_points(const mechanism::Mechanism& m, const CertificateFile& certificate, int mode, const Orders& orders,
                  Examination& examination) {
  PointCheck(m, certificate, mode, orders, examination).run();
}

}  // namespace clearloci::check
