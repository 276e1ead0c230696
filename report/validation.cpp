#include "report/validation.hpp"

#include <nlohmann/json.hpp>

#include "report/loci_json.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;

Json reaction_json(const auto& reaction) {
  return {{"joint", reaction.joint}, {"quantity", to_string(reaction.quantity)}};
}

}  // namespace

Json validation_object(const LociValidation& validation, const std::vector<int>& nodes) {
  const auto& report = validation.report;
  Json tallies = Json::array();
  for (const auto& tally : report.tallies)
    tallies.push_back({{"working_mode", mode_object(validation.map.tower, tally.mode)},
                       {"reaction", reaction_json(tally.reaction)},
                       {"held", tally.held},
                       {"disputed", tally.disputed},
                       {"undecided", tally.undecided},
                       {"outside", tally.outside},
                       {"identically_zero", tally.identically_zero}});
  Json edges = Json::array();
  for (const auto& edge : report.disputed_edges)
    edges.push_back({{"from", edge.from},
                     {"to", edge.to},
                     {"working_mode", mode_object(validation.map.tower, edge.mode)},
                     {"reaction", reaction_json(edge.reaction)},
                     {"sign_change", edge.sign_change},
                     {"crossings", edge.crossings}});
  Json arcs = Json::array();
  for (const auto& arc : report.disputed_arcs)
    arcs.push_back({{"curve", arc.curve},
                    {"at", arc.at},
                    {"working_mode", mode_object(validation.map.tower, arc.mode)},
                    {"reaction", reaction_json(arc.reaction)},
                    {"claimed", arc.claimed},
                    {"unbounded", arc.unbounded}});
  return {{"format", 1},
          {"mechanism", validation.map.mechanism},
          {"grid", nodes},
          {"validated", report.disputed == 0},
          {"held", report.held},
          {"disputed", report.disputed},
          {"undecided", report.undecided},
          {"outside", report.outside},
          {"reactions", std::move(tallies)},
          {"disputed_edges", std::move(edges)},
          {"arcs_held", report.arcs_held},
          {"arcs_undecided", report.arcs_undecided},
          {"disputed_arcs", std::move(arcs)}};
}

}  // namespace clearloci::report
