#include "check/pose_range.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "check/certificate.hpp"
#include "core/errors.hpp"
#include "core/reduced.hpp"

namespace clearloci::check {
namespace {

using core::Rational;
using mechanism::Mechanism;

class PoseRangeCheck {
 public:
  PoseRangeCheck(const Mechanism& m, const PoseRangeClaim& claim, const Deadline& deadline, Examination& examination)
      : m_(m), claim_(claim), deadline_(deadline), examination_(examination) {
    if (m.coordinates.size() != 1 || m.coordinates[0].name != claim.head.coordinates[0])
      throw FalseClaim("coordinates: they are not the model's");
    lower_ = m.coordinates[0].lower;
    upper_ = m.coordinates[0].upper;
  }

  void run() {
    if (claim_.modes.empty()) throw FalseClaim("modes: there is none");
    for (const PoseRangeClaim::Mode& mode : claim_.modes) check_mode(mode);
  }

 private:
  /// A part of the range as a task.
  PoseTaskClaim task(const PoseRangeClaim::Mode& mode, const Rational& from, const Rational& to) const {
    PoseTaskClaim claim = claim_.head;
    claim.shape.name = "box";
    claim.shape.points = {{from}, {to}};
    claim.sides = mode.sides;
    claim.demands = mode.demands;
    return claim;
  }
  PoseTaskClaim without_demands(const PoseRangeClaim::Mode& mode, const Rational& from, const Rational& to) const {
    PoseTaskClaim claim = task(mode, from, to);
    claim.demands.clear();
    return claim;
  }

  PoseTaskClaim with_demand(const PoseRangeClaim::Mode& mode, std::size_t demand, const Rational& from,
                            const Rational& to) const {
    PoseTaskClaim claim = task(mode, from, to);
    claim.demands = {mode.demands[demand]};
    return claim;
  }

  std::string place(const Rational& from, const Rational& to) const {
    if (to - from <= narrow()) return fmt::format("{} = {:.9g}", claim_.head.coordinates[0], from.get_d());
    return fmt::format("{} from {:.9g} to {:.9g}", claim_.head.coordinates[0], from.get_d(), to.get_d());
  }
  void leave(const std::string& what) { examination_.unchecked.push_back(what); }

  /// Where loci alone are, and not what is out of reach.
  Rational narrow() const { return (upper_ - lower_) / 1'000'000; }

  static PoseRangeClaim::Mode without_least_sizes(PoseRangeClaim::Mode mode) {
    for (core::TaskDemand& demand : mode.demands) demand.least = 0;
    return mode;
  }

  void check_mode(const PoseRangeClaim::Mode& asked) {
    if (asked.demands.empty()) throw FalseClaim("demands: there is none");
    const PoseRangeClaim::Mode mode = without_least_sizes(asked);  // of points, and of what lies between intervals
    shown_.clear();
    std::vector<PoseRangeClaim::Free> free = mode.free;
    std::sort(free.begin(), free.end(), [](const auto& a, const auto& b) { return a.from < b.from; });
    Rational reached = lower_;
    for (const PoseRangeClaim::Free& entry : free) {
      if (entry.from < reached || entry.to > upper_) throw FalseClaim("free: intervals overlap, or leave the range");
      check_free(asked, entry);
      if (entry.from > reached) check_between(mode, reached, entry.from);
      reached = entry.to;
    }
    if (reached < upper_) check_between(mode, reached, upper_);
    for (const PoseRangeClaim::Point& point : mode.points) {
      check_words(point);
      if (point.at < lower_ || point.at > upper_ || std::any_of(free.begin(), free.end(), [&](const auto& candidate) {
            return candidate.from < point.at && point.at < candidate.to;
          }))
        throw FalseClaim("points: one is where no locus is, at " + place(point.at, point.at));
    }
  }

