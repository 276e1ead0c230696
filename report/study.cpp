#include "report/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/task.hpp"
#include "report/files.hpp"
#include "report/loci_json.hpp"
#include "report/study_words.hpp"
#include "report/table_json.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using core::StudyDesign;
using core::StudyResult;
using Json = nlohmann::ordered_json;

std::string quoted(const std::string& text) {
  return text.find_first_of(",\"\n") == std::string::npos ? text : fmt::format("\"{}\"", text);
}

std::string number(double value) { return std::isnan(value) ? std::string() : exact_number(value); }

Json design_object(const StudyResult& result, const StudyDesign& design) {
  Json object = {{"index", design.index}};
  Json parameters = Json::object(), figures = Json::object();
  for (std::size_t i = 0; i < result.parameters.size(); ++i)
    parameters[result.parameters[i]] = number_json(design.values[i]);
  for (std::size_t f = 0; f < result.figures.size() && f < design.figures.size(); ++f)
    figures[core::to_string(result.figures[f])] = number_json(design.figures[f]);
  object["parameters"] = parameters;
  object["status"] = to_string(design.status);
  if (!design.reason.empty()) object["reason"] = design.reason;
  object["figures"] = figures;
  return object;
}

Json cell_object(const StudyResult& result, const core::StudyCell& cell) {
  Json object = Json::object();
  for (std::size_t i = 0; i < result.parameters.size(); ++i)
    object[result.parameters[i]] = {number_json(cell.lower[i]), number_json(cell.upper[i])};
  return object;
}

Json ranges_array(const StudyResult& result) {
  Json list = Json::array();
  for (const core::ProvenRange& range : result.ranges)
    list.push_back({{"from", range.from}, {"to", range.to}, {"below", range.below}, {"above", range.above}});
  return list;
}

Json cells_object(const StudyResult& result) {
  Json columns = Json::object();
  for (std::size_t i = 0; i < result.parameters.size(); ++i) {
    Json lower = Json::array(), upper = Json::array();
    for (const core::StudyCell& cell : result.cells) {
      lower.push_back(number_json(cell.lower[i]));
      upper.push_back(number_json(cell.upper[i]));
    }
    columns[result.parameters[i] + "_from"] = std::move(lower);
    columns[result.parameters[i] + "_to"] = std::move(upper);
  }
  Json status = Json::array(), reason = Json::array();
  for (const core::StudyCell& cell : result.cells) {
    status.push_back(to_string(cell.status));
    reason.push_back(cell.reason);
  }
  columns["status"] = std::move(status);
  columns["reason"] = std::move(reason);
  return columns;
}

std::string cells_csv(const StudyResult& result) {
  std::string out;
  for (const std::string& parameter : result.parameters) out += parameter + "_from," + parameter + "_to,";
  out += "status,reason\n";
  for (const core::StudyCell& cell : result.cells) {
    for (std::size_t i = 0; i < cell.lower.size(); ++i)
      out += number(cell.lower[i]) + "," + number(cell.upper[i]) + ",";
    out += to_string(cell.status) + "," + quoted(cell.reason) + "\n";
  }
  return out;
}

/// Column by column: a million designs are a million numbers a column, not a million objects.
Json designs_object(const StudyResult& result) {
  Json columns = Json::object();
  Json index = Json::array(), status = Json::array(), reason = Json::array(), task = Json::array(), at = Json::array();
  for (const StudyDesign& design : result.designs) {
    index.push_back(design.index);
    status.push_back(to_string(design.status));
    reason.push_back(design.reason);
    task.push_back(design.task + 1);
    at.push_back(design.at ? Json{number_json((*design.at)[0]), number_json((*design.at)[1])} : Json(nullptr));
  }
  columns["index"] = std::move(index);
  for (std::size_t i = 0; i < result.parameters.size(); ++i) {
    Json values = Json::array();
    for (const StudyDesign& design : result.designs) values.push_back(number_json(design.values[i]));
    columns[result.parameters[i]] = std::move(values);
  }
  columns["status"] = std::move(status);
  columns["reason"] = std::move(reason);
  columns["task"] = std::move(task);
  columns["at"] = std::move(at);
  for (std::size_t f = 0; f < result.figures.size(); ++f) {
    Json values = Json::array();
    for (const StudyDesign& design : result.designs)
      values.push_back(f < design.figures.size() ? number_json(design.figures[f]) : Json(nullptr));
    columns[core::to_string(result.figures[f])] = std::move(values);
  }
  return columns;
}

}  // namespace

