#include "workbench/server/questions.hpp"

#include <array>
#include <utility>

#include "clearloci/errors.hpp"
#include "clearloci/export.hpp"
#include "clearloci/import.hpp"
#include "clearloci/normalize.hpp"
#include "clearloci/sketch.hpp"
#include "workbench/server/refusal.hpp"

namespace clearloci::workbench {
namespace {

Json parameters_json(const Model& model) {
  Json list = Json::array();
  for (const Model::Parameter& parameter : model.parameters())
    list.push_back({{"name", parameter.name}, {"exact", parameter.exact}, {"value", parameter.value}});
  return list;
}

Json coordinates_json(const Model& model) {
  Json list = Json::array();
  for (const Model::Coordinate& coordinate : model.coordinates())
    list.push_back({{"name", coordinate.name},
                    {"angle", coordinate.angle},
                    {"lower", coordinate.lower},
                    {"upper", coordinate.upper}});
  return list;
}

Json joints_json(const Model& model) {
  Json list = Json::array();
  for (const Model::Joint& joint : model.joints())
    list.push_back({{"name", joint.name},
                    {"type", joint.type},
                    {"actuated", joint.actuated},
                    {"clearance", joint.clearance},
                    {"from", joint.from},
                    {"to", joint.to},
                    {"at", joint.at}});
  return list;
}

Json links_json(const Model& model) {
  Json list = Json::array();
  for (const Model::Link& link : model.links()) list.push_back({{"name", link.name}, {"points", link.points}});
  return list;
}

Json dyads_json(const Model& model) {
  Json list = Json::array();
  for (const Model::Dyad& dyad : model.dyads())
    list.push_back({{"point", dyad.point}, {"left", dyad.left}, {"right", dyad.right}, {"side", dyad.side}});
  return list;
}

}  // namespace

Json answer_model(const Json& body, const Watch&) {
  const Fields fields(body);
  const Model model = model_of(fields);
  const auto sample = sample_pose(model, sides_of(fields));
  return {{"name", model.name()},
          {"spatial", model.spatial()},
          {"pose_is_place", pose_is_place(model)},
          {"parameters", parameters_json(model)},
          {"coordinates", coordinates_json(model)},
          {"joints", joints_json(model)},
          {"links", links_json(model)},
          {"end_effector", {{"link", model.end_effector().link}, {"at", model.end_effector().at}}},
          {"dyads", dyads_json(model)},
          {"sample", sample ? Json(*sample) : Json(nullptr)},
          {"formats",
           {{"loci", loci_formats(model.coordinates().size())},
            {"zones", zone_formats(model)},
            {"verification", verification_formats()}}}};
}

Json answer_normalize(const Json& body, const Watch&) {
  const NormalizedFile found = normalize(model_of(Fields(body)));
  return {{"text", found.text}, {"notes", found.notes}};
}

Json answer_import(const Json& body, const Watch&) {
  const Fields fields(body);
  const ImportRequest request{.clearance = fields.text("clearance", ""),
                              .side = fields.text("side", ""),
                              .side_file = fields.text("side_file", "")};
  const ImportedFile found = import_text(fields.text("text"), file_of(fields), request);
  return {{"text", found.text}, {"source", found.format}, {"notes", found.notes}};
}

LociRequest watched(LociRequest request, const Watch& watch) {
  request.deadline = watch.deadline;
  request.progress = [watch](double fraction, std::string_view stage) {
    if (watch.abandoned()) throw LimitReached("a newer request has taken the place of this one");
    watch.progress(fraction, stage);
  };
  return request;
}

void check(const Watch& watch) {
  if (watch.abandoned()) throw LimitReached("a newer request has taken the place of this one");
  if (std::chrono::steady_clock::now() > watch.deadline) throw LimitReached("the time limit was reached");
}

Question question_named(const std::string& name) {
  constexpr std::array<std::pair<std::string_view, Question>, 12> questions = {{{"model", answer_model},
                                                                                {"loci", answer_loci},
                                                                                {"zones", answer_zones},
                                                                                {"verify", answer_verify},
                                                                                {"pose", answer_pose},
                                                                                {"sweep", answer_sweep},
                                                                                {"cycle", answer_cycle},
                                                                                {"modes", answer_modes},
                                                                                {"trajectory", answer_trajectory},
                                                                                {"normalize", answer_normalize},
                                                                                {"import", answer_import},
                                                                                {"export", answer_export}}};
  for (const auto& [question_name, question] : questions)
    if (question_name == name) return question;
  return nullptr;
}

}  // namespace clearloci::workbench
