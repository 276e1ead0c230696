#include "report/preload.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/shown_units.hpp"
#include "report/loci_json.hpp"
#include "report/table_json.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

constexpr int digits = 6, digits_of_size = 4;

std::string at_least(double size) { return fmt::format("{:.{}g}", rounded_down(size, digits_of_size), digits_of_size); }

std::string at_most(double size) { return fmt::format("{:.{}g}", rounded_up(size, digits_of_size), digits_of_size); }

/// "sizes below 6.088 fail, proven, and ", or nothing.
std::string proven_below(const std::string& sizes, double least) {
  return least > 0 ? fmt::format("{} below {} fail, proven, and ", sizes, at_least(least)) : std::string();
}

class Efforts {
 public:
  Efforts(const core::PreloadAnswer& preload, const core::Units& units) : preload_(preload), units_(units) {}

  std::string told(std::size_t i, double value) const { return fmt::format("{} {}", number(i, value), unit(i).name); }

  /// "[6.05, 6.15] N m (beyond: contact lost in A1)", and where nothing beyond was looked at the end alone.
  std::string end(const std::array<double, 2>& range, const std::string& beyond) const {
    if (beyond.empty() && range[0] == range[1]) return told(0, range[0]);
    return fmt::format("[{}, {}] {}{}", engineering(rounded_down(range[0] * unit(0).per_si, digits), digits),
                       engineering(rounded_up(range[1] * unit(0).per_si, digits), digits), unit(0).name,
                       beyond.empty() ? "" : " (beyond: " + beyond + ")");
  }

 private:
  core::ShownUnit unit(std::size_t i) const { return core::told_unit(preload_.forces[i] ? "N" : "N m", units_); }
  std::string number(std::size_t i, double value) const { return engineering(value * unit(i).per_si, digits); }

  const core::PreloadAnswer& preload_;
  const core::Units& units_;
};

/// "with M_A1 > 0, M_A2 < 0: the smallest size is between 6.08 and 6.12".
std::string pattern_line(const core::PreloadPattern& pattern) {
  std::string signs;
  for (const auto& [name, sign] : pattern.signs)
    signs += (signs.empty() ? "with " : ", ") + name + (sign > 0 ? " > 0" : " < 0");
  if (signs.empty()) signs = "whatever the signs";
  const auto& [least, most] = pattern.size;
  return signs + (pattern.verdict == core::Verdict::verified
                      ? fmt::format(": the smallest size is between {} and {}", at_least(least), at_most(most))
                      : fmt::format(": none was found; sizes below {} fail", at_least(least)));
}

}  // namespace

core::Table law_table(const core::Verification& result) {
  core::Table table;
  const core::PreloadAnswer& preload = *result.preload;
  const auto add = [&](const std::string& name, const std::string& unit, const auto& value_of) {
    table.names.push_back(name);
    table.units.push_back(unit);
    std::vector<double>& column = table.columns.emplace_back();
    for (const core::PreloadLawCell& cell : preload.cells_of_law) column.push_back(value_of(cell));
  };
  for (std::size_t c = 0; c < result.coordinates.size(); ++c) {
    const std::string unit = result.angles[c] ? "rad" : "m";
    add(result.coordinates[c] + "_from", unit, [c](const auto& cell) { return cell.lower[c]; });
    add(result.coordinates[c] + "_to", unit, [c](const auto& cell) { return cell.upper[c]; });
  }
  const std::size_t bases = preload.cells_of_law.empty() ? 0 : preload.cells_of_law.front().efforts.size(),
                    parts = preload.cells_of_law.empty() ? 0 : preload.cells_of_law.front().gains.size();
  for (std::size_t i = 0; i < preload.joints.size(); ++i) {
    const auto of_joint = [&, i](const core::PreloadLawCell& cell, const std::vector<double>& efforts) {
      for (std::size_t k = 0; k < cell.joints.size(); ++k)
        if (cell.joints[k] == preload.joints[i]) return efforts[k];
      return std::numeric_limits<double>::quiet_NaN();
    };
    for (std::size_t base = 0; base < bases; ++base)
      add(preload.joints[i] + (bases == 1  ? ""
                               : base == 0 ? "_first"
                                           : "_last"),
          preload.forces[i] ? "N" : "N m", [&, base](const auto& cell) { return of_joint(cell, cell.efforts[base]); });
    for (std::size_t part = 0; part < parts; ++part)
      add(preload.joints[i] + "_per_load_" + std::to_string(part + 1), "",
          [&, part](const auto& cell) { return of_joint(cell, cell.gains[part]); });
  }
  return table;
}