std::string study_csv(const StudyResult& result) {
  if (result.study.method.kind == core::StudyMethod::Kind::prove) return cells_csv(result);
  std::string out = "index";
  for (const std::string& parameter : result.parameters) out += "," + parameter;
  out += ",status,reason,task,at_1,at_2";
  for (const core::Figure figure : result.figures) out += "," + core::to_string(figure);
  out += '\n';
  for (const StudyDesign& design : result.designs) {
    out += std::to_string(design.index);
    for (const double value : design.values) out += "," + number(value);
    out += "," + to_string(design.status) + "," + quoted(design.reason) + ",";
    const bool fails =
        design.status == StudyDesign::Status::infeasible || design.status == StudyDesign::Status::undecided;
    if (fails) out += std::to_string(design.task + 1);
    for (std::size_t c = 0; c < 2; ++c) out += "," + (design.at ? number((*design.at)[c]) : std::string());
    for (const double value : design.figures) out += "," + number(value);
    out += '\n';
  }
  return out;
}

Json study_object(const StudyResult& result) {
  Json object = {{"format", 1}, {"mechanism", printable(result.mechanism)}, {"study", printable(result.study.file)}};
  Json vary = Json::object();
  for (const core::StudyParameter& parameter : result.study.vary)
    vary[parameter.name] = {core::to_string(parameter.lower), core::to_string(parameter.upper)};
  object["vary"] = vary;
  object["method"] = method_words(result.study.method);
  Json goals = Json::array();
  for (const core::StudyGoal& goal : result.study.goals) goals.push_back(goal_words(goal));
  object["goals"] = goals;
  Json figures = Json::object();
  for (const core::Figure figure : result.figures) figures[core::to_string(figure)] = unit_of(figure);
  object["figures"] = figures;
  object["complete"] = result.complete;
  using Status = StudyDesign::Status;
  if (result.study.method.kind == core::StudyMethod::Kind::prove) {
    Json shares = Json::object();
    for (const Status status : {Status::feasible, Status::infeasible, Status::undecided, Status::left_out})
      shares[to_string(status)] = share(result, status);
    object["shares"] = shares;
    if (result.parameters.size() == 1) object["ranges"] = ranges_array(result);
    if (result.best) object["best"] = design_object(result, result.designs[*result.best]);
    if (result.best_goal) object["best_goal"] = *result.best_goal;
    object["tolerances"] = result.tolerances ? cell_object(result, *result.tolerances) : Json(nullptr);
    object["cells"] = cells_object(result);
    return object;
  }
  Json counts = Json::object();
  for (const Status status : {Status::feasible, Status::infeasible, Status::undecided, Status::left_out})
    counts[to_string(status)] = count(result, status);
  object["counts"] = counts;
  Json reasons = Json::object();
  for (const auto& [reason, many] : study_reasons(result)) reasons[reason] = many;
  object["reasons"] = reasons;
  object["best"] = result.best ? design_object(result, result.designs[*result.best]) : Json(nullptr);
  if (result.study.goals.size() > 1) {
    Json front = Json::array();
    for (const std::size_t index : result.front) front.push_back(design_object(result, result.designs[index]));
    object["front"] = front;
  }
  object["designs"] = designs_object(result);
  return object;
}

