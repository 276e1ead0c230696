// The tables of a pose. Those of the plane and of space differ in which columns have anything in them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "report/file_units.hpp"
#include "report/pose.hpp"
#include "report/preload.hpp"
#include "report/text_table.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using core::Quantity;

constexpr std::string_view axes = "xyz";

template <class... Values>
void put(std::string& text, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
}

/// The largest finite size so far.
class Largest {
 public:
  void see(double value) {
    if (std::isfinite(value)) value_ = std::max(value_, std::abs(value));
  }
  void see(const std::vector<double>& values) {
    for (const double value : values) see(value);
  }
  void see(const std::optional<double>& value) {
    if (value) see(*value);
  }
  double value() const { return value_; }

 private:
  double value_ = 0;
};

/// Numbers of one kind, in one unit.
struct Scale {
  ShownUnit unit;
  double largest = 0;  ///< of them, SI

  /// "unbounded" for infinities and NaN.
  std::string operator()(double value) const {
    if (!std::isfinite(value)) return "unbounded";
    return engineering_beside(value * unit.per_si, largest * unit.per_si, size_digits);
  }
  /// Of a take-up: NaN where it is undefined.
  std::string played(double value) const { return std::isnan(value) ? "undefined" : (*this)(value); }
  std::string played(const std::optional<double>& value) const { return value ? played(*value) : std::string(); }
  std::string head(std::string_view name) const { return fmt::format("{} [{}]", name, unit.name); }
};

Column number_column(const std::string& heading) { return {heading, 0, Alignment::point}; }

const core::ReactionComponent* component(const core::JointReaction& reaction, Quantity quantity) {
  const auto& all = reaction.components;
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.quantity == quantity; });
  return found == all.end() ? nullptr : &*found;
}

/// Why no pose error is defined: "contact is lost at A1, B1; M = 0 at A1", or that it is a direct singularity.
std::string undefined_words(const core::Pose& pose) {
  if (pose.singular) return "|A| = 0 here: the reactions are unbounded or have no limit";
  const std::vector<std::pair<Quantity, std::string>> wordings = {{Quantity::f, "contact is lost at "},
                                                                  {Quantity::end_ahead, "the end ahead lifts at "},
                                                                  {Quantity::end_behind, "the end behind lifts at "},
                                                                  {Quantity::M, "M = 0 at "},
                                                                  {Quantity::F, "F = 0 at "}};
  std::string words;
  for (const auto& [quantity, start] : wordings) {
    std::string joints;
    for (const core::Vanishing& one : pose.vanishing)
      if (one.quantity == quantity) joints += (joints.empty() ? "" : ", ") + one.joint;
    if (!joints.empty()) words += (words.empty() ? "" : "; ") + start + joints;
  }
  return words;
}

void put_head(std::string& text, const core::Pose& pose) {
  const Scale length{table_unit("m", pose.units, 1), 0};
  constexpr double degrees = 180 / std::numbers::pi;
  std::vector<std::string> values;
  for (std::size_t c = 0; c < pose.at.size(); ++c)
    values.push_back(c < pose.angles.size() && pose.angles[c] ? engineering(pose.at[c] * degrees, size_digits) + " deg"
                                                              : length(pose.at[c]));
  put(text, "{} at ({})", pose.mechanism, fmt::join(values, ", "));
  for (const auto& [point, side] : pose.working_mode) put(text, ", {} {}", point, side);
  put(text, "\n{}\n", parameter_line(pose.parameters));
}

std::string points_table(const core::Pose& pose) {
  Largest largest;
  for (const core::PosePoint& point : pose.points) largest.see(point.at);
  const Scale length{table_unit("m", pose.units, 1), largest.value()};
  std::vector<Column> heading = {{"point"}};
  for (std::size_t c = 0; c < pose.worst.displacement.size(); ++c)
    heading.push_back(number_column(length.head(axes.substr(c, 1))));
  std::vector<Row> rows;
  for (const core::PosePoint& point : pose.points) {
    Row& row = rows.emplace_back(Row{point.name});
    for (const double value : point.at) row.push_back(length(value));
  }
  return format_rows(heading, rows);
}

