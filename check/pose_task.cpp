#include "check/pose_task.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "check/certificate.hpp"
#include "check/pose_cell.hpp"
#include "core/errors.hpp"

namespace clearloci::check {
namespace {

using Json = nlohmann::json;
using core::Rational;
using mechanism::Mechanism;

constexpr std::size_t most_pose_cells = 1'000'000, most_variables = 32, most_points = 10'000, most_demands = 10'000;
/// Of the whole: cells are not cut further.
constexpr double finest = 1e-9;

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
    claim.shape = text(at(task, "shape"));
    for (const Json& point : list(at(task, "points"), most_points)) claim.points.push_back(rationals(point));
    claim.radius = rational(at(task, "radius"));
    claim.margin = rational(at(task, "margin"));
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
    check_shape(claim);
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
  void check_shape(const PoseTaskClaim& claim) const {
    const std::size_t count = claim.points.size();
    const bool known = (claim.shape == "box" && count == 2) || (claim.shape == "ball" && count == 1) ||
                       (claim.shape == "path" && count >= 2);
    if (!known || claim.margin < 0 || claim.radius < 0 || (claim.angle_length && *claim.angle_length <= 0))
      fail("the task has no shape");
    for (const auto& point : claim.points)
      if (point.size() != claim.coordinates.size()) fail("a pose has one number a coordinate");
  }

  const std::string& file_;
};

using Range = std::array<double, 2>;
using Box = std::vector<Range>;

/// The double next to it on one side.
Range around(const Rational& value) {
  const Interval own(value, cell_bits);
  return {own.lower(), own.upper()};
}

class PoseTaskCheck {
 public:
  PoseTaskCheck(const Mechanism& m, const PoseTaskClaim& claim, const Deadline& deadline)
      : m_(m), claim_(claim), deadline_(deadline), coordinates_(claim.coordinates.size()) {
    check_names();
    const bool any_length =
        std::any_of(m.coordinates.begin(), m.coordinates.end(), [](const auto& own) { return !own.angle; });
    for (const mechanism::Coordinate& own : m.coordinates) {
      const bool counted = own.angle && claim.angle_length;
      weights_.push_back(counted ? around(*claim.angle_length)[0] : 1.0);
      grows_.push_back(!own.angle || counted || !any_length);
    }
    names_ = claim.coordinates;
    for (const PoseTaskClaim::Range& own : claim.parameters) names_.push_back(own.parameter);
    whole_ = whole();
    for (const auto& point : claim.points) points_.push_back(rounded(point));
  }

  std::size_t run() {
    check_links();
    std::vector<Box> open = {whole_};
    std::size_t cells = 0;
    for (std::size_t count = 0; !open.empty(); ++count) {
      const Box cell = std::move(open.back());
      open.pop_back();
      if (deadline_ && std::chrono::steady_clock::now() >= *deadline_)
        throw core::LimitReached("the time limit was reached before every claim was looked at");
      if (is_apart(cell)) continue;
      std::vector<double> spreads;
      if (holds(cell, spreads)) {
        ++cells;
        continue;
      }
      const std::size_t along = chosen(cell, spreads);
      if (count >= most_pose_cells || along == cell.size())
        throw FalseClaim("task: that it keeps clear is not shown in " + described(cell));
      Box low = cell, high = cell;
      low[along][1] = high[along][0] = 0.5 * (cell[along][0] + cell[along][1]);
      open.push_back(std::move(high));
      open.push_back(std::move(low));
    }
    return cells;
  }

 private:
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
    if (claim_.demands.empty()) throw FalseClaim("demands: there is none");
    for (const auto& point : claim_.points)
      for (std::size_t c = 0; c < coordinates_; ++c)
        if (point[c] < m_.coordinates[c].lower || point[c] > m_.coordinates[c].upper)
          throw FalseClaim("task: it leaves the workspace of the model");
    if (claim_.shape == "box")
      for (std::size_t c = 0; c < coordinates_; ++c)
        if (claim_.points[0][c] > claim_.points[1][c]) throw FalseClaim("task: its box is empty");
  }

  std::vector<double> rounded(const std::vector<Rational>& point) const {
    std::vector<double> own;
    for (const Rational& value : point) own.push_back(value.get_d());
    return own;
  }

  double reach() const {
    const Rational sum = claim_.margin + (claim_.shape == "ball" ? claim_.radius : Rational(0));
    return around(sum)[1] * (1 + 1e-12);
  }

  Box whole() const {
    Box box;
    for (std::size_t c = 0; c < coordinates_; ++c) {
      Range own = around(claim_.points[0][c]);
      for (const auto& point : claim_.points) {
        const Range next = around(point[c]);
        own = {std::min(own[0], next[0]), std::max(own[1], next[1])};
      }
      const bool wide = grows_[c] || claim_.shape == "ball";
      const double more = wide && reach() > 0 ? reach() / weights_[c] * (1 + 1e-12) : 0;
      box.push_back({own[0] - more, own[1] + more});
      if (more > 0) box.back() = {std::nextafter(box.back()[0], -HUGE_VAL), std::nextafter(box.back()[1], HUGE_VAL)};
    }
    for (const PoseTaskClaim::Range& own : claim_.parameters)
      box.push_back({around(own.lower)[0], around(own.upper)[1]});
    return box;
  }

