#include "check/pose_task.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "check/certificate.hpp"
#include "check/constants.hpp"
#include "check/elimination.hpp"
#include "check/law_cells.hpp"
#include "check/pose_cell.hpp"
#include "check/pose_signs.hpp"
#include "core/errors.hpp"
#include "mechanism/free_cables.hpp"

namespace clearloci::check {
namespace {

using core::Expression;
using core::Rational;
using mechanism::Mechanism;

const char* const way_of_load = "way of the load";  // no name of a file

Expression sum(const Expression& a, const Expression& b) { return Expression::apply(Expression::Kind::add, {a, b}); }
Expression product(const Expression& a, const Expression& b) {
  return Expression::apply(Expression::Kind::multiply, {a, b});
}

std::vector<std::array<Jet, 3>> places_of(const std::optional<GroupCell>& groups) {
  return groups ? groups->places : std::vector<std::array<Jet, 3>>();
}

int determinant_sign(const PoseEquations& equations) {
  std::vector<std::vector<Interval>> rows(equations.unknowns,
                                          std::vector<Interval>(equations.unknowns, Interval(cell_bits)));
  for (const PoseEntry& entry : equations.matrix) {
    Interval& row = rows[entry.row][entry.unknown];
    row = row + entry.value.value();
  }
  Interval determinant(1.0, cell_bits);
  return reduce(rows, rows.size(), determinant).size() < rows.size() ? 0 : determinant.sign();
}

class PoseTaskCheck {
 public:
  using Efforts = PoseTaskClaim::Law::Efforts;

  /// `part`: of a law, poses at which the efforts are some of these, or any between them.
  PoseTaskCheck(const Mechanism& m, const PoseTaskClaim& claim, const Deadline& deadline, GroupPlaces& shown,
                const Cell* part = nullptr, const std::vector<Efforts>& efforts = {})
      : m_(m),
        claim_(claim),
        deadline_(deadline),
        shown_(shown),
        coordinates_(claim.coordinates.size()),
        names_(claim.coordinates) {
    check_names();
    region_.emplace(region());
    whole_ = region_->whole();
    for (const PoseTaskClaim::Range& parameter : claim.parameters)
      add_variable(parameter.parameter, parameter.lower, parameter.upper);
    if (!claim.loads_from.empty()) turn_load();
    for (const PoseTaskClaim::LoadWithin& load_range : claim.loads_within) widen_load(load_range);
    fold_constants(m_, Varying(m_, names_));
    if (part != nullptr) std::copy(part->begin(), part->end(), whole_.begin());
    for (const Efforts& one : efforts) choices_.push_back(with_efforts(one));
    if (efforts.empty()) choices_.push_back(m_);
  }

  std::size_t run(Holding holding = Holding::clear) {
    holding_ = holding;
    close_groups();
    if (!groups_) return covered_within(whole_, nullptr);
    std::size_t cells = 0;
    for (const GroupSheet::Part& part : groups_->parts()) {
      Cell within = whole_;
      std::copy(part.cell.begin(), part.cell.end(), within.begin());
      cells += covered_within(within, &part);
    }
    return cells;
  }

  /// Lengths within links do not change with the pose, at a pose of the task and two beside it.
  void check_links() {
    close_groups();
    for (const double share : {0.5, 0.3819, 0.7071}) {
      const GroupSheet::Part* part = nullptr;
      if (groups_)
        part = &groups_->parts()[static_cast<std::size_t>(share * static_cast<double>(groups_->parts().size()))];
      Cell cell = whole_;
      if (part != nullptr) std::copy(part->cell.begin(), part->cell.end(), cell.begin());
      for (auto& side : cell) side[0] = side[1] = side[0] + share * (side[1] - side[0]);
      Jet::Offsets offsets;
      const PoseVariables variables = variables_over(names_, cell, offsets);
      std::vector<double> spreads(names_.size());
      std::optional<GroupCell> groups;
      if (part != nullptr && !(groups = groups_->over(*part, variables, offsets, spreads))) continue;
      const PosePosture posture = posture_over(m_, claim_.sides, variables, places_of(groups));
      if (posture.stopped_by) continue;  // the cells tell
      for (const mechanism::Link& link : m_.links) check_link(link, posture);
    }
  }

