#include "check/arcs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "check/identity.hpp"
#include "check/labels.hpp"
#include "check/statics.hpp"

namespace clearloci::check {
namespace {

using core::ArcEnd;
using core::FactorRole;
using core::Point2;

// All relative to the box. Vertices are on the curve to rounding; ends are where two curves cross, to rounding.
constexpr double on_curve = 1e-11, same_place = 1e-8;
// Pieces of curve are looked at in boxes down to this size, and in so many.
constexpr double smallest_box = 1e-7;
constexpr std::size_t most_boxes = 4'000;

double distance(const Point2& a, const Point2& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

Interval around(double a, double reach) { return {a - reach, a + reach, cell_bits}; }

bool kind_fits(core::LocusKind kind, FactorRole role) {
  using core::LocusKind;
  return role == FactorRole::reaction             ? kind <= LocusKind::component
         : role == FactorRole::margin             ? kind == LocusKind::margin
         : role == FactorRole::preload            ? kind == LocusKind::preload
         : role == FactorRole::direct_singularity ? kind == LocusKind::direct_singularity
                                                  : kind == LocusKind::workspace_boundary;
}

/// An arc's run along one path.
struct Run {
  int path = 0;
  double first = 0, last = 0;                    ///< where it was met first and last
  std::vector<Point2> points;                    ///< its vertices
  double gone = 0, back = 0, ahead = 0;          ///< signed, along the path: in all, the largest step either way
  bool open_before = false, open_after = false;  ///< vertices in open cells
};

/// A part of a path: what an arc covers, or what none does.
struct Part {
  double from = 0, to = 0;
  Point2 a{}, b{};             ///< its ends
  std::vector<Point2> points;  ///< vertices of the arc that covers it
};

class ArcCheck {
 public:
  ArcCheck(const mechanism::Mechanism& m, Curve& curve, const CurvePart& part, std::vector<KnownArc>& arcs,
           std::vector<std::string>& unchecked)
      : m_(m),
        curve_(curve),
        c_(curve.c),
        part_(part),
        arcs_(arcs),
        unchecked_(unchecked),
        covered_(curve.paths.size()) {
    for (std::size_t i = 0; i < 4; ++i) box_[i] = c_.box[i].get_d();
    for (int j = 0; j < static_cast<int>(c_.squares.size()); ++j) {
      core::StraightLineBuilder builder;
      if (!is_at_zero(j)) roots_.push_back(builder.line(builder.variable(2 + j)));
    }
    for (const int j : curve_.claim.at_zero) {
      const std::vector<const core::StraightLine*> square = {&c_.squares[static_cast<std::size_t>(j)]};
      zero_squares_.emplace_back(parts_of(c_, curve_.claim.mode, curve_.claim.at_zero), square);
    }
    for (const int f : part.singular) singular_.push_back(&c_.functions[static_cast<std::size_t>(f)].program);
  }

  void run() {
    std::vector<KnownArc*> candidates;
    std::set<const CurveClaim*> mine, others;  // curves with an arc of more than one chord
    for (KnownArc& arc : arcs_) {
      if (arc.curve->mode != curve_.claim.mode || !kind_fits(arc.curve->kind, curve_.claim.role)) continue;
      const bool is_candidate = is_mine(*arc.curve, *arc.arc);
      if (is_candidate) candidates.push_back(&arc);
      if (!is_chord(*arc.arc)) (is_candidate ? mine : others).insert(arc.curve);
    }
    for (KnownArc* candidate : candidates) {
      KnownArc& arc = *candidate;
      // Between two nodes, where several functions vanish, one chord may be near all of them: it belongs to the
      // function that the other arcs of its curve do.
      if (is_chord(*arc.arc) && others.contains(arc.curve) && !mine.contains(arc.curve)) continue;
      if (arc.curve->certified)
        match(*arc.arc);
      else
        uncertain_ = true;
      arc.sheet = part_.number;
    }
    for (std::size_t p = 0; p < covered_.size(); ++p) check_path(curve_.paths[p], covered_[p]);
  }

 private:
  bool is_at_zero(int j) const {
    return std::find(curve_.claim.at_zero.begin(), curve_.claim.at_zero.end(), j) != curve_.claim.at_zero.end();
  }

  // --- along an arc -------------------------------------------------------------------------------------------------

  /// The function's enclosure over a box around a point holds 0, to first order.
  bool holds_zero(const Point2& at, double reach) {
    return curve_.sheet.enter(around(at[0], reach), around(at[1], reach)) && !curve_.sheet.is_free(0);
  }
  /// The enclosures of the function and of the squares of all roots that are zero along the curve hold 0: of a function
  /// that is a multiple of such a root the first holds it everywhere.
  bool may_be_on(const Point2& at, double reach) {
    return holds_zero(at, reach) && std::all_of(zero_squares_.begin(), zero_squares_.end(), [&](Sheet& square) {
             return square.enter(around(at[0], reach), around(at[1], reach)) && !square.is_free(0);
           });
  }
  double vertex_reach(const Point2& at) const {
    return on_curve * curve_.size + 8 * 0x1p-52 * std::max(std::abs(at[0]), std::abs(at[1]));
  }
  /// Ends are computed apart, and may have been moved to the box.
  double reach_of(const core::Arc& arc, std::size_t i) const {
    const bool end = !arc.closed && (i == 0 || i + 1 == arc.points.size());
    return (end ? 10 : 1) * vertex_reach(arc.points[i]);
  }

  static bool is_chord(const core::Arc& arc) { return arc.points.size() == 2; }

  /// The arc claims to be one of this function: most of some places lie on it.
  bool is_mine(const CurveClaim& claim, const core::Arc& arc) {
    int on = 0;
    const std::size_t n = arc.points.size();
    // Of a single chord that tells little: then what vanishes on it has to be the function's, too.
    if (is_chord(arc) && curve_.claim.role == FactorRole::reaction &&
        std::none_of(claim.vanishing.begin(), claim.vanishing.end(),
                     [&](const Reaction& reaction) { return part_.vanishing.contains(reaction); }))
      return false;
    for (const std::size_t quarter : {1u, 2u, 3u}) {
      if (n > 2) {
        const Point2& at = arc.points[std::clamp<std::size_t>(quarter * (n - 1) / 4, 1, n - 2)];
        on += may_be_on(at, 10 * vertex_reach(at)) ? 1 : 0;
      } else {
        // A chord alone: its middle may lie near another curve too, its ends do not.
        const Point2 &a = arc.points[0], &b = arc.points[1];
        const Point2 at = quarter == 1 ? a : quarter == 3 ? b : Point2{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
        on += may_be_on(at, quarter == 2 ? 1.5 * c_.tolerance : 10 * vertex_reach(at)) ? 1 : 0;
      }
    }
    return on >= (n > 2 ? 2 : 3);
  }

  /// The vertices run along paths of this sheet one after another, through open cells between.
  void match(const core::Arc& arc) {
    std::vector<Run> runs;
    bool was_open = false;
    for (std::size_t i = 0; i < arc.points.size(); ++i) {
      const Point2& at = arc.points[i];
      const double reach = reach_of(arc, i);
      if (at[0] < box_[0] - reach || box_[1] + reach < at[0] || at[1] < box_[2] - reach || box_[3] + reach < at[1])
        curve_.fail("an arc leaves the box");
      bool open = false;
      std::vector<Spot> here = curve_.spots(at, reach, open);
      if (here.empty() || (!open && !holds_zero(at, reach))) {
        if (!open) curve_.fail(fmt::format("an arc's vertex ({}, {}) is not on the curve", at[0], at[1]));
        was_open = true;
        if (!runs.empty()) runs.back().open_after = true;
      } else {
        if (here.size() > 1 && i + 1 < arc.points.size()) prefer_next(here, arc, i + 1);
        follow(runs, here, at, was_open);
        was_open = false;
      }
      if (i > 0) check_chord(arc.points[i - 1], at);
    }
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (i > 0) check_passage(runs[i - 1], runs[i], arc);
      cover(runs[i], arc, i > 0 || runs[i].open_before, i + 1 < runs.size() || runs[i].open_after);
    }
    if (arc.closed && arc.points.front() != arc.points.back()) curve_.fail("a closed arc does not close");
    if (arc.closed && (arc.ends[0] != ArcEnd::none || arc.ends[1] != ArcEnd::none))
      curve_.fail("a closed arc has ends");
    if (!arc.closed)
      for (const std::size_t end : {0u, 1u}) check_end(arc, end);
  }

  /// Where two paths begin in one place, the next vertex tells which is meant.
  void prefer_next(std::vector<Spot>& here, const core::Arc& arc, std::size_t next) {
    bool open = false;
    const std::vector<Spot> there = curve_.spots(arc.points[next], reach_of(arc, next), open);
    std::stable_partition(here.begin(), here.end(), [&](const Spot& spot) {
      return std::any_of(there.begin(), there.end(),
                         [&](const Spot& candidate) { return candidate.path == spot.path; });
    });
  }

  const Path& path_of(int path) const { return curve_.paths[static_cast<std::size_t>(path)]; }
  static double length_of(const Path& path) { return static_cast<double>(path.steps.size()); }

  void follow(std::vector<Run>& runs, const std::vector<Spot>& here, const Point2& at, bool was_open) const {
    const Spot* best = nullptr;
    double step = 0;
    for (const Spot& spot : here) {
      if (runs.empty() || spot.path != runs.back().path) continue;
      double behind = spot.along - runs.back().last;
      const double n = length_of(path_of(spot.path));
      if (path_of(spot.path).closed) behind -= n * std::nearbyint(behind / n);
      if (best != nullptr && std::abs(behind) >= std::abs(step)) continue;
      best = &spot;
      step = behind;
    }
    // What comes out of an open cell elsewhere on the same path has passed that cell.
    if (best == nullptr || (was_open && std::abs(step) > 1)) {
      const double along = here.front().along;
      runs.push_back({here.front().path, along, along, {at}, 0, 0, 0, was_open, false});
      return;
    }
    Run& run = runs.back();
    run.last = best->along;
    run.points.push_back(at);
    run.gone += step;
    run.back = std::min(run.back, step);
    run.ahead = std::max(run.ahead, step);
    run.open_after = false;
  }

  bool is_open(int junction) const { return curve_.junction(junction).kind == Junction::Kind::open; }

  /// From one path to the next only through open cells, along the arc.
  void check_passage(const Run& from, const Run& to, const core::Arc& arc) const {
    const auto is_there = [&](int j) {
      return is_open(j) && passes_near(arc.points, curve_.junction(j).place.at(), 1.5 * c_.tolerance);
    };
    for (const int leaving : {path_of(from.path).first, path_of(from.path).last})
      for (const int entering : {path_of(to.path).first, path_of(to.path).last})
        if (is_there(leaving) && is_there(entering)) return;
    curve_.fail("an arc jumps from one piece of curve to another");
  }

  void cover(const Run& run, const core::Arc& arc, bool comes_from_open, bool goes_to_open) {
    constexpr double jitter = 1e-3;
    const Path& path = path_of(run.path);
    const double n = length_of(path);
    if (run.gone >= 0 ? run.back < -jitter : run.ahead > jitter) curve_.fail("an arc runs back and forth");
    std::vector<Part>& covered = covered_[static_cast<std::size_t>(run.path)];
    const Point2 &from = run.points.front(), &to = run.points.back();
    if (path.closed) {
      if (arc.closed && std::abs(std::abs(run.gone) - n) > 10 * jitter)
        curve_.fail("an arc does not run once round its curve");
      if (run.gone >= 0)
        covered.push_back({run.first, run.first + run.gone, from, to, run.points});
      else
        covered.push_back({run.last, run.last - run.gone, to, from, run.points});
      return;
    }
    if (arc.closed && !comes_from_open && !goes_to_open) curve_.fail("an arc is closed, its curve is open");
    Part part = run.first <= run.last ? Part{run.first, run.last, from, to, run.points}
                                      : Part{run.last, run.first, to, from, run.points};
    const auto extend = [&](bool to_last) {
      const int junction = to_last ? path.last : path.first;
      if (!is_open(junction)) return;
      (to_last ? part.to : part.from) = to_last ? n : 0.0;
      (to_last ? part.b : part.a) = curve_.junction(junction).place.at();
    };
    // With one vertex outside of open cells it came from, or goes to, the end of the path that is open, or the nearer.
    const bool at_last = is_open(path.first) != is_open(path.last) ? is_open(path.last) : run.first + run.last > n;
    const bool forward = run.first < run.last || (run.first == run.last && at_last == goes_to_open);
    if (comes_from_open) extend(!forward);
    if (goes_to_open) extend(forward);
    covered.push_back(part);
  }

  /// Middles of chords are within the tolerance of the curve.
  void check_chord(const Point2& a, const Point2& b) {
    const Point2 middle = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
    const double reach = 1.5 * c_.tolerance + vertex_reach(middle);
    bool open = false;
    const std::vector<Spot> here = curve_.spots(middle, reach, open);
    if (!open && (here.empty() || !holds_zero(middle, reach)))
      curve_.fail(fmt::format("a chord leaves the curve near ({}, {})", middle[0], middle[1]));
  }

  /// The square of a root vanishes there with its slopes: the ends of a dyad of equal lengths meet.
  bool at_cone(const Interval& x, const Interval& y) const {
    const auto is_flat = [&](const core::StraightLine& square) {
      Sheet sheet(parts_of(c_, curve_.claim.mode, curve_.claim.at_zero), {&square});
      if (!sheet.enter(x, y) || sheet.is_free(0)) return false;
      sheet.differentiate();
      for (int d = 0; d < sheet.dimension(); ++d)
        if (!sheet.slope(0, d).contains_zero()) return false;
      return true;
    };
    return std::any_of(c_.squares.begin(), c_.squares.end(), is_flat);
  }

  /// What is said to end the arc is there.
  void check_end(const core::Arc& arc, std::size_t end) {
    const Point2& at = end == 0 ? arc.points.front() : arc.points.back();
    const double reach = same_place * curve_.size;
    const Interval x = around(at[0], reach), y = around(at[1], reach);
    const auto on_boundary = [&] { return may_be_on_boundary(m_, c_, curve_.claim.mode, x, y); };
    const auto on_singularity = [&] {
      return std::any_of(singular_.begin(), singular_.end(), [&](const core::StraightLine* program) {
        Sheet sheet(parts_of(c_, curve_.claim.mode, curve_.claim.at_zero), {program});
        return program != &curve_.program && sheet.enter(x, y) && !sheet.is_free(0);
      });
    };
    bool there = false;
    switch (arc.ends[end]) {
      case ArcEnd::box:
        for (std::size_t i = 0; i < 4; ++i) there = there || std::abs(at[i / 2] - box_[i]) < reach;
        break;
      case ArcEnd::boundary:
        there = on_boundary();
        break;
      case ArcEnd::direct_singularity:
        there = on_singularity();
        break;
      case ArcEnd::crossing: {
        const auto passes = [&](const KnownArc& other) {
          return other.arc != &arc && other.curve->mode == curve_.claim.mode &&
                 passes_near(other.arc->points, at, 2.5 * c_.tolerance);
        };
        // What ends on something graver is named after that. At a cone |A| and a root vanish whatever their curves do.
        const bool cone = at_cone(x, y);
        const auto ends_some = [&](core::LocusKind kind) {
          return std::any_of(arcs_.begin(), arcs_.end(),
                             [&](const KnownArc& other) { return other.curve->kind == kind && passes(other); });
        };
        const bool is_singular =
            cone ? curve_.claim.role != FactorRole::direct_singularity && ends_some(core::LocusKind::direct_singularity)
                 : on_singularity();
        const bool is_last = cone ? ends_some(core::LocusKind::workspace_boundary) : on_boundary();
        there = std::any_of(arcs_.begin(), arcs_.end(), passes) && !is_singular &&
                (curve_.claim.role != FactorRole::reaction || !is_last);
        break;
      }
      case ArcEnd::none:
        break;
    }
    if (!there)
      curve_.fail(fmt::format("an arc ends at ({}, {}), but not on {}", at[0], at[1], to_string(arc.ends[end])));
  }

  // --- along a path ----------------------------------------------------------------------------------------------

  Point2 end_of(const Path& path, bool last) const { return curve_.junction(last ? path.last : path.first).place.at(); }

  void check_path(const Path& path, std::vector<Part> parts) {
    std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.from < b.from; });
    const double n = length_of(path);
    std::vector<Part> gaps;
    const auto between = [&](double from, const Point2& a, double to, const Point2& b) {
      if (to < from - 1e-3 && !is_tiny(path, {to, from, b, a, {}}))
        curve_.fail(fmt::format("two arcs run along one piece of curve near ({}, {})", a[0], a[1]));
      if (to > from) gaps.push_back({from, to, a, b, {}});
    };
    for (std::size_t i = 1; i < parts.size(); ++i) between(parts[i - 1].to, parts[i - 1].b, parts[i].from, parts[i].a);
    if (path.closed && !parts.empty()) {
      between(parts.back().to, parts.back().b, parts.front().from + n, parts.front().a);
    } else if (parts.empty()) {
      gaps.push_back({0, n, end_of(path, false), end_of(path, true), {}});
    } else {
      between(0, end_of(path, false), parts.front().from, parts.front().a);
      between(parts.back().to, parts.back().b, n, end_of(path, true));
    }
    for (const Part& gap : gaps)
      if (!is_tiny(path, gap) && !is_between_vertices(path, gap) && !check_gap(path, gap)) break;
    if (curve_.claim.role == FactorRole::reaction || curve_.claim.role == FactorRole::margin)
      for (const Part& part : parts) check_cuts(path, part);
  }

