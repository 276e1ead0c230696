#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/shown_units.hpp"
#include "core/unloaded_words.hpp"
#include "report/file_units.hpp"
#include "report/preload.hpp"
#include "report/wording.hpp"
#include "report/zones.hpp"

namespace clearloci::report {
namespace {

constexpr int area_digits = 7;

std::string sign_words(int sign) { return sign > 0 ? "+" : sign < 0 ? "-" : "?"; }

/// Without those of reactions that no load reaches, which a note tells.
std::string sign_list(const core::Zones& map, const core::Zone& zone) {
  const std::vector<std::string>& notes = map.loci.notes;
  std::string signs;
  for (const auto& one : zone.signs) {
    const auto& reaction = one.first;
    const std::string unloaded = core::to_string(reaction.quantity) + reaction.joint + unloaded_words;
    const bool effort = reaction.quantity == core::Quantity::M || reaction.quantity == core::Quantity::F;
    if (std::any_of(notes.begin(), notes.end(), [&](const std::string& note) {
          const std::vector<std::string> idle = core::joints_of_unloaded_note(note);
          return note == unloaded || (!effort && std::find(idle.begin(), idle.end(), reaction.joint) != idle.end());
        }))
      continue;
    signs += (signs.empty() ? "" : " ") + reaction_name(reaction) + sign_words(one.second);
  }
  return signs;
}

std::string border_words(const core::Zone& zone) {
  std::string words;
  for (const core::ZoneBorder& border : zone.borders) words += (words.empty() ? "" : " ") + border.curve;
  if (const auto joints = joints_lost_at(zone); !joints.empty()) {
    words += "; contact lost:";
    for (const std::string& joint : joints) words += " " + joint;
  }
  if (!zone.too_small.empty()) words += "; too small: " + reaction_names(zone.too_small);
  if (!zone.isolated_points.empty()) words += fmt::format("; {} isolated points", zone.isolated_points.size());
  return words;
}

/// Over two lengths: rows of the zones, their sum and what is in doubt. `map`: in the units of the file.
std::string rows_of(const core::Zones& map, const core::WorkingMode& mode) {
  const std::string& unit = map.loci.units.length.name;
  int widest = 18;
  for (const core::Zone& zone : map.zones) widest = std::max(widest, columns(sign_list(map, zone)));
  const auto row = [&](const std::string& zone, const std::string& sign, const std::string& signs,
                       const std::string& area, const std::string& rest) {
    return fmt::format("{:<6} {:<4} {:<{}} {:>12}{}\n", zone, sign, signs, widest, area, rest);
  };
  std::string out = row("zone", "|A|", "signs", "area/" + unit + "2",
                        fmt::format("  {:<36} {}", "largest circle/" + unit, "bounded by"));
  double total = 0;
  for (const core::Zone& zone : map.zones) {
    if (zone.mode != mode) continue;
    total += zone.size;
    const std::string circle =
        fmt::format("{} about ({}, {})", engineering(zone.ball.radius, size_digits),
                    engineering(zone.ball.centre[0], size_digits), engineering(zone.ball.centre[1], size_digits));
    out += row(zone.id + (zone.certified ? "" : "*"), sign_words(zone.assembly_mode), sign_list(map, zone),
               engineering(zone.size, area_digits), fmt::format("  {:<36} {}", circle, border_words(zone)));
  }
  out += row("all", "", "", engineering(total, area_digits), "");
  for (const core::ZonedMode& zoned_mode : map.modes)
    if (zoned_mode.mode == mode && zoned_mode.in_doubt != 0)
      out += row("doubt", "", "", engineering(zoned_mode.in_doubt, area_digits),
                 fmt::format("  of a workspace of {}: not certified, or in no zone",
                             engineering(zoned_mode.workspace, area_digits)));
  return out;
}

/// Which free efforts keep every joint loaded in the zones.
std::string preload_lines_of(const core::Zones& map, const core::WorkingMode& mode) {
  std::string lines;
  for (const core::Zone& zone : map.zones)
    if (zone.mode == mode && zone.preload) lines += zone_preload_text(zone.id, *zone.preload, map.loci.units);
  if (!lines.empty()) lines = "\nefforts that are feasible at the sample of each zone\n" + lines;
  std::string regions;
  for (const core::PreloadRegion& region : map.preload_regions) {
    if (region.mode != mode || region.zones.size() < 2) continue;
    regions += fmt::format("{:>12} ", engineering(region.size, area_digits));
    for (const auto& [reaction, sign] : region.signs) regions += " " + reaction_name(reaction) + sign_words(sign);
    regions += ":";
    for (const std::string& zone : region.zones) regions += " " + zone;
    regions += "\n";
  }
  if (!regions.empty())
    lines += fmt::format("\nzones that one effort, varying with the pose, keeps loaded, area/{}2\n",
                         map.loci.units.length.name) +
             regions;
  return lines;
}

/// Of a zone's size, of as many dimensions as there are coordinates: "mm2 deg".
ShownUnit unit_of_size(const core::LocusMap& map) {
  const std::vector<bool> all = angles_of(map);
  const auto angles = std::count(all.begin(), all.end(), true);
  const auto lengths = static_cast<std::ptrdiff_t>(all.size()) - angles;
  const ShownUnit length = table_unit("m", map.units), turn = table_unit("rad", map.units);
  const auto power = [](const ShownUnit& unit, std::ptrdiff_t count) {
    return count == 0 ? std::string() : count == 1 ? unit.name : unit.name + std::to_string(count);
  };
  const std::string m = power(length, lengths), rad = power(turn, angles);
  return {m + (m.empty() || rad.empty() ? "" : " ") + rad,
          std::pow(length.per_si, static_cast<double>(lengths)) * std::pow(turn.per_si, static_cast<double>(angles))};
}

bool at_side(const core::Zone& zone) {
  return std::any_of(zone.borders.begin(), zone.borders.end(), [](const auto& border) { return !border.kind; });
}

std::string bounds_words(const core::Zone& zone) {
  std::string words;
  for (const core::LocusKind kind :
       {core::LocusKind::workspace_boundary, core::LocusKind::direct_singularity, core::LocusKind::contact_loss,
        core::LocusKind::backlash, core::LocusKind::margin, core::LocusKind::preload}) {
    std::vector<core::Vanishing> all;
    std::string causes;
    bool any = false;
    for (const core::ZoneBorder& border : zone.borders) {
      if (border.kind != kind) continue;
      any = true;
      if (border.cause.empty())
        all.insert(all.end(), border.vanishing.begin(), border.vanishing.end());
      else
        causes += (causes.empty() ? " " : ", ") + border.cause;
    }
    if (any)
      words += (words.empty() ? "" : "; ") + kind_words(kind) + (all.empty() ? "" : " ") + reaction_names(all) + causes;
  }
  if (at_side(zone)) words += words.empty() ? "box" : "; box";
  return words;
}

class Places {
 public:
  explicit Places(const core::LocusMap& map)
      : map_(map), angles_(angles_of(map)), length_(shown_unit("m", map.units)) {}