std::vector<std::string> preload_lines(const core::PreloadAnswer& preload, const core::Units& units) {
  const Efforts efforts(preload, units);
  std::vector<std::string> lines;
  std::string looked_for;
  for (std::size_t i = 0; i < preload.joints.size(); ++i)
    looked_for += fmt::format("{}{} from {} to {}", i == 0 ? "" : ", ", preload.joints[i],
                              efforts.told(i, preload.lower[i]), efforts.told(i, preload.upper[i]));
  if (preload.of_poses) {
    if (preload.cells_of_law.empty()) {
      lines.emplace_back("no efforts are proven for every pose");
    } else {
      lines.push_back(fmt::format("efforts exist at every pose, and some that vary continuously: proven in {} cells",
                                  preload.cells_of_law.size()));
      lines.push_back(fmt::format("{}the smallest size of a law is at most {}",
                                  proven_below("laws of a size", preload.size[0]), at_most(preload.size[1])));
    }
  } else if (preload.law) {
    lines.push_back(fmt::format("{} = {}: verifies", preload.joints.front(), preload.law->expression));
    lines.push_back(fmt::format("{} takes {} to {} over the task; {}the smallest size of a law is at most {}",
                                preload.joints.front(), efforts.told(0, preload.law->within[0]),
                                efforts.told(0, preload.law->within[1]),
                                proven_below("laws of a size", preload.size[0]), at_most(preload.size[1])));
  } else if (preload.value) {
    std::string line;
    bool none = true;
    for (std::size_t i = 0; i < preload.joints.size(); ++i) {
      line += fmt::format("{}{} = {}", i == 0 ? "" : ", ", preload.joints[i], efforts.told(i, (*preload.value)[i]));
      none = none && (*preload.value)[i] == 0;
    }
    if (none)
      line += ": none is needed";
    else
      line += fmt::format(": verifies; {}the smallest size that verifies is at most {}",
                          proven_below("sizes", preload.size[0]), at_most(preload.size[1]));
    lines.push_back(line);
  } else {
    lines.emplace_back("none was found");
  }
  for (const core::ProvenRange& range : preload.ranges)
    lines.push_back(fmt::format("{} verifies from {} to {}", preload.joints.front(),
                                efforts.end(range.from, range.below), efforts.end(range.to, range.above)));
  for (const core::PreloadPattern& pattern : preload.patterns)
    if (pattern.verdict != core::Verdict::refuted) lines.push_back(pattern_line(pattern));
  lines.push_back("looked for with " + looked_for);
  return lines;
}

namespace {

nlohmann::ordered_json pattern_object(const core::PreloadAnswer& preload, const core::PreloadPattern& pattern) {
  using Json = nlohmann::ordered_json;
  Json signs = Json::object(), value = Json::object(), refutation = Json::array();
  for (const auto& [name, sign] : pattern.signs) signs[name] = sign;
  for (std::size_t i = 0; pattern.value && i < preload.joints.size(); ++i)
    value[preload.joints[i]] = (*pattern.value)[i];
  for (const core::PreloadRow& row : pattern.refutation)
    refutation.push_back({{"reaction", row.reaction},
                          {"sign", row.sign},
                          {"bound", row.bound},
                          {"at", row.at},
                          {"load", row.load},
                          {"offset", row.offset},
                          {"slope", row.slope},
                          {"multiplier", row.multiplier}});
  return {{"signs", std::move(signs)},
          {"verdict", core::to_string(pattern.verdict)},
          {"size", {number_json(pattern.size[0]), number_json(pattern.size[1])}},
          {"value", pattern.value ? std::move(value) : Json(nullptr)},
          {"joints", pattern.joints},
          {"refutation", std::move(refutation)}};
}

}  // namespace

nlohmann::ordered_json preload_object(const core::PreloadAnswer& preload) {
  using Json = nlohmann::ordered_json;
  Json looked_for = Json::object(), value = Json::object(), ranges = Json::array();
  for (std::size_t i = 0; i < preload.joints.size(); ++i) {
    looked_for[preload.joints[i]] = {preload.lower[i], preload.upper[i]};
    if (preload.value) value[preload.joints[i]] = (*preload.value)[i];
  }
  for (const core::ProvenRange& range : preload.ranges)
    ranges.push_back({{"from", range.from}, {"to", range.to}, {"below", range.below}, {"above", range.above}});
  Json law = nullptr;
  if (preload.law) law = {{"expression", preload.law->expression}, {"within", preload.law->within}};
  Json patterns = Json::array();
  for (const core::PreloadPattern& pattern : preload.patterns) patterns.push_back(pattern_object(preload, pattern));
  return {{"law", std::move(law)},
          {"value", preload.value ? std::move(value) : Json(nullptr)},
          {"size", {number_json(preload.size[0]), number_json(preload.size[1])}},
          {"ranges", std::move(ranges)},
          {"looked_for", std::move(looked_for)},
          {"patterns", std::move(patterns)},
          {"cells", preload.cells}};
}

