#include "report/pose_verification.hpp"
#include "core/shown_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <numbers>

#include "report/file_units.hpp"
#include "report/loci_json.hpp"
#include "report/verification.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;
using Kind = core::TaskWitness::Kind;

Json rounded(const core::RationalPose& pose) {
  Json list = Json::array();
  for (const core::Rational& value : pose) list.push_back(core::to_double(value));
  return list;
}

Json shape_json(const core::PoseShape& shape) {
  if (const auto* box = std::get_if<core::PoseBoxShape>(&shape))
    return {{"lower", rounded(box->lower)}, {"upper", rounded(box->upper)}};
  if (const auto* ball = std::get_if<core::PoseBallShape>(&shape))
    return {{"centre", rounded(ball->centre)}, {"radius", core::to_double(ball->radius)}};
  if (const auto* mesh = std::get_if<core::PoseMeshShape>(&shape)) {
    std::array<double, 3> lower = mesh->corners.front(), upper = lower;
    for (const std::array<double, 3>& corner : mesh->corners)
      for (std::size_t c = 0; c < 3; ++c) {
        lower[c] = std::min(lower[c], corner[c]);
        upper[c] = std::max(upper[c], corner[c]);
      }
    return {{"file", printable(mesh->file)}, {"triangles", mesh->triangles.size()}, {"lower", lower}, {"upper", upper}};
  }
  Json points = Json::array();
  for (const core::RationalPose& point : std::get<core::PosePathShape>(shape).points) points.push_back(rounded(point));
  return points;
}

std::string open_words(core::OpenTask::Reason reason) {
  switch (reason) {
    case core::OpenTask::Reason::time:
      return "the time limit was reached";
    case core::OpenTask::Reason::cells:
      return "as many cells were looked at as are allowed";
    case core::OpenTask::Reason::doubles:
      break;
  }
  return "cells stay open however small they are cut";
}

class Words {
 public:
  Words(const core::PoseVerification& result, const core::Units& units) : result_(result), units_(units) {}

  std::string length(double metres) const {
    const ShownUnit unit = shown_unit("m", units_);
    return engineering(metres * unit.per_si, size_digits) + " " + unit.name;
  }
  static std::string angle(double radians) {
    return engineering(radians * 180 / std::numbers::pi, size_digits) + " deg";
  }

  /// "5 N", "2 N m".
  std::string effort(const core::Vanishing& reaction, double value) const {
    const ShownUnit unit = shown_unit(core::unit_of(reaction.quantity), units_);
    return engineering(value * unit.per_si, size_digits) + " " + unit.name;
  }
  std::string force(const std::vector<double>& parts) const {
    const ShownUnit unit = shown_unit("N", units_);
    std::string words;
    for (const double part : parts)
      words += (words.empty() ? "(" : ", ") + engineering(part * unit.per_si, place_digits);
    return words + ") " + unit.name;
  }

  /// "x = 0.1 m, alpha = 5 deg".
  std::string pose(const std::vector<double>& at) const {
    std::string words;
    for (std::size_t c = 0; c < at.size(); ++c)
      words += fmt::format("{}{} = {}", c == 0 ? "" : ", ", result_.coordinates[c],
                           result_.angles[c] ? angle(at[c]) : length(at[c]));
    return words;
  }

  /// A distance in the task's metric.
  std::string distance(double value) const {
    const bool any_length = std::find(result_.angles.begin(), result_.angles.end(), false) != result_.angles.end();
    return any_length || result_.task.angle_length ? length(value) : angle(value);
  }

 private:
  const core::PoseVerification& result_;
  const core::Units& units_;
};

std::string witness_words(const core::PoseTaskWitness& witness, const Words& shown) {
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
      words = reaction_names(witness.reactions) + (witness.reactions.size() > 1 ? " vanish" : " vanishes");
      break;
    case Kind::too_small:
      words = fmt::format("|{}| is {}, less than {}", reaction_name(witness.reactions.front()),
                          shown.effort(witness.reactions.front(), *witness.size),
                          shown.effort(witness.reactions.front(), core::to_double(*witness.least)));
      break;
    case Kind::displaced:  // not asked for over poses in space
      break;
  }
  if (!witness.load.empty()) words += " under the load " + shown.force(witness.load);
  if (witness.distance > 1e-12) words += "; " + shown.distance(witness.distance) + " from the task, within its margin";
  return words;
}

}  // namespace