  std::string value(std::size_t c, double at) const {
    if (angles_[c]) return engineering(at * 180 / std::numbers::pi, place_digits) + " deg";
    return engineering(at * length_.per_si, place_digits) + " " + length_.name;
  }
  std::string pose(const std::vector<double>& at) const {
    std::string words;
    for (std::size_t c = 0; c < at.size(); ++c)
      words += fmt::format("{}{} = {}", c == 0 ? "" : ", ", map_.tower.coordinates[c], value(c, at[c]));
    return words;
  }

 private:
  const core::LocusMap& map_;
  std::vector<bool> angles_;
  ShownUnit length_;
};

std::string ball_words(const core::LocusMap& map, const Places& places, const core::ZoneBall& ball) {
  const std::vector<bool> all = angles_of(map);
  const auto angles = std::count(all.begin(), all.end(), true);
  const bool mixed = angles > 0 && angles < static_cast<std::ptrdiff_t>(all.size());
  const ShownUnit length = shown_unit("m", map.units);
  // Where lengths and angles mix, a radian counts as a metre.
  const std::string radius = mixed        ? engineering(ball.radius, few_digits) + " (m and rad alike)"
                             : angles > 0 ? engineering(ball.radius * 180 / std::numbers::pi, few_digits) + " deg"
                                          : engineering(ball.radius * length.per_si, few_digits) + " " + length.name;
  return fmt::format("      holds a ball of radius {} around {}\n", radius, places.pose(ball.centre));
}

std::string end_words(const core::LocusMap& map, const Places& places, const core::ZoneEnd& end) {
  std::string words = fmt::format("{}: {}{}{}", places.value(0, end.at), kind_words(end.kind),
                                  end.vanishing.empty() ? "" : " ", reaction_names(end.vanishing));
  if (!end.limit.empty()) words += ", limit of the " + end.limit;
  if (!end.cause.empty()) words += ", " + end.cause;
  const auto is_known = [](const std::vector<double>& parts) {
    return std::all_of(parts.begin(), parts.end(), [](double part) { return std::isfinite(part); });
  };
  if (end.jump && !(is_known(end.jump->displacement) && is_known(end.jump->rotation))) {
    words += "; the jump of the end effector is undefined";
  } else if (end.jump) {
    double most = 0;
    for (const double part : end.jump->displacement) most = std::max(most, std::abs(part));
    const ShownUnit unit = table_unit("m", map.units, most), turn = table_unit("rad", map.units);
    const auto numbers = [](const std::vector<double>& parts, double factor) {
      double largest = 0;
      for (const double part : parts) largest = std::max(largest, std::abs(part));
      std::string list;
      for (const double part : parts)
        list += (list.empty() ? "" : ", ") + engineering_beside(part * factor, largest * factor, few_digits);
      return parts.size() == 1 ? list : "(" + list + ")";
    };
    words += fmt::format("; the end effector jumps by {} {} and {} {}", numbers(end.jump->displacement, unit.per_si),
                         unit.name, numbers(end.jump->rotation, turn.per_si), turn.name);
  }
  return words;
}

/// By cells: a paragraph a zone, and what is in doubt and out of reach. `map`: in SI units.
std::string paragraphs_of(const core::Zones& map, const core::WorkingMode& mode) {
  const Places places(map.loci);
  const ShownUnit unit = unit_of_size(map.loci);
  const auto size = [&](double si) { return engineering(si * unit.per_si, size_digits); };
  const bool line = map.grid.size() == 1;
  std::string out;
  for (const core::Zone& zone : map.zones) {
    if (zone.mode != mode) continue;
    const char* const determinant = zone.assembly_mode > 0 ? "|A|+" : zone.assembly_mode < 0 ? "|A|-" : "";
    out += fmt::format("{:<5} {}  {}\n", zone.id, determinant, sign_list(map, zone));
    if (line)
      out += fmt::format("      {} to {}\n", places.value(0, zone.lower[0]), places.value(0, zone.upper[0]));
    else
      out += fmt::format("      {} to {} {}; a pose of it: {}\n", size(zone.at_least), size(zone.at_most), unit.name,
                         places.pose(zone.sample));
    if (zone.ball.radius > 0) out += ball_words(map.loci, places, zone.ball);
    out += fmt::format("      beside it: {}\n", bounds_words(zone));
    if (!zone.too_small.empty()) out += fmt::format("      too small: {}\n", reaction_names(zone.too_small));
    for (const core::ZoneEnd& end : zone.ends) out += "      ends at " + end_words(map.loci, places, end) + "\n";
    if (zone.perhaps_one_with.empty()) continue;
    out += "      perhaps the same zone as";
    for (const std::string& other : zone.perhaps_one_with) out += " " + other;
    out += "\n";
  }
  if (out.empty()) out = "no zones: nothing in the box is proven to be free of loci\n";
  for (const core::ZonedMode& zoned_mode : map.modes)
    if (zoned_mode.mode == mode)
      out += fmt::format("\nin doubt {} {}, out of reach {} {}; {} cells\n", size(zoned_mode.in_doubt), unit.name,
                         size(zoned_mode.outside), unit.name, zoned_mode.cells);
  return out;
}

}  // namespace

std::vector<std::string> zone_end_lines(const core::Zones& map, const core::WorkingMode& mode) {
  const Places places(map.loci);
  std::map<double, std::string> lines;
  // Two zones end at one place, to the finest cells.
  constexpr double one_place = 1e-7;
  const double width = one_place * core::to_double(map.loci.upper[0] - map.loci.lower[0]);
  for (const core::Zone& zone : map.zones)
    for (const core::ZoneEnd& end : zone.ends) {
      if (zone.mode != mode) continue;
      const auto near = lines.lower_bound(end.at - width);
      if (near == lines.end() || near->first > end.at + width) lines.emplace(end.at, end_words(map.loci, places, end));
    }
  std::vector<std::string> all;
  for (auto& [at, words] : lines) all.push_back(std::move(words));
  return all;
}

std::string zones_table(const core::Zones& in_si) {
  const core::Zones map = in_si.by_cells ? in_si : in_file_units(in_si);
  std::string out = printable(map.loci.mechanism) + "\n" + parameter_line(map.loci.parameters);
  const std::vector<core::WorkingMode> modes = modes_of_zones(map);
  for (const core::WorkingMode& mode : modes) {
    const std::string words = printable(mode_words(map.loci.tower, mode));
    out += words.empty() ? "\n" : "\nWorking mode: " + words + "\n";
    out += map.by_cells ? paragraphs_of(map, mode) : rows_of(map, mode);
    out += preload_lines_of(map, mode);
  }
  if (modes.empty()) out += "\nno zones: the mechanism reaches nothing in the box\n";
  const bool doubtful = std::any_of(map.zones.begin(), map.zones.end(), [](const auto& z) { return !z.certified; });
  if (doubtful && !map.by_cells) out += "\n*: not certified\n";
  if (map.by_cells && map.loci.out_of_time) out += "the time limit came first\n";
  std::vector<std::string> notes = map.loci.notes;
  if (map.by_cells) notes = core::in_file_units(std::move(notes), map.loci.units, map.loci.angles);
  for (const std::string& note : told_once(notes)) out += printable(note) + "\n";
  return out;
}

}  // namespace clearloci::report