  PoseSigns signs() {
    PosePosture posture;
    PoseSigns all;
    const PoseCellProof proof = proof_at_pose(posture, all.determinant);
    all.demands.assign(claim_.demands.size(), 0);
    for (std::size_t d = 0; d < proof.components.size(); ++d)
      all.demands[d] = sign_of(m_, claim_.demands[d], proof.components[d], posture);
    return all;
  }

  std::vector<std::vector<std::array<double, 2>>> reactions() {
    PosePosture posture;
    int determinant = 0;
    PoseCellProof proof = proof_at_pose(posture, determinant);
    if (!proof.regular) throw FalseClaim("singular: that a pose is not is not shown");
    return std::move(proof.components);
  }

 private:
  /// At a pose that is all of the task.
  PoseCellProof proof_at_pose(PosePosture& posture, int& determinant) {
    close_groups();
    std::vector<double> spreads(names_.size());
    Jet::Offsets offsets;
    const PoseVariables variables = variables_over(names_, whole_, offsets);
    std::optional<GroupCell> groups;
    if (groups_ && !(groups = groups_->over(groups_->parts().front(), variables, offsets, spreads)))
      throw FalseClaim("groups: that they close at a pose is not shown");
    posture = posture_over(m_, claim_.sides, variables, places_of(groups));
    if (posture.stopped_by)
      throw FalseClaim("within reach: it is not shown of the pose " + described(whole_, claim_.coordinates));
    const std::vector<PoseEquations> equations = {equations_over(m_, posture, variables, claim_.demands)};
    determinant = determinant_sign(equations.front());
    // What the posture is made of points to the offsets.
    for (auto& place : posture.points)
      for (Jet& jet : place) jet = Jet(jet.value());
    return prove_cell(equations, claim_.demands, offsets);
  }

 public:
  double maybe_reached() const {
    double open = 0;
    constexpr std::size_t most = 4000;
    constexpr double finest = 0x1p-26;
    std::vector<Cell> left = {whole_};
    for (std::size_t count = 0; !left.empty(); ++count) {
      const Cell cell = std::move(left.back());
      left.pop_back();
      if (is_out_of_reach(cell)) continue;
      const auto [low, high] = cell.front();
      if (count >= most || !m_.groups.empty() || high - low <= finest * (whole_[0][1] - whole_[0][0])) {
        open += high - low;
        continue;
      }
      const double middle = low + 0.5 * (high - low);
      left.push_back({{middle, high}});
      left.push_back({{low, middle}});
    }
    return open;
  }

  /// The poses of the task and its margin.
  Cell poses() const { return {whole_.begin(), whole_.begin() + static_cast<std::ptrdiff_t>(coordinates_)}; }
  const TaskRegion& task() const { return *region_; }

 private:
  std::size_t covered_within(const Cell& whole, const GroupSheet::Part* part) {
    return covered(
        whole, names_, [&](const Cell& cell) { return region_->is_apart(cell) || is_beyond_balls(cell); },
        [&](const Cell& cell, std::vector<double>& spreads) { return holds(cell, part, spreads); }, deadline_);
  }

  /// A pose of the task.
  std::vector<double> pose_inside() const {
    std::vector<double> pose;
    const auto& points = claim_.shape.points;
    for (std::size_t c = 0; c < coordinates_; ++c) {
      const bool box = claim_.shape.name == "box";
      pose.push_back((box ? Rational((points[0][c] + points[1][c]) / 2) : points[0][c]).get_d());
    }
    return pose;
  }

