// What is left open, as it stands in the answer (core::OpenRegion): by searches, by checks, by engines.
#pragma once

#include <array>

#include "core/locus_map.hpp"
#include "loci/curves/edge_labels.hpp"

namespace clearloci::loci {

using PlaneBox = std::array<double, 4>;  ///< x0, x1, y0, y1

PlaneBox extent_of(const core::Polyline& points);

/// A place at which the curves that the label is of are not settled.
void leave_open(const EdgeLabel& label, const core::WorkingMode& mode, const PlaneBox& box, core::LocusMap& map);

/// A place at which it is not settled whether the joint loses contact at isolated points.
void leave_point_open(const std::string& joint, const core::WorkingMode& mode, const PlaneBox& box,
                      core::LocusMap& map);

/// The label of a curve that is there.
EdgeLabel label_of(const core::LocusCurve& curve);

/// Where one locus has more open places than anyone can look at, neighbours are told together; then says whether all is
/// known.
void finish_open_regions(core::LocusMap& map);

}  // namespace clearloci::loci
