#include "symbolic/locus_problem.hpp"

#include <algorithm>
#include <chrono>

#include "core/errors.hpp"
#include "mechanism/actions.hpp"
#include "symbolic/algebra_turn.hpp"
#include "symbolic/collect_factors.hpp"
#include "symbolic/factor_emission.hpp"
#include "symbolic/factor_selection.hpp"
#include "symbolic/singular_modes.hpp"

namespace clearloci::symbolic {
namespace {

using mechanism::Mechanism;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// `pieces`: one an angle, in the order of the coordinates.
Charts charts_of(const Mechanism& m, const std::vector<ChartRange>& pieces) {
  Charts charts(m.coordinates.size());
  auto piece = pieces.begin();
  for (std::size_t i = 0; i < charts.size(); ++i)
    if (m.coordinates[i].angle) charts[i] = (piece++)->chart;
  return charts;
}

/// Every choice of one piece an angle, the last angle's fastest.
std::vector<std::vector<ChartRange>> all_pieces(const Mechanism& m) {
  std::vector<std::vector<ChartRange>> all(1);
  for (const auto& coordinate : m.coordinates) {
    if (!coordinate.angle) continue;
    std::vector<std::vector<ChartRange>> longer;
    for (const auto& chosen : all) {
      for (const ChartRange& range : chart_ranges(m, coordinate)) {
        longer.push_back(chosen);
        longer.back().push_back(range);
      }
    }
    all = std::move(longer);
  }
  return all;
}

/// Of every sheet's modes that |A| = 0 in all their poses: "the working mode B1 right, B2 right where x > 0 is ...".
std::vector<std::string> words_of_singular(const Mechanism& mechanism, const Geometry& geometry,
                                           const std::vector<Sides>& modes, const std::string& why) {
  std::string where;
  FactorText words(mechanism, geometry);
  for (const Fold& fold : geometry.folds())
    where += (where.empty() ? " where " : " and ") + words.of(fold.where) + " > 0";
  std::vector<std::string> list;
  for (const Sides& sides : modes)
    list.push_back("the working mode " + mode_words(mechanism, sides) + where +
                   " is singular in every pose: |A| = 0, for " + why);
  return list;
}

std::optional<FactoredDeterminants> determinants_of(const Geometry& geometry, const Family* family) {
  if (family != nullptr)
    if (std::optional<FactoredDeterminants> from_family = family->at(geometry)) return from_family;
  return regular_determinants(geometry);
}

void emit_factors(Derivation& d) {
  FactorEmission emission(d);
  const bool efforts_free = !d.preload.joints.empty();
  emission.reactions();
  emission.moving_guides();
  if (!efforts_free && (d.selection.min_force || d.selection.min_couple)) emission.margins();
  if (efforts_free || mechanism::has_effort_bounds(d.mechanism)) emission.preload();
  emission.direct_singularities();
  emission.along_divided_roots();
  emission.boundaries();
  emission.undirected();
  emission.force_planes();
  emission.force_probes();
  emission.force_pairs();
  emission.append_roots();
}

DerivedProblem derived(Derivation& d) {
  const auto start = Clock::now();
  FactorSelection selection(d);
  collect_factors(d);
  selection.by_demand();
  d.result.symbolic_seconds = seconds_since(start);
  const auto elimination_start = Clock::now();
  take_determinant_apart(d);
  selection.by_order();
  emit_factors(d);
  d.result.elimination_seconds = seconds_since(elimination_start);
  d.result.in_file = d.words.take();
  return std::move(d.result);
}

/// The problems of one choice of charts.
struct Piece {
  std::vector<DerivedProblem> problems;
  DerivedProblem without_modes;      ///< in their place where none is left
  std::vector<std::string> refused;  ///< sheets on which |A| vanishes everywhere, and why
  std::vector<BentMode> bent;        ///< modes none of whose sheets is left
};

Piece problems_of(const Mechanism& mechanism, const Selection& selection, const std::vector<ChartRange>& charts,
                  const Family* family, const std::vector<Sides>& modes) {
  auto start = Clock::now();
  Piece piece;
  const Charts half_angles = charts_of(mechanism, charts);
  std::vector<SheetGeometry> sheets = sheet_geometries(mechanism, half_angles, modes, &piece.bent);
  KnownEliminations known;
  KnownEliminations* const shared = sheets.size() > 1 ? &known : nullptr;
  const auto refuse = [&](const Geometry& geometry, const std::vector<Sides>& singular, const std::string& why) {
    for (std::string& words : words_of_singular(mechanism, geometry, singular, why))
      piece.refused.push_back(std::move(words));
  };
  for (SheetGeometry& sheet : sheets) {
    std::optional<FactoredDeterminants> determinants = determinants_of(sheet.geometry, family);
    if (!determinants) {
      if (!sheet.geometry.has_dependent_roots()) throw_singular(mechanism);
      refuse(sheet.geometry, sheet.modes, "its determinant is zero as it stands");
      continue;
    }
    Derivation derivation(mechanism, selection, charts, std::move(*determinants), std::move(sheet), shared);
    if (const std::optional<std::string> why = vanishing_factor(
            derivation.determinants.determinant, derivation.geometry, derivation.elimination, derivation.causes)) {
      if (!derivation.geometry.has_dependent_roots())
        throw core::InputError({mechanism.file}, "the equations are singular in every pose: |A| = 0 on the closure",
                               "check the lengths, the joints and which of them are actuated");
      refuse(derivation.geometry, derivation.modes, *why);
      continue;
    }
    const double preparation = seconds_since(start);
    piece.problems.push_back(derived(derivation));
    piece.problems.back().symbolic_seconds += preparation;
    start = Clock::now();
  }
  if (piece.problems.empty())
    piece.without_modes.problem =
        problem_without_modes(Geometry(mechanism, false, half_angles, {modes.front()}), charts);
  return piece;
}

/// Of the modes that are bent whatever the charts.
std::vector<std::string> words_of_bent(const Mechanism& mechanism, const std::vector<Piece>& pieces) {
  std::vector<std::string> list;
  for (const BentMode& mode : pieces.front().bent) {
    const auto is_bent = [&](const Piece& piece) {
      return std::any_of(piece.bent.begin(), piece.bent.end(),
                         [&](const BentMode& other) { return other.sides == mode.sides; });
    };
    if (std::all_of(pieces.begin(), pieces.end(), is_bent))
      list.push_back("the working mode " + mode_words(mechanism, mode.sides) + " bends a link: " + mode.what);
  }
  return list;
}

std::vector<DerivedProblem> problems_of(const Mechanism& mechanism, const Selection& selection, const Family* family) {
  std::vector<Sides> modes = selection.working_modes;
  if (modes.empty()) modes.push_back(mechanism::working_mode(mechanism));
  std::vector<Piece> pieces;
  for (const std::vector<ChartRange>& charts : all_pieces(mechanism))
    pieces.push_back(problems_of(mechanism, selection, charts, family, modes));
  const std::vector<std::string> bent = words_of_bent(mechanism, pieces);
  if (std::all_of(pieces.begin(), pieces.end(), [](const Piece& piece) { return piece.problems.empty(); })) {
    const auto refused =
        std::find_if(pieces.begin(), pieces.end(), [](const Piece& piece) { return !piece.refused.empty(); });
    throw core::InputError({mechanism.file}, refused != pieces.end() ? refused->refused.front() : bent.front(),
                           "choose another working mode, or change the lengths, the joints or which are actuated");
  }
  for (const std::string& words : bent) pieces.front().refused.push_back(words);
  std::vector<DerivedProblem> problems;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    std::vector<DerivedProblem>& derived_problems = pieces[i].problems;
    if (derived_problems.empty()) derived_problems.push_back(std::move(pieces[i].without_modes));
    for (const std::string& note : pieces[i].refused) derived_problems.front().notes.push_back(note + "; left out");
    for (DerivedProblem& problem : derived_problems) {
      problem.piece = static_cast<int>(i);
      problems.push_back(std::move(problem));
    }
  }
  return problems;
}

}  // namespace

