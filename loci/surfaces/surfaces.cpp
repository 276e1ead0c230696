#include "loci/surfaces/surfaces.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <sstream>
#include <tuple>
#include <utility>

#include "core/errors.hpp"
#include "loci/curves/curves.hpp"
#include "loci/search/search.hpp"
#include "loci/surfaces/measure.hpp"
#include "loci/surfaces/meshed.hpp"
#include "loci/surfaces/space_curves.hpp"

namespace clearloci::loci {
namespace {

using core::FactorRole;
using core::LocusFactor;
using core::LocusKind;
using core::LocusMap;
using core::LocusProblem;
using core::LocusSurface;
using surface::Field;
using surface::Mesh;
using surface::Meshed;
using surface::OpenCells;
using surface::Point;

/// A factor vanishes at a point where its zero is this near, in unit coordinates, to first order.
constexpr double vanishes_within = 1e-8;
/// Points of a component at which other factors are looked at.
constexpr std::size_t samples = 24;

/// A factor of the first chart that has it, with what continues it in the other charts.
struct Whole {
  std::vector<Field::ChartPart> parts;
  const LocusFactor* factor = nullptr;  ///< of the first part
  std::optional<int> root;              ///< the factor is s_j itself: it vanishes on the boundary Q_j = 0
};

std::optional<int> root_dividing(const core::Polynomial& p, std::size_t roots) {
  for (std::size_t j = 0; j < roots; ++j)
    if (!p.terms.empty() &&
        std::all_of(p.terms.begin(), p.terms.end(), [&](const core::Term& term) { return term.exponents[3 + j] > 0; }))
      return static_cast<int>(j);
  return std::nullopt;
}

/// Joins the factors of all charts across the seams.
std::vector<Whole> joined(const std::vector<const LocusProblem*>& charts, const core::WorkingMode& mode) {
  std::vector<std::vector<bool>> taken;
  for (const LocusProblem* chart : charts) taken.emplace_back(chart->factors.size(), false);
  std::vector<Whole> wholes;
  for (std::size_t first = 0; first < charts.size(); ++first)
    for (std::size_t f = 0; f < charts[first]->factors.size(); ++f) {
      if (taken[first][f]) continue;
      taken[first][f] = true;
      const LocusFactor& factor = charts[first]->factors[f];
      if (factor.role == FactorRole::construction) continue;
      Whole whole{{{charts[first], {factor.sheet, factor.line}, 1}},
                  &factor,
                  root_dividing(factor.sheet, charts[first]->tower.roots.size())};
      for (std::size_t part = 0; part < whole.parts.size(); ++part)
        for (std::size_t next = 0; next < charts.size(); ++next) {
          const Field::ChartPart chart_part = whole.parts[part];
          const bool has = std::any_of(whole.parts.begin(), whole.parts.end(),
                                       [&](const Field::ChartPart& other) { return other.problem == charts[next]; });
          if (has || !surface::are_neighbours(*chart_part.problem, *charts[next])) continue;
          for (std::size_t g = 0; g < charts[next]->factors.size(); ++g) {
            const LocusFactor& other = charts[next]->factors[g];
            if (taken[next][g] || other.role != factor.role || other.vanishing != factor.vanishing) continue;
            const sheet::SheetFunction function{other.sheet, other.line};
            const auto sign =
                surface::sign_across_seam(*chart_part.problem, chart_part.function, *charts[next], function, mode);
            if (!sign) continue;
            taken[next][g] = true;
            whole.parts.push_back({charts[next], function, chart_part.sign * *sign});
            break;
          }
        }
      wholes.push_back(std::move(whole));
    }
  return wholes;
}

bool shares_surface(const LocusFactor& a, const LocusFactor& b) {
  if (a.implicit_too_heavy || b.implicit_too_heavy) return true;
  return std::any_of(a.implicit.begin(), a.implicit.end(), [&](const core::Polynomial& p) {
    return std::find(b.implicit.begin(), b.implicit.end(), p) != b.implicit.end();
  });
}

/// Surfaces of the factor are asked for: alone, or where others vanish too.
bool is_wanted(const LocusProblem& problem, const std::vector<Whole>& wholes, const Whole& whole) {
  const LocusFactor& factor = *whole.factor;
  if (factor.implicit.empty() && !factor.implicit_too_heavy) return false;
  if (factor.role != FactorRole::reaction) return true;
  if (!reaction_label(problem, std::vector{&factor}).vanishing.empty()) return true;
  std::vector<const LocusFactor*> together = {&factor};
  for (const Whole& other : wholes)
    if (&other != &whole && other.factor->role == FactorRole::reaction && shares_surface(factor, *other.factor))
      together.push_back(other.factor);
  return !reaction_label(problem, together).vanishing.empty();
}

class ModeSurfaces {
 public:
  ModeSurfaces(const std::vector<const LocusProblem*>& charts, const core::WorkingMode& mode, int level,
               std::function<bool()> stop)
      : problem_(*charts.front()), mode_(mode), level_(level), stop_(std::move(stop)), wholes_(joined(charts, mode)) {
    for (const Whole& whole : wholes_) fields_.push_back(std::make_unique<Field>(whole.parts, mode));
    meshed_.resize(wholes_.size());
  }