  /// What vanishes is of the mechanism, and the kind is that of what vanishes.
  void check_words(const PoseRangeClaim::Point& point) {
    using enum core::LocusKind;
    const std::string what = words_of(point);
    for (const Reaction& vanishing : point.vanishing)
      if (std::none_of(m_.joints.begin(), m_.joints.end(),
                       [&](const auto& joint) { return joint.name == vanishing.first; }))
        throw FalseClaim(what + ": the model has no joint " + vanishing.first.substr(0, 40));
    const bool of_reactions = point.kind == contact_loss || point.kind == backlash;
    if (of_reactions && (point.vanishing.empty() || gravest_kind(point.vanishing) != point.kind))
      throw FalseClaim(what + ": what vanishes is of another kind");
    if ((point.kind == workspace_boundary || point.kind == direct_singularity) && !point.vanishing.empty())
      leave(what + ": what vanishes there");
  }

  std::string words_of(const PoseRangeClaim::Point& point) const {
    return fmt::format("the {} at {}", core::to_string(point.kind), place(point.at, point.at));
  }

  /// Whether what is within reach is where the mechanism closes, from wherever it comes, and not where efforts keep to
  /// bounds besides.
  bool is_reach_closure() const {
    return std::none_of(m_.joints.begin(), m_.joints.end(), [](const mechanism::Joint& joint) {
      return joint.meshing || joint.within || joint.law_within;
    });
  }

  bool holds(const PoseTaskClaim& claim, Holding holding) {
    try {
      examination_.task_cells += check_poses(m_, claim, holding, deadline_, shown_);
      return true;
    } catch (const FalseClaim&) {
      return false;
    }
  }

  /// The demands of an interval: without the least size of what is too small there, which is shown at its middle.
  PoseRangeClaim::Mode demanded_in(const PoseRangeClaim::Mode& asked, const PoseRangeClaim::Free& free) {
    PoseRangeClaim::Mode mode = asked;
    const Rational middle = (free.from + free.to) / 2;
    for (const auto& [joint, quantity] : free.too_small) {
      const std::optional<std::size_t> demand = demand_of(mode, joint, quantity);
      if (!demand || mode.demands[*demand].least <= 0 ||
          holds(with_demand(mode, *demand, middle, middle), Holding::clear))
        throw FalseClaim(fmt::format("too_small: {}_{}, at {}", core::to_string(quantity), joint.substr(0, 40),
                                     place(free.from, free.to)));
      mode.demands[*demand].least = 0;
    }
    return mode;
  }

  void check_free(const PoseRangeClaim::Mode& asked, const PoseRangeClaim::Free& free) {
    const PoseRangeClaim::Mode mode = demanded_in(asked, free);
    try {
      examination_.task_cells += check_poses(m_, task(mode, free.from, free.to), Holding::clear, deadline_, shown_);
    } catch (const FalseClaim& claim) {
      throw FalseClaim(fmt::format("{} ({}): {}", free.name.substr(0, 40), place(free.from, free.to), claim.what()));
    }
    ++examination_.zones;
    if (free.assembly_mode == 0 && free.signs.empty()) return;
    if (free.name.empty()) throw FalseClaim("signs: they are of no zone, at " + place(free.from, free.to));
    const Rational middle = (free.from + free.to) / 2;
    const PoseSigns signs = signs_at(m_, task(mode, middle, middle), deadline_, shown_);
    if (free.assembly_mode * signs.determinant != 0) {
      const int sense = free.assembly_mode * signs.determinant;
      if (sense_ != 0 && sense_ != sense) throw FalseClaim("signs: of |A|, at " + place(free.from, free.to));
      sense_ = sense;
    }
    for (const auto& [joint, quantity, sign] : free.signs) {
      const std::optional<std::size_t> demand = demand_of(mode, joint, quantity);
      if (demand && sign != 0 && signs.demands[*demand] == 0) continue;
      if (!demand || signs.demands[*demand] != sign)
        throw FalseClaim(fmt::format("signs: of {}_{}, at {}", core::to_string(quantity), joint.substr(0, 40),
                                     place(free.from, free.to)));
    }
  }

