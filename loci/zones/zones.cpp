#include "loci/zones/zones.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "core/errors.hpp"
#include "loci/curves/curves.hpp"
#include "loci/sheet/sheet.hpp"
#include "loci/zones/edge_area.hpp"
#include "loci/zones/inscribed_circle.hpp"
#include "loci/zones/largest_circle.hpp"
#include "loci/zones/workspace_area.hpp"
#include "loci/zones/workspace_rings.hpp"
#include "loci/zones/zone_graph.hpp"

namespace clearloci::loci {
namespace {

using core::Circle;
using core::LocusMap;
using core::Point2;
using core::Polyline;
using core::Zone;

class ModeZones {
 public:
  ModeZones(const core::LocusProblem& problem, const LocusMap& map, const core::WorkingMode& mode, bool sketch)
      : problem_(problem),
        map_(map),
        mode_(mode),
        sketch_(sketch),
        workspace_(problem.tower, mode),
        singularities_(problem.tower, determinants(problem)),
        sign_(singularities_, mode),
        projections_(problem, map),
        cut_(zone_graph(problem, map, mode, projections_, sketch)) {
    for (std::size_t i = 0; i < map.isolated_points.size(); ++i) {
      if (map.isolated_points[i].mode == mode) points_.push_back(static_cast<int>(i));
    }
  }

  bool finer_may_tell() const { return cut_.finer_may_tell; }
  bool is_cut_certified() const { return cut_.certified; }
  /// Once zones are found: there are some of which no pose was, since chords are as coarse as they are wide, or what is
  /// between curves about a node is left out.
  bool has_lost() const { return lost_ > 0; }

  /// The mode's zones go to `map`, which holds the loci that this was made from.
  void find(core::Zones& map, const ZoneLabel& label) {
    PlaneGraph& graph = cut_.graph;
    if (label) join_alike(label);
    for (const GraphEdge& edge : graph.edges) {
      beside_.push_back(area_beside_chords(edge.points, form_of(edge)));
      slack_.push_back(area_slack_of(edge));
    }
    std::vector<Face> faces;
    for (GraphFace& walks : faces_of(graph))
      if (!walks.outer.empty()) faces.push_back(measured(std::move(walks)));
    for (Face& face : faces)
      if (!sketch_) refine(face);
    std::erase_if(faces, [&](const Face& face) { return face.area <= 0 && !lies_along_locus(face); });
    if (!sketch_)
      for (const JoinedNodes& joined : cut_.joined) lose(joined);
    for (const GraphEdge& edge : graph.edges)
      obstacles_.push_back({&edge.points, curve_of(edge) == nullptr ? nullptr : &projections_.of(edge.owners.front())});

    for (std::size_t f = 0; f < faces.size(); ++f) note_sides(faces[f].walks, name_of(f));
    std::vector<Zone> found;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      Face face = measured(faces[f].walks);
      if (!is_in_workspace(face)) {
        if (cut_.certified && lies_along_locus(face)) lose(face);
        continue;
      }
      found.push_back(describe(std::move(face)));
      found.back().id = name_of(f);
    }
    std::stable_sort(found.begin(), found.end(), [](const Zone& a, const Zone& b) { return a.size > b.size; });
    account_for(found, map);
    for (Zone& zone : found) map.zones.push_back(std::move(zone));
    if (sketch_) return;
    for (const std::string& note : cut_.notes) map.loci.notes.push_back("zones: " + note);
  }

 private:
  static std::vector<sheet::SheetFunction> determinants(const core::LocusProblem& problem) {
    std::vector<sheet::SheetFunction> list;
    for (const core::LocusFactor& factor : problem.factors)
      if (factor.role == core::FactorRole::direct_singularity) list.push_back({factor.sheet, factor.line});
    return list;
  }

