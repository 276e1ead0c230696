// The claims of one sheet's cells, and the arcs that were handed out for it. Private to check/.
//
// In a cell in which the curve takes every value of one variable at most once, it is a row of graphs over that
// variable; their ends lie on the cell's sides and on Q_j = 0. So the ends, sorted, bound the graphs two by two, and
// graphs that meet on a common side make up the curve.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "check/certificate.hpp"
#include "check/identity.hpp"
#include "check/zeros.hpp"

namespace clearloci::check {

struct Tally {
  std::size_t cells = 0, graphs = 0, crossings = 0, arcs = 0, points = 0, zones = 0;
  double area = 0, open_area = 0;  ///< of all sheets, and of the cells of which nothing was claimed
};

/// A piece of curve between two ends, or a closed one, as the cells prove it.
struct Chain {
  core::Point2 inner{};  ///< a point on it, to rounding
  bool has_arc = false;
};

/// An arc of the certificate, and whether it was found to be what some sheet says.
struct KnownArc {
  const CurveClaim* curve = nullptr;
  const core::Arc* arc = nullptr;
  int sheet = -1;  ///< by which it was found right; -1: none yet
};

/// Checks cells and ends of a sheet, and matches the arcs of its mode and role with its chains. Throws FalseClaim. What
/// is left is chains inside the workspace without an arc.
std::vector<Chain> check_sheet(const CertificateFile& certificate, int sheet, const std::vector<int>& singular,
                               std::vector<KnownArc>& arcs, Tally& tally);

/// "cell [0, 1] x [2, 3]".
std::string describe(const Rectangle& cell);

}  // namespace clearloci::check
