#include "report/verification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/shown_units.hpp"
#include "core/task.hpp"
#include "core/unloaded_words.hpp"
#include "report/file_units.hpp"
#include "report/loci_json.hpp"
#include "report/picture.hpp"
#include "report/preload.hpp"
#include "report/task_panels.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;
using Kind = core::TaskWitness::Kind;

/// What is nearer, m or rad, is in the task but for rounding.
constexpr double rounding_of_distance = 1e-12;

const char* verdict_line(core::Verdict verdict) {
  switch (verdict) {
    case core::Verdict::verified:
      return "VERIFIED      no locus, singularity or boundary in the task: proven";
    case core::Verdict::refuted:
      return "REFUTED       the task fails at the witness, confirmed numerically";
    case core::Verdict::undecided:
      break;
  }
  return "UNDECIDED     neither proven nor refuted";
}

std::string open_words(const core::Verification& result) {
  switch (result.open->reason) {
    case core::OpenTask::Reason::time:
      return "the time limit was reached";
    case core::OpenTask::Reason::cells:
      return fmt::format("{} cells were looked at", result.cells);
    case core::OpenTask::Reason::doubles:
      break;
  }
  return "doubles tell no more apart there";
}

/// Exact numbers of a shape, rounded.
Json poses_json(const std::vector<core::RationalPose>& poses) {
  Json list = Json::array();
  for (const core::RationalPose& pose : poses) list.push_back(core::rounded(pose));
  return list;
}

Json shape_json(const core::TaskShape& shape) {
  const auto range = [](const std::array<core::RationalPose, 2>& ends) {
    return Json{{"lower", core::rounded(ends[0])}, {"upper", core::rounded(ends[1])}};
  };
  if (std::holds_alternative<core::TaskBox>(shape)) return range(core::bounds(shape));
  if (const auto* ball = std::get_if<core::TaskBall>(&shape))
    return {{"centre", core::rounded(ball->centre)}, {"radius", core::to_double(ball->radius)}};
  if (const auto* polygon = std::get_if<core::TaskPolygon>(&shape)) {
    if (polygon->above.empty()) return poses_json(polygon->corners);
    Json object = range(core::bounds(shape));
    object["corners"] = Json::array();
    for (const core::Point2& corner : core::outline(shape)) object["corners"].push_back(corner);
    object["corners"].erase(object["corners"].size() - 1);
    return object;
  }
  if (const auto* mesh = std::get_if<core::TaskMesh>(&shape)) {
    Json object = {{"file", printable(mesh->file)}, {"triangles", mesh->triangles.size()}};
    object.update(range(core::bounds(shape)));
    return object;
  }
  return poses_json(std::get<core::TaskPath>(shape).points);
}

Json names_of(const std::vector<core::Vanishing>& reactions) {
  Json joints = Json::array();
  for (const core::Vanishing& vanishing : reactions)
    if (std::find(joints.begin(), joints.end(), vanishing.joint) == joints.end()) joints.push_back(vanishing.joint);
  return joints;
}

template <class Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json witness_json(const core::Verification& result) {
  const core::TaskWitness& witness = *result.witness;
  Json object = {{"at", witness.at},
                 {"load", witness.load.empty() ? Json(nullptr) : Json(witness.load)},
                 {"distance", witness.distance},
                 {"reason", witness_words(witness, {}, result.margin_of_angles())},
                 {"vanishing", vanishing_array(witness.vanishing)},
                 {"too_small", vanishing_array(witness.too_small)},
                 {"size", or_null(witness.size)}};
  if (!witness.beyond_bound.empty()) object["beyond_bound"] = vanishing_array(witness.beyond_bound);
  if (!witness.limit.empty()) object["limit"] = witness.limit;
  for (const auto& [name, value] : witness.design) object["design"][name] = value;
  for (const core::WitnessLoad& load : witness.loads)
    object["loads"].push_back({{"load", load.load + 1},
                               {"force", load.force},
                               {"couple", load.couple.size() == 1 ? Json(load.couple.front()) : Json(load.couple)}});
  return object;
}

