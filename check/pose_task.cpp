#include "check/pose_task.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "check/certificate.hpp"
#include "check/group_sheet.hpp"
#include "check/pose_cell.hpp"
#include "core/errors.hpp"

namespace clearloci::check {
namespace {

using Json = nlohmann::json;
using core::Expression;
using core::Rational;
using mechanism::Mechanism;

constexpr std::size_t most_variables = 32, most_points = 10'000, most_demands = 10'000;

class Reader {
 public:
  explicit Reader(const std::string& file) : file_(file) {}

  PoseTaskClaim read(const Json& root) const {
    PoseTaskClaim claim;
    claim.model = text(at(at(root, "model"), "text"));
    for (const Json& pair : list(at(at(root, "model"), "set"), most_variables))
      claim.overrides.emplace_back(text(item(pair, 0)), text(item(pair, 1)));
    for (const Json& name : list(at(root, "coordinates"), most_variables)) claim.coordinates.push_back(text(name));
    const Json& task = at(root, "pose_task");
    claim.shape = shape(task);
    if (const Json& own = at(task, "angle_length"); !own.is_null()) claim.angle_length = rational(own);
    for (const Json& side : list(at(task, "sides"), 10 * most_variables)) {
      if (side != 1 && side != -1) fail("a side is 1 or -1");
      claim.sides.push_back(side.get<int>());
    }
    for (const Json& own : list(at(task, "parameters"), most_variables))
      claim.parameters.push_back({text(item(own, 0)), rational(item(own, 1)), rational(item(own, 2))});
    for (const Json& own : list(at(task, "demands"), most_demands))
      claim.demands.push_back({text(item(own, 0)), quantity(text(item(own, 1))), rational(item(own, 2))});
    for (const Json& own : list(at(task, "unchecked"), most_variables)) claim.unchecked.push_back(text(own));
    if (task.contains("loads_from"))
      for (const Json& own : list(task["loads_from"], 2)) claim.loads_from.push_back(rationals(own));
    if (task.contains("loads_within"))
      for (const Json& own : list(task["loads_within"], most_variables))
        claim.loads_within.push_back({index(item(own, 0)), rational(item(own, 1)), rational(item(own, 2))});
    if (!claim.shape.is_shape(claim.coordinates.size()) || (claim.angle_length && *claim.angle_length <= 0))
      fail("the task has no shape");
    return claim;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw core::InputError({file_}, "this is no certificate that can be read: " + what,
                           "write it anew with --certificate");
  }
  const Json& at(const Json& json, const char* key) const {
    if (!json.is_object() || !json.contains(key)) fail(fmt::format("'{}' is missing", key));
    return json[key];
  }
  const Json& item(const Json& json, std::size_t i) const {
    if (!json.is_array() || i >= json.size()) fail("a list is too short");
    return json[i];
  }
  const Json& list(const Json& json, std::size_t most) const {
    if (!json.is_array() || json.size() > most) fail("a list is missing, or too long");
    return json;
  }
  std::string text(const Json& json) const {
    if (!json.is_string()) fail("a text is missing");
    return json.get<std::string>();
  }
  Rational rational(const Json& json) const {
    const std::string digits = text(json);
    const std::optional<Rational> value = fraction_of(digits);
    if (!value) fail("'" + digits.substr(0, 40) + "' is no fraction");
    return *value;
  }
  std::vector<Rational> rationals(const Json& json) const {
    std::vector<Rational> all;
    for (const Json& own : list(json, most_variables)) all.push_back(rational(own));
    return all;
  }
  core::Quantity quantity(const std::string& name) const {
    for (const core::Quantity q : core::all_quantities)
      if (core::to_string(q) == name) return q;
    fail("an unknown quantity");
  }
  std::size_t index(const Json& json) const {
    if (!json.is_number_unsigned() || json.get<std::size_t>() >= most_variables)
      fail("a number is missing, or too large");
    return json.get<std::size_t>();
  }
  ClaimedShape shape(const Json& task) const {
    ClaimedShape own;
    own.name = text(at(task, "shape"));
    for (const Json& point : list(at(task, "points"), most_points)) own.points.push_back(rationals(point));
    own.radius = rational(at(task, "radius"));
    own.margin = rational(at(task, "margin"));
    if (task.contains("across")) own.across = {index(item(task["across"], 0)), index(item(task["across"], 1))};
    if (task.contains("above")) own.above = rationals(task["above"]);
    return own;
  }