  static std::optional<std::size_t> demand_of(const PoseRangeClaim::Mode& mode, const std::string& joint,
                                              core::Quantity quantity) {
    for (std::size_t d = 0; d < mode.demands.size(); ++d)
      if (mode.demands[d].joint == joint && mode.demands[d].quantity == quantity) return d;
    return std::nullopt;
  }

  void check_between(const PoseRangeClaim::Mode& mode, const Rational& from, const Rational& to) {
    std::vector<const PoseRangeClaim::Point*> points;
    for (const PoseRangeClaim::Point& point : mode.points)
      if (point.at >= from && point.at <= to) points.push_back(&point);
    const bool open = std::any_of(mode.open.begin(), mode.open.end(), [&](const auto& candidate) {
      return candidate.first <= to && candidate.second >= from;
    });
    if (open) return leave("the open place " + place(from, to));
    if (to - from > narrow()) return check_out_of_reach(mode, from, to);
    if (points.empty()) throw FalseClaim("points: there is none at " + place(from, to));
    for (const PoseRangeClaim::Point* point : points) check_point(mode, *point, from, to);
  }

  /// But for a hair at either end, where a boundary is.
  void check_out_of_reach(const PoseRangeClaim::Mode& mode, const Rational& from, const Rational& to) {
    const double left = maybe_reached(m_, without_demands(mode, from, to), deadline_);
    if (left > 10 * narrow().get_d()) {
      refuse_reached(mode, from, to);
      leave("that " + place(from, to) + " is out of reach");
    }
    if (from > lower_) check_end_of_reach(mode, from, false);
    if (to < upper_) check_end_of_reach(mode, to, true);
    for (const PoseRangeClaim::Point& point : mode.points) {
      if (point.at < from || point.at > to) continue;
      if (point.at - from > narrow() && to - point.at > narrow())
        throw FalseClaim("points: one is out of reach, at " + place(point.at, point.at));
      if (point.kind != core::LocusKind::workspace_boundary) check_at_boundary(mode, point, from, to);
    }
  }

  /// A boundary is where an interval begins or ends beside what is out of reach, and what vanishes there is named.
  void check_end_of_reach(const PoseRangeClaim::Mode& mode, const Rational& end, bool begins) {
    const PoseRangeClaim::Point* boundary = nullptr;
    for (const PoseRangeClaim::Point& point : mode.points) {
      if (point.kind != core::LocusKind::workspace_boundary || abs(point.at - end) > narrow() / 10 ||
          (begins ? point.at > end : point.at < end))
        continue;
      if (boundary != nullptr) throw FalseClaim("points: two boundaries are at " + place(end, end));
      boundary = &point;
    }
    if (boundary == nullptr) throw FalseClaim("points: no boundary is at " + place(end, end));
    const Rational beyond = 2 * boundary->at - end;
    const Rational &from = begins ? beyond : end, &to = begins ? end : beyond;
    if (!holds(without_demands(mode, from, to), Holding::regular)) return;  // nothing closes beyond
    require_named(mode, signs_at(m_, task(mode, from, from), deadline_, shown_),
                  signs_at(m_, task(mode, to, to), deadline_, shown_), from, to);
  }

  /// Poses between two at which the mechanism closes are within reach.
  void refuse_reached(const PoseRangeClaim::Mode& mode, const Rational& from, const Rational& to) {
    if (!is_reach_closure()) return;
    constexpr int parts = 16;
    for (int k = 1; k < parts; ++k) {
      const Rational at = from + (to - from) * core::reduced(k, parts);
      if (holds(without_demands(mode, at, at), Holding::closure))
        throw FalseClaim("free: " + place(at, at) + " is within reach, and neither there nor open");
    }
  }

  /// Where teeth change flanks the mechanism still closes beyond the boundary.
  void check_at_boundary(const PoseRangeClaim::Mode& mode, const PoseRangeClaim::Point& point, const Rational& from,
                         const Rational& to) {
    try {
      if (point.at > from && point.at - from <= narrow()) return check_point(mode, point, from, 2 * point.at - from);
      if (point.at < to && to - point.at <= narrow()) return check_point(mode, point, 2 * point.at - to, to);
    } catch (const FalseClaim&) {
      // Nothing closes beyond: a change of sign is not seen.
    }
    leave(words_of(point) + ", on the boundary");
  }

