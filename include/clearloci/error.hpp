// How far is the end effector from where it should be, all over the workspace? The pose error that the clearances cause
// (docs/method.md section 6): as a map over two free coordinates, as a volume over three, and over a single one with
// its jumps at the loci.
//
//     const clearloci::Model model = clearloci::Model::read("five_bar.yaml");
//     const clearloci::ErrorMap errors = clearloci::error_map(model, {.nx = 200, .ny = 300});
//     const clearloci::ModeErrors& own = errors.modes.front();
//     std::cout << "within " << own.sizes.back()->percentile_90 << " m in nine cells of ten under any load\n";
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

/// A scalar over the plane of two free coordinates, sampled in the middle of the cells of a grid.
struct Field {
  std::string name;            ///< "dx": of files
  std::string label;           ///< "error in x": of legends
  std::string unit;            ///< "m" or "rad"
  bool is_signed = false;      ///< else a magnitude
  std::vector<double> values;  ///< row after row from the lowest second coordinate; NaN where there is none
};

struct FieldMap {
  std::string mechanism;
  std::array<std::string, 2> coordinates;
  std::array<double, 2> lower{}, upper{};  ///< of the grid's outer edges; of an angle (LocusMap::angles) rad, else m
  int nx = 0, ny = 0;                      ///< cells
  std::vector<Field> fields;

  double x(int i) const { return lower[0] + (i + 0.5) * (upper[0] - lower[0]) / nx; }
  double y(int j) const { return lower[1] + (j + 0.5) * (upper[1] - lower[1]) / ny; }
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i);
  }
};

/// Scalars over the box of three free coordinates, likewise.
struct FieldVolume {
  std::string mechanism;
  std::array<std::string, 3> coordinates;
  std::array<bool, 3> angles{};
  std::array<double, 3> lower{}, upper{};  ///< m, of angles rad
  std::array<int, 3> cells{};
  std::vector<Field> fields;  ///< values along the first coordinate, row after row, layer after layer

  /// The middle of cell `i` along a coordinate.
  double at(std::size_t coordinate, int i) const {
    return lower[coordinate] + (i + 0.5) * (upper[coordinate] - lower[coordinate]) / cells[coordinate];
  }
  std::size_t index(const std::array<int, 3>& cell) const {
    const auto [i, j, k] = cell;
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(cells[1]) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(cells[0]) +
           static_cast<std::size_t>(i);
  }
};

/// A layer of cells across a coordinate, for pictures.
struct VolumeSlice {
  std::size_t across = 2;
  int layer = 0;
};

/// A layer of cells across one of the coordinates, as a map over the other two.
FieldMap slice_of(const FieldVolume& volume, std::size_t across, int layer);

/// Typical absolute values, in the unit of what they are of: near direct singularities errors grow without bound, so
/// means say nothing.
struct ErrorSizes {
  double median = 0, percentile_90 = 0, percentile_99 = 0;
  double largest = 0;  ///< with its sign
  std::size_t at = 0;  ///< where: the cell or the row
};

/// A discontinuity-free zone and the map's cells in it.
struct ZoneErrors {
  std::string zone;                              ///< Zone::id
  std::vector<std::size_t> cells;                ///< those whose middle lies in it, by their index, ascending
  std::vector<std::optional<ErrorSizes>> sizes;  ///< over these cells, as of ModeErrors
};

struct ModeErrors {
  WorkingMode mode;
  /// dx, dy, dalpha, dp; worst_dx, worst_dy, worst_dalpha, worst_dp, over all take-ups. In space dx, dy, dz, dalpha_x,
  /// dalpha_y, dalpha_z, dp; worst_ of each.
  FieldMap map;
  std::vector<std::optional<ErrorSizes>> sizes;  ///< of each of the map's fields; nothing where that has no value
  std::size_t reachable = 0;                     ///< cells with a posture
  std::size_t undefined = 0;                     ///< of those, cells on a locus to the last bit: no error there
  /// Joints whose reaction is zero in every pose, to rounding: their take-up is undefined everywhere, and the map has
  /// the worst case alone.
  std::vector<std::string> never_loaded;
  std::vector<ZoneErrors> zones;  ///< where they are asked for
};

