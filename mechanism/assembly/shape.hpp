// The shape of a link: where its points are in a frame of its own, exactly. That of the drawing, unless lengths are
// given. Private to mechanism/.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/assembly/drawing.hpp"

namespace clearloci::mechanism {

class Shape {
 public:
  /// Throws core::InputError where lengths are given that fix no shape.
  Shape(const Drawing& drawing, LinkIndex link);

  bool has(PointIndex point) const { return at_.contains(point); }
  /// Required: has(point).
  const Amounts& at(PointIndex point) const { return at_.at(point); }
  Amounts way(PointIndex from, PointIndex to) const { return at(to) - at(from); }
  Amount distance(PointIndex a, PointIndex b) const;
  bool is_drawn() const { return drawn_; }

 private:
  void place_by_lengths(const Drawing& drawing, LinkIndex link);
  /// `bases`: points with a place whose distances from this one are given. Nothing where they are too few.
  std::optional<Amounts> place_from(const Drawing& drawing, const Link& link, PointIndex point,
                                    std::vector<PointIndex> bases) const;
  [[noreturn]] void refuse(const Drawing& drawing, const Link& link, const std::string& problem) const;

  std::map<PointIndex, Amounts> at_;
  std::vector<GivenLength> given_;
  bool drawn_ = true;
};

}  // namespace clearloci::mechanism