  /// The part stays in one place, to rounding; or it is a path that leaves open cells and comes back at once.
  bool is_tiny(const Path& path, const Part& part) const {
    const double n = length_of(path), reach = 10 * same_place * curve_.size;
    Rectangle near = {part.a[0] - reach, part.a[0] + reach, part.a[1] - reach, part.a[1] + reach};
    if (path.closed && part.to - part.from > 0.999 * n) return false;
    if (!path.closed && part.to - part.from == n && is_open(path.first) && is_open(path.last) &&
        curve_.same_region(path.first, path.last)) {
      near = curve_.region_at(path.first);
      const double margin = near.size();
      near = {near.x0 - margin, near.x1 + margin, near.y0 - margin, near.y1 + margin};
    }
    const auto is_near = [&](const Point2& p) {
      return near.x0 <= p[0] && p[0] <= near.x1 && near.y0 <= p[1] && p[1] <= near.y1;
    };
    bool all = is_near(part.b);
    for (int s = static_cast<int>(std::ceil(part.from)); s < part.to && all; ++s) {
      const Step& step = path.steps[static_cast<std::size_t>(s) % path.steps.size()];
      const End& begin = curve_.piece(step).ends[step.forward ? 0 : 1];
      all = is_near(curve_.junction(begin.junction).place.at());
    }
    return all;
  }

