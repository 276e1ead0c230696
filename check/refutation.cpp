#include "check/refutation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>

#include "check/certificate.hpp"
#include "check/pose_task.hpp"
#include "mechanism/joint_traits.hpp"

namespace clearloci::check {
namespace {

using core::Expression;
using core::Rational;
using mechanism::Joint;
using mechanism::Mechanism;

std::string name_of(const core::TaskDemand& demand) { return core::to_string(demand.quantity) + "_" + demand.joint; }

std::string quoted(const std::string& name) { return "'" + name.substr(0, 40) + "'"; }

class RefutationCheck {
 public:
  RefutationCheck(const Mechanism& m, const PoseTaskClaim& claim, const Deadline& deadline, Examination& examination)
      : m_(m), claim_(claim), own_(*claim.refutation), deadline_(deadline), examination_(examination) {}

  void run() {
    if (!claim_.parameters.empty() || !claim_.loads_from.empty() || claim_.law)
      throw FalseClaim("refutation: of tolerances, of loads from and to, or with a law");
    check_efforts();
    for (const Refutation::Pattern& pattern : own_.patterns)
      for (const auto& [name, sign] : pattern.signs)
        if (!is_demanded(name) && !is_own_backlash(name))
          throw FalseClaim("refutation: no sign of " + quoted(name) + " is asked for");
    require_all({});
    for (const Refutation::Pattern& pattern : own_.patterns) check(pattern);
  }

 private:
  /// Every effort that may be chosen, in all of its range.
  void check_efforts() {
    const std::set<std::string> motors = free_motors(), named(own_.joints.begin(), own_.joints.end());
    const bool all = std::includes(named.begin(), named.end(), motors.begin(), motors.end());
    const bool no_others = std::all_of(named.begin(), named.end(), [&](const std::string& name) {
      return motors.count(name) > 0 || mechanism::is_cable(joint_named(name));
    });
    if (named.empty() || !all || !no_others || named.size() != own_.joints.size() ||
        own_.ranges.size() != own_.joints.size())
      throw FalseClaim("refutation: its efforts are not the free ones of the model");
    for (std::size_t k = 0; k < own_.joints.size(); ++k) {
      const Joint& joint = joint_named(own_.joints[k]);
      const auto& within = mechanism::is_cable(joint) ? joint.within : joint.free_effort->within;
      const auto& [lower, upper] = own_.ranges[k];
      if (lower > upper || (!within && lower == upper))
        throw FalseClaim("refutation: the range of the effort of " + own_.joints[k] + " is empty");
      if (within && (lower > within->first || upper < within->second))
        throw FalseClaim("refutation: the effort of " + own_.joints[k] + " may be beyond its range");
      if (!within)
        examination_.unchecked.push_back(
            fmt::format("task: efforts of {} beyond {:.6g} to {:.6g}", own_.joints[k], lower.get_d(), upper.get_d()));
    }
  }

  /// Of motors, and of the cables that the model leaves free.
  std::set<std::string> held_efforts() const {
    std::set<std::string> held;
    for (const Joint& joint : m_.joints)
      if (joint.free_effort && !joint.free_effort->given) held.insert(joint.name);
    return held;
  }

  std::set<std::string> free_motors() const {
    std::set<std::string> motors = held_efforts();
    std::erase_if(motors, [&](const std::string& name) { return mechanism::is_cable(joint_named(name)); });
    return motors;
  }

  /// The mechanism with the efforts of a pattern as those that are chosen. Of cables they are as many as are free.
  Mechanism mechanism_of(const Refutation::Pattern& pattern) const {
    const std::set<std::string> named(pattern.joints.begin(), pattern.joints.end()), motors = free_motors();
    const bool known = std::all_of(named.begin(), named.end(), [&](const std::string& name) {
      return std::find(own_.joints.begin(), own_.joints.end(), name) != own_.joints.end();
    });
    if (!known || named.size() != pattern.joints.size() ||
        !std::includes(named.begin(), named.end(), motors.begin(), motors.end()))
      throw FalseClaim("refutation: the efforts of a pattern are not those that may be chosen");
    // Where one choice is for several poses or loads, which tensions are held while others follow is of the model.
    const bool held = !own_.controlled || (!own_.knows_load && !claim_.loads_within.empty());
    if (held && named != held_efforts())
      throw FalseClaim("refutation: the efforts of a pattern are not those that the model holds");
    Mechanism m = m_;
    choose_cables(m, pattern.joints);
    return m;
  }