namespace {

/// "B2", in the unit of the file: "from 15 N m (M_A1) to 93.5 N m (M_A2)", "any".
std::string range_words(const core::EffortRange& range, const core::ShownUnit& unit) {
  const auto end = [&](const char* word, double value, const std::vector<core::Vanishing>& fails) {
    if (!std::isfinite(value)) return std::string();
    return fmt::format("{} {} {}{}", word, engineering(value * unit.per_si, digits), unit.name,
                       fails.empty() ? "" : " (" + reaction_names(fails) + ")");
  };
  const std::string from = end("from", range.from, range.below),
                    to = end(from.empty() ? "up to" : "to", range.to, range.above);
  return from.empty() && to.empty() ? "any" : from + (from.empty() || to.empty() ? "" : " ") + to;
}

core::ShownUnit unit_of(const core::FeasibleEfforts& efforts, const core::Units& units) {
  return core::told_unit(efforts.force ? "N" : "N m", units);
}

/// "tension of K1 = 31.2 N, feasible from 5 N (F_K2) to 88.1 N (F_K3)".
std::string tension_text(const core::FeasibleEfforts& tension, const core::ShownUnit& unit) {
  std::string text =
      fmt::format("tension of {} = {} {}", tension.joint, engineering(tension.effort * unit.per_si, digits), unit.name);
  for (const core::EffortRange& range : tension.ranges) text += ", feasible " + range_words(range, unit);
  if (tension.ranges.empty())
    text += "; no tensions within their bounds hold this pose" +
            (tension.never.empty() ? "" : ": those of " + reaction_names(tension.never) + " exclude each other");
  return text + "\n";
}

/// Of an effort where some are feasible. Two ranges meet where a reaction vanishes; at another end it may be the least
/// that is asked for, which a chosen effort has.
std::string feasibility_words(const core::FeasibleEfforts& efforts) {
  int ends = 0;
  for (const core::EffortRange& range : efforts.ranges) {
    if (efforts.effort < range.from || efforts.effort > range.to) continue;
    const bool at_end =
        (efforts.effort == range.from && !range.below.empty()) || (efforts.effort == range.to && !range.above.empty());
    if (!at_end) return "";
    ++ends;
  }
  if (ends == 1) return efforts.given ? ", at the end of a range" : "";
  return ", which is not feasible";
}

}  // namespace

std::string feasible_efforts_text(const core::FeasibleEfforts& efforts, const core::Units& units) {
  const core::ShownUnit unit = unit_of(efforts, units);
  if (efforts.cable) return tension_text(efforts, unit);
  std::string text = fmt::format(
      "effort of {} = {} {}{}\n", efforts.joint, engineering(efforts.effort * unit.per_si, digits), unit.name,
      efforts.ranges.empty() ? "; none is feasible here" : feasibility_words(efforts) + "; feasible here");
  if (!efforts.never.empty()) text += "  " + reaction_names(efforts.never) + ": lost whatever the effort\n";
  for (const core::EffortRange& range : efforts.ranges) text += "  " + range_words(range, unit) + "\n";
  return text;
}

std::string zone_preload_text(const std::string& zone, const core::ZonePreload& preload, const core::Units& units) {
  std::string text;
  for (const core::FeasibleEfforts& efforts : preload.efforts) {
    if (!preload.feasible) {
      text = efforts.cable ? "no tensions within their bounds"
                           : fmt::format("no effort of {} keeps every joint loaded", efforts.joint);
      if (!efforts.never.empty()) text += ": " + reaction_names(efforts.never);
      text += "\n";
      break;
    }
    for (const core::EffortRange& range : efforts.ranges)
      text += fmt::format("{}{} {}\n", text.empty() ? "" : "       ", efforts.joint,
                          range_words(range, unit_of(efforts, units)));
  }
  return fmt::format("{:<6} {}", zone, text);
}

nlohmann::ordered_json feasible_efforts_object(const core::FeasibleEfforts& efforts) {
  using Json = nlohmann::ordered_json;
  Json ranges = Json::array();
  for (const core::EffortRange& range : efforts.ranges)
    ranges.push_back({{"from", number_json(range.from)},
                      {"to", number_json(range.to)},
                      {"below", vanishing_array(range.below)},
                      {"above", vanishing_array(range.above)}});
  return {{"effort", efforts.effort},
          {"given", efforts.given},
          {"within", efforts.within ? Json(*efforts.within) : Json(nullptr)},
          {"ranges", std::move(ranges)},
          {"never", vanishing_array(efforts.never)}};
}

nlohmann::ordered_json zone_preload_object(const core::ZonePreload& preload) {
  using Json = nlohmann::ordered_json;
  Json efforts = Json::object();
  for (const core::FeasibleEfforts& feasible_efforts : preload.efforts) {
    const Json object = feasible_efforts_object(feasible_efforts);
    Json& told = efforts[feasible_efforts.joint];
    for (const char* key : {"within", "ranges", "never"}) told[key] = object[key];
    if (preload.patterns.size() != feasible_efforts.ranges.size() || preload.efforts.size() > 1) continue;
    for (std::size_t i = 0; i < preload.patterns.size(); ++i) {
      Json signs = Json::object();
      for (const auto& [reaction, sign] : preload.patterns[i])
        signs[reaction.joint][core::to_string(reaction.quantity)] = sign;
      told["ranges"][i]["signs"] = std::move(signs);
    }
  }
  return {{"feasible", preload.feasible},
          {"smallest", preload.smallest ? Json(*preload.smallest) : Json(nullptr)},
          {"efforts", std::move(efforts)}};
}

}  // namespace clearloci::report
