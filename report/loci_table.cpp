#include "report/loci_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "report/file_units.hpp"
#include "report/text_table.hpp"
#include "report/wording.hpp"
#include "report/wrap.hpp"

namespace clearloci::report {
namespace {

constexpr int table_width = 120;
constexpr double degrees = 180 / std::numbers::pi;

/// A longer factor would fill the screen; `equations` prints it whole.
constexpr int longest_factor = 60;

/// Of a direct singularity.
constexpr const char* not_excited = "not excited by this load";

/// "f: A1, B1, P; M: A1, A2 (no change of sign)".
std::string what_vanishes(const std::vector<core::Vanishing>& vanishing) {
  std::string text;
  for (const auto quantity : core::all_quantities) {
    std::string joints;
    for (const auto& one : vanishing) {
      if (one.quantity != quantity) continue;
      joints += (joints.empty() ? "" : ", ") + printable(one.joint);
      if (one.multiplicity % 2 == 0) joints += " (no change of sign)";
    }
    if (!joints.empty()) text += (text.empty() ? "" : "; ") + core::to_string(quantity) + ": " + joints;
  }
  return text;
}

/// What vanishes, and on a line of its own where.
std::string where(const core::LocusMap& map, const core::LocusCurve& curve) {
  const std::string what = what_vanishes(curve.vanishing);
  const std::string start = (what.empty() ? "" : what + "\n") + (curve.excited ? "" : std::string(not_excited) + "\n");
  return start +
         reason_words(curve.kind, curve.vanishing, curve.factor, curve.cause, readable_factor(map, longest_factor));
}

/// "open: 3 places, 0.2 % of the box"; empty where there are none.
std::string open_words(const core::LocusMap& map, const std::vector<const core::OpenRegion*>& regions) {
  if (regions.empty()) return {};
  double part = 0;
  for (const core::OpenRegion* region : regions) {
    double share = 1;
    for (std::size_t c = 0; c < region->lower.size(); ++c)
      share *= (region->upper[c] - region->lower[c]) / core::to_double(map.upper[c] - map.lower[c]);
    part += share;
  }
  const double percent = 100 * std::min(part, 1.0);
  constexpr double least = 1e-3;
  return fmt::format("open: {} place{}, {} % of the box", regions.size(), regions.size() == 1 ? "" : "s",
                     percent < least ? "below 0.001" : fmt::format("{:.2g}", percent));
}

/// In the place of the rows of a map that has none.
std::string nothing_words(const core::LocusMap& map, bool in_reach = true) {
  if (map.out_of_time) return "nothing was found before the time limit";
  if (!in_reach && map.tower.coordinates.size() == 1 && !map.open.empty())
    return "in reach nowhere outside of the places that are open";
  if (!in_reach && map.tower.coordinates.size() == 1)
    return map.complete ? "out of reach in the whole range" : "nothing is proven: all that may be in reach is in doubt";
  if (!in_reach && map.tower.coordinates.size() == 3) return "nothing vanishes in the box";
  return map.tower.coordinates.size() == 3 ? "no surfaces" : "no curves";
}

double total_length(const core::LocusCurve& curve) {
  double length = 0;
  for (const auto& arc : curve.arcs) length += arc.length;
  return length;
}

bool has_angles(const core::LocusMap& map) {
  return std::any_of(map.angles.begin(), map.angles.end(), [](bool angle) { return angle; });
}

std::string curve_rows(const core::LocusMap& map, const core::WorkingMode& mode, bool exact) {
  std::vector<Column> heading = {{"curve", 8},
                                 {"kind", 18},
                                 {"what vanishes, where", 0},
                                 {"degree", 6, Alignment::right},
                                 {"closed form", 0},
                                 {"arcs", 4, Alignment::right},
                                 {has_angles(map) ? "length" : "length/" + map.units.length.name, 0, Alignment::point}};
  std::vector<Row> rows;
  int closed_form = 0, identifier = columns(heading[0].heading);
  std::vector<const core::OpenRegion*> left;
  for (const core::OpenRegion& region : map.open)
    if (region.mode == mode) left.push_back(&region);
  const auto take_those = [&left](const auto& are_wanted) {
    std::vector<const core::OpenRegion*> curve_rows;
    for (const core::OpenRegion*& region : left)
      if (region != nullptr && are_wanted(*region)) curve_rows.push_back(std::exchange(region, nullptr));
    return curve_rows;
  };
  for (const auto& curve : map.curves) {
    if (curve.mode != mode) continue;
    const std::string open =
        open_words(map, take_those([&](const core::OpenRegion& region) { return is_open_place_of(region, curve); }));
    rows.push_back({printable(curve.id) + (curve.certified ? "" : "*"), kind_words(curve.kind),
                    where(map, curve) + (open.empty() ? "" : "\n" + open),
                    curve.implicit.is_zero() ? "-" : std::to_string(core::total_degree(curve.implicit)),
                    closed_form_words(curve.closed_form, map.tower.coordinates, exact),
                    std::to_string(curve.arcs.size()), engineering(total_length(curve), size_digits)});
    closed_form = std::max(closed_form, columns(rows.back()[4]));
    identifier = std::max(identifier, std::min(columns(rows.back()[0]), heading[0].widest));
  }
  // What is open of loci of which nothing is drawn.
  for (const core::OpenRegion* first : left) {
    if (first == nullptr) continue;
    core::LocusCurve nothing;
    nothing.kind = first->kind;
    nothing.vanishing = first->vanishing;
    nothing.factor = first->factor;
    nothing.cause = first->cause;
    nothing.mode = mode;
    const bool point = first->point;
    const auto taken = take_those([&](const core::OpenRegion& region) {
      return point ? region.point && region.vanishing == nothing.vanishing : is_open_place_of(region, nothing);
    });
    const std::string what = point ? what_vanishes(nothing.vanishing) + "\nat isolated points" : where(map, nothing);
    rows.push_back({"-", kind_words(nothing.kind), what + "\n" + open_words(map, taken), "-", "", "0", ""});
  }
  // The two wide columns share what the others leave of the width.
  constexpr int least = 30;
  const int others = identifier + 18 + 6 + 4 + 8 + 6 * 2;
  heading[4].widest = std::clamp(closed_form, 11, table_width - others - least);
  heading[2].widest = table_width - others - heading[4].widest;
  if (rows.empty()) return nothing_words(map) + "\n";
  return format_rows(heading, rows);
}

std::string point_rows(const core::LocusMap& map, const core::WorkingMode& mode) {
  std::vector<Column> heading = {{"point", 8}, {"kind", 18}, {"vanishing", 40}};
  for (std::size_t i = 0; i < map.tower.coordinates.size(); ++i)
    heading.push_back({printable(map.tower.coordinates[i]) +
                           (has_angles(map) && map.angles[i] ? "/deg" : "/" + map.units.length.name),
                       0, Alignment::point});
  std::vector<Row> rows;
  for (std::size_t i = 0; i < map.isolated_points.size(); ++i) {
    const auto& point = map.isolated_points[i];
    if (point.mode != mode) continue;
    Row row = {"p" + std::to_string(i + 1) + (point.certified ? "" : "*"), kind_words(point.kind),
               what_vanishes(point.vanishing)};
    for (std::size_t c = 0; c < point.at.size(); ++c)
      row.push_back(engineering(point.at[c] * (has_angles(map) && map.angles[c] ? degrees : 1), place_digits));
    rows.push_back(std::move(row));
  }
  return rows.empty() ? "" : "\nisolated points\n" + format_rows(heading, rows);
}

/// Where it vanishes: the cause, the factor where it is short, or the degree.
std::string where(const core::LocusMap& map, const core::LocusSurface& surface) {
  const std::string what = what_vanishes(surface.vanishing);
  const std::string start = what.empty() ? "" : what + "\n";
  return start + reason_words(surface.kind, surface.vanishing, surface.factor, surface.cause,
                              readable_factor(map, longest_factor));
}

std::string surface_rows(const core::LocusMap& map, const core::WorkingMode& mode) {
  const std::vector<Column> heading = {
      {"surface", 8},
      {"kind", 18},
      {"what vanishes, where", 52},
      {"degree", 6, Alignment::right},
      {"pieces", 6, Alignment::right},
      {"triangles", 9, Alignment::right},
      {has_angles(map) ? "area" : "area/" + map.units.length.name + "^2", 0, Alignment::point}};
  std::vector<Row> rows;
  for (const auto& surface : map.surfaces) {
    if (surface.mode != mode) continue;
    const int degree = core::total_degree(surface.implicit);
    rows.push_back({printable(surface.id) + (surface.certified ? "" : "*"), kind_words(surface.kind),
                    where(map, surface), degree > 0 ? std::to_string(degree) : "-", std::to_string(surface.components),
                    std::to_string(surface.triangles.size()), engineering(surface.area, size_digits)});
  }
  return rows.empty() ? nothing_words(map) + "\n" : format_rows(heading, rows);
}

/// Besides the surfaces: curves, and points with their coordinates.
std::string space_curve_rows(const core::LocusMap& map, const core::WorkingMode& mode) {
  const std::vector<Column> heading = {
      {"curve", 8},
      {"kind", 18},
      {"what vanishes", 52},
      {"arcs", 6, Alignment::right},
      {has_angles(map) ? "length" : "length/" + map.units.length.name, 0, Alignment::point}};
  std::vector<Row> rows;
  for (const auto& curve : map.space_curves) {
    if (curve.mode != mode) continue;
    double length = 0;
    for (const auto& arc : curve.arcs) length += arc.length;
    rows.push_back({printable(curve.id) + (curve.certified ? "" : "*"), kind_words(curve.kind),
                    what_vanishes(curve.vanishing), std::to_string(curve.arcs.size()),
                    engineering(length, size_digits)});
  }
  return rows.empty() ? "" : "\n" + format_rows(heading, rows);
}

bool is_angle(const core::LocusMap& map) { return !map.angles.empty() && map.angles.front(); }

/// A value of the one coordinate: m, or deg.
std::string place(const core::LocusMap& map, double value) {
  return engineering(is_angle(map) ? value * degrees : value, place_digits);
}

/// With one free coordinate: the reachable intervals, then a row a point, with the reason.
std::string single_coordinate_rows(const core::LocusMap& map, const core::WorkingMode& mode) {
  const std::string name = printable(map.tower.coordinates.front());
  const std::string unit = is_angle(map) ? "deg" : map.units.length.name;
  std::string out = "reachable: ";
  bool any = false;
  for (const auto& interval : map.reachable) {
    if (interval.mode != mode) continue;
    out += (any ? ", " : "") + place(map, interval.from) + " to " + place(map, interval.to);
    any = true;
  }
  out += any ? " " + unit + "\n" : "nowhere\n";
  std::vector<Column> heading = {
      {"point", 8}, {"kind", 18}, {"what vanishes, where", 60}, {name + "/" + unit, 0, Alignment::point}};
  std::vector<Row> rows;
  for (std::size_t i = 0; i < map.isolated_points.size(); ++i) {
    const auto& point = map.isolated_points[i];
    if (point.mode != mode) continue;
    const std::string why =
        reason_words(point.kind, point.vanishing, point.factor, point.cause, 2 * readable_factor(map, longest_factor));
    const std::string what = what_vanishes(point.vanishing) + (point.excited ? "" : not_excited);
    rows.push_back({"p" + std::to_string(i + 1) + (point.certified ? "" : "*"), kind_words(point.kind),
                    what + (what.empty() ? "" : "\n") + why, place(map, point.at.front())});
  }
  return out + (rows.empty() ? "no points\n" : format_rows(heading, rows));
}

std::string notes(const core::LocusMap& map) {
  const auto measure = [](std::string_view text) { return static_cast<double>(columns(text)); };
  std::vector<std::string> sentences = told_once(map.notes);
  const auto uncertain = [](const auto& one) { return !one.certified; };
  if (std::any_of(map.curves.begin(), map.curves.end(), uncertain) ||
      std::any_of(map.space_curves.begin(), map.space_curves.end(), uncertain) ||
      std::any_of(map.isolated_points.begin(), map.isolated_points.end(), uncertain)) {
    sentences.emplace_back(map.tower.coordinates.size() == 1 ? "*: found, but not certified."
                                                             : "*: traced, but its topology is not certified.");
  }
  const auto missing = [](const core::LocusSurface& surface) { return !surface.within_resolution; };
  if (std::any_of(map.surfaces.begin(), map.surfaces.end(), missing))
    sentences.emplace_back("*: meshed; it is not certified that no part of the surface is missing.");
  else if (std::any_of(map.surfaces.begin(), map.surfaces.end(), uncertain))
    sentences.emplace_back(
        "*: meshed, and no part of the surface is missing; at some places its topology is not certified (loci.json, "
        "open).");
  if (map.out_of_time)
    sentences.emplace_back("Incomplete: the work was stopped at its time limit.");
  else if (!map.open.empty())
    sentences.emplace_back("Incomplete: some places are open (loci.json, open). Outside of them the answer holds.");
  std::string out;
  for (const auto& sentence : sentences) {
    const auto lines = wrap(printable(sentence), table_width - 2, measure);
    for (std::size_t i = 0; i < lines.size(); ++i) out += (i == 0 ? "" : "  ") + lines[i] + "\n";
  }
  return out.empty() ? "" : "\n" + out;
}

}  // namespace

std::string loci_table(const core::LocusMap& in_si, bool exact) {
  const core::LocusMap map = in_file_units(in_si);
  std::string out = printable(map.mechanism) + "\n" + parameter_line(map.parameters, exact);
  std::vector<core::WorkingMode> modes = modes_of(map);
  if (modes.empty()) out += "\n" + nothing_words(map, false) + "\n";
  for (const auto& mode : modes) {
    const std::string words = printable(mode_words(map.tower, mode));
    out += words.empty() ? "\n" : "\nWorking mode: " + words + "\n";
    if (map.tower.coordinates.size() == 1)
      out += single_coordinate_rows(map, mode);
    else if (map.tower.coordinates.size() == 3)
      out += surface_rows(map, mode) + space_curve_rows(map, mode) + point_rows(map, mode);
    else
      out += curve_rows(map, mode, exact) + point_rows(map, mode);
  }
  return out + notes(map);
}

}  // namespace clearloci::report