  const Joint& joint_named(const std::string& name) const {
    const auto found =
        std::find_if(m_.joints.begin(), m_.joints.end(), [&](const Joint& joint) { return joint.name == name; });
    if (found == m_.joints.end()) throw FalseClaim("refutation: the model has no joint " + quoted(name));
    return *found;
  }

  const core::TaskDemand* demand_named(const std::string& name) const {
    const auto found = std::find_if(claim_.demands.begin(), claim_.demands.end(),
                                    [&](const core::TaskDemand& demand) { return name_of(demand) == name; });
    return found == claim_.demands.end() ? nullptr : &*found;
  }
  bool is_demanded(const std::string& name) const { return demand_named(name) != nullptr; }

  /// Of an actuator of free effort that has play itself: its effort may not vanish.
  bool is_own_backlash(const std::string& name) const {
    return std::any_of(own_.joints.begin(), own_.joints.end(), [&](const std::string& candidate) {
      const Joint& joint = joint_named(candidate);
      return joint.clearance && ((name == "M_" + candidate && !joint.clearance->angular.is_zero_literal()) ||
                                 (name == "F_" + candidate && !joint.clearance->axial.is_zero_literal()));
    });
  }

  /// Whatever signs reactions have, some pattern has them.
  void require_all(const std::map<std::string, int>& signs) const {
    const auto has = [&](const auto& candidate) {
      const auto found = signs.find(candidate.first);
      return found != signs.end() && found->second == candidate.second;
    };
    const auto conflicts = [&](const auto& candidate) {
      const auto found = signs.find(candidate.first);
      return found != signs.end() && found->second != candidate.second;
    };
    for (const Refutation::Pattern& pattern : own_.patterns)
      if (std::all_of(pattern.signs.begin(), pattern.signs.end(), has)) return;
    for (const Refutation::Pattern& pattern : own_.patterns) {
      if (std::any_of(pattern.signs.begin(), pattern.signs.end(), conflicts)) continue;
      const auto next = std::find_if_not(pattern.signs.begin(), pattern.signs.end(), has);
      for (const int sign : {1, -1}) {
        std::map<std::string, int> more = signs;
        more[next->first] = sign;
        require_all(more);
      }
      return;
    }
    throw FalseClaim("refutation: patterns of signs are missing");
  }

  void check(const Refutation::Pattern& pattern) {
    const Mechanism m = mechanism_of(pattern);
    Interval offset(cell_bits);
    std::vector<Interval> slopes(pattern.joints.size(), Interval(cell_bits));
    const Refutation::Row* first = nullptr;
    for (const Refutation::Row& row : pattern.rows) {
      if (row.multiplier <= 0) throw FalseClaim("refutation: a multiplier is not positive");
      if (row.at.empty() && row.bound) continue;  // the ranges
      if (!row.bound) require_sign(pattern, row);
      if (!row.at.empty()) {
        require_place(row);
        const bool same = first == nullptr || (row.at == first->at && (!own_.knows_load || row.load == first->load));
        if (own_.controlled && !same) throw FalseClaim("refutation: efforts that vary are refuted at one pose");
        first = &row;
      }
      add(m, pattern.joints, row, offset, slopes);
    }
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      const auto place = std::find(own_.joints.begin(), own_.joints.end(), pattern.joints[k]);
      const auto& [lower, upper] = own_.ranges[static_cast<std::size_t>(place - own_.joints.begin())];
      const Interval at_lower = slopes[k] * Interval(lower, cell_bits),
                     at_upper = slopes[k] * Interval(upper, cell_bits);
      offset = offset + (at_lower.upper() > at_upper.upper() ? at_lower : at_upper);
    }
    if (!offset.below()) throw FalseClaim("refutation: the rows of a pattern do not exclude each other");
    ++examination_.refuted_patterns;
  }

  static void require_sign(const Refutation::Pattern& pattern, const Refutation::Row& row) {
    const auto sign = pattern.signs.find(row.reaction);
    if (sign == pattern.signs.end() || sign->second != row.sign)
      throw FalseClaim("refutation: a row of " + quoted(row.reaction) + " is not of its pattern");
  }

  void require_place(const Refutation::Row& row) const {
    if (row.at.size() != m_.coordinates.size() || !may_be_pose_of(m_, claim_, row.at))
      throw FalseClaim("refutation: a pose is not one of the task");
    std::size_t part = 0;
    const auto take = [&](std::size_t count, const Rational& radius) {
      Rational square = 0;
      for (; count > 0; --count, ++part) {
        if (part >= row.load.size()) throw FalseClaim("refutation: a load has too few parts");
        square += row.load[part] * row.load[part];
      }
      const Rational most = radius * Rational(1'000'000'000'001, 1'000'000'000'000);  // for its roundings
      if (square > most * most) throw FalseClaim("refutation: a load is not in its range");
    };
    for (const PoseTaskClaim::LoadWithin& load_range : claim_.loads_within) {
      if (load_range.load >= m_.loads.size()) throw FalseClaim("loads: the model has no such force");
      if (load_range.force > 0) take(m_.loads[load_range.load].force.size(), load_range.force);
      if (load_range.couple > 0) take(1, load_range.couple);
    }
    if (part != row.load.size()) throw FalseClaim("refutation: a load has too many parts");
  }

