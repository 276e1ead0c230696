// Where roots of the tower depend on one another, modes and the sides of folds have problems of their own
// (symbolic/locus_problem.hpp): their maps as one.
#pragma once

#include <string>
#include <vector>

#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"

namespace clearloci::loci {

/// The modes of a problem's map without the signs of roots that only this problem may have (of folds, margins and
/// lengths): what the maps of several problems name alike. Of a single mode with the roots that `tower` names.
void drop_own_roots(core::LocusMap& map);
void drop_own_roots(const core::TowerNames& tower, core::WorkingMode& mode);

/// Whether a fold has the polynomial of a curve: both sides may have found the curve, as they have the fold.
bool may_be_on_fold(const core::LocusCurve& curve, const core::LocusProblem& problem);

/// Whether the middle of an arc is on another one, as far as chords tell.
bool is_on(const core::Arc& arc, const core::Arc& other, double near);

/// `maps`: of `problems`, which cut one box into sheets; two lengths. Curves that run on over a fold are one with arcs
/// on both sides; the fold itself, which both sides have found, is there once. Modes and curves are in the order of
/// `modes`, which are those of the first problem.
core::LocusMap join_sheets(const std::vector<const core::LocusProblem*>& problems, std::vector<core::LocusMap> maps,
                           const std::vector<core::WorkingMode>& modes);

/// The same for points over one coordinate and surfaces over three, which need no joining.
void append_sheets(core::LocusMap& joined, core::LocusMap map);

/// What a curve of one sheet, or an isolated point, is called in the joined map: its id; its place, or -1.
std::string name_in(const core::LocusMap& joined, const core::LocusCurve& curve);
int place_in(const core::LocusMap& joined, const core::IsolatedPoint& point);

/// Whether every root of a tower is real at a place, as doubles have it.
bool is_on_sheet(const core::RootTower& tower, const core::WorkingMode& mode, const core::Point2& at);

/// Gravest kinds first, then as the polynomials order them; ids follow.
void sort_and_name(core::LocusMap& map, const std::vector<core::WorkingMode>& modes);

/// "c1", "c2", ... in their order, and "m1", ... of margins, so that the others are called the same whatever margin is
/// asked for.
void number_curves(std::vector<LocusCurve>& curves);

}  // namespace clearloci::loci