  /// Over the coordinates and the parameters that vary; loads do nothing to them.
  void close_groups() {
    if (m_.groups.empty() || groups_) return;
    const auto count = static_cast<std::ptrdiff_t>(coordinates_ + claim_.parameters.size());
    groups_.emplace(
        m_, claim_.sides, std::vector<std::string>(names_.begin(), names_.begin() + count),
        Cell(whole_.begin(), whole_.begin() + count), pose_inside(),
        [&](const Cell& cell) { return region_->is_apart(cell); }, deadline_, shown_);
  }

  void check_names() const {
    if (m_.coordinates.size() != coordinates_ || coordinates_ == 0)
      throw FalseClaim("coordinates: they are not the model's");
    for (std::size_t c = 0; c < coordinates_; ++c)
      if (m_.coordinates[c].name != claim_.coordinates[c]) throw FalseClaim("coordinates: they are not the model's");
    if (claim_.sides.size() != mechanism::dyad_points(m_).size())
      throw FalseClaim("sides: there is not one for every dyad and slider");
    for (const PoseTaskClaim::Range& range : claim_.parameters) {
      const auto found = std::find_if(m_.parameters.begin(), m_.parameters.end(),
                                      [&](const auto& parameter) { return parameter.name == range.parameter; });
      if (found == m_.parameters.end() || !(range.lower <= found->value && found->value <= range.upper))
        throw FalseClaim("parameters: '" + range.parameter.substr(0, 40) +
                         "' is none of the model's, or not in its range");
    }
    for (const auto& point : claim_.shape.points)
      for (std::size_t c = 0; c < coordinates_; ++c) {
        const Rational above = claim_.shape.above.empty() ? Rational(0) : claim_.shape.above[c];
        if (point[c] < m_.coordinates[c].lower || point[c] + above > m_.coordinates[c].upper)
          throw FalseClaim("task: it leaves the workspace of the model");
      }
  }

  TaskRegion region() const {
    std::vector<double> weights;
    std::vector<bool> grows;
    const bool any_length = std::any_of(m_.coordinates.begin(), m_.coordinates.end(),
                                        [](const auto& coordinate) { return !coordinate.angle; });
    for (const mechanism::Coordinate& coordinate : m_.coordinates) {
      const bool counted = coordinate.angle && claim_.angle_length;
      weights.push_back(counted ? around(*claim_.angle_length)[0] : 1.0);
      grows.push_back(!coordinate.angle || counted || !any_length);
    }
    return {claim_.shape, std::move(weights), std::move(grows)};
  }

  void add_variable(const std::string& name, const Rational& lower, const Rational& upper) {
    names_.push_back(name);
    whole_.push_back({around(lower)[0], around(upper)[1]});
  }

  /// (1 - t) first + t last instead of the force of the load, t from 0 to 1.
  void turn_load() {
    const auto& [first, last] = std::tie(claim_.loads_from.front(), claim_.loads_from.back());
    if (m_.loads.size() != 1 || claim_.loads_from.size() != 2 || m_.loads[0].force_vector ||
        first.size() != m_.loads[0].force.size() || last.size() != first.size())
      throw FalseClaim("loads: the model has no such force");
    const Expression way = Expression::symbol(way_of_load);
    for (std::size_t c = 0; c < first.size(); ++c)
      m_.loads[0].force[c] = sum(Expression::number(first[c]), product(Expression::number(last[c] - first[c]), way));
    add_variable(way.name(), 0, 1);
  }

  /// Parts of the force, and of a couple, that are variables in a ball.
  void widen_load(const PoseTaskClaim::LoadWithin& within) {
    if (within.load >= m_.loads.size() || within.force < 0 || within.couple < 0 ||
        (within.force > 0 && m_.loads[within.load].force.empty()))
      throw FalseClaim("loads: the model has no such force");
    mechanism::Load& load = m_.loads[within.load];
    std::vector<Expression*> force;
    for (Expression& part : load.force) force.push_back(&part);
    if (within.force > 0) add_ball(force, within.force);
    if (within.couple > 0) add_ball(load.couple_parts(m_.space), within.couple);
  }