  void check_point(const PoseRangeClaim::Mode& mode, const PoseRangeClaim::Point& point, const Rational& from,
                   const Rational& to) {
    using enum core::LocusKind;
    const std::string what = words_of(point);
    const bool zero = point.kind == contact_loss || point.kind == backlash || point.kind == direct_singularity;
    if (point.kind == workspace_boundary && is_reach_closure() &&
        holds(without_demands(mode, from, to), Holding::closure))
      throw FalseClaim(what + ": the mechanism closes on both sides");
    if (!zero) return leave(what);
    std::string refuted;
    try {
      const bool singular = point.kind == direct_singularity;
      examination_.task_cells += check_poses(m_, without_demands(mode, from, to),
                                             singular ? Holding::closure : Holding::regular, deadline_, shown_);
      const PoseSigns before = signs_at(m_, task(mode, from, from), deadline_, shown_),
                      behind = signs_at(m_, task(mode, to, to), deadline_, shown_);
      if (singular && before.determinant * behind.determinant >= 0) {
        if (!holds(without_demands(mode, from, to), Holding::regular)) return leave(what);
        refuted = "|A|";
      }
      std::string unknown;
      for (const auto& [joint, quantity] : point.vanishing) {
        if (singular) continue;
        const std::optional<std::size_t> d = demand_of(mode, joint, quantity);
        if (d && before.demands[*d] * behind.demands[*d] < 0) continue;
        const std::string name = fmt::format("{}_{}", core::to_string(quantity), joint.substr(0, 40));
        if (d && holds(with_demand(mode, *d, from, to), Holding::clear)) refuted = name;
        unknown += (unknown.empty() ? "" : ", ") + name;
      }
      if (!singular) require_named(mode, before, behind, from, to);
      if (!unknown.empty() && refuted.empty()) return leave(what + ": that " + unknown + " vanishes");
      if (refuted.empty()) ++examination_.points;
    } catch (const FalseClaim& claim) {
      if (!point.certified) return leave(what);
      throw FalseClaim(what + ": " + claim.what());
    }
    if (!refuted.empty()) throw FalseClaim(what + ": " + refuted + " does not vanish");
  }

  /// Whatever changes its sign between two poses vanishes there, where |A| does not, an odd number of times.
  void require_named(const PoseRangeClaim::Mode& mode, const PoseSigns& before, const PoseSigns& behind,
                     const Rational& from, const Rational& to) const {
    for (std::size_t d = 0; d < mode.demands.size(); ++d) {
      const core::TaskDemand& demand = mode.demands[d];
      if (demand.bound || before.demands[d] * behind.demands[d] >= 0) continue;
      const Reaction reaction{demand.joint, demand.quantity};
      const auto count = std::count_if(mode.points.begin(), mode.points.end(), [&](const PoseRangeClaim::Point& point) {
        return point.at >= from && point.at <= to &&
               std::find(point.vanishing.begin(), point.vanishing.end(), reaction) != point.vanishing.end();
      });
      if (count % 2 == 0)
        throw FalseClaim(fmt::format("points: {}_{} vanishes at {}, and {} name it", core::to_string(demand.quantity),
                                     demand.joint, place(from, to), count));
    }
  }

  const Mechanism& m_;
  const PoseRangeClaim& claim_;
  const Deadline& deadline_;
  Examination& examination_;
  GroupPlaces shown_;  ///< of the mode
  Rational lower_, upper_;
  int sense_ = 0;  ///< of the certificate's |A| and that of here
};

}  // namespace

void check_pose_range(const Mechanism& m, const PoseRangeClaim& claim, const Deadline& deadline,
                      Examination& examination) {
  PoseRangeCheck(m, claim, deadline, examination).run();
  examination.accepted = true;
}

}  // namespace clearloci::check