  /// A path from open cells to open cells that an arc passes without a vertex.
  bool is_between_vertices(const Path& path, const Part& part) const {
    if (path.closed || !is_open(path.first) || !is_open(path.last) || part.to - part.from < length_of(path))
      return false;
    return std::all_of(path.steps.begin(), path.steps.end(), [&](const Step& step) {
      return std::all_of(std::begin(curve_.piece(step).ends), std::end(curve_.piece(step).ends), [&](const End& end) {
        const Point2 at = curve_.junction(end.junction).place.at();
        return std::any_of(arcs_.begin(), arcs_.end(), [&](const KnownArc& arc) {
          return arc.sheet == part_.number && passes_near(arc.arc->points, at, 1.5 * c_.tolerance);
        });
      });
    });
  }

  struct Left {
    const Piece* piece;
    Rectangle box;
    double low, high;  ///< of the part: the piece's variable
  };

  /// Boxes that cover a part of a path, cut until `settle` is content or they are tiny: those are left. `sheet`: the
  /// curve's function first. False: too many boxes.
  template <class Settle>
  bool explore(const Path& path, const Part& part, Sheet& sheet, const Settle& settle) {
    std::size_t count = 0;
    for (int s = static_cast<int>(std::floor(part.from)); s < part.to; ++s) {
      const Step& step = path.steps[static_cast<std::size_t>(s) % path.steps.size()];
      const Piece& piece = curve_.piece(step);
      const Leaf& leaf = curve_.leaf(piece);
      double a = std::max(part.from - s, 0.0), b = std::min(part.to - s, 1.0);
      if (!step.forward) std::tie(a, b) = std::pair{1 - b, 1 - a};
      const double k0 = a == 0 ? piece.ends[0].key.lower() : 0, k1 = b == 1 ? piece.ends[1].key.upper() : 0;
      const double from = piece.ends[0].key.middle(), way = piece.ends[1].key.middle() - from;
      const double low = a == 0 ? k0 : from + a * way, high = b == 1 ? k1 : from + b * way;
      const int variable = leaf.claim.axis;
      Rectangle cell = leaf.cell;
      if (variable == 0) cell.x0 = std::max(cell.x0, low), cell.x1 = std::min(cell.x1, high);
      if (variable == 1) cell.y0 = std::max(cell.y0, low), cell.y1 = std::min(cell.y1, high);
      std::vector<Rectangle> open = {cell};
      while (!open.empty()) {
        const Rectangle box = open.back();
        open.pop_back();
        if (++count > most_boxes + 20 * path.steps.size()) return false;
        const bool entered = sheet.enter({box.x0, box.x1, cell_bits}, {box.y0, box.y1, cell_bits});
        if (entered && sheet.is_free(0)) continue;
        if (entered && variable >= 2 &&
            (sheet.root(variable - 2).upper() < low || high < sheet.root(variable - 2).lower()))
          continue;
        if (settle(Left{&piece, box, low, high}, entered)) continue;
        for (const Rectangle& half : halves(box)) open.push_back(half);
      }
    }
    return true;
  }