  std::size_t size() const { return wholes_.size(); }
  /// A surface may be missing altogether.
  bool is_within_resolution() const {
    return std::all_of(meshed_.begin(), meshed_.end(),
                       [](const auto& meshed) { return !meshed || meshed->unexplained == 0; });
  }

  /// Grows with the time that a factor takes.
  std::size_t cost(std::size_t f) const {
    const sheet::SheetFunction& function = wholes_[f].parts.front().function;
    return function.line.empty() ? function.polynomial.terms.size() : function.line.steps.size();
  }

  /// Meshes one factor; others may be meshed at the same time.
  void mesh(std::size_t f) {
    if (!wholes_[f].root && is_wanted(problem_, wholes_, wholes_[f]))
      meshed_[f] = surface::mesh_of(*fields_[f], level_, stop_);
  }

  /// The surfaces of one factor, once all are meshed.
  void add(std::size_t f, LocusMap& map) {
    if (!meshed_[f]) return;
    const Meshed& meshed = *meshed_[f];
    const std::vector<int> component = surface::components_of(meshed.mesh);
    const int count = component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
    std::vector<EdgeLabel> labels;
    std::vector<std::vector<int>> components;  // of each label
    for (int c = 0; c < count; ++c) {
      std::vector<bool> kept;
      for (const int one : component) kept.push_back(one == c);
      for (EdgeLabel& label : labels_of(f, surface::part_of(meshed.mesh, kept), meshed.boundary)) {
        const auto found = std::find(labels.begin(), labels.end(), label);
        const auto place = static_cast<std::size_t>(found - labels.begin());
        if (found == labels.end()) {
          labels.push_back(std::move(label));
          components.emplace_back();
        }
        components[place].push_back(c);
      }
    }
    for (std::size_t i = 0; i < labels.size(); ++i) {
      std::vector<bool> kept;
      for (const int one : component)
        kept.push_back(std::find(components[i].begin(), components[i].end(), one) != components[i].end());
      map.surfaces.push_back(finished(f, labels[i], kept, meshed));
      map.surfaces.back().components = static_cast<int>(components[i].size());
    }
    if (meshed.unexplained > 0) note(f, meshed, map);
  }

 private:
  /// Whether a factor vanishes all over a mesh.
  bool vanishes_on(std::size_t g, const Mesh& mesh, std::optional<int> boundary) {
    if (wholes_[g].root) return wholes_[g].root == boundary;
    Field& field = *fields_[g];
    const std::size_t step = std::max<std::size_t>(1, mesh.triangles.size() / samples);
    int seen = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += step) {
      Point slopes{};
      const Point& at = mesh.points[static_cast<std::size_t>(mesh.triangles[t][0])];
      if (!boundary && !field.inside(at)) continue;
      const double value = boundary ? field.gradient_on_rim(at, *boundary, slopes) : field.gradient(at, slopes);
      const double slope = std::sqrt(surface::dot(slopes, slopes));
      if (!(std::abs(value) <= vanishes_within * slope) && value != 0) return false;
      ++seen;
    }
    return seen > 0;
  }

