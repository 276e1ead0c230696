// The judgement of the cell edges along one grid line, for one reaction after another. Doubt is refined before it is
// admitted: a polyline deviates from its curve by up to the map's tolerance and a numerator from its value by rounding,
// so ends that are in doubt are moved along the line to where both are clear.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "numeric/grid_passages.hpp"
#include "numeric/line_witness.hpp"

namespace clearloci::numeric {

enum class Outcome { held, disputed, undecided, outside };

struct Finding {
  Outcome outcome = Outcome::undecided;
  int crossings = 0;  ///< of the edge (where refined: of the stretch compared) by the reaction's polylines
  bool sign_change = false;
};

/// A reaction on the edges of a line. weights[c]: how often it vanishes on curve c of the map, 0 if not at all.
struct LineReaction {
  WitnessColumns columns;
  std::span<const int> weights;
};

/// Nodes at the two ends of an edge, from the fast route. `change`: unknown where a numerator is exactly zero.
struct EdgeNodes {
  bool first_reachable = false, second_reachable = false;
  Parity change = Parity::unknown;
};

class EdgeJudge {
 public:
  /// `passages`: of the line. boundary[c]: whether curve c is workspace boundary. `reach`: how far a polyline may be
  /// from its curve, m.
  EdgeJudge(LineWitness witness, const GridAxis& along, std::span<const Passage> passages,
            std::span<const int> boundary, double reach);

  /// Edge i joins nodes i and i + 1. Edges are to be asked for in ascending order.
  Finding judge(int edge, const LineReaction& reaction, const EdgeNodes& nodes);

 private:
  /// The part of an edge next to a reachable node where the boundary is not met, from the node on.
  struct Stretch {
    double from = 0, to = 0;
  };

  void turn_to(int edge);
  int crossings_between(const LineReaction& reaction, double a, double b) const;
  int touches_between(const LineReaction& reaction, double a, double b);
  bool boundary_between(double a, double b) const;
  double leave_passages(const LineReaction& reaction, double from, int direction) const;
  std::optional<double> clear_position(const LineReaction& reaction, double from, std::span<const int> directions,
                                       double within);
  std::optional<Stretch> stretch_from(double node, double other);
  Finding compare(const LineReaction& reaction, double a, double b);
  Finding refine(const LineReaction& reaction);
  Finding judge_outside(const LineReaction& reaction);
  Finding judge_boundary(const LineReaction& reaction, const EdgeNodes& nodes);

  LineWitness witness_;
  GridAxis along_;
  std::span<const Passage> passages_;
  std::span<const int> boundary_;
  double reach_;
  // Of the edge last turned to:
  int edge_ = -1;
  double low_ = 0, high_ = 0;
  bool meets_boundary_ = false;
  std::vector<Passage> near_;                                       ///< passages within a cell of the edge
  std::array<std::optional<std::optional<Stretch>>, 2> stretches_;  ///< from either node, once known
};

}  // namespace clearloci::numeric
