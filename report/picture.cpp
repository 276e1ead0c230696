#include "report/picture.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "core/errors.hpp"
#include "report/cell_zone_picture.hpp"

#include "report/drawing.hpp"
#include "report/file_units.hpp"
#include "report/range_picture.hpp"
#include "report/space_picture.hpp"
#include "report/surface.hpp"
#include "report/wording.hpp"

namespace clearloci::report {
namespace {

std::string title_of(const Subject& subject) {
  const std::string mode = mode_words(subject.map->tower, subject.mode);
  const std::string what =
      subject.layer == nullptr ? "Discontinuity loci" : "Pose error, " + subject.layer->field->label;
  return printable(what + ": " + subject.map->mechanism + (mode.empty() ? "" : ", " + mode));
}

std::string legend_of(const Groups& groups) {
  std::string text;
  for (const auto& group : groups.curves) text += group.what + (group.why.empty() ? "" : " — " + group.why) + "\n";
  for (const auto& group : groups.points) text += group.label + "\n";
  return text;
}

std::string drawn(const Subject& subject, PictureFormat format) {
  const Layout layout = lay_out(subject);
  return render({layout.width, layout.height, title_of(subject), legend_of(subject.groups)}, format,
                [&](const auto& canvas) { draw(canvas, subject, layout); });
}

}  // namespace

const char* ending_of(PictureFormat format) {
  switch (format) {
    case PictureFormat::svg:
      return ".svg";
    case PictureFormat::png:
      return ".png";
    case PictureFormat::pdf:
      break;
  }
  return ".pdf";
}

std::string picture(const core::LocusMap& in_si, const core::WorkingMode& mode, const core::Sketch* si_sketch,
                    PictureFormat format, bool beside) {
  const core::LocusMap map = in_file_units(in_si);
  std::optional<core::Sketch> in_units;
  if (si_sketch != nullptr) in_units = in_file_units(*si_sketch, map.units);
  const core::Sketch* const sketch = in_units ? &*in_units : nullptr;
  if (map.tower.coordinates.size() == 3) return space_picture(map, mode, sketch, format);
  if (map.tower.coordinates.size() == 1) return range_picture(map, mode, sketch, format);
  Subject subject{&map, mode, groups_of_mode(group_loci(map), mode)};
  (beside ? subject.inset : subject.sketch) = sketch;
  return drawn(subject, format);
}

std::string field_picture(const core::LocusMap& in_si, const core::WorkingMode& mode, const core::FieldMap& si_fields,
                          const core::Field& si_field, PictureFormat format, const std::vector<double>& coloured_by) {
  const core::LocusMap map = in_file_units(in_si);
  core::FieldMap field_map = si_fields;
  field_map.fields = {si_field};
  const core::FieldMap fields = in_file_units(std::move(field_map), map.units);
  const core::Field& field = fields.fields.front();
  std::vector<double> values = coloured_by.empty() ? field.values : coloured_by;
  if (!coloured_by.empty())
    for (double& value : values) value *= shown_unit(si_field.unit, map.units).per_si;
  const FieldLayer layer{&fields, &field, scale_of(values, field.is_signed, field.unit, map.units.angle_declared)};
  return drawn({&map, mode, groups_of_mode(group_loci(map), mode), nullptr, &layer, nullptr, nullptr}, format);
}

namespace {

/// Of the mode, without preload loci that no zone has for a border: most places in which bounds of efforts meet part
/// nothing.
Groups groups_beside_zones(const core::Zones& map, const core::WorkingMode& mode) {
  std::set<std::string> borders;
  for (const core::Zone& zone : map.zones)
    if (zone.mode == mode)
      for (const core::ZoneBorder& border : zone.borders) borders.insert(border.curve);
  Groups groups = groups_of_mode(group_loci(map.loci), mode);
  for (CurveGroup& group : groups.curves)
    if (group.kind == core::LocusKind::preload)
      std::erase_if(group.curves, [&](const core::LocusCurve* curve) { return !borders.contains(curve->id); });
  std::erase_if(groups.curves, [](const CurveGroup& group) { return group.curves.empty(); });
  return groups;
}

}  // namespace

std::string zone_picture(const core::Zones& in_si, const core::WorkingMode& mode, PictureFormat format) {
  if (in_si.by_cells) {
    const auto found =
        std::find_if(in_si.modes.begin(), in_si.modes.end(), [&](const auto& m) { return m.mode == mode; });
    if (found == in_si.modes.end())
      throw core::InputError({}, "the zones are not of this working mode", "choose one of modes_of(zones)");
    return cell_zone_picture(in_si, *found, format);
  }
  const core::Zones map = in_file_units(in_si);
  return drawn({&map.loci, mode, groups_beside_zones(map, mode), nullptr, nullptr, &map, nullptr}, format);
}

std::string task_picture(const core::Zones& map, const core::WorkingMode& mode, const TaskMark& task,
                         PictureFormat format) {
  return drawn({&map.loci, mode, groups_beside_zones(map, mode), nullptr, nullptr, &map, &task}, format);
}

}  // namespace clearloci::report