  struct Face {
    GraphFace walks;
    Polyline outer;
    std::vector<Polyline> holes;
    double area = 0, error = 0;  // m^2
    double slack = 0;            // m^2, between the curves and chords within the tolerance of them at most
  };

  /// Takes the edges out that preload loci alone lie along and that have the same label on both sides.
  void join_alike(const ZoneLabel& label) {
    const std::vector<GraphFace> faces = faces_of(cut_.graph);
    std::vector<std::string> labels(2 * cut_.graph.edges.size());
    for (const GraphFace& face : faces) {
      if (face.outer.empty()) continue;
      std::vector<Polyline> rings = {ring_of(cut_.graph, face.outer)};
      for (const auto& walk : face.inner) rings.push_back(ring_of(cut_.graph, walk));
      const Polyline inner = points_in_face(rings);
      if (!workspace_.holds_one_of(inner)) continue;
      const std::string zone_label = label(mode_, {inner.front()[0], inner.front()[1]});
      for (const HalfEdge half : face.outer) labels[place_of(half)] = zone_label;
      for (const auto& walk : face.inner)
        for (const HalfEdge half : walk) labels[place_of(half)] = zone_label;
    }
    std::vector<bool> alike(cut_.graph.edges.size(), false);
    for (std::size_t e = 0; e < alike.size(); ++e)
      alike[e] = is_of_preload(cut_.graph.edges[e]) && !labels[2 * e].empty() && labels[2 * e] == labels[2 * e + 1];
    cut_.graph = without_edges(cut_.graph, alike);
  }

  bool is_of_preload(const GraphEdge& edge) const {
    return std::all_of(edge.owners.begin(), edge.owners.end(), [&](int owner) {
      return owner != box_owner && map_.curves[static_cast<std::size_t>(owner)].kind == core::LocusKind::preload;
    });
  }

  /// Of a face, until zones are numbered: no other of any mode has it.
  std::string name_of(std::size_t face) const {
    std::string name = std::to_string(face);
    for (const int side : mode_) name += side > 0 ? "+" : "-";
    return name;
  }

  static std::size_t place_of(HalfEdge half) {
    return 2 * static_cast<std::size_t>(half.edge) + (half.reversed ? 1 : 0);
  }

  void note_sides(const GraphFace& face, const std::string& name) {
    sides_.resize(2 * cut_.graph.edges.size());
    for (const HalfEdge half : face.outer) sides_[place_of(half)] = name;
    for (const auto& walk : face.inner)
      for (const HalfEdge half : walk) sides_[place_of(half)] = name;
  }

  /// Holds the zones against the workspace, found without them and without any locus: what they do not cover, or cover
  /// twice, and what is not certified is in doubt.
  void account_for(std::vector<Zone>& found, core::Zones& map) {
    core::ZonedMode account;
    account.mode = mode_;
    const double box = box_size();
    account.workspace = workspace_faces(problem_, mode_, map_).area;
    if (!sketch_) {
      const AreaBounds bounds = workspace_area(problem_, mode_);
      if (!bounds.allow(account.workspace))
        account.workspace = bounds.most;  // the boundary has gaps: what is certain is only what enclosures tell
    }
    double covered = 0;
    for (const Zone& zone : found) covered += zone.size;
    const double amiss = std::abs(account.workspace - covered);
    if (amiss > AreaBounds::slack * account.workspace) {
      account.in_doubt = amiss;
      cut_.certified = false;
      cut_.notes.push_back("the zones found have " + std::to_string(covered) + " m^2 of a workspace of " +
                           std::to_string(account.workspace) + " m^2");
      for (Zone& zone : found) zone.certified = false;
    } else {
      account.in_doubt = lost_;
    }
    for (const Zone& zone : found) account.in_doubt += zone.certified ? 0 : zone.size;
    account.in_doubt = std::min(account.in_doubt, std::max(account.workspace, covered));
    account.outside = std::max(0.0, box - account.workspace);
    for (Zone& zone : found)
      if (!zone.certified) zone.at_least = 0, zone.at_most = box;
    map.modes.push_back(std::move(account));
  }