  Mechanism with_efforts(const Efforts& efforts) const {
    Mechanism given = m_;
    choose_cables(given, efforts.joints);
    for (std::size_t j = 0; j < efforts.joints.size(); ++j) {
      const std::string& name = efforts.joints[j];
      const auto joint = std::find_if(given.joints.begin(), given.joints.end(),
                                      [&](const auto& candidate) { return candidate.name == name; });
      if (joint == given.joints.end() || !joint->free_effort || joint->free_effort->given)
        throw FalseClaim("law: '" + name.substr(0, 40) + "' has no free effort");
      joint->effort = effort_of(efforts, j);
      require_bounds(*joint, efforts, j);
    }
    return given;
  }

  /// As it depends on what is known of the load.
  Expression effort_of(const Efforts& efforts, std::size_t joint) const {
    Expression effort = Expression::number(efforts.at_loads.front()[joint]);
    if (efforts.at_loads.size() > 1) {
      if (claim_.loads_from.empty()) throw FalseClaim("law: it depends on a load that does not vary");
      const Rational more = efforts.at_loads.back()[joint] - efforts.at_loads.front()[joint];
      effort = sum(effort, product(Expression::number(more), Expression::symbol(way_of_load)));
    }
    std::vector<std::string> parts;
    for (const LoadBall& ball : balls_)
      for (std::size_t c = 0; c < ball.count; ++c) parts.push_back(names_[ball.first + c]);
    if (!efforts.gains.empty() && efforts.gains.size() != parts.size())
      throw FalseClaim("law: it depends on a load that does not vary");
    for (std::size_t c = 0; c < efforts.gains.size(); ++c)
      effort = sum(effort, product(Expression::number(efforts.gains[c][joint]), Expression::symbol(parts[c])));
    return effort;
  }

  static void require_bounds(const mechanism::Joint& joint, const Efforts& efforts, std::size_t j) {
    if (!joint.free_effort->within) return;
    for (const auto& values : efforts.at_loads)
      if (values[j] < joint.free_effort->within->first || values[j] > joint.free_effort->within->second)
        throw FalseClaim("law: the effort of " + joint.name + " is beyond its bounds");
  }

  void add_ball(const std::vector<Expression*>& parts, const Rational& radius) {
    balls_.push_back({names_.size(), parts.size()});
    for (Expression* const part : parts) {
      const std::string name = fmt::format("part {} of loads", names_.size());
      *part = sum(*part, Expression::symbol(name));
      add_variable(name, -radius, radius);
    }
  }

  /// No load of the cell is within the ball of its parts.
  bool is_beyond_balls(const Cell& cell) const {
    return std::any_of(balls_.begin(), balls_.end(), [&](const LoadBall& ball) {
      double square = 0;
      for (std::size_t c = ball.first; c < ball.first + ball.count; ++c)
        square += std::pow(std::max({0.0, cell[c][0], -cell[c][1]}), 2);
      return std::sqrt(square) * (1 - 1e-12) > whole_[ball.first][1];
    });
  }

  /// Those that the cell has the whole of.
  std::vector<LoadBall> balls_in(const Cell& cell) const {
    std::vector<LoadBall> balls;
    for (const LoadBall& ball : balls_) {
      const auto first = static_cast<std::ptrdiff_t>(ball.first),
                 last = first + static_cast<std::ptrdiff_t>(ball.count);
      if (std::equal(cell.begin() + first, cell.begin() + last, whole_.begin() + first)) balls.push_back(ball);
    }
    return balls;
  }