std::vector<DerivedProblem> locus_problems(const Mechanism& mechanism, const Selection& selection) {
  const auto turn = algebra_turn();
  return problems_of(mechanism, selection, nullptr);
}

LocusFamily::LocusFamily(const Mechanism& member) {
  const auto turn = algebra_turn();
  family_ = std::make_unique<const Family>(member);
}
LocusFamily::~LocusFamily() {
  const auto turn = algebra_turn();
  family_.reset();
}
LocusFamily::LocusFamily(LocusFamily&&) noexcept = default;
LocusFamily& LocusFamily::operator=(LocusFamily&& other) noexcept {
  const auto turn = algebra_turn();
  family_ = std::move(other.family_);
  return *this;
}

std::vector<DerivedProblem> LocusFamily::problems(const Mechanism& member, const Selection& selection) const {
  const auto turn = algebra_turn();
  return problems_of(member, selection, family_.get());
}

namespace {

void ensure_one_chart(const Mechanism& mechanism) {
  for (const auto& coordinate : mechanism.coordinates) {
    if (coordinate.angle && chart_ranges(mechanism, coordinate).size() > 1)
      throw core::InputError({mechanism.file},
                             "the range of the angle '" + coordinate.name + "' needs more than one chart",
                             "keep it between two odd multiples of 90 deg");
  }
}

}  // namespace

DerivedProblem locus_problem(const Mechanism& mechanism, const Selection& selection) {
  ensure_one_chart(mechanism);
  return std::move(locus_problems(mechanism, selection).front());
}

DerivedProblem locus_problem(const Mechanism& member, const Selection& selection, const LocusFamily& family) {
  ensure_one_chart(member);
  return std::move(family.problems(member, selection).front());
}

}  // namespace clearloci::symbolic
