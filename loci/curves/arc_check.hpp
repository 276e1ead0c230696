// The last look at an arc before it is handed out, by none of the reasoning that made it: enclosures around each of its
// vertices refute what is not in the box, not on the curve or not in the mode. Always armed.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci {

struct ArcFault {
  std::string what;  ///< "a vertex outside the box"
  core::Point2 at{};
  bool in_vertices = false;  ///< some of them are wrong, which says nothing against the others
};

/// Holds arcs against one factor in one mode.
class ArcCheck {
 public:
  ArcCheck(const core::LocusProblem& problem, const core::LocusFactor& factor, const core::WorkingMode& mode);
  ArcCheck(const ArcCheck&) = delete;
  ArcCheck& operator=(const ArcCheck&) = delete;

  /// What is proven to be wrong with the arc; none: nothing. Vertices may be off by 1e-12 of the box or four spacings
  /// of doubles, whichever is larger.
  std::optional<ArcFault> operator()(const core::Arc& arc);
  /// Whether one vertex, or an end of this kind, passes.
  bool holds(const core::Point2& vertex, core::ArcEnd end);
  /// The same of a vertex that may be off by `reach` in either coordinate.
  bool holds(const core::Point2& vertex, core::ArcEnd end, const core::Point2& reach);

 private:
  std::optional<std::string> fault_at(const core::Point2& at, core::ArcEnd end, const core::Point2& reach);

  /// Any |A|, or any denominator, in a place whose roots registers_ hold.
  bool one_vanishes(const std::array<core::Interval, 2>& place, bool of_denominators);

  const core::LocusProblem& problem_;
  core::WorkingMode mode_;
  sheet::SheetProgram program_;
  sheet::SheetProgram::Registers<core::Interval> registers_;
  std::array<double, 2> lower_{}, upper_{};
  double reach_ = 0;
  std::optional<sheet::SheetProgram> at_ends_;  ///< of every |A|, then every denominator; once one is asked for
  std::optional<sheet::SheetProgram::Registers<core::Interval>> registers_at_ends_;
};

/// By how much a vertex of a map over this box may be off, in the larger of its sides and of its numbers.
double vertex_reach(const std::vector<double>& lower, const std::vector<double>& upper);

/// The checks of the factors whose zeros a curve may be: a vertex is to pass one of them. None: nothing is known of it.
std::deque<ArcCheck> checks_of(const core::LocusProblem& problem, const core::LocusCurve& curve);

/// An arc of a map that is proven to be wrong.
struct WrongArc {
  std::size_t curve = 0, arc = 0;
  ArcFault fault;
};

/// All of them, in order.
std::vector<WrongArc> wrong_arcs(const core::LocusProblem& problem, const core::LocusMap& map);

/// Whether a curve's arcs are zeros of the factor: it plays the curve's part and owns its polynomial.
bool owns(const core::LocusFactor& factor, const core::LocusCurve& curve);

/// Withholds arcs of the map that are proven to be wrong, but for pieces without a wrong vertex: their curves are not
/// certified then, and a note says so. True: there were some.
bool withhold_wrong_arcs(const core::LocusProblem& problem, core::LocusMap& map);

}  // namespace clearloci::loci