  /// `part`: that the cell is in, of a mechanism with groups.
  bool holds(const Cell& cell, const GroupSheet::Part* part, std::vector<double>& spreads) const {
    Jet::Offsets offsets;
    const PoseVariables variables = variables_over(names_, cell, offsets);
    std::optional<GroupCell> groups;
    if (part != nullptr && !(groups = groups_->over(*part, variables, offsets, spreads))) return false;
    const PosePosture posture = posture_over(m_, claim_.sides, variables, places_of(groups));
    if (posture.stopped_by) {
      const std::vector<Interval>& slopes = posture.stopped_by->slopes();
      for (std::size_t c = 0; c < slopes.size(); ++c)
        if (slopes[c].is_finite()) spreads[c] = std::abs(slopes[c].middle()) * 0.5 * (cell[c][1] - cell[c][0]);
      return false;
    }
    if (holding_ == Holding::closure) return true;
    const std::vector<LoadBall> balls = balls_in(cell);
    std::vector<PoseEquations> equations;
    for (const Mechanism& choice : choices_)
      equations.push_back(equations_over(choice, posture, variables, claim_.demands));
    PoseCellProof proof = prove_cell(equations, claim_.demands, offsets, balls);
    spreads = std::move(proof.spreads);
    // A ball that is cut is no ball any more: poses are cut before.
    constexpr double last = 0.125;
    for (const LoadBall& ball : balls)
      for (std::size_t c = ball.first; c < ball.first + ball.count; ++c) spreads[c] *= last;
    return holding_ == Holding::regular ? proof.regular : proof.holds();
  }

  /// Nothing closes there, or a bound is broken; of mechanisms without groups.
  bool is_out_of_reach(const Cell& cell) const {
    if (!m_.groups.empty()) return false;
    Jet::Offsets offsets;
    const PoseVariables variables = variables_over(names_, cell, offsets);
    const PosePosture posture = posture_over(m_, claim_.sides, variables);
    if (posture.stopped_by) return posture.stopped_by->value().below();
    const PoseCellProof proof = prove_cell({equations_over(m_, posture, variables, {})}, {}, offsets);
    return proof.regular && proof.broken;
  }

  void check_link(const mechanism::Link& link, const PosePosture& posture) const {
    for (std::size_t i = 0; i < link.points.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const auto &a = posture.points[static_cast<std::size_t>(link.points[i])],
                   &b = posture.points[static_cast<std::size_t>(link.points[j])];
        Jet square;
        for (std::size_t k = 0; k < a.size(); ++k) square = square + squared(a[k] - b[k]);
        constexpr double bending = 1e-15;
        for (std::size_t c = 0; c < coordinates_ && !square.is_constant(); ++c) {
          const double slope = std::max(std::abs(square.slopes()[c].lower()), std::abs(square.slopes()[c].upper()));
          if (!(slope <= bending * (1 + square.value().upper())))
            throw FalseClaim(fmt::format("links: a length of {} changes with the pose", link.name));
        }
      }
  }