/// Where no joint has the component, or it is 0 in all that have, its column is left out; the latter is said below.
std::string reactions_table(const core::Pose& pose) {
  const std::vector<Quantity> shown = {Quantity::fx, Quantity::fy, Quantity::fz, Quantity::f,
                                       Quantity::mx, Quantity::my, Quantity::mz, Quantity::N,
                                       Quantity::T,  Quantity::F,  Quantity::M};
  // Mechanisms are some metres large, so that couples and forces compare.
  Largest largest;
  for (const core::JointReaction& reaction : pose.reactions)
    for (const core::ReactionComponent& part : reaction.components) largest.see(part.value);
  std::vector<Column> heading = {{"joint"}};
  std::vector<Row> rows;
  for (const core::JointReaction& reaction : pose.reactions) rows.push_back({reaction.joint});
  std::string zeros;
  for (const Quantity quantity : shown) {
    const Scale scale{table_unit(core::unit_of(quantity), pose.units), largest.value()};
    std::vector<std::string> cells;
    for (const core::JointReaction& reaction : pose.reactions) {
      const auto size = [&](Quantity of) {
        const core::ReactionComponent* const reaction_component = component(reaction, of);
        return reaction_component == nullptr ? 0 : reaction_component->value;
      };
      const bool whole = quantity == Quantity::f && component(reaction, Quantity::fx) != nullptr;
      const core::ReactionComponent* const reaction_component = component(reaction, quantity);
      cells.push_back(whole ? scale(std::hypot(size(Quantity::fx), size(Quantity::fy), size(Quantity::fz)))
                      : reaction_component == nullptr ? std::string()
                                                      : scale(reaction_component->value));
    }
    const auto has_none = [](const std::string& cell) { return cell.empty(); };
    if (std::all_of(cells.begin(), cells.end(), has_none)) continue;
    const auto is_zero = [](const std::string& cell) { return cell.empty() || cell == "0"; };
    if (std::all_of(cells.begin(), cells.end(), is_zero)) {
      zeros += (zeros.empty() ? "" : ", ") + core::to_string(quantity);
      continue;
    }
    heading.push_back(number_column(scale.head(quantity == Quantity::f ? "|f|" : core::to_string(quantity))));
    for (std::size_t r = 0; r < rows.size(); ++r) rows[r].push_back(cells[r]);
  }
  std::string text = format_rows(heading, rows);
  if (!zeros.empty()) text += zeros + " = 0 in every joint\n";
  return text;
}

std::string take_up_table(const core::Pose& pose) {
  Largest lengths, angles;
  for (const core::JointTakeUp& take_up : pose.take_up) {
    lengths.see(take_up.displacement);
    lengths.see(take_up.normal);
    lengths.see(take_up.axial);
    angles.see(take_up.tilt);
    angles.see(take_up.rotation);
  }
  const Scale length{table_unit("m", pose.units, lengths.value()), lengths.value()};
  const Scale angle{table_unit("rad", pose.units), angles.value()}, direction{table_unit("rad", pose.units), 1};
  std::vector<Column> heading = {{"take-up"}};
  for (std::size_t c = 0; c < pose.worst.displacement.size(); ++c)
    heading.push_back(number_column(length.head("d" + std::string(axes.substr(c, 1)))));
  for (const auto& [name, scale] :
       {std::pair("beta", &direction), std::pair("normal", &length), std::pair("tilt", &angle),
        std::pair("axial", &length), std::pair("dtheta", &angle)})
    heading.push_back(number_column(scale->head(name)));
  std::vector<Row> rows;
  for (const core::JointTakeUp& take_up : pose.take_up) {
    Row& row = rows.emplace_back(Row{take_up.joint});
    for (std::size_t c = 0; c < pose.worst.displacement.size(); ++c)
      row.push_back(take_up.displacement.empty() ? std::string() : length.played(take_up.displacement[c]));
    row.insert(row.end(), {direction.played(take_up.beta), length.played(take_up.normal), angle.played(take_up.tilt),
                           length.played(take_up.axial), angle.played(take_up.rotation)});
  }
  return format_filled_columns(heading, rows);
}