  void add(const Mechanism& m, const std::vector<std::string>& joints, const Refutation::Row& row, Interval& offset,
           std::vector<Interval>& slopes) {
    const Interval y(row.multiplier, cell_bits), factor(Rational(row.sign * row.multiplier), cell_bits);
    const core::TaskDemand* const demand = demand_named(row.reaction);
    const Rational least = demand == nullptr ? Rational(0) : demand->least;
    if (row.at.empty()) {
      const auto k = std::find_if(joints.begin(), joints.end(), [&](const std::string& joint) {
        return row.reaction == "M_" + joint || row.reaction == "F_" + joint;
      });
      if (k == joints.end() || !is_own_backlash(row.reaction))
        throw FalseClaim("refutation: a row of no effort with play");
      Interval& slope = slopes[static_cast<std::size_t>(k - joints.begin())];
      slope = slope + factor;
      offset = offset - y * Interval(least, cell_bits);
      return;
    }
    core::TaskDemand wanted;
    if (demand != nullptr) wanted = *demand;
    Rational from = row.sign * least;
    if (row.bound) std::tie(wanted, from) = bounded(m, row);
    const auto under = [&](const std::string& effort) {
      return reaction(with_efforts(m, joints, effort), row, wanted);
    };
    const Interval start = under("");
    offset = offset + factor * (start - Interval(from, cell_bits));
    for (std::size_t k = 0; k < slopes.size(); ++k) slopes[k] = slopes[k] + factor * (under(joints[k]) - start);
  }

  /// What keeps to a bound of the model's, and the bound.
  static std::pair<core::TaskDemand, Rational> bounded(const Mechanism& m, const Refutation::Row& row) {
    for (const Joint& joint : m.joints)
      for (const core::Quantity quantity : {core::Quantity::M, core::Quantity::F}) {
        core::TaskDemand demand;
        demand.joint = joint.name;
        demand.quantity = quantity;
        if (name_of(demand) != row.reaction) continue;
        const auto& within = joint.within;
        if (joint.actuated && within) return {demand, row.sign > 0 ? within->first : within->second};
      }
    throw FalseClaim("refutation: " + quoted(row.reaction) + " has no bounds");
  }

  /// With all free efforts 0 but for the one that is named, which is 1.
  static Mechanism with_efforts(Mechanism m, const std::vector<std::string>& joints, const std::string& one) {
    for (const std::string& name : joints)
      for (Joint& joint : m.joints)
        if (joint.name == name) joint.effort = Expression::number(name == one ? 1 : 0);
    return m;
  }

  Interval reaction(Mechanism m, const Refutation::Row& row, const core::TaskDemand& demand) {
    std::size_t part = 0;
    const auto add_to = [&](Expression& expression) {
      expression = Expression::apply(Expression::Kind::add, {expression, Expression::number(row.load.at(part++))});
    };
    for (const PoseTaskClaim::LoadWithin& load_range : claim_.loads_within) {
      if (load_range.force > 0)
        for (Expression& component : m.loads[load_range.load].force) add_to(component);
      if (load_range.couple > 0) add_to(m.loads[load_range.load].couple);
    }
    PoseTaskClaim place = claim_;
    place.shape = {};
    place.shape.name = "box";
    place.shape.points = {row.at, row.at};
    place.loads_within.clear();
    place.demands = {demand};
    const auto components = reactions_at(m, place, deadline_, shown_);
    ++examination_.task_cells;
    if (components.size() != 1 || components.front().size() != 1)
      throw FalseClaim("refutation: " + quoted(row.reaction) + " is not known, or has several components");
    return {components.front().front()[0], components.front().front()[1], cell_bits};
  }

  const Mechanism& m_;
  const PoseTaskClaim& claim_;
  const Refutation& own_;
  const Deadline& deadline_;
  Examination& examination_;
  GroupPlaces shown_;
};

}  // namespace

void check_refutation(const Mechanism& m, const PoseTaskClaim& claim, const Deadline& deadline,
                      Examination& examination) {
  RefutationCheck(m, claim, deadline, examination).run();
  examination.accepted = true;
}

}  // namespace clearloci::check
