// A study as one page that can be handed to a colleague: what was varied, what was required, what is feasible, why the
// rest fails, and the recommended design with its proof. No script, nothing from elsewhere.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/rational.hpp"
#include "report/base64.hpp"
#include "report/study.hpp"
#include "report/study_words.hpp"
#include "report/svg_text.hpp"
#include "report/verification.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

using core::StudyDesign;
using core::StudyResult;
using Status = StudyDesign::Status;

constexpr const char* style =
    "body{max-width:52rem;margin:2rem auto;padding:0 1rem;font:16px/1.5 system-ui,sans-serif;color:#212121;"
    "background:#fff}h1{font-size:1.6rem}h2{font-size:1.2rem;margin-top:2rem}table{border-collapse:collapse}"
    "th,td{padding:.2rem .8rem .2rem 0;text-align:left;vertical-align:top;border-bottom:1px solid #ddd}"
    "td.number,th.number{text-align:right;font-variant-numeric:tabular-nums}img{max-width:100%;height:auto}"
    "pre{background:#f5f5f5;padding:.8rem;white-space:pre-wrap;overflow-wrap:anywhere;font-size:.85rem}.short{font-"
    "size:1.1rem}"
    "@media print{body{margin:0}}";

std::string text(const std::string& words) { return escape_xml(printable(words)); }

std::string cell(const std::string& words) { return "<td>" + text(words) + "</td>"; }
std::string number_cell(const std::string& words) { return "<td class=\"number\">" + text(words) + "</td>"; }
std::string head(const std::string& words, bool number = false) {
  return (number ? "<th class=\"number\">" : "<th>") + text(words) + "</th>";
}
std::string row(const std::string& cells) { return "<tr>" + cells + "</tr>\n"; }
std::string table(const std::string& rows) { return "<table>\n" + rows + "</table>\n"; }
std::string item(const std::string& words) { return "<li>" + text(words) + "</li>\n"; }
std::string image(const std::string& bytes, const std::string& what, PictureFormat format = PictureFormat::svg) {
  const std::string type = format == PictureFormat::svg ? "svg+xml" : "png";
  return "<p><img alt=\"" + text(what) + "\" src=\"data:image/" + type + ";base64," + base64(bytes) + "\"></p>\n";
}

std::string percent(double part) { return short_number(100 * part, 4) + " %"; }

bool is_proof(const StudyResult& result) { return result.study.method.kind == core::StudyMethod::Kind::prove; }

std::string sentence_of_proof(const StudyResult& result) {
  std::string words =
      fmt::format("{} of the range verifies, {} fails, each proven for every design in it; {} stays undecided.",
                  percent(share(result, Status::feasible)), percent(share(result, Status::infeasible)),
                  percent(share(result, Status::undecided)));
  if (!result.complete) words += " Not all of it was looked at.";
  if (result.best)
    words += fmt::format(" Recommended: {} = {}.", result.parameters.front(),
                         exact_number(result.designs[*result.best].values.front()));
  if (result.tolerances)
    words += " The design of the file is good, and so is every design in a box around it: its tolerances.";
  return words;
}

std::string sentence(const StudyResult& result) {
  if (is_proof(result)) return sentence_of_proof(result);
  std::string words = fmt::format("{} of {} designs are proven to do what is required, in every pose.",
                                  count(result, Status::feasible), result.designs.size());
  if (!result.best) return words + " There is none to recommend.";
  words += " Recommended:";
  const StudyDesign& best = result.designs[*result.best];
  for (std::size_t i = 0; i < result.parameters.size(); ++i)
    words += fmt::format("{} {} = {}", i == 0 ? "" : ",", result.parameters[i], exact_number(best.values[i]));
  for (std::size_t f = 0; f < result.figures.size(); ++f)
    words += fmt::format(", {} {} {}", core::to_string(result.figures[f]), short_number(best.figures[f], 5),
                         unit_of(result.figures[f]));
  words += ".";
  for (const std::string& edge_word : edge_words(result)) words += " " + edge_word + ".";
  return words;
}