  bool is_in(const Left& left, const Place& place) const {
    const Interval at = curve_.key(left.piece->leaf, place);
    return at.upper() >= left.low && at.lower() <= left.high;
  }

  /// A part that no arc covers is outside of the box or the workspace, or makes nothing wanted vanish; false: nothing
  /// along the whole path.
  bool check_gap(const Path& path, const Part& gap) {
    std::vector<const core::StraightLine*> functions = {&curve_.program};
    for (const core::StraightLine& root : roots_) functions.push_back(&root);
    Sheet all(parts_of(c_, curve_.claim.mode, curve_.claim.at_zero), functions);
    bool nothing = false, decided = true;
    const double tiny = smallest_box * curve_.size;
    const bool done = explore(path, gap, all, [&](const Left& left, bool entered) {
      const Rectangle& box = left.box;
      if (!entered || nothing || box.x1 < box_[0] || box_[1] < box.x0 || box.y1 < box_[2] || box_[3] < box.y0)
        return true;
      if (box.size() > tiny) return false;
      const Point2 middle = {0.5 * (box.x0 + box.x1), 0.5 * (box.y0 + box.y1)};
      if (std::min(distance(middle, gap.a), distance(middle, gap.b)) < 20 * tiny) return true;
      const std::optional<Place> place = curve_.place_on(*left.piece, box);
      // Next to the boundary a root varies much in a small box: the place may be one before or after the part.
      if (place && !is_in(left, *place)) return true;
      const bool inside = place && box_[0] < place->x.lower() && place->x.upper() < box_[1] &&
                          box_[2] < place->y.lower() && place->y.upper() < box_[3] && all.enter(place->x, place->y) &&
                          all.is_inner();
      if (inside)
        nothing = is_missing(place->at());
      else
        decided = decided && place && !all.enter(place->x, place->y);
      return true;
    });
    if (!done || !decided)
      note(fmt::format("whether its piece from ({}, {}) to ({}, {}) lies in the workspace", gap.a[0], gap.a[1],
                       gap.b[0], gap.b[1]));
    return !nothing;
  }