  /// No pose of the cell is within reach of the task, for certain.
  bool is_apart(const Box& cell) const {
    if (claim_.shape == "box") {
      double square = 0;
      for (std::size_t c = 0; c < coordinates_; ++c) {
        const double off = std::max({0.0, cell[c][0] - points_[1][c], points_[0][c] - cell[c][1]});
        square += grows_[c] ? std::pow(weights_[c] * off, 2) : 0.0;
      }
      return std::sqrt(square) * (1 - 1e-12) > reach() + hair();
    }
    double half = 0;
    std::vector<double> middle;
    for (std::size_t c = 0; c < coordinates_; ++c) {
      middle.push_back(0.5 * (cell[c][0] + cell[c][1]));
      half += std::pow(weights_[c] * 0.5 * (cell[c][1] - cell[c][0]), 2);
    }
    double nearest = distance(middle, points_[0], points_[0]);
    for (std::size_t i = 1; i < points_.size(); ++i)
      nearest = std::min(nearest, distance(middle, points_[i - 1], points_[i]));
    return nearest * (1 - 1e-12) - std::sqrt(half) * (1 + 1e-12) > reach() + hair();
  }

  /// Rounding of the task's own numbers.
  double hair() const {
    double size = 0;
    for (const auto& point : points_)
      for (std::size_t c = 0; c < coordinates_; ++c) size = std::max(size, weights_[c] * std::abs(point[c]));
    return 1e-14 * size;
  }

  double distance(const std::vector<double>& p, const std::vector<double>& a, const std::vector<double>& b) const {
    double along = 0, square = 0;
    for (std::size_t c = 0; c < coordinates_; ++c) {
      const double w = weights_[c] * weights_[c];
      along += w * (p[c] - a[c]) * (b[c] - a[c]);
      square += w * (b[c] - a[c]) * (b[c] - a[c]);
    }
    const double t = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
    double sum = 0;
    for (std::size_t c = 0; c < coordinates_; ++c) sum += std::pow(weights_[c] * (p[c] - a[c] - t * (b[c] - a[c])), 2);
    return std::sqrt(sum);
  }

  PoseVariables variables_over(const Box& cell, Jet::Offsets& offsets) const {
    PoseVariables variables{names_, {}};
    std::vector<Interval> ranges;
    offsets.clear();
    for (const Range& own : cell) {
      ranges.emplace_back(own[0], own[1], cell_bits);
      offsets.push_back(ranges.back() - middle_of(ranges.back()));
    }
    for (std::size_t c = 0; c < cell.size(); ++c) variables.values.emplace_back(ranges[c], offsets, c);
    return variables;
  }

  bool holds(const Box& cell, std::vector<double>& spreads) const {
    Jet::Offsets offsets;
    const PoseVariables variables = variables_over(cell, offsets);
    const PosePosture posture = posture_over(m_, claim_.sides, variables);
    spreads.assign(cell.size(), 0.0);
    if (!posture.is_proven) {
      const std::vector<Interval>& slopes = posture.positive.back().slopes();
      for (std::size_t c = 0; c < slopes.size(); ++c)
        if (slopes[c].is_finite()) spreads[c] = std::abs(slopes[c].middle()) * 0.5 * (cell[c][1] - cell[c][0]);
      return false;
    }
    PoseCellProof proof = prove_cell(equations_over(m_, posture, variables, claim_.demands), claim_.demands, offsets);
    spreads = std::move(proof.spreads);
    return proof.holds();
  }

  /// Where a cut helps most; all of them where the cell is too fine.
  std::size_t chosen(const Box& cell, const std::vector<double>& spreads) const {
    constexpr double share_of_width = 1e-3;
    std::size_t best = cell.size();
    double most = -1, total = 0;
    for (const double own : spreads) total += own;
    if (!(total > 0) || !std::isfinite(total)) total = 1;
    for (std::size_t c = 0; c < cell.size(); ++c) {
      const double width = cell[c][1] - cell[c][0], all = whole_[c][1] - whole_[c][0];
      if (!(width > finest * all) || !(width > 0x1p-50 * std::max(std::abs(cell[c][0]), std::abs(cell[c][1]))))
        continue;
      const double own = (std::isfinite(spreads[c]) ? spreads[c] : 0) + share_of_width * total * width / all;
      if (own > most) {
        most = own;
        best = c;
      }
    }
    return best;
  }

  /// Lengths within links do not change with the pose, at a pose of the task and two beside it.
  void check_links() const {
    for (const double share : {0.5, 0.3819, 0.7071}) {
      Box cell;
      for (const Range& own : whole_) cell.push_back({own[0] + share * (own[1] - own[0]), 0});
      for (Range& own : cell) own[1] = own[0];
      Jet::Offsets offsets;
      const PosePosture posture = posture_over(m_, claim_.sides, variables_over(cell, offsets));
      if (!posture.is_proven) continue;  // the cells tell
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

  std::string described(const Box& cell) const {
    std::vector<std::string> parts;
    for (std::size_t c = 0; c < cell.size(); ++c)
      parts.push_back(fmt::format("{} {:.6g} to {:.6g}", names_[c], cell[c][0], cell[c][1]));
    return fmt::format("{}", fmt::join(parts, ", "));
  }

  const Mechanism& m_;
  const PoseTaskClaim& claim_;
  const Deadline& deadline_;
  std::size_t coordinates_;
  std::vector<double> weights_;
  std::vector<bool> grows_;
  std::vector<std::string> names_;
  Box whole_;
  std::vector<std::vector<double>> points_;
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
