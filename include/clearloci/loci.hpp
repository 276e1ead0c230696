// Where do reactions vanish? The discontinuity loci of a mechanism (method.md sections 1 to 5, 10): points over
// one free coordinate, curves over two, surfaces over three.
//
//     const clearloci::Model model = clearloci::Model::read("five_bar.yaml");
//     const clearloci::LocusMap loci = clearloci::trace_loci(model, {.all_working_modes = true});
//     for (const clearloci::LocusCurve& curve : loci.curves) std::cout << curve.id << " " << curve.cause << "\n";
//
// Lengths in m, angles in rad, forces in N, couples in N m.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "clearloci/exact.hpp"
#include "clearloci/quantity.hpp"
#include "clearloci/units.hpp"
#include "clearloci/working_mode.hpp"

namespace clearloci::inline core {

using Point2 = std::array<double, 2>;
using Polyline = std::vector<Point2>;

/// Gravest first; a curve takes the gravest kind of what vanishes on it.
/// `no_limit`, of points only: the named reactions have no limit there, for it depends on the way along which the pose
/// is approached.
/// `preload`: of free efforts without a value reactions can only vanish together there, or at the bounds of efforts, or
/// do not depend on the free ones, so that the choice of efforts changes; of determined efforts one is at its bound.
enum class LocusKind {
  contact_loss,
  backlash,
  component,
  margin,
  preload,
  direct_singularity,
  workspace_boundary,
  no_limit
};

/// "contact-loss", "backlash", ... as written in loci.json.
std::string to_string(LocusKind kind);

/// Where an arc ends. `none`: it is closed, or it is not certified and may go on.
enum class ArcEnd { none, boundary, direct_singularity, box, crossing };

std::string to_string(ArcEnd end);

struct Arc {
  bool closed = false;  ///< a closed arc repeats its first point at the end
  std::array<ArcEnd, 2> ends = {ArcEnd::none, ArcEnd::none};
  double length = 0;  ///< m
  Polyline points;
};

/// a x + b y + c = 0, coprime integers.
struct LineForm {
  Rational a, b, c;
};

/// Centre exact; radius^2 exact, `radius` exact where radius^2 is the square of a rational.
struct CircleForm {
  std::array<Rational, 2> centre;
  Rational radius_squared;
  std::optional<Rational> radius;
};

/// A non-circular conic a x^2 + b x y + c y^2 + d x + e y + f = 0.
struct ConicForm {
  std::string type;                                ///< "ellipse", "hyperbola", "parabola"
  std::array<Rational, 6> coefficients;            ///< a, b, c, d, e, f
  std::optional<Point2> centre;                    ///< absent for a parabola
  std::optional<std::array<double, 2>> semi_axes;  ///< ellipse, hyperbola: along `angle` and across
  double angle = 0;                                ///< rad, of the first axis; a parabola opens along it
};

/// rational + multiple sqrt(n), with the n of its CirclePairForm.
struct QuadraticNumber {
  Rational rational, multiple;
};

/// Two circles that are conjugate over Q: one of this centre and squared radius, and one with -sqrt(n) in place of
/// sqrt(n). `n` is a positive integer and no square.
struct CirclePairForm {
  Integer n;
  std::array<QuadraticNumber, 2> centre;
  QuadraticNumber radius_squared;
};

using ClosedForm = std::variant<std::monostate, LineForm, CircleForm, ConicForm, CirclePairForm>;

struct Circle {
  Point2 centre{};
  double radius = 0;
};

/// One curve: an irreducible polynomial, in one working mode, with everything that vanishes on it there.
struct LocusCurve {
  std::string id;  ///< "c1"
  LocusKind kind = LocusKind::contact_loss;
  std::vector<Vanishing> vanishing;
  std::string factor;                       ///< over the points' coordinates: "x - xB2"
  std::string cause;                        ///< "link PB2 parallel to the load"; empty where it has no such reading
  Polynomial implicit;                      ///< in (x, y), primitive over Z; zero as a surface's
  std::vector<std::string> variables = {};  ///< of `implicit`, of an angle "tan(phi/2)"; empty: the map's coordinates
  ClosedForm closed_form;
  WorkingMode mode;
  bool certified = false;
  /// Of a direct singularity: some reaction grows without bound there. False: under this load all stay finite.
  bool excited = true;
  std::vector<Arc> arcs;
};

using Point3 = std::array<double, 3>;

/// Over three free coordinates: where a factor vanishes in one working mode, as triangles. Coordinates are those of the
/// map, angles in rad. Edges of one triangle only are the surface's rim: on the box or on the workspace's boundary.
struct LocusSurface {
  std::string id;  ///< "s1"
  LocusKind kind = LocusKind::contact_loss;
  std::vector<Vanishing> vanishing;
  std::string factor;  ///< as a curve's
  std::string cause;
  Polynomial implicit = {};  ///< zero where it is not known, or where an angle has several charts with one each
  std::vector<std::string> variables = {};  ///< of `implicit`: the coordinates, of an angle "tan(phi/2)"
  WorkingMode mode;
  std::vector<Point3> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< seen from where the factor is positive: counter-clockwise
  int components = 0;
  int euler_characteristic = 0;  ///< vertices - edges + triangles
  double area = 0;               ///< m^2 where all coordinates are lengths, else of the coordinates as they are
  double deviation = 0;          ///< largest distance of a triangle's middle from the surface, to first order, likewise
  /// Proven: the triangles are isotopic to the surface, within the box and its faces, and nothing of it is missing.
  bool certified = false;
  /// Proven: wherever in the workspace the factor may vanish is within `resolution` of the triangles.
  bool within_resolution = false;
  Point3 resolution{};  ///< along each coordinate
  /// Where the topology is open: along the workspace boundary, where the surface touches itself, and where its parts
  /// are too close to be told apart. The triangles may join there what is apart.
  struct Open {
    Point3 lower{}, upper{};  ///< a box round cells that touch each other
    int cells = 0;
  };
  std::vector<Open> open = {};
  bool excited = true;  ///< as of a curve
};

struct SpaceArc {
  bool closed = false;  ///< a closed arc repeats its first point at the end
  std::array<ArcEnd, 2> ends = {ArcEnd::none, ArcEnd::none};
  bool certified = false;
  double length = 0;  ///< of the coordinates as they are
  std::vector<Point3> points;
};

/// Over three free coordinates: where a contact force of several components vanishes though on no surface.
struct SpaceCurve {
  std::string id;  ///< "c1"
  LocusKind kind = LocusKind::contact_loss;
  std::vector<Vanishing> vanishing;
  std::string factor;  ///< the two or three that vanish together, "; " between them
  std::string cause;
  WorkingMode mode;
  /// Proven: each arc is there, and goes where it says, to its ends or round. False also where one of three equations
  /// is known to vanish by rounding alone.
  bool certified = false;
  std::vector<SpaceArc> arcs;
};

struct IsolatedPoint {
  LocusKind kind = LocusKind::contact_loss;
  std::vector<Vanishing> vanishing;
  std::vector<double> at;  ///< one value a coordinate
  WorkingMode mode;
  bool certified = false;
  std::string factor = {};  ///< what vanishes there and why, where a single coordinate is free; else empty
  std::string cause = {};
  bool excited = true;  ///< as of a curve, where a single coordinate is free
};

/// A place at which a locus is not settled: what was found holds outside of it. The locus is named as its curve is,
/// whether or not there is one in the map.
struct OpenRegion {
  LocusKind kind = LocusKind::contact_loss;
  std::vector<Vanishing> vanishing;
  std::string factor = {};
  std::string cause = {};
  WorkingMode mode;
  std::vector<double> lower, upper;  ///< a box: one value a coordinate, which may be the same
  bool point = false;                ///< isolated points may be in it, and no curve
};

/// Whether a region is one of the curve's.
bool is_open_place_of(const OpenRegion& region, const LocusCurve& curve);

/// One free coordinate: a piece of its range in which the mode's posture exists.
struct ReachableInterval {
  WorkingMode mode;
  double from = 0, to = 0;
};

/// The workspace of one mode inside the box: rings to be filled by the even-odd rule.
struct WorkspaceRegion {
  WorkingMode mode;
  std::vector<Polyline> rings;
};

struct LocusMap {
  std::string mechanism;
  std::vector<std::pair<std::string, std::string>> parameters;  ///< name, exact value ("1/2")
  TowerNames tower;                                             ///< names of coordinates and of the modes' points
  std::vector<Rational> lower, upper;                           ///< box
  double tolerance = 0;
  /// Nothing is known to be missing: no place is open, no work was stopped.
  bool complete = true;
  /// The time limit was reached: what is missing then need not be in `open`.
  bool out_of_time = false;
  std::vector<std::string> notes;  ///< degenerate mathematics worth a sentence, e.g. a reaction that is zero everywhere
  std::vector<LocusCurve> curves;
  std::vector<LocusSurface> surfaces;  ///< with three free coordinates, and besides them:
  std::vector<SpaceCurve> space_curves;
  std::vector<IsolatedPoint> isolated_points;
  std::vector<WorkspaceRegion> workspace;
  std::vector<ReachableInterval> reachable;            ///< with one free coordinate, ascending within a mode
  std::vector<bool> angles;                            ///< which coordinates are angles, in rad; empty: none
  std::vector<std::pair<std::string, double>> timing;  ///< stage, s
  Units units = {};                                    ///< of the mechanism file: what tables and pictures speak in
  std::vector<OpenRegion> open = {};                   ///< over two coordinates
};

/// `exact`: the CGAL arrangement of the implicit curves proves the topology. `adaptive`: certified subdivision on the
/// working mode's sheet. `adaptive_then_exact`: adaptive, and exact for what that leaves open.
enum class Engine { adaptive_then_exact, exact, adaptive };

/// "adaptive-then-exact", "exact", "adaptive".
std::string to_string(Engine engine);
/// Nothing for any other name; "automatic" is another name of adaptive-then-exact.
std::optional<Engine> engine_named(std::string_view name);

}  // namespace clearloci::inline core

