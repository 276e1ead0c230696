#include "report/verification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/task.hpp"
#include "report/file_units.hpp"
#include "report/loci_json.hpp"
#include "report/picture.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;

/// m; what is nearer is in the task but for rounding.
constexpr double rounding_of_distance = 1e-12;

std::string unit_of(const core::Vanishing& reaction, const core::Units& units) {
  return reaction.quantity == core::Quantity::M || reaction.quantity == core::Quantity::T ? "N m" : units.force.name;
}

std::string open_words(const core::OpenTask& open) {
  switch (open.reason) {
    case core::OpenTask::Reason::time:
      return "the time limit was reached";
    case core::OpenTask::Reason::cells:
      return fmt::format("{} cells were looked at", open.looked_at);
    case core::OpenTask::Reason::doubles:
      break;
  }
  return "doubles tell no more apart there";
}

/// Exact numbers of a shape, rounded.
Json point_json(const core::RationalPoint& p) { return {core::to_double(p[0]), core::to_double(p[1])}; }

Json points_json(const std::vector<core::RationalPoint>& points) {
  Json list = Json::array();
  for (const core::RationalPoint& p : points) list.push_back(point_json(p));
  return list;
}

Json shape_json(const core::TaskShape& shape) {
  if (const auto* box = std::get_if<core::TaskBox>(&shape))
    return {{"lower", point_json(box->lower)}, {"upper", point_json(box->upper)}};
  if (const auto* circle = std::get_if<core::TaskCircle>(&shape))
    return {{"centre", point_json(circle->centre)}, {"radius", core::to_double(circle->radius)}};
  if (const auto* polygon = std::get_if<core::TaskPolygon>(&shape)) return points_json(polygon->corners);
  return points_json(std::get<core::TaskPath>(shape).points);
}

}  // namespace

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

std::string witness_words(const core::TaskWitness& witness, const core::Units& units) {
  std::string words;
  switch (witness.kind) {
    case core::TaskWitness::Kind::unreachable:
      words = witness.limit.empty() ? "the mechanism does not reach it" : "beyond the limit of the " + witness.limit;
      break;
    case core::TaskWitness::Kind::boundary:
      words = witness.limit.empty() ? "the boundary of the workspace passes here"
                                    : "the limit of the " + witness.limit + " passes here";
      break;
    case core::TaskWitness::Kind::singular:
      words = "|A| vanishes: a direct singularity";
      break;
    case core::TaskWitness::Kind::vanishing:
      words = reaction_names(witness.vanishing) + (witness.vanishing.size() > 1 ? " vanish" : " vanishes");
      break;
    case core::TaskWitness::Kind::too_small:
      words = fmt::format("|{}| is {} {}, less than {}", reaction_name(witness.too_small.front()),
                          engineering(*witness.size, size_digits), unit_of(witness.too_small.front(), units),
                          engineering(core::to_double(*witness.least), size_digits));
      break;
    case core::TaskWitness::Kind::displaced:
      words = fmt::format("the clearances displace the end effector by {} {}, more than {}",
                          engineering(*witness.size, size_digits), units.length.name,
                          engineering(core::to_double(*witness.most), size_digits));
      break;
  }
  if (witness.load)
    words += fmt::format(" under the load ({}, {}) {}", engineering((*witness.load)[0], place_digits),
                         engineering((*witness.load)[1], place_digits), units.force.name);
  for (const core::WitnessLoad& own : witness.loads)
    words += fmt::format(" under ({}, {}) {} and {} N m as load {}",
                         engineering(own.force[0] / units.force.size, place_digits),
                         engineering(own.force[1] / units.force.size, place_digits), units.force.name,
                         engineering(own.couple, place_digits), own.load + 1);
  for (std::size_t i = 0; i < witness.design.size(); ++i)
    words += fmt::format("{}{} = {}", i == 0 ? " of the design " : ", ", witness.design[i].first,
                         exact_number(witness.design[i].second));
  if (witness.distance > rounding_of_distance)
    words += fmt::format("; {} {} from the task, within its margin", engineering(witness.distance, size_digits),
                         units.length.name);
  return words;
}

std::string shown_witness_words(const core::Verification& result) {
  return witness_words(*in_file_units(result).witness, result.units);
}