std::string what_was_varied(const StudyResult& result) {
  std::string rows = row(head("parameter") + head("from", true) + head("to", true));
  for (const core::StudyParameter& parameter : result.study.vary)
    rows += row(cell(parameter.name) + number_cell(exact_number(core::to_double(parameter.lower))) +
                number_cell(exact_number(core::to_double(parameter.upper))));
  return table(rows) + "<p>" + text("Method: " + method_words(result.study.method) + ". Values in SI units.") +
         "</p>\n";
}

std::string what_was_required(const StudyResult& result) {
  std::string list;
  for (const core::Task& task : result.study.tasks) {
    std::string words = "No joint loses contact, no drive crosses its play, no singularity and no boundary: ";
    for (const std::string& task_word : task_words(task)) words += (words.ends_with(": ") ? "" : "; ") + task_word;
    list += item(words + ".");
  }
  for (const core::StudyRequirement& requirement : result.study.require)
    list += item("Required: " + requirement_words(requirement) + ".");
  for (const std::string& name : result.study.keep) list += item("Kept to: " + name + ".");
  for (const core::StudyGoal& goal : result.study.goals) list += item("Goal: " + goal_words(goal) + ".");
  return "<ul>\n" + list + "</ul>\n";
}

std::string ranges_of(const StudyResult& result) {
  if (result.ranges.empty()) return {};
  const auto enclosed = [](const std::array<double, 2>& end) {
    return end[0] == end[1] ? exact_number(end[0]) : "between " + exact_number(end[0]) + " and " + exact_number(end[1]);
  };
  const auto beyond = [](const std::string& reason) { return reason.empty() ? std::string() : "beyond: " + reason; };
  std::string rows = row(head(result.parameters.front() + " from") + head("to") + head("below") + head("above"));
  for (const core::ProvenRange& range : result.ranges)
    rows += row(cell(enclosed(range.from)) + cell(enclosed(range.to)) + cell(beyond(range.below)) +
                cell(beyond(range.above)));
  return "<p>All values that verify, the ends enclosed:</p>\n" + table(rows);
}

std::string what_is_feasible(const StudyResult& result) {
  std::string rows;
  for (const Status status : {Status::feasible, Status::infeasible, Status::undecided, Status::left_out}) {
    if (is_proof(result)) {
      if (const double part = share(result, status); part > 0 || status == Status::feasible)
        rows += row(cell(core::to_string(status)) + number_cell(percent(part)));
    } else if (const std::size_t many = count(result, status); many > 0 || status == Status::feasible) {
      rows += row(cell(core::to_string(status)) + number_cell(std::to_string(many)));
    }
  }
  // Of many designs the shapes are more to read than the pixels.
  constexpr std::size_t most_shapes = 4000;
  const bool many = result.designs.size() + result.cells.size() > most_shapes;
  const PictureFormat format = many ? PictureFormat::png : PictureFormat::svg;
  return table(rows) + ranges_of(result) + image(study_picture(result, format), "Designs of the study", format);
}

std::string why_the_rest_fails(const StudyResult& result) {
  std::string rows = row(head("reason") + head(is_proof(result) ? "part" : "designs", true) + head("which means"));
  bool any = false;
  const auto add = [&](const std::string& reason, const std::string& many) {
    rows += row(cell(reason) + number_cell(many) + cell(meaning_of(reason)));
    any = true;
  };
  if (is_proof(result))
    for (const auto& [reason, part] : cell_reasons(result)) add(reason, percent(part));
  else
    for (const auto& [reason, many] : study_reasons(result)) add(reason, std::to_string(many));
  if (any) return table(rows);
  const bool all_decided = result.complete && !(is_proof(result) && share(result, Status::undecided) > 0);
  return all_decided ? "<p>No design fails.</p>\n" : "<p>No design is known to fail.</p>\n";
}