namespace clearloci {

class Model;

/// Signs of a mechanism's dyads and sliders in their order (Model::dyads): +1 left or ahead, -1 right or behind.
using DyadSides = std::vector<int>;

struct LociRequest {
  std::vector<std::string> joints = {};  ///< empty: every joint with a clearance, or all where none has one
  std::vector<Quantity> quantities = {Quantity::f, Quantity::M};
  std::optional<Rational> min_force = {};   ///< N: adds the margin curves |f_J|, |F_J| = min_force
  std::optional<Rational> min_couple = {};  ///< N m: adds the margin curves |M_J| = min_couple
  /// Of free efforts without a value: they may vary with the pose. Then a pose is singular only if it is so whichever
  /// efforts are free; tensions of cables vary always.
  bool controlled = false;
  std::vector<DyadSides> working_modes = {};  ///< empty: the file's
  bool all_working_modes = false;             ///< every combination of sides, the file's first
  double tolerance = 1e-5;                    ///< largest distance of a chord from its curve, m
  double mesh_size = 1.0 / 32;                ///< of surfaces: edges of triangles, as a part of the box's extent
  Engine engine = Engine::adaptive_then_exact;
  std::optional<std::chrono::steady_clock::time_point> deadline = {};  ///< then: what is known, complete = false
  std::function<void(double fraction, std::string_view stage)> progress = {};  ///< may be empty
  /// The loci of another design of the mechanism, and who is told of them as carry_loci carries them over to this one,
  /// before anything is proven. Nobody where either is empty; trace_loci alone.
  std::shared_ptr<const LocusMap> last = {};
  std::function<void(LocusMap carried)> carried = {};
};

/// The loci, every curve with its implicit polynomial, what vanishes on it and why, and its arcs in the box.
/// Throws InputError where the mechanism has no loci to speak of: a system that is not square, a determinant that
/// vanishes in every pose, an unknown joint, a working mode of the wrong length.
LocusMap trace_loci(const Model& model, const LociRequest& request = {});

/// The loci of another design of the mechanism, moved vertex by vertex to those of this one by Newton's method: a first
/// answer, quick and without any proof (`certified` and `complete` are false). Loci keep their order and ids; those
/// that are new are absent, and arcs are cut where they are lost. Over one to three coordinates; of mechanisms with
/// points that close together no loci. Of the request, what trace_loci was asked for `last`. Throws as trace_loci does.
///
///     const clearloci::Model longer = model.with({{"L", "0.51"}});
///     const clearloci::LocusMap first = clearloci::carry_loci(clearloci::trace_loci(model), longer);
LocusMap carry_loci(const LocusMap& last, const Model& model, const LociRequest& request = {});

}  // namespace clearloci