/// Values of an answer as they are told, in the units of its mechanism file.
class Words {
 public:
  explicit Words(const core::Verification& result) : result_(result) {
    plane_ = result.angles == std::vector<bool>{false, false};
  }

  bool plane() const { return plane_; }
  std::string length(double metres) const { return told(metres, "m"); }
  std::string angle(double radians) const { return told(radians, "rad"); }
  std::string effort(const core::Vanishing& reaction, double value) const {
    return told(value, core::unit_of(reaction.quantity));
  }
  /// Bounds, rounded so that they stay ones.
  std::string at_least(double value, const std::string& si) const { return told(value, si, rounded_down); }
  std::string at_most(double value, const std::string& si) const { return told(value, si, rounded_up); }
  /// A distance in the task's metric.
  std::string distance(double value) const { return result_.margin_of_angles() ? angle(value) : length(value); }

  /// "(250, -700)"; over other coordinates "x = 250 mm, alpha = 5 deg".
  std::string pose(const std::vector<double>& at, int digits = size_digits) const {
    std::string words;
    for (std::size_t c = 0; c < at.size(); ++c) {
      const ShownUnit unit = core::told_unit(result_.angles[c] ? "rad" : "m", result_.units);
      words +=
          fmt::format("{}{}{}{}", c == 0 ? "" : ", ", plane_ ? "" : result_.coordinates[c] + " = ",
                      engineering(without_rounding(at[c], c) * unit.per_si, digits), plane_ ? "" : " " + unit.name);
    }
    return plane_ ? "(" + words + ")" : words;
  }

 private:
  /// 0 for what halving the task's cells left of it.
  double without_rounding(double value, std::size_t coordinate) const {
    constexpr double rounding = 1e-12;  // of the task
    const std::array<core::RationalPose, 2> ends = core::bounds(result_.task.shape);
    if (coordinate >= ends[0].size()) return value;
    const double from = core::to_double(ends[0][coordinate]), to = core::to_double(ends[1][coordinate]);
    return std::abs(value) <= rounding * std::max(std::abs(from), std::abs(to)) ? 0 : value;
  }

  std::string told(double value, const std::string& si, double (*rounded)(double, int) = nullptr) const {
    const ShownUnit unit = core::told_unit(si, result_.units);
    const double shown = value * unit.per_si;
    return engineering(rounded == nullptr ? shown : rounded(shown, size_digits), size_digits) + " " + unit.name;
  }

  const core::Verification& result_;
  bool plane_ = false;
};

/// The couple of a load; parts that are roundings of the force times a metre, or of the others, are 0.
std::vector<double> without_rounding(const core::WitnessLoad& load) {
  double size = 0;
  for (const std::vector<double>* parts : {&load.force, &load.couple})
    for (const double part : *parts) size = std::max(size, std::abs(part));
  std::vector<double> couple = load.couple;
  constexpr double rounding = 1e-14;
  for (double& part : couple)
    if (std::abs(part) <= rounding * size) part = 0;
  return couple;
}

/// Joints by their contacts, motors by what they exert.
std::vector<std::string> idle_names(const std::vector<core::Vanishing>& reactions) {
  std::vector<std::string> names;
  for (const core::Vanishing& reaction : reactions) {
    const bool effort = reaction.quantity == core::Quantity::M || reaction.quantity == core::Quantity::F;
    std::string name = effort ? reaction_name(reaction) : reaction.joint;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
  }
  return names;
}

/// Two different values by as many digits as tell them apart.
std::array<std::string, 2> told_apart(double one, double other) {
  std::array<std::string, 2> words;
  constexpr int all_digits = 17;
  for (int digits = size_digits; digits <= all_digits; ++digits) {
    words = {engineering(one, digits), engineering(other, digits)};
    if (words[0] != words[1]) break;
  }
  return words;
}

}  // namespace

