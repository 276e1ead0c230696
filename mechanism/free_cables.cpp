#include "mechanism/free_cables.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/posture_sample.hpp"
#include "mechanism/reader.hpp"
#include "mechanism/redundancy.hpp"

namespace clearloci::mechanism {
namespace {

/// The balances at a pose in which all cables are columns.
struct Balances {
  Matrix matrix;
  std::vector<JointIndex> cable;  ///< of every column; -1: of another joint
};

/// `known`: cables whose tension is given, and which are none.
std::optional<Balances> balances_at(Mechanism m, const std::vector<JointIndex>& chosen,
                                    const std::vector<double>& pose) {
  set_free_cables(m, chosen);
  const auto columns = reactions_at(m, pose);
  if (!columns) return std::nullopt;
  std::vector<std::array<double, 3>> places;
  for (const auto& place : sample_points(m, pose)) {
    if (!place) return std::nullopt;
    places.push_back(*place);
  }
  Balances balances{balances_of(m, *columns, places), {}};
  for (const BorneReaction& column : *columns)
    balances.cable.push_back(column.motor && is_cable(m.joints[static_cast<std::size_t>(column.joint)]) ? column.joint
                                                                                                        : -1);
  return balances;
}

/// Gauss and Jordan over a part of the columns, the largest pivot next. Columns that are taken; fewer than rows where
/// the part does not hold the mechanism.
class Pivots {
 public:
  explicit Pivots(Matrix matrix) : a_(std::move(matrix)), taken_(a_.empty() ? 0 : a_.front().size()) {}

  /// Until no pivot is left among the columns that `among` is true for.
  template <class Among>
  void take(const Among& among) {
    constexpr double rounding = 1e-9;
    for (; done_ < a_.size(); ++done_) {
      std::size_t row = done_, column = taken_.size();
      double best = rounding;
      for (std::size_t i = done_; i < a_.size(); ++i)
        for (std::size_t j = 0; j < taken_.size(); ++j)
          if (!taken_[j] && among(j) && std::abs(a_[i][j]) > best) best = std::abs(a_[row = i][column = j]);
      if (column == taken_.size()) return;
      std::swap(a_[done_], a_[row]);
      taken_[column] = true;
      for (std::size_t i = done_ + 1; i < a_.size(); ++i) {
        const double factor = a_[i][column] / a_[done_][column];
        for (std::size_t j = 0; j < taken_.size() && factor != 0; ++j) a_[i][j] -= factor * a_[done_][j];
      }
    }
  }

  bool complete() const { return done_ == a_.size(); }
  bool is_taken(std::size_t column) const { return taken_[column]; }

