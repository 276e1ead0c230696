// How far is the end effector from where it should be, all over the workspace? The pose error that the clearances cause
// (method.md section 6), over one to three free coordinates: in the cells of a grid, over a single coordinate
// along its range with the jumps at the loci.
//
//     const clearloci::Model model = clearloci::Model::read("five_bar.yaml");
//     const clearloci::Errors errors = clearloci::find_errors(model, {.grid = {200, 300}});
//     const clearloci::ModeErrors& mode = errors.modes.front();
//     std::cout << "within " << mode.sizes.back()->percentile_90 << " m in nine cells of ten under any load\n";
//
// Errors are displacements of the end effector's point in m and small rotations in rad; every field and column says its
// unit.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "clearloci/loci.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/table.hpp"
#include "clearloci/zones.hpp"

namespace clearloci::inline core {

/// A scalar over the free coordinates.
struct Field {
  std::string name;            ///< "dx": of files
  std::string label;           ///< "error in x": of legends
  std::string unit;            ///< "m" or "rad"
  bool is_signed = false;      ///< else a magnitude
  std::vector<double> values;  ///< a cell each, the first coordinate fastest; NaN where there is none
};

/// Fields over one to three free coordinates, each known at the same poses: one a cell.
struct FieldMap {
  std::vector<std::string> coordinates;
  std::vector<bool> angles;          ///< of each coordinate
  std::vector<double> lower, upper;  ///< the box; of an angle rad, else m
  /// Along each coordinate the values at which the fields are known, ascending: the middles of equal cells; over a
  /// single coordinate the ends of equal steps, and more.
  std::vector<std::vector<double>> axes;
  std::vector<Field> fields;

  std::size_t dimension() const { return axes.size(); }
  std::size_t size() const;                                         ///< cells
  std::size_t index(const std::array<std::size_t, 3>& cell) const;  ///< `cell`: 0 beyond the coordinates
  std::array<std::size_t, 3> cell(std::size_t index) const;
  std::vector<double> place(std::size_t index) const;  ///< where the fields are known in the cell
};

/// A layer of cells across a coordinate, for pictures.
struct FieldSlice {
  std::size_t across = 2;
  std::size_t layer = 0;
};

/// A layer of cells as a map over the other coordinates, in their order.
FieldMap slice_of(const FieldMap& map, const FieldSlice& slice);

/// Typical absolute values, in the unit of what they are of: near direct singularities errors grow without bound, so
/// means say nothing.
struct ErrorSizes {
  double median = 0, percentile_90 = 0, percentile_99 = 0;
  double largest = 0;  ///< with its sign
  std::size_t at = 0;  ///< where: the cell
};

/// A discontinuity-free zone and the map's cells in it.
struct ZoneErrors {
  std::string zone;                              ///< Zone::id
  std::vector<std::size_t> cells;                ///< those whose place lies in it, by their index, ascending
  std::vector<std::optional<ErrorSizes>> sizes;  ///< over these cells, as of ModeErrors
};

/// Over a single coordinate: something that happens at one value of it, and by how much the end effector jumps there.
struct ErrorEvent {
  IsolatedPoint point;
  bool jumps = false;  ///< a reaction vanishes that decides a take-up; else `jump` says nothing
  PoseError jump;      ///< behind minus before; NaN where the error has no limit on both sides
};

struct ModeErrors {
  WorkingMode mode;
  /// dx, dy, dalpha, dp; worst_dx, worst_dy, worst_dalpha, worst_dp, over all take-ups. In space dx, dy, dz, dalpha_x,
  /// dalpha_y, dalpha_z, dp; worst_ of each. Over a single coordinate cells lie at the ends of its steps, on both sides
  /// of every event, and at the event itself, where no field has a value, so that lines are broken there.
  FieldMap map;
  std::vector<std::optional<ErrorSizes>> sizes;  ///< of each of the map's fields; nothing where that has no value
  std::size_t reachable = 0;                     ///< cells with a posture
  std::size_t undefined = 0;                     ///< of those, cells without an error: exactly on a locus
  /// Joints whose reaction is zero in every pose, to rounding: their take-up is undefined everywhere, and the map has
  /// the worst case alone.
  std::vector<std::string> never_loaded;
  std::vector<ZoneErrors> zones = {};  ///< where they are asked for

  // Over a single coordinate:
  /// A row a cell: the reactions; of the joints' take-up beta_J (direction of the pin's displacement), theta_J and
  /// travel_J (play of a turning and of a sliding actuator), normal_J and tilt_J (in a guide), in space d_J_x, d_J_y,
  /// d_J_z in the place of beta_J.
  Table take_up = {};
  std::vector<ErrorEvent> events = {};  ///< ascending
};

struct Errors {
  /// Coordinates, box and units; the loci where they are asked for, over one or two coordinates. Incomplete where the
  /// deadline came before all of them were traced.
  LocusMap loci;
  std::vector<int> grid;                ///< as of ErrorRequest
  std::vector<std::string> joints;      ///< in the file's order
  std::vector<ModeErrors> modes;        ///< the request's, without those in which |A| vanishes everywhere
  std::vector<std::string> notes = {};  ///< such as what a clearance stands for
};

/// Over a single coordinate all that is told of it, as columns: the coordinate, reactions, take-up, errors.
Table samples_of(const ModeErrors& errors);

}  // namespace clearloci::inline core

namespace clearloci {

struct ErrorRequest {
  /// Cells along each coordinate, along a single one equal steps; empty: 720, 400 x 400 or 40 x 40 x 40.
  std::vector<int> grid = {};
  bool worst_case = true;     ///< also the worst case over all take-ups
  bool with_loci = true;      ///< over one and two coordinates also the loci, for pictures and as the places of jumps
  bool with_zones = false;    ///< also the zones, with the cells in each
  long zone_cells = 300'000;  ///< of zones by cells: as ZoneRequest::cells
  LociRequest loci = {};      ///< working modes, deadline, progress; and how the loci are traced
};

/// Over one to three free coordinates. Throws InputError where there are others, where no joint has a clearance, where
/// the equations are not square or the determinant vanishes in every pose, where zones over two lengths are asked for
/// without loci; LimitReached where the deadline comes before the errors, but not where it comes before the loci; and
/// as trace_loci and find_zones, where these are asked for.
Errors find_errors(const Model& model, const ErrorRequest& request = {});

}  // namespace clearloci
