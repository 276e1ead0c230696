#include "report/validation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <nlohmann/json.hpp>

#include "core/shown_units.hpp"
#include "report/file_units.hpp"
#include "report/loci_json.hpp"
#include "report/wording.hpp"
#include "report/zones.hpp"

namespace clearloci::report {
namespace {

using Json = nlohmann::ordered_json;

Json reaction_json(const auto& reaction) {
  return {{"joint", reaction.joint}, {"quantity", to_string(reaction.quantity)}};
}

std::string reaction_name(const core::TracedReaction& reaction) {
  return fmt::format("{}_{}", to_string(reaction.quantity), reaction.joint);
}

std::string after(const core::Validation& validation, const core::WorkingMode& mode) {
  const std::string words = mode_words(validation.map.tower, mode);
  return words.empty() ? "" : "; " + words;
}

std::string tallies_text(const core::Validation& validation) {
  std::string text;
  const core::WorkingMode* mode = nullptr;
  for (const core::ReactionTally& tally : validation.report.tallies) {
    if (mode == nullptr || *mode != tally.mode) {
      text += fmt::format("\n{:<16}{:>14}{:>14}{:>14}{:>10}  edges{}\n", "reaction", "confirmed", "contradicted",
                          "unresolved", "outside", after(validation, tally.mode));
      mode = &tally.mode;
    }
    const std::string name = reaction_name(tally.reaction);
    text += tally.identically_zero ? fmt::format("{:<16}{:>14}\n", name, "zero in every pose")
                                   : fmt::format("{:<16}{:>14}{:>14}{:>14}{:>10}\n", name, tally.held, tally.disputed,
                                                 tally.undecided, tally.outside);
  }
  return text;
}

}  // namespace

Json validation_object(const core::Validation& validation) {
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
          {"parameters", parameters_object(validation.map.parameters)},
          {"grid", validation.nodes},
          {"validated", validation.validated()},
          {"held", report.held},
          {"disputed", report.disputed},
          {"undecided", report.undecided},
          {"outside", report.outside},
          {"reactions", std::move(tallies)},
          {"disputed_edges", std::move(edges)},
          {"arcs_held", report.arcs_held},
          {"arcs_undecided", report.arcs_undecided},
          {"disputed_arcs", std::move(arcs)},
          {"notes", validation.map.notes}};
}

std::string validation_text(const core::Validation& validation) {
  constexpr std::size_t edges_shown = 20;
  const std::array<const char*, 3> names = {"points", "arcs", "surfaces"};
  const char* const loci = names.at(validation.map.lower.size() - 1);
  const core::ValidationReport& report = validation.report;
  const auto place = [&map = validation.map](const std::vector<double>& at) {
    return place_words(at, angles_of(map), map.units, place_digits);
  };
  std::string text = fmt::format("{}: loci against reactions at {} nodes\n", validation.map.mechanism,
                                 fmt::join(validation.nodes, " x ")) +
                     parameter_line(validation.map.parameters);
  text += tallies_text(validation);
  text += fmt::format("\n{} edges confirmed, {} contradicted, {} unresolved, {} outside\n", report.held,
                      report.disputed, report.undecided, report.outside);
  for (std::size_t i = 0; i < report.disputed_edges.size() && i < edges_shown; ++i) {
    const core::DisputedEdge& edge = report.disputed_edges[i];
    text += fmt::format("contradicted: {} {} from {} to {}, crossed by {} {}{}\n", reaction_name(edge.reaction),
                        edge.sign_change ? "changes sign" : "keeps its sign", place(edge.from), place(edge.to),
                        edge.crossings, loci, after(validation, edge.mode));
  }
  if (report.disputed_edges.size() > edges_shown) text += "... --json lists more contradicted edges\n";
  text += fmt::format("{} reactions along {} confirmed, {} contradicted, {} unresolved\n", report.arcs_held, loci,
                      report.disputed_arcs.size(), report.arcs_undecided);
  for (std::size_t i = 0; i < report.disputed_arcs.size() && i < edges_shown; ++i) {
    const core::DisputedArc& arc = report.disputed_arcs[i];
    const char* what = arc.unbounded ? "grows without bound" : arc.claimed ? "does not vanish" : "vanishes unnamed";
    text += fmt::format("contradicted: {} {} along {} near {}{}\n", reaction_name(arc.reaction), what, arc.curve,
                        place(arc.at), after(validation, arc.mode));
  }
  const core::LocusMap& map = validation.map;
  for (const std::string& note : told_once(core::in_file_units(map.notes, map.units, angles_of(map))))
    text += printable(note) + "\n";
  return text;
}

}  // namespace clearloci::report
