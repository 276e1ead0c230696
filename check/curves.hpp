// The claims of one sheet's cells, and the curve that they prove. Private to check/.
//
// In a cell in which the curve takes every value of one variable at most once, it is a row of graphs over that
// variable; their ends lie on the cell's sides and on Q_j = 0. So the ends, sorted, bound the graphs two by two, and
// graphs that meet on a common side make up the curve. Cells of which the certificate claims nothing are cut here
// until they tell as much; what stays open is tiny, or counted as unchecked.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "check/certificate.hpp"
#include "check/zeros.hpp"

namespace clearloci::check {

struct Leaf {
  Rectangle cell;
  core::CellNode claim;
  int origin = 0;          ///< the cell of the certificate that it is, or a part of
  bool unclaimed = false;  ///< a part of a cell of which nothing was claimed
};

struct Node {
  Rectangle cell;
  int axis = -1;
  double at = 0;
  int child[2] = {-1, -1};
  int leaf = -1;
};

/// Where pieces begin and end: on a side between cells, on the domain's, on the workspace's boundary, at an open cell.
struct Junction {
  enum class Kind { seam, side, rim, open } kind = Kind::seam;
  Place place;
  int beyond = -1;      ///< the leaf on the other side of a seam, or the open one
  bool inside = false;  ///< a seam between parts of one cell of the certificate
};

struct End {
  int junction = 0;
  Interval key;  ///< the value of the leaf's variable
};

/// One graph.
struct Piece {
  int leaf = 0;
  End ends[2];
};

struct Step {
  int piece = 0;
  bool forward = true;
};

struct Path {
  std::vector<Step> steps;
  bool closed = false;
  int first = 0, last = 0;  ///< junctions
};

/// A place on a path: 2.5 is the middle of its third piece.
struct Spot {
  int path = 0;
  double along = 0;
};

class Curve {
 public:
  /// Checks the cells. Throws FalseClaim.
  Curve(const CertificateFile& certificate, const SheetCells& claim);

  [[noreturn]] void fail(const std::string& what) const;
  const Junction& junction(int j) const { return junctions_[static_cast<std::size_t>(j)]; }
  /// Whether the open cells at two junctions touch, by way of others.
  bool same_region(int j, int k) const { return region(junction(j).beyond) == region(junction(k).beyond); }
  /// What the open cells there take up.
  Rectangle region_at(int j) const;
  const Piece& piece(const Step& step) const { return pieces_[static_cast<std::size_t>(step.piece)]; }
  const Leaf& leaf(const Piece& piece) const { return leaves_[static_cast<std::size_t>(piece.leaf)]; }
  /// Spots of a point on the paths; whether an open cell is there besides.
  std::vector<Spot> spots(const core::Point2& at, double reach, bool& open);
  /// The point of a graph near a box in its cell, if it is found.
  std::optional<Place> place_on(const Piece& piece, const Rectangle& near);

  /// The variable of a leaf's graph at a place.
  Interval key(int leaf, const Place& place);

  const CertificateFile& c;
  const SheetCells& claim;
  const core::StraightLine& program;
  Sheet sheet;
  double size = 0;  ///< of the box
  std::vector<Path> paths;
  std::size_t cells = 0, graphs = 0, ends = 0;
  double area = 0, open_area = 0;

 private:
  void plant();
  void check_leaf(std::size_t node);
  void cut_leaf(std::size_t node, int cuts);
  void cut_open(std::vector<std::size_t> nodes);
  std::array<std::size_t, 2> cut(std::size_t node);
  bool is_free(const Rectangle& cell, int cuts);
  bool is_graph(const Rectangle& cell, int variable);
  bool is_graph_here(int variable) const;
  void find_ends();
  void meet_seams(int index);
  void meet_along(int a, int b, int axis, double at);
  void meet_side(int leaf, int beyond, int axis, double at, double from, double to, Junction::Kind kind);
  void open(int leaf);
  int region(int leaf) const;
  void meet_sides();
  void meet_rims();
  bool pair();
  void count_ends() const;
  void string_together();
  int leaf_at(const Place& place) const;
  void attach(int leaf, int junction);
  core::CellNode::Kind kind(int leaf) const { return leaves_[static_cast<std::size_t>(leaf)].claim.kind; }

  bool opened_ = false;
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_, origins_;
  std::vector<int> variables_;  // 0, 1 and those of the function's roots
  std::vector<Junction> junctions_;
  std::vector<std::vector<End>> ends_;
  std::vector<int> region_;  // of open leaves that touch, by way of another of them
  std::vector<Piece> pieces_;
  std::map<std::array<double, 4>, CommonZeros> known_;         // zeros on sides
  std::map<int, std::vector<std::pair<int, int>>> places_of_;  // leaf: path, step
};

/// "cell [0, 1] x [2, 3]".
std::string describe(const Rectangle& cell);

}  // namespace clearloci::check
