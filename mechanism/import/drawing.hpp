// A source on the drawing: names of links and points that a mechanism file may contain, one point a pin for all its
// links, what slides exactly between the two points of its guide. Coordinates are the shortest decimals within a
// billionth of the source's size. Private to mechanism/.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/rational.hpp"
#include "mechanism/import/common.hpp"

namespace clearloci::mechanism::imports {

constexpr double exactness = 1e-9;  ///< of the size of the source

/// Letters, digits and _ of a name, such as expressions may contain.
std::string plain_name(const std::string& name, const char* prefix);
/// The name, or with _2, _3 where it is taken; takes it.
std::string unused(std::string name, std::set<std::string>& used);

struct DrawnPlace {
  std::string name;
  Vec at{};
  std::array<core::Rational, 3> exact;
  std::set<int> links;
  bool dropped = false;
};

using PlaceIndex = std::size_t;

class Drawing {
 protected:
  explicit Drawing(Source& source) : s_(source), size_(size_of(source)), dimension_(source.planar ? 2U : 3U) {}

  void name_links();
  const std::string& link_name(int link) const;
  std::optional<PlaceIndex> found(int link, const Vec& at) const;
  PlaceIndex place_of(int link, const Vec& at, const std::string& name);
  /// One point of both links.
  PlaceIndex pin(const SourceJoint& joint);
  static bool slides(const SourceJoint& joint) { return joint.slides(); }
  void make_places();
  /// A guide on the ground slides nothing: its link is `to`.
  static void turn_to_links(SourceJoint& joint);
  /// A second point of a link of a single one, whose angle is a coordinate.
  void give_direction(int link, const SourceJoint& joint);
  /// A point of `to`: one that is there, the nearest.
  PlaceIndex slider_place(const SourceJoint& joint);
  std::optional<PlaceIndex> centre_place(int link);
  Vec load_end(const SourceLoad& load) const { return load.at + (0.1 * size_) * unit(load.force); }
  /// What slides between two points of a link is exactly on the line through them.
  void put_on_guides();
  bool is_on_line(PlaceIndex a, PlaceIndex b, PlaceIndex p) const;

  double tolerance() const { return exactness * size_; }
  bool same(const Vec& a, const Vec& b) const {
    double most = 0;
    for (std::size_t i = 0; i < dimension_; ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most <= 1e-6 * size_;
  }
  std::string number(double value) const { return shortest_decimal(value, tolerance()); }

  std::string vector_text(const Vec& v, double within) const {
    std::string text = "[";
    for (std::size_t i = 0; i < dimension_; ++i) text += (i == 0 ? "" : ", ") + shortest_decimal(v[i], within);
    return text + "]";
  }
  std::string list_of(const std::array<core::Rational, 3>& exact) const {
    std::string text = "[";
    for (std::size_t i = 0; i < dimension_; ++i) text += (i == 0 ? "" : ", ") + exact_decimal(exact[i]);
    return text + "]";
  }

  Source& s_;
  double size_;
  std::size_t dimension_;
  std::vector<std::string> link_names_;
  std::set<std::string> point_names_;
  std::vector<DrawnPlace> places_;
  std::map<int, std::vector<PlaceIndex>> order_;      ///< of a link, its points
  std::map<int, std::optional<PlaceIndex>> centres_;  ///< nothing: the middle of the first two points
  std::vector<PlaceIndex> at_;                        ///< of joints
};

}  // namespace clearloci::mechanism::imports
