// Loci, zones, verdicts, and their files.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "clearloci/errors.hpp"
#include "clearloci/export.hpp"
#include "clearloci/handed_files.hpp"
#include "clearloci/verify.hpp"
#include "clearloci/zones.hpp"
#include "report/base64.hpp"
#include "report/formats.hpp"
#include "report/loci_json.hpp"
#include "report/verification.hpp"
#include "report/viewer.hpp"
#include "report/zones.hpp"
#include "workbench/server/questions.hpp"
#include "workbench/server/refusal.hpp"

namespace clearloci::workbench {
namespace {

Json loci_json(const LocusMap& map) { return report::viewer_object({map, {}}); }

Json files_json(const std::vector<ExportedFile>& files) {
  Json list = Json::array();
  for (const ExportedFile& file : files) list.push_back({{"name", file.name}, {"base64", report::base64(file.bytes)}});
  return {{"files", std::move(list)}};
}

/// Tasks of two lengths lie among loci and zones; those of other coordinates are proven over poses.
bool over_two_lengths(const Model& model) {
  const std::vector<Model::Coordinate> coordinates = model.coordinates();
  return coordinates.size() == 2 &&
         std::none_of(coordinates.begin(), coordinates.end(), [](const auto& one) { return one.angle; });
}

/// That the page can draw.
Zones zones_in_plane(const Model& model, const LociRequest& request) {
  if (!over_two_lengths(model))
    throw InputError({}, "the workbench draws zones over two lengths", "ask 'clearloci zones' for those over others");
  return find_zones(model, {request});
}

/// `task`: the text of a task file.
Verification verification(const Fields& fields, const Watch& watch) {
  const Model model = model_of(fields);
  const std::string fit = fields.text("fit", "");
  if (!fit.empty() && fit != "nearest" && fit != "best" && fit != "largest")
    throw Refusal(400, "'fit' is to be nearest, best or largest");
  VerifyRequest request{.loci = watched(loci_request(fields, model), watch)};
  if (!fit.empty())
    request.fit = fit == "nearest" ? TaskFit::nearest : fit == "best" ? TaskFit::best : TaskFit::largest;
  // Over two lengths the loci are drawn already.
  if (over_two_lengths(model) && fit.empty() && !fields.flag("with_loci")) request.depth = VerifyDepth::margin;
  return verify(model, parse_task(fields.text("task"), model, fields.files("files")), request);
}

}  // namespace

/// `last`: the name of the loci that the page shows. A first part of the answer is where they go.
Json answer_loci(const Json& body, const Watch& watch) {
  const Fields fields(body);
  const Model model = model_of(fields);
  LociRequest request = watched(loci_request(fields, model), watch);
  const auto kept = [&watch](LocusMap map) {
    Json picture = loci_json(map);
    if (watch.answered != nullptr) picture["name"] = watch.answered->keep(std::move(map));
    return picture;
  };
  if (watch.answered != nullptr) {
    request.last = watch.answered->find(fields.text("last", ""));
    request.carried = [&](LocusMap map) {
      Json picture = kept(std::move(map));
      picture["seconds"] = watch.seconds();
      watch.ahead({{"carried", std::move(picture)}});
    };
  }
  return kept(trace_loci(model, request));
}

Json answer_zones(const Json& body, const Watch& watch) {
  const Fields fields(body);
  const Model model = model_of(fields);
  const Zones map = zones_in_plane(model, watched(loci_request(fields, model), watch));
  Json answer = report::zones_object(map);
  if (fields.flag("with_loci")) answer["picture"] = loci_json(map.loci);
  return answer;
}

Json answer_verify(const Json& body, const Watch& watch) {
  const Fields fields(body);
  const Verification result = verification(fields, watch);
  Json answer = report::verification_object(result);
  if (result.witness) answer["reason_shown"] = report::shown_witness_words(result);
  return answer;
}

Json answer_export(const Json& body, const Watch& watch) {
  const Fields fields(body);
  const std::string what = fields.text("what", "loci");
  const std::set<std::string> formats = {fields.text("format")};
  if (what == "verification") return files_json(files_of(verification(fields, watch), formats));
  const Model model = model_of(fields);
  const LociRequest request = watched(loci_request(fields, model), watch);
  if (what == "zones") return files_json(files_of(zones_in_plane(model, request), formats));
  if (what == "loci") return files_json(files_of(model, trace_loci(model, request), formats));
  throw Refusal(400, "'what' is to be loci, zones or verification");
}

}  // namespace clearloci::workbench