  double box_size() const { return core::to_double((map_.upper[0] - map_.lower[0]) * (map_.upper[1] - map_.lower[1])); }

  Polyline isolated() const {
    Polyline list;
    for (const int i : points_) list.push_back(place(i));
    return list;
  }
  Point2 place(int point) const {
    const auto& at = map_.isolated_points[static_cast<std::size_t>(point)].at;
    return {at[0], at[1]};
  }

  const core::LocusCurve* curve_of(const GraphEdge& edge) const {
    const int owner = edge.owners.front();
    return owner == box_owner ? nullptr : &map_.curves[static_cast<std::size_t>(owner)];
  }

  core::ClosedForm form_of(const GraphEdge& edge) const {
    const core::LocusCurve* const curve = curve_of(edge);
    return curve == nullptr ? core::ClosedForm(core::LineForm{}) : curve->closed_form;
  }

  Face measured(GraphFace walks) const {
    Face face;
    const auto add = [&](const std::vector<HalfEdge>& walk) {
      Polyline ring = ring_of(cut_.graph, walk);
      face.area += signed_area(ring);
      for (const HalfEdge half : walk) {
        const EdgeArea& beside = beside_[static_cast<std::size_t>(half.edge)];
        face.area += half.reversed ? -beside.area : beside.area;
        face.error += beside.error;
        const double slack = slack_[static_cast<std::size_t>(half.edge)];
        face.slack += std::max(slack, slack / 2 + std::abs(beside.area) * (slack > 0 ? 1 : 0));
        for (const JoinedNodes& joined : cut_.joined)
          if (tail(cut_.graph, half) == joined.node) face.slack += area_of(joined.circle);
      }
      return ring;
    };
    face.outer = add(walks.outer);
    for (const auto& walk : walks.inner) face.holes.push_back(add(walk));
    face.walks = std::move(walks);
    return face;
  }

  /// The curve keeps to the tube of the tolerance around its chords.
  double area_slack_of(const GraphEdge& edge) const {
    if (curve_of(edge) == nullptr) return 0;
    const core::ClosedForm& form = form_of(edge);
    if (std::holds_alternative<core::LineForm>(form) || core::circle_through(form, edge.points)) return 0;
    return (2 * length_of(edge.points) + std::numbers::pi * map_.tolerance) * map_.tolerance;
  }

  /// Both sides of a locus are in the workspace.
  bool lies_along_locus(const Face& face) const {
    const auto is_locus = [&](const HalfEdge& half) {
      const std::vector<int>& owners = cut_.graph.edges[static_cast<std::size_t>(half.edge)].owners;
      return std::none_of(owners.begin(), owners.end(), [&](int owner) {
        return owner == box_owner ||
               map_.curves[static_cast<std::size_t>(owner)].kind == core::LocusKind::workspace_boundary;
      });
    };
    const auto any = [&](const std::vector<HalfEdge>& walk) { return std::any_of(walk.begin(), walk.end(), is_locus); };
    return any(face.walks.outer) || std::any_of(face.walks.inner.begin(), face.walks.inner.end(), any);
  }

  bool is_in_workspace(const Face& face) {
    std::vector<Polyline> rings = face.holes;
    rings.push_back(face.outer);
    return face.area > 0 && workspace_.holds_one_of(points_in_face(rings));
  }

  /// A zone of which no pose was found, since its chords are as coarse as it is wide.
  void lose(const Face& face) {
    const Point2& at = face.outer.front();
    lost_ += std::max(0.0, face.area) + face.slack;
    cut_.notes.push_back("a zone at (" + std::to_string(at[0]) + ", " + std::to_string(at[1]) +
                         ") is thinner than the tolerance: it is in doubt");
  }