  const std::string& file_;
};

Expression sum(const Expression& a, const Expression& b) { return Expression::apply(Expression::Kind::add, {a, b}); }
Expression product(const Expression& a, const Expression& b) {
  return Expression::apply(Expression::Kind::multiply, {a, b});
}

class PoseTaskCheck {
 public:
  PoseTaskCheck(const Mechanism& m, const PoseTaskClaim& claim, const Deadline& deadline)
      : m_(m), claim_(claim), deadline_(deadline), coordinates_(claim.coordinates.size()), names_(claim.coordinates) {
    check_names();
    region_.emplace(region());
    whole_ = region_->whole();
    for (const PoseTaskClaim::Range& own : claim.parameters) add_variable(own.parameter, own.lower, own.upper);
    if (!claim.loads_from.empty()) turn_load();
    for (const PoseTaskClaim::LoadWithin& own : claim.loads_within) widen_load(own);
  }

  std::size_t run() {
    close_groups();
    check_links();
    if (!groups_) return covered_within(whole_, nullptr);
    std::size_t cells = 0;
    for (const GroupSheet::Part& part : groups_->parts()) {
      Cell within = whole_;
      std::copy(part.cell.begin(), part.cell.end(), within.begin());
      cells += covered_within(within, &part);
    }
    return cells;
  }

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
    if (m_.groups.empty()) return;
    const auto count = static_cast<std::ptrdiff_t>(coordinates_ + claim_.parameters.size());
    groups_.emplace(
        m_, claim_.sides, std::vector<std::string>(names_.begin(), names_.begin() + count),
        Cell(whole_.begin(), whole_.begin() + count), pose_inside(),
        [&](const Cell& cell) { return region_->is_apart(cell); }, deadline_);
  }

