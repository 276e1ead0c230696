// The door of zones/: the parts of the workspace that are free of discontinuities. Over two coordinates faces of the
// graph of curves that were traced, of every mode of a map (method.md section 9); over one to three, cells that are
// proven free (cell_zones.hpp, method.md section 13).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "clearloci/zones.hpp"
#include "core/locus_factor.hpp"
#include "loci/zones/cell_zones.hpp"
#include "loci/zones/largest_ball.hpp"
#include "loci/zones/plane_graph.hpp"
#include "loci/zones/workspace_rings.hpp"

namespace clearloci::loci {

struct CutZones {
  core::Zones map;
  bool finer_may_tell = true;  ///< where zones are not certified, finer polylines of the loci may change that
  bool left = false;           ///< finer polylines are wanted: there is nothing else
};

/// What the caller knows of a pose; faces that only loci of the kind `preload` part, and of whose samples it says the
/// same, are one zone.
using ZoneLabel = std::function<std::string(const core::WorkingMode& mode, const std::vector<double>& sample)>;

/// Polylines of borders get more vertices where areas correct to 1e-6 need them; `assembly_mode` and `signs` are left
/// to the caller, who knows reactions. `traced`: the loci of the problem, complete. Two free coordinates required.
/// `sketch`: as of zone_graph; areas are those of the polylines, inscribed circles are free of them and near the
/// largest ones, in long slivers perhaps half as large, and what is not certified is not spoken of in notes.
/// `may_leave`: nothing is measured where finer polylines may certify how curves cut the workspace, and these do not.
/// `label`: may be empty.
CutZones zones(const core::LocusProblem& problem, core::LocusMap traced, bool sketch = false, bool may_leave = false,
               const ZoneLabel& label = {});

}  // namespace clearloci::loci