  void lose(const JoinedNodes& joined) {
    const Circle& circle = joined.circle;
    lost_ += area_of(circle);
    std::ostringstream note;
    note << "curves meet within " << circle.radius << " m of (" << circle.centre[0] << ", " << circle.centre[1]
         << "), nearer than their order is told: what is between them there is in doubt";
    cut_.notes.push_back(note.str());
  }

  static double area_of(const Circle& circle) { return std::numbers::pi * circle.radius * circle.radius; }

  /// More vertices where the area of a small face wants them, or where its chords are too coarse to tell its inside.
  void refine(Face& face) {
    // Of a graph with wrong faces it is no matter of chords.
    const bool may_be_coarse = cut_.certified && lies_along_locus(face);
    for (int round = 0; may_be_coarse && round < most_refinements && !is_in_workspace(face); ++round) {
      if (face.outer.size() > most_of_coarse || !halve(face, [](std::size_t) { return true; })) break;
      face = measured(std::move(face.walks));
    }
    std::size_t edges = face.walks.outer.size();
    for (const auto& walk : face.walks.inner) edges += walk.size();
    for (int round = 0; round < most_refinements && face.error > area_accuracy * face.area; ++round) {
      if (!cut_.certified && is_no_zone(face)) return;
      const double share = area_accuracy * face.area / static_cast<double>(edges);
      if (!halve(face, [&](std::size_t e) { return !(beside_[e].error <= share); })) return;
      face = measured(std::move(face.walks));
    }
  }

  /// Inside out, where the order of curves is wrong, or as thin as vertices are off their curves, where curves meet all
  /// along: no more vertices make a zone of it.
  bool is_no_zone(const Face& face) const {
    constexpr double vertex_accuracy = 1e-12;  // relative to the box
    double outline = length_of(face.outer);
    for (const Polyline& hole : face.holes) outline += length_of(hole);
    return face.area < -face.error || std::abs(face.area) <= vertex_accuracy * std::sqrt(box_size()) * outline;
  }

  /// The chords of the edges of a face that `wanted` is true for. False: of none.
  template <typename Wanted>
  bool halve(const Face& face, const Wanted& wanted) {
    bool finer = false;
    const auto visit = [&](const std::vector<HalfEdge>& walk) {
      for (const HalfEdge half : walk) {
        const auto e = static_cast<std::size_t>(half.edge);
        GraphEdge& edge = cut_.graph.edges[e];
        if (!wanted(e) || !halve_chords(edge)) continue;
        beside_[e] = area_beside_chords(edge.points, form_of(edge));
        finer = true;
      }
    };
    visit(face.walks.outer);
    for (const auto& walk : face.walks.inner) visit(walk);
    return finer;
  }

  /// A vertex of the curve amid every chord. False: the curve is not found there.
  bool halve_chords(GraphEdge& edge) {
    if (curve_of(edge) == nullptr) return false;
    const CurveProjection& curve = projections_.of(edge.owners.front());
    Polyline finer = {edge.points.front()};
    for (std::size_t i = 1; i < edge.points.size(); ++i) {
      const Point2 &a = edge.points[i - 1], &b = edge.points[i];
      const Point2 middle = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
      // A chord beside the boundary may have its middle beyond.
      const Point2 on = curve.between(a, b).value_or(curve(middle).at);
      if (!is_beside_chord(on, a, b, 2 * map_.tolerance)) return false;
      finer.push_back(on);
      finer.push_back(b);
    }
    edge.points = std::move(finer);
    return true;
  }