  void check_names() const {
    if (m_.coordinates.size() != coordinates_ || coordinates_ == 0)
      throw FalseClaim("coordinates: they are not the model's");
    for (std::size_t c = 0; c < coordinates_; ++c)
      if (m_.coordinates[c].name != claim_.coordinates[c]) throw FalseClaim("coordinates: they are not the model's");
    if (claim_.sides.size() != mechanism::dyad_points(m_).size())
      throw FalseClaim("sides: there is not one for every dyad and slider");
    for (const PoseTaskClaim::Range& own : claim_.parameters) {
      const auto found = std::find_if(m_.parameters.begin(), m_.parameters.end(),
                                      [&](const auto& parameter) { return parameter.name == own.parameter; });
      if (found == m_.parameters.end() || !(own.lower <= found->value && found->value <= own.upper))
        throw FalseClaim("parameters: '" + own.parameter.substr(0, 40) +
                         "' is none of the model's, or not in its range");
    }
    // Where efforts have bounds, that they keep to these is a claim.
    const bool bounded = std::any_of(m_.joints.begin(), m_.joints.end(), [](const mechanism::Joint& joint) {
      return joint.meshing || (joint.actuated && joint.within);
    });
    if (claim_.demands.empty() && !bounded) throw FalseClaim("demands: there is none");
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
    const bool any_length =
        std::any_of(m_.coordinates.begin(), m_.coordinates.end(), [](const auto& own) { return !own.angle; });
    for (const mechanism::Coordinate& own : m_.coordinates) {
      const bool counted = own.angle && claim_.angle_length;
      weights.push_back(counted ? around(*claim_.angle_length)[0] : 1.0);
      grows.push_back(!own.angle || counted || !any_length);
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
    const Expression way = Expression::symbol("way of the load");  // no name of a file
    for (std::size_t c = 0; c < first.size(); ++c)
      m_.loads[0].force[c] = sum(Expression::number(first[c]), product(Expression::number(last[c] - first[c]), way));
    add_variable(way.name(), 0, 1);
  }

  /// Parts of the force, and of a couple, that are variables in a ball.
  void widen_load(const PoseTaskClaim::LoadWithin& within) {
    const bool planar = m_.space == mechanism::Space::planar;
    if (within.load >= m_.loads.size() || within.force < 0 || within.couple < 0 ||
        (within.force > 0 && m_.loads[within.load].force.empty()) || (within.couple > 0 && !planar))
      throw FalseClaim("loads: the model has no such force");
    mechanism::Load& load = m_.loads[within.load];
    if (within.force > 0) add_ball(load.force, within.force);
    if (!(within.couple > 0)) return;
    std::vector<Expression> couple = {load.couple};
    add_ball(couple, within.couple);
    load.couple = couple.front();
  }

  void add_ball(std::vector<Expression>& parts, const Rational& radius) {
    balls_.push_back({names_.size(), parts.size()});
    for (Expression& part : parts) {
      const std::string name = fmt::format("part {} of loads", names_.size());
      part = sum(part, Expression::symbol(name));
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
    std::vector<LoadBall> own;
    for (const LoadBall& ball : balls_) {
      const auto first = static_cast<std::ptrdiff_t>(ball.first),
                 last = first + static_cast<std::ptrdiff_t>(ball.count);
      if (std::equal(cell.begin() + first, cell.begin() + last, whole_.begin() + first)) own.push_back(ball);
    }
    return own;
  }

  /// `part`: that the cell is in, of a mechanism with groups.
  bool holds(const Cell& cell, const GroupSheet::Part* part, std::vector<double>& spreads) const {
    Jet::Offsets offsets;
    const PoseVariables variables = variables_over(names_, cell, offsets);
    std::optional<GroupCell> groups;
    if (part != nullptr && !(groups = groups_->over(*part, variables, offsets, spreads))) return false;
    const PosePosture posture =
        posture_over(m_, claim_.sides, variables, groups ? groups->places : std::vector<std::array<Jet, 3>>());
    if (posture.stopped_by) {
      const std::vector<Interval>& slopes = posture.stopped_by->slopes();
      for (std::size_t c = 0; c < slopes.size(); ++c)
        if (slopes[c].is_finite()) spreads[c] = std::abs(slopes[c].middle()) * 0.5 * (cell[c][1] - cell[c][0]);
      return false;
    }
    const std::vector<LoadBall> balls = balls_in(cell);
    PoseCellProof proof =
        prove_cell(equations_over(m_, posture, variables, claim_.demands), claim_.demands, offsets, balls);
    spreads = std::move(proof.spreads);
    // A ball that is cut is no ball any more: poses are cut before.
    constexpr double last = 0.125;
    for (const LoadBall& ball : balls)
      for (std::size_t c = ball.first; c < ball.first + ball.count; ++c) spreads[c] *= last;
    return proof.holds();
  }

  /// Lengths within links do not change with the pose, at a pose of the task and two beside it.
  void check_links() const {
    for (const double share : {0.5, 0.3819, 0.7071}) {
      const GroupSheet::Part* part = nullptr;
      if (groups_)
        part = &groups_->parts()[static_cast<std::size_t>(share * static_cast<double>(groups_->parts().size()))];
      Cell cell = whole_;
      if (part != nullptr) std::copy(part->cell.begin(), part->cell.end(), cell.begin());
      for (auto& own : cell) own[0] = own[1] = own[0] + share * (own[1] - own[0]);
      Jet::Offsets offsets;
      const PoseVariables variables = variables_over(names_, cell, offsets);
      std::vector<double> spreads(names_.size());
      std::optional<GroupCell> groups;
      if (part != nullptr && !(groups = groups_->over(*part, variables, offsets, spreads))) continue;
      const PosePosture posture =
          posture_over(m_, claim_.sides, variables, groups ? groups->places : std::vector<std::array<Jet, 3>>());
      if (posture.stopped_by) continue;  // the cells tell
      for (const mechanism::Link& link : m_.links) check_link(link, posture);
    }
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

  Mechanism m_;  ///< with what its loads vary by
  const PoseTaskClaim& claim_;
  const Deadline& deadline_;
  std::size_t coordinates_;
  std::vector<std::string> names_;  ///< of the coordinates, and of all that varies besides
  std::optional<TaskRegion> region_;
  Cell whole_;
  std::vector<LoadBall> balls_;
  std::optional<GroupSheet> groups_;
};

}  // namespace

PoseTaskClaim read_pose_task(const Json& root, const std::string& file) { return Reader(file).read(root); }

void check_pose_task(const Mechanism& m, const PoseTaskClaim& claim, const Deadline& deadline,
                     Examination& examination) {
  examination.task_cells = PoseTaskCheck(m, claim, deadline).run();
  examination.unchecked = claim.unchecked;
  for (std::string& own : examination.unchecked) own = "task: " + own.substr(0, 200);
  examination.accepted = true;
}

}  // namespace clearloci::check