Json verification_object(const core::Verification& result) {
  const core::LocusMap& loci = result.map.loci;
  Json root = {{"format", 1},
               {"mechanism", printable(loci.mechanism)},
               // A verdict alone comes without a map, and so without the names of the mode's points.
               {"working_mode", loci.tower.roots.empty() ? Json::object() : mode_object(loci.tower, result.mode)},
               {"task", {{core::kind_of(result.task.shape), shape_json(result.task.shape)}}},
               {"verdict", core::to_string(result.verdict)},
               {"verified", result.verified()},
               {"zone", result.zone.empty() ? Json(nullptr) : Json(result.zone)},
               {"margin", result.verified() ? Json(result.margin) : Json(nullptr)},
               {"nearest", nullptr},
               {"witness", nullptr},
               {"open", nullptr}};
  if (result.units.declared) root["units"] = "SI";
  if (result.task.pose_error) root["pose_error"] = result.pose_error ? Json(*result.pose_error) : Json(nullptr);
  if (result.by) root["moved_by"] = point_json(*result.by);
  if (result.nearest) {
    const core::NearestOfTask& nearest = *result.nearest;
    Json joints = Json::array();
    for (const core::Vanishing& v : nearest.vanishing)
      if (std::find(joints.begin(), joints.end(), v.joint) == joints.end()) joints.push_back(v.joint);
    root["nearest"] = {{"curve", nearest.curve.empty() ? Json(nullptr) : Json(nearest.curve)},
                       {"kind", core::to_string(nearest.kind)},
                       {"joints", std::move(joints)},
                       {"vanishing", vanishing_array(nearest.vanishing)},
                       {"at", nearest.at},
                       {"distance", nearest.distance}};
    if (!nearest.limit.empty()) root["nearest"]["limit"] = nearest.limit;
  }
  if (result.witness) {
    const core::TaskWitness& witness = *result.witness;
    root["witness"] = {{"at", witness.at},
                       {"load", witness.load ? Json(*witness.load) : Json(nullptr)},
                       {"distance", witness.distance},
                       {"reason", witness_words(witness, {})},
                       {"vanishing", vanishing_array(witness.vanishing)},
                       {"too_small", vanishing_array(witness.too_small)},
                       {"size", witness.size ? Json(*witness.size) : Json(nullptr)}};
    if (!witness.limit.empty()) root["witness"]["limit"] = witness.limit;
    if (!witness.design.empty()) {
      Json design = Json::object();
      for (const auto& [name, value] : witness.design) design[name] = value;
      root["witness"]["design"] = design;
    }
    if (!witness.loads.empty()) {
      Json loads = Json::array();
      for (const core::WitnessLoad& own : witness.loads)
        loads.push_back({{"load", own.load + 1}, {"force", own.force}, {"couple", own.couple}});
      root["witness"]["loads"] = loads;
    }
  }
  if (result.open)
    root["open"] = {{"lower", result.open->lower},
                    {"upper", result.open->upper},
                    {"cells", result.open->cells},
                    {"reason", open_words(*result.open)}};
  root["notes"] = result.notes;
  return root;
}

std::string verification_text(const core::Verification& in_si, bool fit) {
  const core::Verification result = in_file_units(in_si);
  const std::string& unit = result.units.length.name;
  std::string text;
  const auto put = [&](fmt::string_view format, const auto&... values) {
    text += fmt::format(fmt::runtime(format), values...);
  };
  const core::LocusMap& loci = result.map.loci;
  put("{}: {}", printable(loci.mechanism), core::kind_of(result.task.shape));
  const std::string mode = printable(mode_words(loci.tower, result.mode));
  put("{}\n\n", mode.empty() ? "" : "; " + mode);
  if (result.by)
    put("moved by      ({}, {}) {}\n", engineering(core::to_double((*result.by)[0]), size_digits),
        engineering(core::to_double((*result.by)[1]), size_digits), unit);
  else if (fit)
    put("No place in the box was found that verifies; where the task lies:\n");
  put("{}\n", verdict_line(result.verdict));
  const auto many = [](std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  };
  std::string of;
  if (const std::size_t count = result.task.tolerances.size(); count > 0)
    of = "every design within the tolerances of " + many(count, "parameter");
  if (const std::size_t count = result.task.loads_within.size(); count > 0)
    of += (of.empty() ? "" : ", ") + ("every load within " + many(count, "ball"));
  if (!of.empty()) put("of            {}\n", of);
  if (!result.zone.empty()) put("zone          {}\n", result.zone);
  if (result.verified()) put("margin        at least {} {}, proven\n", engineering(result.margin, size_digits), unit);
  if (result.pose_error)
    put("pose error    at most {} {}, proven\n", engineering(*result.pose_error, size_digits), unit);
  if (result.nearest) {
    const core::NearestOfTask& nearest = *result.nearest;
    put("nearest       {}{}{}{} at ({}, {}), {}\n", kind_words(nearest.kind), nearest.vanishing.empty() ? "" : " ",
        reaction_names(nearest.vanishing),
        nearest.isolated        ? ", an isolated point"
        : nearest.curve.empty() ? ""
        : nearest.limit.empty() ? " on " + nearest.curve
                                : ", limit of the " + nearest.limit + ", on " + nearest.curve,
        engineering(nearest.at[0], size_digits), engineering(nearest.at[1], size_digits),
        nearest.distance > rounding_of_distance
            ? fmt::format("{} {} away", engineering(nearest.distance, size_digits), unit)
            : "in the task");
  }
  if (result.witness)
    put("witness       ({}, {}): {}\n", engineering(result.witness->at[0], place_digits),
        engineering(result.witness->at[1], place_digits), witness_words(*result.witness, result.units));
  if (result.open)
    put("open          {} cell{} in [{}, {}] x [{}, {}]: {}; the rest is proven\n", result.open->cells,
        result.open->cells == 1 ? "" : "s", engineering(result.open->lower[0], place_digits),
        engineering(result.open->upper[0], place_digits), engineering(result.open->lower[1], place_digits),
        engineering(result.open->upper[1], place_digits), open_words(*result.open));
  for (const std::string& note : told_once(result.notes)) put("{}\n", printable(note));
  return text;
}

std::string verification_picture(const core::Verification& result, PictureFormat format) {
  const core::Verification shown = in_file_units(result);
  TaskMark mark;
  mark.outline = core::outline(shown.task.shape);
  mark.filled = !std::holds_alternative<core::TaskPath>(result.task.shape);
  mark.verified = result.verified();
  mark.margin = shown.verified() ? shown.margin : core::to_double(shown.task.margin);
  if (shown.witness)
    mark.points.push_back(shown.witness->at);
  else if (shown.nearest)
    mark.points.push_back(shown.nearest->at);
  return task_picture(shown.map, result.mode, mark, format);
}

}  // namespace clearloci::report