  Zone describe(Face face) {
    Zone zone;
    zone.mode = mode_;
    zone.size = face.area;
    zone.at_least = std::max(0.0, face.area - face.slack);
    zone.at_most = std::min(box_size(), face.area + face.slack);
    zone.outer = std::move(face.outer);
    zone.holes = std::move(face.holes);
    const auto inside = [&](const Point2& at) {
      return inside_ring(zone.outer, at) && std::none_of(zone.holes.begin(), zone.holes.end(),
                                                         [&](const Polyline& hole) { return inside_ring(hole, at); });
    };
    std::vector<Polyline> rings = zone.holes;
    rings.push_back(zone.outer);
    const Polyline inner = points_in_face(rings);
    // A zone may be so thin that rounding takes a point out of its chords.
    const auto found = std::find_if(inner.begin(), inner.end(), inside);
    const Point2& within = found != inner.end() ? *found : inner.front();
    const std::optional<Circle> circle = largest_circle(face.walks, zone, inside);
    const Circle inscribed = circle && inside(circle->centre) ? *circle : Circle{within, 0};
    zone.ball = {{inscribed.centre[0], inscribed.centre[1]}, inscribed.radius};
    // The ends of a leg may meet amid the circle, where the mechanism is not defined.
    const Point2 sample = workspace_.holds(inscribed.centre).value_or(false) ? inscribed.centre : within;
    zone.sample = {sample[0], sample[1]};
    put_box_around(zone);
    zone.borders = borders(face.walks);
    for (const int i : points_) {
      if (inside(place(i))) zone.isolated_points.push_back(i);
    }
    zone.certified = cut_.certified && inside(sample) && !holds_open_point(inside) && is_one(rings, zone.size);
    return zone;
  }

  static void put_box_around(Zone& zone) {
    zone.lower = zone.upper = {zone.outer.front()[0], zone.outer.front()[1]};
    for (const Point2& at : zone.outer)
      for (std::size_t c = 0; c < 2; ++c) {
        zone.lower[c] = std::min(zone.lower[c], at[c]);
        zone.upper[c] = std::max(zone.upper[c], at[c]);
      }
  }

  /// Whether isolated points of a contact loss may be inside that nothing was proven of. Their boxes are tiny.
  template <typename Inside>
  bool holds_open_point(const Inside& inside) const {
    return std::any_of(map_.open.begin(), map_.open.end(), [&](const core::OpenRegion& region) {
      if (!region.point || region.mode != mode_) return false;
      const auto [x0, y0] = std::pair(region.lower[0], region.lower[1]);
      const auto [x1, y1] = std::pair(region.upper[0], region.upper[1]);
      return inside({x0, y0}) || inside({x1, y0}) || inside({x0, y1}) || inside({x1, y1});
    });
  }

  /// A check by other means than those that made the face: all over it poses can be reached, and no factor of |A| has
  /// both signs.
  bool is_one(const std::vector<Polyline>& rings, double area) {
    const double wide = clear_of_chords * map_.tolerance;
    const Polyline points = points_all_over_face(rings, wide);
    if (!amiss_among(points)) return true;
    // In a sliver at an angle to a wide span its middle is near a chord all the same, where it tells nothing.
    const std::optional<Point2> at = amiss_among(clear_of(rings, points, wide / 2));
    if (!at) return true;
    cut_.notes.push_back("a zone of " + std::to_string(area) + " m^2 is not one at (" + std::to_string((*at)[0]) +
                         ", " + std::to_string((*at)[1]) + ")");
    return false;
  }

  /// The first of the points that is not of one zone with those before it.
  std::optional<Point2> amiss_among(const Polyline& points) {
    std::vector<int> signs(static_cast<std::size_t>(singularities_.functions()), 0);
    for (const Point2& at : points) {
      if (workspace_.holds(at) == std::optional<bool>(false)) return at;
      for (std::size_t f = 0; f < signs.size(); ++f) {
        const int sign = sign_(at[0], at[1], static_cast<int>(f)).value_or(0);
        if (sign * signs[f] < 0) return at;
        if (sign != 0) signs[f] = sign;
      }
    }
    return std::nullopt;
  }