  Mechanism m_;                     ///< with what its loads vary by
  std::vector<Mechanism> choices_;  ///< the same with each choice of efforts
  const PoseTaskClaim& claim_;
  const Deadline& deadline_;
  GroupPlaces& shown_;
  std::size_t coordinates_;
  std::vector<std::string> names_;  ///< of the coordinates, and of all that varies besides
  std::optional<TaskRegion> region_;
  Cell whole_;
  std::vector<LoadBall> balls_;
  std::optional<GroupSheet> groups_;
  Holding holding_ = Holding::clear;
};

/// The cells at the rim of the task end where it does, but for their roundings.
std::vector<Cell> up_to_rim(std::vector<Cell> cells, const Cell& whole) {
  constexpr double rounding = 1e-12;
  for (Cell& cell : cells)
    for (std::size_t c = 0; c < cell.size(); ++c)
      for (const std::size_t end : {0U, 1U})
        if (std::abs(cell[c][end] - whole[c][end]) <= rounding * (1 + std::abs(whole[c][end])))
          cell[c][end] = whole[c][end];
  return cells;
}

/// Each cell with its efforts, and each place that several cells hold with all that is between theirs.
std::size_t check_law(const Mechanism& m, const PoseTaskClaim& claim, const Deadline& deadline, GroupPlaces& shown,
                      const PoseTaskCheck& task) {
  const PoseTaskClaim::Law& law = *claim.law;
  const std::vector<Cell> cells = up_to_rim(law.cells, task.poses());
  require_cover(task.poses(), cells, claim.coordinates, [&](const Cell& cell) { return task.task().is_apart(cell); });
  std::size_t count = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
    count += PoseTaskCheck(m, claim, deadline, shown, &cells[i], {law.efforts[i]}).run();
  // Bounds of efforts that each of them keeps are kept between them.
  if (claim.demands.empty()) return count;
  for (const CommonPlace& place : common_places(cells)) {
    std::vector<PoseTaskClaim::Law::Efforts> efforts;
    for (const std::size_t i : place.cells)
      if (std::find(efforts.begin(), efforts.end(), law.efforts[i]) == efforts.end()) efforts.push_back(law.efforts[i]);
    if (efforts.size() > 1) count += PoseTaskCheck(m, claim, deadline, shown, &place.place, efforts).run();
  }
  return count;
}

}  // namespace

void choose_cables(Mechanism& m, const std::vector<std::string>& joints) {
  std::vector<mechanism::JointIndex> free;
  std::size_t before = 0, chosen = 0;
  for (const mechanism::JointIndex j : mechanism::cables_of(m)) {
    const mechanism::Joint& cable = m.joints[static_cast<std::size_t>(j)];
    const bool is_fixed = cable.effort && (!cable.free_effort || cable.free_effort->given);
    const bool is_chosen = std::find(joints.begin(), joints.end(), cable.name) != joints.end();
    if (is_fixed && is_chosen) throw FalseClaim("'" + cable.name + "' has no free effort");
    before += cable.effort && !is_fixed ? 1U : 0U;
    chosen += is_chosen ? 1U : 0U;
    if (is_fixed || is_chosen) free.push_back(j);
  }
  if (before != chosen) throw FalseClaim(fmt::format("{} cables have a free tension, not {}", before, chosen));
  mechanism::set_free_cables(m, free);
}

void check_pose_task(const Mechanism& m, const PoseTaskClaim& claim, const Deadline& deadline,
                     Examination& examination) {
  // Where efforts have bounds, that they keep to these is a claim.
  const bool bounded = std::any_of(m.joints.begin(), m.joints.end(), [](const mechanism::Joint& joint) {
    return joint.meshing || (joint.actuated && joint.within);
  });
  if (claim.demands.empty() && !bounded) throw FalseClaim("demands: there is none");
  if (claim.refutation) return check_refutation(m, claim, deadline, examination);
  GroupPlaces shown;
  PoseTaskCheck check(m, claim, deadline, shown);
  check.check_links();
  examination.task_cells = claim.law ? check_law(m, claim, deadline, shown, check) : check.run();
  examination.unchecked = claim.unchecked;
  for (std::string& text : examination.unchecked) text = "task: " + text.substr(0, 200);
  examination.accepted = true;
}

std::size_t check_poses(const Mechanism& m, const PoseTaskClaim& claim, Holding holding, const Deadline& deadline,
                        GroupPlaces& shown) {
  PoseTaskCheck check(m, claim, deadline, shown);
  if (holding == Holding::clear) check.check_links();
  return check.run(holding);
}

PoseSigns signs_at(const Mechanism& m, const PoseTaskClaim& claim, const Deadline& deadline, GroupPlaces& shown) {
  return PoseTaskCheck(m, claim, deadline, shown).signs();
}

std::vector<std::vector<std::array<double, 2>>> reactions_at(const Mechanism& m, const PoseTaskClaim& claim,
                                                             const Deadline& deadline, GroupPlaces& shown) {
  return PoseTaskCheck(m, claim, deadline, shown).reactions();
}

bool may_be_pose_of(const Mechanism& m, const PoseTaskClaim& claim, const std::vector<Rational>& pose) {
  GroupPlaces none;
  Cell cell;
  for (const Rational& value : pose) cell.push_back(around(value));
  return !PoseTaskCheck(m, claim, {}, none).task().is_apart(cell);
}

double maybe_reached(const Mechanism& m, const PoseTaskClaim& claim, const Deadline& deadline) {
  GroupPlaces none;
  return PoseTaskCheck(m, claim, deadline, none).maybe_reached();
}

}  // namespace clearloci::check
