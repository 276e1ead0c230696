// A LocusMap in the formats of other programs. Coordinates are metres; every function returns the file's bytes, which
// depend on the map alone.
#pragma once

#include <string>

#include "core/locus_map.hpp"

namespace clearloci::report {

/// RFC 4180 with "\n": a header row, then one row a vertex: `curve` (id; p1, p2, ... for isolated points), `arc` (from
/// 1; empty for an isolated point and for the vertices of a surface), `kind`, `vanishing` ("f_A1 f_B1 M_A1"), `mode`
/// ("B1 right, B2 left"), `closed`
/// ("true" or "false"), then one column a coordinate, by its name.
std::string csv(const core::LocusMap& map);

/// `r2000`: AC1015, open curves without a closed form as LWPOLYLINE. `r12`: AC1009, which has no LWPOLYLINE, and for
/// which they are POLYLINE; for readers that stop at R12.
enum class DxfVersion { r2000, r12 };

/// One layer a curve, "c1-contact-loss", with its colour and line type; LINE, CIRCLE and ARC where the curve has that
/// closed form, POINT for isolated points. Extended data of the application CLEARLOCI states mode, what vanishes and
/// where on each entity. Unit: m ($INSUNITS 6).
std::string dxf(const core::LocusMap& map, DxfVersion version = DxfVersion::r2000);

/// A FeatureCollection: one LineString an arc, one Point an isolated point; `units` "m" on the collection and on every
/// feature, with curve, arc, kind, vanishing, factor, cause, mode, certified, closed, ends and length.
std::string geojson(const core::LocusMap& map);

/// VTK XML PolyData: isolated points as vertices, arcs as polylines, in the plane z = 0; triangles of surfaces. Cell
/// data: `curve` (index from 0, of curves or of surfaces, -1 for isolated points), `arc`, `kind` and `mode` (indices
/// into the field data `kind_names`, `mode_names`), `closed`.
std::string vtp(const core::LocusMap& map);

/// "s1-contact-loss": a surface in the names of files and groups.
std::string mesh_name(const core::LocusSurface& surface);

/// Binary STL of one surface: little-endian, 50 bytes a triangle after a header of 84, unit normals towards the side on
/// which the factor is positive.
std::string stl(const core::LocusSurface& surface);

/// Wavefront OBJ: one group a surface, "g s1-contact-loss", with materials from `mtl`, which is to be in loci.mtl.
std::string obj(const core::LocusMap& map);
std::string mtl(const core::LocusMap& map);

}  // namespace clearloci::report