  /// What vanishes on a component of the mesh of factor `f`; empty where another factor's mesh has it.
  std::vector<EdgeLabel> labels_of(std::size_t f, const Mesh& part, std::optional<int> boundary) {
    const LocusFactor& factor = *wholes_[f].factor;
    std::vector<const LocusFactor*> reactions;
    std::vector<EdgeLabel> labels;
    for (std::size_t g = 0; g < wholes_.size(); ++g) {
      const LocusFactor& other = *wholes_[g].factor;
      const bool same = g == f;
      if (!same && !wholes_[g].root && other.role != factor.role) continue;
      if (!same && (!shares_surface(factor, other) || !vanishes_on(g, part, boundary))) continue;
      if (!same && !wholes_[g].root && g < f) return {};
      switch (other.role) {
        case FactorRole::reaction:
          reactions.push_back(&other);
          break;
        case FactorRole::margin:
          labels.push_back({LocusKind::margin, other.vanishing, other.expression, other.cause});
          break;
        case FactorRole::preload:
          labels.push_back({LocusKind::preload, other.vanishing, other.expression, other.cause});
          break;
        case FactorRole::direct_singularity:
          labels.push_back({LocusKind::direct_singularity, {}, other.expression, other.cause});
          break;
        case FactorRole::workspace_boundary:
          labels.push_back({LocusKind::workspace_boundary, {}, other.expression, other.cause});
          break;
        case FactorRole::construction:
          break;
      }
    }
    EdgeLabel label = reaction_label(problem_, reactions);
    if (!label.vanishing.empty()) labels.insert(labels.begin(), std::move(label));
    return labels;
  }

  /// `own`: the triangles of the mesh that are the surface's.
  LocusSurface finished(std::size_t f, const EdgeLabel& label, const std::vector<bool>& kept, const Meshed& meshed) {
    const Mesh part = surface::part_of(meshed.mesh, kept);
    const Whole& whole = wholes_[f];
    Field& field = *fields_[f];
    LocusSurface result;
    result.kind = label.kind;
    result.vanishing = label.vanishing;
    result.factor = label.factor;
    result.cause = label.cause;
    if (whole.parts.size() == 1 && whole.factor->implicit.size() == 1) {
      result.implicit = whole.factor->implicit.front();
      result.variables = problem_.tower.coordinates;
    }
    result.mode = mode_;
    for (const Point& point : part.points) result.vertices.push_back(field.frame().place(point));
    result.triangles = part.triangles;
    loci::measure(result);
    result.deviation = surface::deviation(field, part);
    result.within_resolution = meshed.unexplained == 0;
    for (const OpenCells& open : meshed.open) {
      // What no triangle is near may be a part that is missing: of any surface of the factor.
      const bool concerns =
          open.triangles.empty() || std::any_of(open.triangles.begin(), open.triangles.end(),
                                                [&](int t) { return kept[static_cast<std::size_t>(t)]; });
      if (concerns)
        result.open.push_back({field.frame().place(open.lower), field.frame().place(open.upper), open.count});
    }
    result.certified = result.within_resolution && result.open.empty();
    for (std::size_t i = 0; i < 3; ++i) result.resolution[i] = surface::resolution(level_) * field.frame().width(i);
    return result;
  }

  void note(std::size_t f, const Meshed& meshed, LocusMap& map) {
    const LocusFactor& factor = *wholes_[f].factor;
    std::string what = core::to_string(factor.role == FactorRole::workspace_boundary ? LocusKind::workspace_boundary
                                                                                     : LocusKind::direct_singularity);
    if (factor.role == FactorRole::reaction || factor.role == FactorRole::margin ||
        factor.role == FactorRole::preload) {
      what.clear();
      for (const core::Vanishing& v : reaction_label(problem_, std::vector{&factor}).vanishing)
        what += (what.empty() ? "" : ", ") + core::to_string(v.quantity) + "_" + v.joint;
      if (what.empty()) what = factor.cause;
    }
    for (const auto& [point, side] : core::describe_mode(names_of(problem_.tower), mode_))
      what += ", " + point + " " + side;
    const Point at = fields_[f]->frame().place(meshed.at);
    std::ostringstream text;
    text.precision(3);
    text << what << ": further parts of the surface could not be excluded in " << meshed.unexplained
         << (meshed.unexplained == 1 ? " cell" : " cells") << " away from it, "
         << (meshed.unexplained == 1 ? "at (" : "one of them at (") << at[0] << ", " << at[1] << ", " << at[2]
         << "); a smaller --mesh-size may exclude them.";
    map.notes.push_back(text.str());
  }