std::string tolerances_of(const StudyResult& result) {
  if (!result.tolerances) return "<p>The file's own design is not proven, and none is recommended.</p>\n";
  std::string rows = row(head("parameter") + head("from", true) + head("to", true));
  for (std::size_t i = 0; i < result.parameters.size(); ++i)
    rows += row(cell(result.parameters[i]) + number_cell(exact_number(result.tolerances->lower[i])) +
                number_cell(exact_number(result.tolerances->upper[i])));
  return "<p>The design of the file, with any of these values at once: every such design is proven.</p>\n" +
         table(rows);
}

std::string recommended(const StudyResult& result, const std::vector<core::Verification>& proofs) {
  if (is_proof(result) && !result.best) return tolerances_of(result);
  if (!result.best) return "<p>No design is proven to do what is required.</p>\n";
  const StudyDesign& best = result.designs[*result.best];
  std::string rows;
  for (std::size_t i = 0; i < result.parameters.size(); ++i)
    rows += row(cell(result.parameters[i]) + number_cell(exact_number(best.values[i])) + cell(""));
  for (std::size_t f = 0; f < best.figures.size(); ++f)
    rows += row(cell(core::to_string(result.figures[f])) + number_cell(short_number(best.figures[f], 6)) +
                cell(unit_of(result.figures[f])));
  std::string page = result.front.size() > 1 ? "<p>The best by the first goal; what it costs in the others is the "
                                               "subject of the next section.</p>\n"
                                             : "";
  page += table(rows) + "<p>The mechanism file is best.yaml, ready for every other command.</p>\n";
  for (std::size_t t = 0; t < proofs.size(); ++t) {
    if (proofs.size() > 1) page += fmt::format("<h3>Task {}</h3>\n", t + 1);
    page += "<pre>" + escape_xml(verification_text(proofs[t])) + "</pre>\n";
    if (!proofs[t].map.loci.tower.coordinates.empty())
      page += image(verification_picture(proofs[t], PictureFormat::svg), "The task among the loci");
  }
  return is_proof(result) ? page + tolerances_of(result) : page;
}

std::string front_of(const StudyResult& result) {
  if (result.front.size() < 2) return {};
  std::string heads;
  for (const std::string& parameter : result.parameters) heads += head(parameter, true);
  for (const core::Figure figure : result.figures)
    heads += head(core::to_string(figure) + ", " + unit_of(figure), true);
  std::string rows = row(heads);
  for (const std::size_t i : result.front) {
    std::string cells;
    for (const double value : result.designs[i].values) cells += number_cell(short_number(value, 6));
    for (const double value : result.designs[i].figures) cells += number_cell(short_number(value, 6));
    rows += row(cells);
  }
  return "<h2>What can be traded for what</h2>\n<p>None of these designs is better than another in every goal.</p>\n" +
         table(rows);
}

}  // namespace

std::string study_page(const StudyResult& result, const std::vector<core::Verification>& proofs) {
  std::string page =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      text(result.mechanism) + ": study of designs</title>\n<style>" + style + "</style>\n</head>\n<body>\n<h1>" +
      text(result.mechanism) + ": study of designs</h1>\n";
  page += "<p class=\"short\">" + text(sentence(result)) + "</p>\n";
  if (!result.complete) page += "<p><strong>Incomplete: the run was stopped; --resume goes on.</strong></p>\n";
  page += "<h2>What was varied</h2>\n" + what_was_varied(result);
  page += "<h2>What was required</h2>\n" + what_was_required(result);
  page += "<h2>What is feasible</h2>\n" + what_is_feasible(result);
  page += "<h2>Why the rest fails</h2>\n" + why_the_rest_fails(result);
  page += "<h2>Recommended design, and its proof</h2>\n" + recommended(result, proofs);
  page += front_of(result);
  page +=
      "<h2>How far this can be trusted</h2>\n<p>A design is called feasible where enclosures of every reaction, of the "
      "determinant and of the workspace exclude failure over cells that cover the task, rounding included; "
      "infeasible where a pose, or two, shows for certain that it fails. What is neither is called "
      "undecided.</p>\n</body>\n</html>\n";
  return page;
}

}  // namespace clearloci::report