 private:
  Matrix a_;
  std::vector<bool> taken_;
  std::size_t done_ = 0;
};

}  // namespace

std::vector<JointIndex> cables_of(const Mechanism& mechanism) {
  std::vector<JointIndex> all;
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    if (is_cable(mechanism.joints[j])) all.push_back(static_cast<JointIndex>(j));
  return all;
}

void set_free_cables(Mechanism& mechanism, const std::vector<JointIndex>& free) {
  for (const JointIndex j : cables_of(mechanism)) {
    Joint& joint = mechanism.joints[static_cast<std::size_t>(j)];
    const std::string parameter = free_effort_parameter(joint.name);
    const auto has_name = [&](const Parameter& candidate) { return candidate.name == parameter; };
    const bool is_free = std::find(free.begin(), free.end(), j) != free.end();
    if (is_free == joint.effort.has_value()) continue;
    joint.actuated = !is_free;
    if (is_free) {
      joint.free_effort = FreeEffort{parameter, joint.within};
      joint.effort = Expression::symbol(parameter);
      if (std::any_of(mechanism.parameters.begin(), mechanism.parameters.end(), has_name)) continue;
      Parameter tension;
      tension.name = parameter;
      tension.expression = Expression::number(0);
      tension.dimension.force = 1;
      mechanism.parameters.push_back(std::move(tension));
    } else {
      joint.free_effort.reset();
      joint.effort.reset();
      std::erase_if(mechanism.parameters, has_name);
    }
  }
}

std::optional<std::vector<JointIndex>> best_free_cables(const Mechanism& mechanism, const std::vector<double>& pose) {
  std::vector<JointIndex> chosen;
  for (const JointIndex j : cables_of(mechanism))
    if (const Joint& joint = mechanism.joints[static_cast<std::size_t>(j)];
        joint.effort && (!joint.free_effort || joint.free_effort->given))
      chosen.push_back(j);
  const auto balances = balances_at(mechanism, chosen, pose);
  if (!balances) return std::nullopt;
  Pivots pivots(balances->matrix);
  pivots.take([&](std::size_t column) { return balances->cable[column] < 0; });
  pivots.take([](std::size_t) { return true; });
  if (!pivots.complete()) return std::nullopt;
  std::vector<JointIndex> free = chosen;
  for (std::size_t c = 0; c < balances->cable.size(); ++c)
    if (!pivots.is_taken(c) && balances->cable[c] >= 0) free.push_back(balances->cable[c]);
  return free;
}

namespace {

void choose_free(Mechanism& mechanism, const std::vector<std::string>& preferred) {
  const std::size_t rows = equations_per_link(mechanism) * mechanism.links.size(), columns = unknowns(mechanism).size();
  std::vector<JointIndex> order = cables_of(mechanism);
  if (columns <= rows || order.empty()) return;
  std::reverse(order.begin(), order.end());
  std::stable_partition(order.begin(), order.end(), [&](JointIndex j) {
    const std::string name = free_effort_parameter(mechanism.joints[static_cast<std::size_t>(j)].name);
    return std::find(preferred.begin(), preferred.end(), name) != preferred.end();
  });
  constexpr std::size_t poses = 64;
  for (const std::vector<double>& pose : spread_poses(mechanism, poses)) {
    const auto balances = balances_at(mechanism, {}, pose);
    if (!balances) continue;
    std::vector<JointIndex> free;
    for (const JointIndex j : order) {
      if (free.size() == columns - rows) break;
      free.push_back(j);
      Pivots pivots(balances->matrix);
      pivots.take([&](std::size_t column) {
        return std::find(free.begin(), free.end(), balances->cable[column]) == free.end();
      });
      if (!pivots.complete()) free.pop_back();
    }
    if (free.size() < columns - rows) continue;
    std::sort(free.begin(), free.end());
    return set_free_cables(mechanism, free);
  }
}

}  // namespace

void choose_free_cables(Mechanism& mechanism, const std::vector<std::string>& preferred) {
  choose_free(mechanism, preferred);
  for (const JointIndex j : cables_of(mechanism))
    if (const Joint& joint = mechanism.joints[static_cast<std::size_t>(j)];
        !joint.effort &&
        std::find(preferred.begin(), preferred.end(), free_effort_parameter(joint.name)) != preferred.end())
      throw core::InputError({.file = "--preload"}, "the tension of cable " + joint.name + " follows from the others",
                             "give as many tensions as there are cables more than freedoms");
}

void hold_point_masses(Mechanism& mechanism) {
  for (std::size_t l = 0; l < mechanism.links.size(); ++l) {
    const auto link = static_cast<LinkIndex>(l);
    const Link& link_data = mechanism.links[l];
    Joint* first = nullptr;
    bool only_cables = link_data.points.size() == 1;
    for (Joint& joint : mechanism.joints) {
      if (joint.from != link && joint.to != link) continue;
      const PointIndex end = joint.to == link ? joint.at : joint.other_end;
      only_cables = only_cables && is_cable(joint) && end == link_data.points.front();
      if (first == nullptr) first = &joint;
    }
    if (!only_cables || first == nullptr) continue;
    const auto refuse = [&](const core::SourcePosition& where, const std::string& what) {
      throw core::InputError(where, what + " turns link " + link_data.name + ", which cables hold at one point",
                             "let forces act at its point, or give the link two points that cables pull at");
    };
    for (const Load& load : mechanism.loads) {
      if (load.link != link) continue;
      const bool couple =
          !load.couple.is_zero_literal() || std::any_of(load.couple_vector.begin(), load.couple_vector.end(),
                                                        [](const Expression& e) { return !e.is_zero_literal(); });
      if (couple || (load.at && *load.at != link_data.points.front())) refuse(load.where, "a load");
    }
    for (const Spring& spring : mechanism.springs)
      if ((spring.from == link && spring.from_point != link_data.points.front()) ||
          (spring.to == link && spring.to_point != link_data.points.front()))
        refuse(spring.where, "spring " + spring.name);
    for (const Mass& mass : masses(mechanism))
      if (!mechanism.gravity.empty() && mass.link == link && mass.at != link_data.points.front())
        refuse(link_data.where, "its weight");
    first->holds_turning = true;
  }
}

}  // namespace clearloci::mechanism