  std::vector<core::ZoneBorder> borders(const GraphFace& face) const {
    std::map<int, double> lengths;  // by owner
    std::map<int, std::set<std::string>> beside;
    const auto add = [&](const std::vector<HalfEdge>& walk) {
      for (const HalfEdge half : walk) {
        const GraphEdge& edge = cut_.graph.edges[static_cast<std::size_t>(half.edge)];
        const std::string& other = sides_[place_of({half.edge, !half.reversed})];
        for (const int owner : edge.owners) {
          lengths[owner] += length_of(edge.points);
          if (!other.empty()) beside[owner].insert(other);
        }
      }
    };
    add(face.outer);
    for (const auto& walk : face.inner) add(walk);
    std::vector<core::ZoneBorder> list;
    for (const auto& [owner, length] : lengths) {
      if (owner == box_owner) {
        list.push_back({"box", length});
        continue;
      }
      const core::LocusCurve& curve = map_.curves[static_cast<std::size_t>(owner)];
      list.push_back({curve.id, length, curve.kind, curve.vanishing, {beside[owner].begin(), beside[owner].end()}});
    }
    // Lengths are those of chords: what is as long to a thousandth is told in the order of its name.
    const auto longest =
        std::max_element(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.length < b.length; });
    const double step = list.empty() ? 0 : 1e-3 * longest->length;
    std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.curve < b.curve; });
    std::stable_sort(list.begin(), list.end(), [step](const auto& a, const auto& b) {
      return std::round(a.length / step) > std::round(b.length / step);
    });
    return list;
  }

  /// None where the face is too thin for one.
  template <typename Inside>
  std::optional<Circle> largest_circle(const GraphFace& face, const Zone& zone, const Inside& inside) {
    std::vector<Obstacle> borders;
    double length = 0;
    const auto add = [&](const std::vector<HalfEdge>& walk) {
      for (const HalfEdge half : walk) {
        borders.push_back(obstacles_[static_cast<std::size_t>(half.edge)]);
        length += length_of(*borders.back().line);
      }
    };
    add(face.outer);
    for (const auto& walk : face.inner) add(walk);
    const Polyline points = isolated();
    const double width = 2 * zone.size / length;
    const double step =
        sketch_ ? std::max(width / 4, length / most_sites_of_a_sketch) : std::max(width / 8, length / most_sites);
    Polyline sites = points;
    for (const Obstacle& border : borders) sample(*border.line, step, sites);

    std::vector<Circle> candidates;
    for (const Circle& circle : voronoi_circles(sites)) {
      const bool another = std::none_of(candidates.begin(), candidates.end(), [&](const Circle& other) {
        return std::hypot(other.centre[0] - circle.centre[0], other.centre[1] - circle.centre[1]) < 0.2 * other.radius;
      });
      if (!another || !inside(circle.centre)) continue;
      candidates.push_back(circle);
      if (candidates.size() == most_candidates) break;
    }
    std::optional<Circle> best;
    for (const Circle& candidate : candidates) {
      // No circle about a place grows by more than one moves it.
      if (best && (1 + farthest_polished) * candidate.radius < best->radius) continue;
      const Circle circle =
          sketch_ ? free_of(borders, points, candidate.centre) : polished(candidate, borders, points, map_.tolerance);
      if (inside(circle.centre) && (!best || circle.radius > best->radius)) best = circle;
    }
    return best;
  }

  /// As large as chords and points let it be about this place.
  static Circle free_of(const std::vector<Obstacle>& borders, const Polyline& points, const Point2& centre) {
    double squared = std::numeric_limits<double>::infinity();
    const auto meet = [&](const Point2& a, const Point2& b) {
      const double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
      const double along = (centre[0] - a[0]) * dx + (centre[1] - a[1]) * dy;
      const double t = length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
      const double x = a[0] + t * dx - centre[0], y = a[1] + t * dy - centre[1];
      squared = std::min(squared, x * x + y * y);
    };
    for (const Obstacle& border : borders)
      for (std::size_t i = 1; i < border.line->size(); ++i) meet((*border.line)[i - 1], (*border.line)[i]);
    for (const Point2& point : points) meet(point, point);
    return {centre, std::sqrt(squared)};
  }

  static double length_of(const Polyline& points) {
    double length = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
      length += std::hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]);
    return length;
  }

  /// Points along a polyline no further apart than `step`, its vertices apart from those that stand closer.
  static void sample(const Polyline& line, double step, Polyline& sites) {
    sites.push_back(line.front());
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Point2 from = sites.back(), to = line[i];
      const double gap = std::hypot(to[0] - from[0], to[1] - from[1]);
      if (gap < step / 2 && i + 1 < line.size()) continue;
      const int pieces = std::max(1, static_cast<int>(std::ceil(gap / step)));
      for (int k = 1; k <= pieces; ++k) {
        const double t = static_cast<double>(k) / pieces;
        sites.push_back({from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])});
      }
    }
  }

  static constexpr double area_accuracy = 1e-7;  ///< relative; a tenth of what is promised, since it is an estimate
  /// Tolerances, so that a point amid a span this wide is on the side of every curve that its chords tell.
  static constexpr double clear_of_chords = 8;
  static constexpr int most_refinements = 8;
  static constexpr std::size_t most_of_coarse = 4000;  ///< vertices; a face of more has no coarse chords
  static constexpr double most_sites = 4000, most_sites_of_a_sketch = 250;  ///< on a zone's border
  static constexpr std::size_t most_candidates = 3;

  const core::LocusProblem& problem_;
  const LocusMap& map_;
  core::WorkingMode mode_;
  bool sketch_;
  ModeWorkspace workspace_;
  sheet::SheetProgram singularities_;
  sheet::PointSign sign_;
  CurveProjections projections_;
  ZoneGraph cut_;
  std::vector<int> points_;
  std::vector<EdgeArea> beside_;
  std::vector<double> slack_;       ///< of every edge (Face::slack)
  double lost_ = 0;                 ///< m^2 of zones of which no pose was found
  std::vector<std::string> sides_;  ///< of every half-edge the name of the face on its left, if it is one
  std::vector<Obstacle> obstacles_;
};

