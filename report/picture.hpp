// Pictures of discontinuity loci: one drawing, in SVG, PDF or PNG.
#pragma once

#include <string>

#include "clearloci/zones.hpp"
#include "core/field_map.hpp"
#include "core/locus_map.hpp"
#include "core/sketch.hpp"
#include "report/task_mark.hpp"

namespace clearloci::report {

enum class PictureFormat { svg, pdf, png };

/// ".svg", ".pdf", ".png".
const char* ending_of(PictureFormat format);

/// The loci of one working mode as the bytes of a file: workspace shaded, one colour and dash pattern a reason, direct
/// singularities dash-dotted in black, the boundary thin and grey, isolated points as ringed markers, and, where given,
/// the mechanism in the posture of `sketch` with its loads: in the plane of the free coordinates where these are the
/// platform point's x and y, else `beside` it, below the legend. Axes have one scale; the legend names joints.
/// The same map gives the same bytes. PNG has 2 pixels a point.
std::string picture(const core::LocusMap& map, const core::WorkingMode& mode, const core::Sketch* sketch,
                    PictureFormat format, bool beside = false);

/// `coloured_by`: values in SI that choose the scale of the colours; none: the field's own.
/// A field of `fields` in colours over the workspace, the loci and singularities of the mode drawn over it. Nothing is
/// painted where the field is not a number.
std::string field_picture(const core::LocusMap& map, const core::WorkingMode& mode, const core::FieldMap& fields,
                          const core::Field& field, PictureFormat format, const std::vector<double>& coloured_by = {});

/// The zones of one working mode in colours, numbered; over two lengths with their largest circles, the loci drawn over
/// them; by cells as cell_zone_picture.
std::string zone_picture(const core::Zones& map, const core::WorkingMode& mode, PictureFormat format);

/// The zones with a task over them.
std::string task_picture(const core::Zones& map, const core::WorkingMode& mode, const TaskMark& task,
                         PictureFormat format);

}  // namespace clearloci::report