  /// A place on the curve, inside, that no arc covers. True: nothing wanted vanishes along it.
  bool is_missing(const Point2& at) {
    const std::string place = fmt::format("near ({}, {})", at[0], at[1]);
    if (uncertain_ || curve_.claim.role == FactorRole::margin) {
      note("its piece " + place);
      return true;
    }
    if (curve_.claim.role != FactorRole::reaction) curve_.fail("there is no arc for a piece of it " + place);
    const auto label = label_at(m_, c_, curve_.claim, at);
    if (!label) note("what vanishes " + place);
    if (label && !label->empty()) curve_.fail(names(*label) + " vanish " + place + ", but no arc says so");
    return true;
  }

  /// Another root is 0 near a vertex: there |A| may vanish in that place alone.
  bool is_corner(Sheet& sheet, const std::vector<Point2>& points, std::size_t i) const {
    const Point2 &a = points[i == 0 ? 0 : i - 1], &b = points[i];
    const auto hull = [&](std::size_t axis) {
      return Interval(std::min(a[axis], b[axis]) - 2 * c_.tolerance, std::max(a[axis], b[axis]) + 2 * c_.tolerance,
                      cell_bits);
    };
    return !sheet.enter(hull(0), hull(1)) || !sheet.is_inner();
  }

  /// |A| keeps its sign along an arc: at its vertices, and between them it has no zero.
  void check_cuts(const Path& path, const Part& part) {
    const Point2& middle = part.points[part.points.size() / 2];
    const auto inner = place_near(
        c_, curve_.claim,
        part.points.size() > 2 ? middle : Point2{0.5 * (part.a[0] + part.b[0]), 0.5 * (part.a[1] + part.b[1])});
    std::vector<const core::StraightLine*> functions = {&curve_.program};
    for (const core::StraightLine* program : singular_)
      if (!inner || !vanishes_at(c_, curve_.claim, *program, *inner)) functions.push_back(program);
    if (functions.size() == 1) return;
    const int n = static_cast<int>(functions.size());
    Sheet sheet(parts_of(c_, curve_.claim.mode, curve_.claim.at_zero), functions);
    std::vector<int> signs(functions.size(), 0);
    bool touched = false;
    for (std::size_t i = 0; i < part.points.size(); ++i) {
      const Point2& at = part.points[i];
      const double reach = vertex_reach(at);
      if (!sheet.enter(around(at[0], reach), around(at[1], reach))) continue;
      for (int f = 1; f < n; ++f) {
        const int sign = sheet.value(f).sign();
        int& claimed_sign = signs[static_cast<std::size_t>(f)];
        if (sign * claimed_sign < 0 && !is_corner(sheet, part.points, i))
          curve_.fail(fmt::format("|A| changes its sign along an arc from ({}, {}) to ({}, {}), which is not cut there",
                                  part.a[0], part.a[1], part.b[0], part.b[1]));
        touched = touched || sign * claimed_sign < 0;
        if (sign != 0) claimed_sign = sign;
        if (!sheet.enter(around(at[0], reach), around(at[1], reach))) break;
      }
    }
    const double tiny = smallest_box * curve_.size;
    const bool done = explore(path, part, sheet, [&](const Left& left, bool entered) {
      bool apart = true;
      for (int f = 1; f < n && entered; ++f) apart = apart && sheet.is_free(f);
      if (apart || left.box.size() > tiny) return apart;
      const Point2 at = {0.5 * (left.box.x0 + left.box.x1), 0.5 * (left.box.y0 + left.box.y1)};
      touched = touched || std::min(distance(at, part.a), distance(at, part.b)) > 1e3 * tiny;
      return true;
    });
    if (!done || touched) note(fmt::format("whether |A| vanishes within an arc from ({}, {})", part.a[0], part.a[1]));
  }

  void note(const std::string& what) {
    unchecked_.push_back(fmt::format("{} in mode {}: {}",
                                     c_.functions[static_cast<std::size_t>(curve_.claim.function)].name,
                                     curve_.claim.mode + 1, what));
  }

  const mechanism::Mechanism& m_;
  Curve& curve_;
  const CertificateFile& c_;
  const CurvePart& part_;
  std::vector<KnownArc>& arcs_;
  std::vector<std::string>& unchecked_;
  std::vector<std::vector<Part>> covered_;  // by path
  std::array<double, 4> box_{};
  std::vector<core::StraightLine> roots_;  // programs that are one root each
  std::vector<const core::StraightLine*> singular_;
  std::vector<Sheet> zero_squares_;  // of the roots that are zero along the curve, a function each
  bool uncertain_ = false;           // some arc of it is not claimed to be certain
};

}  // namespace

void check_arcs(const mechanism::Mechanism& m, Curve& curve, const CurvePart& part, std::vector<KnownArc>& arcs,
                std::vector<std::string>& unchecked) {
  ArcCheck(m, curve, part, arcs, unchecked).run();
}

}  // namespace clearloci::check
