#include "loci/sheet_loci.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "loci/edge_labels.hpp"
#include "loci/plane_curve.hpp"
#include "loci/sheet/trace_sheet.hpp"

namespace clearloci::loci {
namespace {

using core::FactorRole;
using core::LocusCurve;
using core::LocusFactor;
using core::LocusKind;
using core::LocusMap;
using core::LocusProblem;

/// A factor may have several implicit polynomials: the one that an arc lies on.
std::size_t implicit_of(const core::Arc& arc, const std::vector<PlaneCurve>& curves) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < curves.size(); ++i) {
    double off = 0;
    for (std::size_t k = 1; k + 1 < arc.points.size() || k == 1; k += 1 + arc.points.size() / 8) {
      const PlaneCurve::Jet jet = curves[i].jet(arc.points[std::min(k, arc.points.size() - 1)]);
      off = std::max(off, jet.slope() > 0 ? std::abs(jet.f) / jet.slope() : std::abs(jet.f));
    }
    if (off < least) {
      least = off;
      best = i;
    }
  }
  return best;
}

struct Meaning {
  LocusKind kind;
  std::vector<core::Vanishing> vanishing;
};

Meaning meaning_of(const LocusProblem& problem, const LocusFactor& factor) {
  if (factor.role == FactorRole::margin) return {LocusKind::margin, factor.vanishing};
  if (factor.role == FactorRole::direct_singularity) return {LocusKind::direct_singularity, {}};
  const std::vector<core::Vanishing> vanishing = wanted_vanishing(problem, factor.vanishing);
  return {gravest_kind(vanishing), vanishing};
}

}  // namespace

void add_sheet_loci(const LocusProblem& problem, const std::vector<LocusFactor>& factors, const TraceOptions& options,
                    LocusMap& map) {
  std::vector<sheet::Cutter> cutters;
  for (const LocusFactor& factor : problem.factors) {
    if (factor.role == FactorRole::direct_singularity) {
      cutters.push_back({factor.sheet, core::ArcEnd::direct_singularity});
    }
  }
  sheet::SheetTraceOptions sheet_options;
  sheet_options.tolerance = problem.tolerance;
  if (options.deadline) {
    sheet_options.stop = [deadline = *options.deadline] { return std::chrono::steady_clock::now() > deadline; };
  }
  double done = 0;
  const double all = static_cast<double>(factors.size() * problem.modes.size());
  for (const LocusFactor& factor : factors) {
    const Meaning meaning = meaning_of(problem, factor);
    std::vector<PlaneCurve> curves;
    for (const core::Polynomial& p : factor.implicit) curves.emplace_back(p);
    for (const core::WorkingMode& mode : problem.modes) {
      if (options.progress) options.progress(0.5 + 0.5 * done++ / all, "arcs of high degree");
      if (factor.role == FactorRole::reaction && meaning.vanishing.empty()) continue;
      const bool cut = factor.role != FactorRole::direct_singularity;
      sheet::SheetTrace traced = sheet::trace_sheet(problem.tower, mode, problem.lower, problem.upper, factor.sheet,
                                                    cut ? cutters : std::vector<sheet::Cutter>{}, sheet_options);
      // A budget of cells that runs out leaves undecided cells; only time leaves the work incomplete.
      const bool out_of_time = traced.stopped && sheet_options.stop && sheet_options.stop();
      if (out_of_time) map.complete = false;
      if (!traced.certified && !out_of_time) {
        map.notes.push_back(std::to_string(traced.undecided.size()) + " undecided cells on " +
                            (factor.cause.empty() ? factor.expression.substr(0, 60) : factor.cause));
      }
      std::vector<LocusCurve> own(curves.size());
      for (std::size_t i = 0; i < own.size(); ++i) {
        own[i].kind = meaning.kind;
        own[i].vanishing = meaning.vanishing;
        own[i].factor = factor.expression;
        own[i].cause = factor.cause;
        own[i].implicit = factor.implicit[i];
        own[i].closed_form = core::recognise_closed_form(factor.implicit[i]);
        own[i].mode = mode;
        own[i].certified = traced.certified;
      }
      for (core::Arc& arc : traced.arcs) own[implicit_of(arc, curves)].arcs.push_back(std::move(arc));
      for (LocusCurve& curve : own) {
        if (!curve.arcs.empty()) map.curves.push_back(std::move(curve));
      }
      for (const core::Point2& at : traced.isolated_points) {
        map.isolated_points.push_back({meaning.kind, meaning.vanishing, {at[0], at[1]}, mode, false});
      }
    }
  }
}

}  // namespace clearloci::loci