std::string witness_words(const core::TaskWitness& witness, const core::Units& units, bool of_angles) {
  const ShownUnit length = shown_unit("m", units), force = shown_unit("N", units);
  const auto listed = [](const std::vector<double>& parts, const ShownUnit& unit) {
    std::string words;
    for (const double part : parts)
      words += (words.empty() ? "" : ", ") + engineering(part * unit.per_si, place_digits);
    return (parts.size() == 1 ? words : "(" + words + ")") + " " + unit.name;
  };
  const auto vector = [&](const std::vector<double>& parts) { return listed(parts, force); };
  std::string words;
  switch (witness.kind) {
    case Kind::unreachable:
      words = witness.limit.empty() ? "the mechanism does not reach it" : "beyond the limit of the " + witness.limit;
      break;
    case Kind::boundary:
      words = witness.limit.empty() ? "the boundary of the workspace passes here"
                                    : "the limit of the " + witness.limit + " passes here";
      break;
    case Kind::singular:
      words = "|A| vanishes: a direct singularity";
      break;
    case Kind::vanishing:
      words = reaction_names(witness.vanishing) + (witness.vanishing.size() > 1 ? " vanish" : " vanishes");
      break;
    case Kind::too_small: {
      const core::Vanishing& reaction = witness.too_small.front();
      const ShownUnit unit = shown_unit(core::unit_of(reaction.quantity), units);
      if (!witness.size) {
        words = fmt::format("{} in any pose, less than {} {}", core::words_of_idle(idle_names(witness.too_small)),
                            engineering(core::to_double(*witness.least) * unit.per_si, size_digits), unit.name);
        break;
      }
      const auto [size, least] = told_apart(*witness.size * unit.per_si, core::to_double(*witness.least) * unit.per_si);
      words = fmt::format("|{}| is {} {}, less than {}", reaction_name(reaction), size, unit.name, least);
      break;
    }
    case Kind::beyond_bound: {
      if (!witness.size) {
        words = "no efforts meet all conditions here: those of " + reaction_names(witness.beyond_bound) +
                (witness.beyond_bound.size() > 1 ? " exclude each other" : " cannot be met");
        break;
      }
      const core::Vanishing& effort = witness.beyond_bound.front();
      const ShownUnit unit = shown_unit(core::unit_of(effort.quantity), units);
      const core::Rational& bound = witness.least ? *witness.least : *witness.most;
      const auto [size, told_bound] = told_apart(*witness.size * unit.per_si, core::to_double(bound) * unit.per_si);
      words = fmt::format("{} is {} {}, {} {}", reaction_name(effort), size, unit.name,
                          witness.least ? "less than" : "more than", told_bound);
      break;
    }
    case Kind::displaced: {
      const auto [size, most] =
          told_apart(*witness.size * length.per_si, core::to_double(*witness.most) * length.per_si);
      words = fmt::format("the clearances displace the end effector by {} {}, more than {}", size, length.name, most);
      break;
    }
  }
  if (!witness.load.empty()) words += " under the load " + vector(witness.load);
  for (const core::WitnessLoad& load : witness.loads)
    words += fmt::format(" under {} and {} as load {}", vector(load.force),
                         listed(without_rounding(load), shown_unit("N m", units)), load.load + 1);
  for (std::size_t i = 0; i < witness.design.size(); ++i)
    words += fmt::format("{}{} = {}", i == 0 ? " of the design " : ", ", witness.design[i].first,
                         exact_number(witness.design[i].second));
  if (witness.distance > rounding_of_distance) {
    const ShownUnit unit = of_angles ? core::told_unit("rad", units) : length;
    words += fmt::format("; {} {} from the task, within its margin",
                         engineering(witness.distance * unit.per_si, size_digits), unit.name);
  }
  return words;
}

std::string shown_witness_words(const core::Verification& result) {
  return witness_words(*result.witness, result.units, result.margin_of_angles());
}