/// "z1", "z2", ... in place of the names of faces; those that are no zones are beside none.
void number_zones(std::vector<Zone>& zones) {
  std::map<std::string, std::string> names;
  for (const Zone& zone : zones) names.emplace(zone.id, "z" + std::to_string(names.size() + 1));
  for (Zone& zone : zones) {
    for (core::ZoneBorder& border : zone.borders) {
      std::vector<std::string> beside;
      for (const std::string& face : border.beside)
        if (const auto name = names.find(face); name != names.end() && face != zone.id) beside.push_back(name->second);
      border.beside = std::move(beside);
    }
  }
  for (Zone& zone : zones) zone.id = names.at(zone.id);
}

}  // namespace

CutZones zones(const core::LocusProblem& problem, core::LocusMap traced, bool sketch, bool may_leave,
               const ZoneLabel& label) {
  core::ensure(problem.tower.coordinates.size() == 2, "two free coordinates");
  CutZones cut;
  core::Zones& map = cut.map;
  map.loci = std::move(traced);
  std::deque<ModeZones> modes;
  bool is_certified = true;
  for (const core::WorkingMode& mode : problem.modes) {
    const ModeZones& zones = modes.emplace_back(problem, map.loci, mode, sketch);
    cut.finer_may_tell = cut.finer_may_tell && zones.finer_may_tell();
    is_certified = is_certified && zones.is_cut_certified();
  }
  cut.left = may_leave && cut.finer_may_tell && !is_certified;
  if (cut.left) return cut;
  for (ModeZones& zones : modes) {
    zones.find(map, label);
    cut.left = cut.left || (may_leave && cut.finer_may_tell && zones.has_lost());
  }
  number_zones(map.zones);
  return cut;
}

}  // namespace clearloci::loci
