// Where the labels of a drawing stand, so that each can be read: of the places that it may have the one that covers
// least of what is drawn and of the labels before it.
// Private to report/.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/locus_map.hpp"
#include "report/axis.hpp"

namespace clearloci::report {

class LabelPlaces {
 public:
  /// Labels stay within `room`. All lengths in pt.
  explicit LabelPlaces(const Box& room) : room_(room) {}

  /// What labels had better not cover; `weight`: what covering it costs, of a label 1.
  void occupy(const Box& box, double weight);
  void occupy(const core::Point2& from, const core::Point2& to, double width, double weight);

  /// The middle of a label of this size: the first of the places among those that cover least, moved into the room.
  /// It is occupied from then on.
  core::Point2 take(const std::vector<core::Point2>& places, double width, double height);

  /// The same where no more than this part of the label would be covered; else nothing is taken.
  std::optional<core::Point2> take_free(const std::vector<core::Point2>& places, double width, double height,
                                        double part);

 private:
  struct Occupied {
    Box box;
    double weight;
  };
  double cost(const Box& box) const;
  std::pair<Box, double> cheapest(const std::vector<core::Point2>& places, double width, double height) const;

  Box room_;
  std::vector<Occupied> occupied_;
};

}  // namespace clearloci::report