struct ErrorMap {
  LocusMap loci;                  ///< without curves where they are not asked for; incomplete where the deadline came
  std::vector<ModeErrors> modes;  ///< the request's, without those in which |A| vanishes everywhere
  std::vector<std::string> notes = {};  ///< such as what a clearance stands for
};

struct VolumeModeErrors {
  std::vector<std::pair<std::string, std::string>> mode;  ///< as describe_mode
  FieldVolume volume;                                     ///< fields as of ModeErrors::map
  std::vector<std::optional<ErrorSizes>> sizes;           ///< as of ModeErrors, like what follows
  std::size_t reachable = 0, undefined = 0;
  std::vector<std::string> never_loaded;
};

/// Over three free coordinates, without loci.
struct VolumeErrors {
  std::vector<VolumeModeErrors> modes;
  std::vector<std::string> notes;
  Units units = {};  ///< of the mechanism file
};

/// Something that happens at one value of the coordinate, and by how much the end effector jumps there.
struct ErrorEvent {
  IsolatedPoint point;
  bool jumps = false;  ///< a reaction vanishes that decides a take-up; else `jump` says nothing
  PoseError jump;      ///< behind minus before; NaN where the error has no limit on both sides
};

struct CoordinateModeErrors {
  WorkingMode mode;
  /// The coordinate; the reactions; of the joints' take-up beta_J (direction of the pin's displacement), theta_J and
  /// travel_J (play of a turning and of a sliding actuator), normal_J and tilt_J (in a guide), in space d_J_x, d_J_y,
  /// d_J_z in the place of beta_J; the components of the error. In steps, and on both sides of every event; the row at
  /// an event itself has no values, so that lines are broken there.
  Table samples;
  std::vector<std::optional<ErrorSizes>> sizes;  ///< of each of CoordinateErrors::components, over the rows
  std::vector<std::string> never_loaded;         ///< as of ModeErrors
  std::vector<ErrorEvent> events;                ///< ascending
};

/// A component of the error over a single coordinate: those of ModeErrors::map.
struct ErrorComponent {
  std::string name, label, unit;
  bool is_signed = false;  ///< else a magnitude
};

struct CoordinateErrors {
  std::string mechanism;
  std::string coordinate;
  bool angle = false;             ///< the coordinate is an angle in rad, else a length in m
  std::array<double, 2> range{};  ///< of the coordinate
  int steps = 0;
  std::vector<std::string> joints;  ///< in the file's order
  std::vector<ErrorComponent> components;
  LocusMap loci;  ///< as of ErrorMap
  std::vector<CoordinateModeErrors> modes;
  std::vector<std::string> notes = {};  ///< as of ErrorMap
};

}  // namespace clearloci::inline core

namespace clearloci {

struct ErrorRequest {
  int nx = 400, ny = 400;                   ///< cells along each of two coordinates
  int steps = 720;                          ///< over a single one
  std::array<int, 3> cells = {40, 40, 40};  ///< along each of three
  bool worst_case = true;                   ///< also the worst case over all take-ups
  bool with_loci = true;                    ///< also the loci, for pictures and as the places of jumps
  bool with_zones = false;                  ///< also the zones, with the cells in each; over two lengths
  LociRequest loci = {};                    ///< working modes, deadline, progress; and how the loci are traced
};

/// Over two free coordinates. Throws InputError where there are not two, where no joint has a clearance, where the
/// equations are not square or the determinant vanishes in every pose, where zones are asked for without loci; and as
/// trace_loci and find_zones, where these are asked for.
ErrorMap error_map(const Model& model, const ErrorRequest& request = {});

/// Over three free coordinates. Throws likewise; LimitReached where the deadline comes first.
VolumeErrors error_volume(const Model& model, const ErrorRequest& request = {});

/// Over the one free coordinate. Throws likewise.
CoordinateErrors coordinate_errors(const Model& model, const ErrorRequest& request = {});

}  // namespace clearloci