Json pose_verification_object(const core::PoseVerification& result) {
  Json mode = Json::object();
  for (const auto& [point, side] : result.working_mode) mode[point] = side;
  const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); };
  Json root = {{"format", 1},
               {"mechanism", printable(result.mechanism)},
               {"coordinates", result.coordinates},
               {"angles", result.angles},
               {"working_mode", std::move(mode)},
               {"task", {{core::kind_of(result.task.shape), shape_json(result.task.shape)}}},
               {"verdict", core::to_string(result.verdict)},
               {"verified", result.verified()},
               {"zone", nullptr},
               {"margin", number(result.margin)},
               {"angle_margin", number(result.angle_margin)},
               {"nearest", nullptr},
               {"witness", nullptr},
               {"open", nullptr}};
  if (result.task.angle_length) root["task"]["angle_length"] = core::to_double(*result.task.angle_length);
  if (result.units.declared) root["units"] = "SI";
  if (result.by) root["by"] = *result.by;
  if (result.scale) root["scale"] = *result.scale;
  if (result.nearest) {
    Json joints = Json::array();
    for (const core::Vanishing& own : result.nearest->reactions)
      if (std::find(joints.begin(), joints.end(), own.joint) == joints.end()) joints.push_back(own.joint);
    root["nearest"] = {{"curve", nullptr},
                       {"kind", core::to_string(result.nearest->kind)},
                       {"joints", std::move(joints)},
                       {"vanishing", vanishing_array(result.nearest->reactions)},
                       {"at", result.nearest->at},
                       {"distance", result.nearest->distance}};
  }
  if (result.witness) {
    const core::Units si;
    const core::PoseTaskWitness& witness = *result.witness;
    const bool small = witness.kind == Kind::too_small;
    root["witness"] = {{"at", witness.at},
                       {"load", witness.load.empty() ? Json(nullptr) : Json(witness.load)},
                       {"distance", witness.distance},
                       {"reason", witness_words(witness, {result, si})},
                       {"vanishing", small ? Json::array() : vanishing_array(witness.reactions)},
                       {"too_small", small ? vanishing_array(witness.reactions) : Json::array()},
                       {"size", number(witness.size)}};
    if (!witness.limit.empty()) root["witness"]["limit"] = witness.limit;
  }
  if (result.open)
    root["open"] = {{"lower", result.open->lower},
                    {"upper", result.open->upper},
                    {"cells", result.open->cells},
                    {"reason", open_words(result.open->reason)}};
  Json least = Json::array();
  for (const core::LeastReaction& own : result.least)
    least.push_back({{"joint", own.reaction.joint},
                     {"quantity", core::to_string(own.reaction.quantity)},
                     {"proven", own.proven},
                     {"met", own.met}});
  root["least"] = std::move(least);
  root["cells"] = result.cells;
  root["notes"] = result.notes;
  return root;
}

std::string pose_verification_text(const core::PoseVerification& result) {
  const Words words(result, result.units);
  std::string text = fmt::format("{}: {} over", printable(result.mechanism), core::kind_of(result.task.shape));
  for (std::size_t c = 0; c < result.coordinates.size(); ++c)
    text += fmt::format("{} {}", c == 0 ? "" : ",", result.coordinates[c]);
  std::string mode;
  for (const auto& [point, side] : result.working_mode)
    mode += fmt::format("{}{} {}", mode.empty() ? "; " : ", ", point, side);
  text += printable(mode) + "\n\n";
  const auto put = [&](const char* head, const std::string& fact) { text += fmt::format("{:<14}{}\n", head, fact); };
  text += std::string(verdict_line(result.verdict)) + "\n";
  if (result.by) put("moved by", words.pose(*result.by));
  if (result.scale) put("scaled by", engineering(*result.scale, size_digits));
  if (result.verified()) {
    const bool apart = result.margin && result.angle_margin;
    if (result.margin)
      put("margin", fmt::format("at least {}, proven{}", words.length(*result.margin),
                                apart ? ", with the angles of the task"
                                : result.task.angle_length
                                    ? ", " + words.length(core::to_double(*result.task.angle_length)) + " a radian"
                                    : ""));
    if (result.angle_margin)
      put("margin", fmt::format("at least {}, proven{}", Words::angle(*result.angle_margin),
                                apart ? ", with the lengths of the task" : ""));
  }
  if (result.nearest)
    put("nearest",
        fmt::format("{}{}{} at {}, {}", kind_words(result.nearest->kind), result.nearest->reactions.empty() ? "" : " ",
                    reaction_names(result.nearest->reactions), words.pose(result.nearest->at),
                    result.nearest->distance > 1e-12
                        ? fmt::format("found {} away", words.distance(result.nearest->distance))
                        : "in the task"));
  if (result.witness)
    put("witness", fmt::format("{}: {}", words.pose(result.witness->at), witness_words(*result.witness, words)));
  if (result.open)
    put("open", fmt::format("{} cell{} from ({}) to ({}): {}; the rest is proven", result.open->cells,
                            result.open->cells == 1 ? "" : "s", words.pose(result.open->lower),
                            words.pose(result.open->upper), open_words(result.open->reason)));
  for (const core::LeastReaction& own : result.least)
    put("least", fmt::format("|{}| at least {} over the task, proven; {} met", reaction_name(own.reaction),
                             words.effort(own.reaction, own.proven), words.effort(own.reaction, own.met)));
  for (const std::string& note : told_once(core::in_file_units(result.notes, result.units, result.angles)))
    text += printable(note) + "\n";
  return text;
}

}  // namespace clearloci::report
