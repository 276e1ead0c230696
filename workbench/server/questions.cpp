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
  for (const Model::Parameter& own : model.parameters())
    list.push_back({{"name", own.name}, {"exact", own.exact}, {"value", own.value}});
  return list;
}

Json coordinates_json(const Model& model) {
  Json list = Json::array();
  for (const Model::Coordinate& own : model.coordinates())
    list.push_back({{"name", own.name}, {"angle", own.angle}, {"lower", own.lower}, {"upper", own.upper}});
  return list;
}

Json joints_json(const Model& model) {
  Json list = Json::array();
  for (const Model::Joint& own : model.joints())
    list.push_back({{"name", own.name},
                    {"type", own.type},
                    {"actuated", own.actuated},
                    {"clearance", own.clearance},
                    {"from", own.from},
                    {"to", own.to},
                    {"at", own.at}});
  return list;
}

Json links_json(const Model& model) {
  Json list = Json::array();
  for (const Model::Link& own : model.links()) list.push_back({{"name", own.name}, {"points", own.points}});
  return list;
}

Json dyads_json(const Model& model) {
  Json list = Json::array();
  for (const Model::Dyad& own : model.dyads())
    list.push_back({{"point", own.point}, {"left", own.left}, {"right", own.right}, {"side", own.side}});
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
            {"zones", zone_formats()},
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
  const ImportedFile found = import_text(fields.text("text"), fields.text("file", "model.yaml"), request);
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
  constexpr std::array<std::pair<std::string_view, Question>, 12> known = {{{"model", answer_model},
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
  for (const auto& [own, question] : known)
    if (own == name) return question;
  return nullptr;
}

}  // namespace clearloci::workbench