  const LocusProblem& problem_;
  core::WorkingMode mode_;
  int level_;
  std::function<bool()> stop_;
  std::vector<Whole> wholes_;
  std::vector<std::unique_ptr<Field>> fields_;
  std::vector<std::optional<Meshed>> meshed_;  ///< nothing: not wanted, or not done in time
};

void sort_and_name_surfaces(LocusMap& map, const std::vector<core::WorkingMode>& modes) {
  const auto key = [&](const LocusSurface& one) {
    return std::tuple(std::find(modes.begin(), modes.end(), one.mode) - modes.begin(), one.kind);
  };
  std::stable_sort(map.surfaces.begin(), map.surfaces.end(),
                   [&](const LocusSurface& a, const LocusSurface& b) { return key(a) < key(b); });
  int number = 0;
  for (LocusSurface& one : map.surfaces) one.id = "s" + std::to_string(++number);
  number = 0;
  for (core::SpaceCurve& one : map.space_curves) one.id = "c" + std::to_string(++number);
}

/// All factors of all modes, on as many threads as the machine has. False: the time was over before.
bool mesh_all(const std::vector<std::unique_ptr<ModeSurfaces>>& modes, const TraceOptions& options,
              const std::function<bool()>& stop) {
  std::vector<std::pair<ModeSurfaces*, std::size_t>> tasks;
  for (const auto& mode : modes)
    for (std::size_t f = 0; f < mode->size(); ++f) tasks.emplace_back(mode.get(), f);
  // The dearest first, so that no thread is left with it alone at the end.
  std::stable_sort(tasks.begin(), tasks.end(), [](const auto& one, const auto& other) {
    return one.first->cost(one.second) > other.first->cost(other.second);
  });
  std::size_t done = 0;
  std::atomic<bool> late = false;
  std::mutex guard;
  run_in_order(tasks.size(), [&](std::size_t t) {
    if (late) return;
    try {
      if (stop()) throw core::LimitReached("the time limit was reached");
      tasks[t].first->mesh(tasks[t].second);
    } catch (const core::LimitReached&) {
      late = true;
      return;
    }
    const std::scoped_lock lock(guard);
    if (options.progress) options.progress(static_cast<double>(++done) / static_cast<double>(tasks.size()), "surfaces");
  });
  return !late;
}

}  // namespace

LocusMap trace_surfaces(const std::vector<const LocusProblem*>& charts, const SurfaceOptions& options) {
  core::ensure(!charts.empty() && charts.front()->tower.coordinates.size() == 3, "three free coordinates");
  constexpr double finest_mesh = 1.0 / 256, coarsest_mesh = 1.0 / 4;
  if (!(options.mesh_size >= finest_mesh && options.mesh_size <= coarsest_mesh))
    throw core::InputError({.file = "--mesh-size"}, "no size for a mesh", "give a part of the box, from 1/256 to 1/4");
  // The triangles of a cell are about half as large as the cell.
  const int level = static_cast<int>(std::ceil(std::log2(0.5 / options.mesh_size) - 1e-9));
  const LocusProblem& problem = *charts.front();
  LocusMap map;
  const std::function<bool()> stop = [&] {
    return options.trace.deadline && std::chrono::steady_clock::now() > *options.trace.deadline;
  };
  std::vector<std::unique_ptr<ModeSurfaces>> modes;
  for (const core::WorkingMode& mode : problem.modes)
    modes.push_back(std::make_unique<ModeSurfaces>(charts, mode, level, stop));
  map.out_of_time = !mesh_all(modes, options.trace, stop);
  for (const auto& mode : modes)
    for (std::size_t f = 0; f < mode->size(); ++f) mode->add(f, map);
  try {
    for (const core::WorkingMode& mode : problem.modes)
      if (!map.out_of_time) add_space_curves(charts, mode, stop, map);
  } catch (const core::LimitReached&) {
    map.out_of_time = true;
  }
  map.complete = !map.out_of_time &&
                 std::all_of(modes.begin(), modes.end(), [](const auto& mode) { return mode->is_within_resolution(); });
  map.tower = names_of(problem.tower);
  map.lower = problem.lower;
  map.upper = problem.upper;
  map.tolerance = problem.tolerance;
  const surface::Frame frame = surface::frame_of(charts);
  map.angles = {frame.angle[0], frame.angle[1], frame.angle[2]};
  sort_and_name_surfaces(map, problem.modes);
  return map;
}

void measure(LocusSurface& locus_surface) {
  const Mesh mesh{locus_surface.vertices, locus_surface.triangles};
  const std::vector<int> component = surface::components_of(mesh);
  locus_surface.components = component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
  locus_surface.euler_characteristic = static_cast<int>(mesh.points.size()) -
                                       static_cast<int>(surface::edges_of(mesh).size()) +
                                       static_cast<int>(mesh.triangles.size());
  locus_surface.area = surface::area(mesh);
}

}  // namespace clearloci::loci