Json verification_object(const core::Verification& result) {
  Json mode = Json::object();
  for (const auto& [point, side] : result.working_mode) mode[point] = side;
  Json root = {{"format", 1},
               {"mechanism", printable(result.mechanism)},
               {"parameters", parameters_object(result.parameters)},
               {"coordinates", result.coordinates},
               {"angles", result.angles},
               {"working_mode", std::move(mode)},
               {"task", {{core::kind_of(result.task.shape), shape_json(result.task.shape)}}},
               {"verdict", core::to_string(result.verdict)},
               {"verified", result.verified()},
               {"zone", result.zone.empty() ? Json(nullptr) : Json(result.zone)},
               {"margin", or_null(result.margin)},
               {"angle_margin", or_null(result.angle_margin)},
               {"nearest", nullptr},
               {"witness", nullptr},
               {"open", nullptr}};
  if (result.task.angle_length) root["task"]["angle_length"] = core::to_double(*result.task.angle_length);
  if (result.units.declared) root["units"] = "SI";
  if (result.task.pose_error) root["pose_error"] = or_null(result.pose_error);
  if (result.moved_by) root["moved_by"] = core::rounded(*result.moved_by);
  if (result.scaled_by) root["scale"] = core::to_double(*result.scaled_by);
  if (result.nearest) {
    const core::NearestOfTask& nearest = *result.nearest;
    root["nearest"] = {{"curve", nearest.curve.empty() ? Json(nullptr) : Json(nearest.curve)},
                       {"kind", core::to_string(nearest.kind)},
                       {"joints", names_of(nearest.vanishing)},
                       {"vanishing", vanishing_array(nearest.vanishing)},
                       {"at", nearest.at},
                       {"distance", nearest.distance}};
    if (!nearest.limit.empty()) root["nearest"]["limit"] = nearest.limit;
  }
  if (result.witness) root["witness"] = witness_json(result);
  if (result.open)
    root["open"] = {{"lower", result.open->lower},
                    {"upper", result.open->upper},
                    {"cells", result.open->cells},
                    {"reason", open_words(result)}};
  root["least"] = Json::array();
  for (const core::LeastReaction& reaction : result.least)
    root["least"].push_back({{"joint", reaction.reaction.joint},
                             {"quantity", core::to_string(reaction.reaction.quantity)},
                             {"proven", reaction.proven},
                             {"met", reaction.met}});
  if (result.preload) root["preload"] = preload_object(*result.preload);
  root["cells"] = result.cells;
  root["notes"] = result.notes;
  return root;
}