namespace {

std::string end_words(const std::array<double, 2>& end, const std::string& reason) {
  std::string words = exact_number(end[0]);
  if (end[0] != end[1]) words = fmt::format("[{}, {}]", words, exact_number(end[1]));
  return words + (reason.empty() ? "" : " (beyond: " + printable(reason) + ")");
}

std::string proof_text(const StudyResult& result) {
  using Status = StudyDesign::Status;
  std::string out = fmt::format("{}: {} cells, {}\n\n", printable(result.mechanism), result.cells.size(),
                                method_words(result.study.method));
  const std::pair<Status, const char*> lines[] = {
      {Status::feasible, "every design verifies, proven"},
      {Status::infeasible, "every design fails, proven"},
      {Status::undecided,
       result.complete ? "neither is proven, even in the finest cells" : "neither is proven, or not looked at yet"},
      {Status::left_out, result.best_goal ? "keep does not hold, or no better than the best" : "keep does not hold"}};
  for (const auto& [status, words] : lines) {
    const double part = share(result, status);
    if (part > 0 || status == Status::feasible)
      out += fmt::format("{:<12}{:>9.4f} %  {}\n", to_string(status), 100 * part, words);
  }
  if (!result.complete) out += "\nincomplete: --resume goes on\n";
  for (const core::ProvenRange& index : result.ranges)
    out += fmt::format("\n{} verifies from {} to {}\n", result.parameters.front(), end_words(index.from, index.below),
                       end_words(index.to, index.above));
  if (result.best_goal) {
    const core::StudyGoal& goal = result.study.goals.front();
    out += fmt::format("\nbest         {}: {}, and no design {} {}, proven\n", goal_words(goal),
                       exact_number((*result.best_goal)[1]), goal.maximise ? "above" : "below",
                       exact_number((*result.best_goal)[0]));
    for (std::size_t i = 0; i < result.parameters.size(); ++i)
      out += fmt::format("  {} = {}\n", result.parameters[i], exact_number(result.designs[*result.best].values[i]));
  } else if (result.best)
    out += fmt::format("\nbest         {}\n  {} = {}, rounded inwards\n", goal_words(result.study.goals.front()),
                       result.parameters.front(), exact_number(result.designs[*result.best].values.front()));
  if (!result.tolerances) return out;
  out += "\naround the file's design every design verifies with\n";
  for (std::size_t i = 0; i < result.parameters.size(); ++i)
    out += fmt::format("  {} from {} to {}\n", result.parameters[i], exact_number(result.tolerances->lower[i]),
                       exact_number(result.tolerances->upper[i]));
  return out;
}

}  // namespace

std::string study_text(const StudyResult& result) {
  using Status = StudyDesign::Status;
  if (result.study.method.kind == core::StudyMethod::Kind::prove) return proof_text(result);
  std::string out = fmt::format("{}: {} designs, {}\n\n", printable(result.mechanism), result.designs.size(),
                                method_words(result.study.method));
  for (const Status status : {Status::feasible, Status::infeasible, Status::undecided, Status::left_out}) {
    const std::size_t many = count(result, status);
    if (many == 0 && status != Status::feasible) continue;
    out += fmt::format("{:<12}{:>9}{}\n", to_string(status), many,
                       status == Status::feasible ? "  proven for every pose of the task" : "");
  }
  const auto reasons = study_reasons(result);
  if (!reasons.empty()) out += "\nwhy designs fail\n";
  constexpr std::size_t most = 12;
  for (std::size_t i = 0; i < std::min(reasons.size(), most); ++i)
    out += fmt::format("{:>9}  {}\n", reasons[i].second, printable(reasons[i].first));
  if (reasons.size() > most) out += fmt::format("{:>9}  further reasons: designs.json\n", reasons.size() - most);
  if (!result.complete) out += "\nincomplete: --resume goes on\n";
  if (!result.best) return out;
  const StudyDesign& best = result.designs[*result.best];
  out += fmt::format("\nbest         {}\n", goal_words(result.study.goals.front()));
  for (std::size_t i = 0; i < result.parameters.size(); ++i)
    out += fmt::format("  {} = {}\n", result.parameters[i], exact_number(best.values[i]));
  for (std::size_t f = 0; f < result.figures.size(); ++f)
    out += fmt::format("  {:<14} {} {}\n", core::to_string(result.figures[f]), short_number(best.figures[f], 6),
                       unit_of(result.figures[f]));
  for (const std::string& words : edge_words(result)) out += "  " + words + "\n";
  if (result.front.size() > 1)
    out += fmt::format("front        {} designs, none better in every goal\n", result.front.size());
  return out;
}

std::vector<std::string> study_format_names() { return {"csv", "svg", "png", "pdf", "html"}; }

std::vector<std::filesystem::path> stage_study(StagedFiles& staged, const StudyResult& result,
                                               const std::filesystem::path& directory,
                                               const std::set<std::string>& formats) {
  std::vector<std::filesystem::path> files;
  const auto write = [&](const std::string& name, const std::string& bytes) {
    files.push_back(directory / name);
    staged.add(files.back(), bytes);
  };
  write("designs.json", json_text(study_object(result)));
  if (formats.contains("csv")) write("designs.csv", study_csv(result));
  if (formats.contains("svg")) write("designs.svg", study_picture(result, PictureFormat::svg));
  if (formats.contains("png")) write("designs.png", study_picture(result, PictureFormat::png));
  if (formats.contains("pdf")) write("designs.pdf", study_picture(result, PictureFormat::pdf));
  return files;
}

}  // namespace clearloci::report