/// The error, that beyond the linear step and the worst case, each a row.
std::string error_table(const core::Pose& pose) {
  const bool space = pose.worst.displacement.size() == 3;
  Largest lengths, angles;
  const auto see = [&](const core::PoseError& error) {
    lengths.see(error.displacement);
    angles.see(error.rotation);
  };
  if (pose.error) see(*pose.error);
  if (pose.actual) see(pose.actual->error);
  see({pose.worst.displacement, pose.worst.rotation});
  lengths.see(pose.worst.distance);
  const Scale length{table_unit("m", pose.units, lengths.value()), lengths.value()};
  const Scale angle{table_unit("rad", pose.units), angles.value()};
  std::vector<Column> heading = {
      {"pose error" + (pose.relative_to.empty() ? "" : " relative to link " + pose.relative_to)}};
  for (std::size_t c = 0; c < pose.worst.displacement.size(); ++c)
    heading.push_back(number_column(length.head("d" + std::string(axes.substr(c, 1)))));
  for (std::size_t c = 0; c < pose.worst.rotation.size(); ++c)
    heading.push_back(number_column(angle.head(space ? "dalpha_" + std::string(axes.substr(c, 1)) : "dalpha")));
  heading.push_back(number_column(length.head("distance")));
  if (space) heading.push_back(number_column(angle.head("rotation")));
  std::vector<Row> rows;
  const auto add = [&](const std::string& what, const core::PoseError& error, double distance, double turn) {
    Row& row = rows.emplace_back(Row{what});
    for (const double value : error.displacement) row.push_back(length(value));
    for (const double value : error.rotation) row.push_back(angle(value));
    row.push_back(length(distance));
    if (space) row.push_back(angle(turn));
  };
  const auto size = [](const std::vector<double>& parts) {
    return parts.size() == 3 ? std::hypot(parts[0], parts[1], parts[2]) : std::hypot(parts[0], parts[1]);
  };
  const auto turned = [](const std::vector<double>& parts) {
    return parts.size() == 3 ? std::hypot(parts[0], parts[1], parts[2]) : std::abs(parts[0]);
  };
  if (pose.error) add("linear", *pose.error, size(pose.error->displacement), turned(pose.error->rotation));
  if (pose.actual) {
    const core::PoseError &actual = pose.actual->error, &beyond = pose.actual->beyond_linear;
    add("iterated", actual, size(actual.displacement), turned(actual.rotation));
    add("  difference", beyond, size(beyond.displacement), turned(beyond.rotation));
  }
  add("worst, any load", {pose.worst.displacement, pose.worst.rotation}, pose.worst.distance, pose.worst.angle);
  std::string text = format_rows(heading, rows);
  if (!pose.error) text += "undefined under the load: " + undefined_words(pose) + "\n";
  if (pose.actual)
    put(text, "iterated {} times, closure within {} {}\n", pose.actual->iterations,
        engineering(pose.actual->residual * length.unit.per_si, 2), length.unit.name);
  return text;
}

}  // namespace

std::string pose_text(const core::Pose& pose) {
  std::string text;
  put_head(text, pose);
  text += points_table(pose) + "\n" + reactions_table(pose);
  put(text, "\n|A| = {}, condition number {}\n", engineering(pose.determinant, size_digits),
      std::isfinite(pose.condition) ? engineering(pose.condition, few_digits) : "unbounded");
  for (const core::FeasibleEfforts& efforts : pose.efforts)
    text +=
        (efforts.cable && &efforts != &pose.efforts.front() ? "" : "\n") + feasible_efforts_text(efforts, pose.units);
  if (!pose.take_up.empty()) text += "\n" + take_up_table(pose) + "\n" + error_table(pose);
  for (const std::string& note : pose.notes) put(text, "{}\n", note);
  return text;
}

}  // namespace clearloci::report