std::string verification_text(const core::Verification& result) {
  const Words words(result);
  std::string text = printable(result.mechanism) + ": " + core::kind_of(result.task.shape);
  for (std::size_t c = 0; c < result.coordinates.size() && !words.plane(); ++c)
    text += (c == 0 ? " over " : ", ") + result.coordinates[c];
  std::string mode;
  for (const auto& [point, side] : result.working_mode) mode += (mode.empty() ? "; " : ", ") + point + " " + side;
  text += printable(mode) + "\n" + parameter_line(result.parameters) + "\n";
  const auto put = [&](const char* head, const std::string& fact) { text += fmt::format("{:<14}{}\n", head, fact); };
  const auto many = [](std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  };
  const bool stays = result.moved_by && std::all_of(result.moved_by->begin(), result.moved_by->end(),
                                                    [](const core::Rational& part) { return part == 0; });
  if (stays)
    put("moved by", "nothing: this is its place");
  else if (result.moved_by)
    put("moved by", words.pose(core::rounded(*result.moved_by)) +
                        (words.plane() ? " " + shown_unit("m", result.units).name : std::string()));
  if (result.scaled_by) put("scaled by", engineering(core::to_double(*result.scaled_by), size_digits));
  text += std::string(verdict_line(result.verdict)) + "\n";
  std::string of;
  if (const std::size_t count = result.task.tolerances.size(); count > 0)
    of = "every design within the tolerances of " + many(count, "parameter");
  if (const std::size_t count = result.task.loads_within.size(); count > 0)
    of += (of.empty() ? "" : ", ") + ("every load within " + many(count, "ball"));
  if (result.task.loads) of += (of.empty() ? "" : ", ") + std::string("every load of loads_from");
  if (!of.empty()) put("of", of);
  if (result.preload)
    for (const std::string& line : preload_lines(*result.preload, result.units)) put("preload", printable(line));
  if (!result.zone.empty()) put("zone", result.zone);
  const bool apart = result.margin && result.angle_margin;
  if (result.margin)
    put("margin", fmt::format("at least {}, proven{}", words.at_least(*result.margin, "m"),
                              apart ? ", with the angles of the task"
                              : result.task.angle_length
                                  ? ", " + words.length(core::to_double(*result.task.angle_length)) + " per radian"
                                  : ""));
  if (result.angle_margin)
    put("margin", fmt::format("at least {}, proven{}", words.at_least(*result.angle_margin, "rad"),
                              apart ? ", with the lengths of the task" : ""));
  if (result.pose_error) put("pose error", fmt::format("at most {}, proven", words.at_most(*result.pose_error, "m")));
  if (result.nearest) {
    const core::NearestOfTask& nearest = *result.nearest;
    const bool in_task = nearest.distance <= rounding_of_distance;
    put("nearest", fmt::format("{}{}{}{} at {}, {}", kind_words(nearest.kind), nearest.vanishing.empty() ? "" : " ",
                               reaction_names(nearest.vanishing),
                               nearest.isolated        ? ", an isolated point"
                               : nearest.curve.empty() ? ""
                               : nearest.limit.empty() ? " on " + nearest.curve
                                                       : ", limit of the " + nearest.limit + ", on " + nearest.curve,
                               words.pose(nearest.at),
                               in_task ? "in the task"
                                       : fmt::format("{}{} away", words.plane() ? "" : "found ",
                                                     words.distance(nearest.distance))));
  }
  if (result.witness)
    put("witness", fmt::format("{}: {}", words.pose(result.witness->at, place_digits), shown_witness_words(result)));
  if (result.open)
    put("open", fmt::format("{} from {} to {}: {}; the rest is proven", many(result.open->cells, "cell"),
                            words.pose(result.open->lower, place_digits), words.pose(result.open->upper, place_digits),
                            open_words(result)));
  for (const core::LeastReaction& reaction : result.least)
    put("least",
        fmt::format("|{}| at least {} over the task, proven; least value found {}", reaction_name(reaction.reaction),
                    words.at_least(reaction.proven, core::unit_of(reaction.reaction.quantity)),
                    words.effort(reaction.reaction, reaction.met)));
  for (const std::string& note : told_once(core::in_file_units(result.notes, result.units, result.angles)))
    text += printable(note) + "\n";
  return text;
}

std::string verification_picture(const core::Verification& result, PictureFormat format) {
  if (result.map.loci.tower.coordinates.empty()) return task_panels(result, format);
  const ShownUnit unit = shown_unit("m", result.units);
  const auto shown = [&](double x, double y) { return core::Point2{x * unit.per_si, y * unit.per_si}; };
  TaskMark mark;
  for (const core::Point2& at : core::outline(result.task.shape)) mark.outline.push_back(shown(at[0], at[1]));
  mark.filled = !std::holds_alternative<core::TaskPath>(result.task.shape);
  mark.verified = result.verified();
  mark.margin = unit.per_si * (result.verified() ? result.margin.value_or(0) : core::to_double(result.task.margin));
  if (result.witness)
    mark.points.push_back(shown(result.witness->at[0], result.witness->at[1]));
  else if (result.nearest)
    mark.points.push_back(shown(result.nearest->at[0], result.nearest->at[1]));
  return task_picture(in_file_units(result.map), result.mode, mark, format);
}

}  // namespace clearloci::report
