// Points of a planar drawing that close together, none before the others: they become a group of the file
// (docs/reference/mechanism-file.md). Private to mechanism/.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/assembly/planar_loci.hpp"
#include "mechanism/assembly/smallest_group.hpp"

namespace clearloci::mechanism {

class PlanarGroups : public PlanarLoci {
 public:
  using PlanarLoci::PlanarLoci;

 private:
  /// Of an unknown point: held by equations of its own, or built on others.
  enum class Use { free, base, derived };
  /// A distance or a line that holds unknown points.
  struct Held {
    std::vector<PointIndex> points;
    std::string first, second;     ///< of a distance, by names
    std::string length;            ///< of a distance
    const Locus* locus = nullptr;  ///< what a point is held by that is known; else a distance or a line between points
    std::string along;             ///< of a line between points
  };
  struct Derived {
    PointIndex point = 0;
    std::vector<PointIndex> bases;
    Node form;
  };
  struct Parts {
    std::map<PointIndex, Use> use;  ///< of the points that matter
    std::vector<Derived> derived;
    std::vector<Held> held;
    std::vector<std::vector<Locus>> loci;
  };

  bool put_group() override;
  const std::string& name_of(PointIndex point) const;
  /// Unknown points that more than one link has, or that something else holds.
  bool is_shared(PointIndex point) const;
  std::vector<LinkIndex> links_with_shared_points(const Parts& parts) const;
  std::vector<LinkIndex>::const_iterator next_link(const std::vector<LinkIndex>& links, const Parts& parts) const;
  std::vector<PointIndex> shared_of(LinkIndex link, const Parts& parts) const;
  void add_distance(LinkIndex link, PointIndex a, PointIndex b, Parts& parts) const;
  bool is_held_by_lengths(LinkIndex link, PointIndex a, PointIndex b, PointIndex point) const;
  bool add_link(LinkIndex link, Parts& parts);
  void add_known_guides(Parts& parts);
  void add_moving_guides(std::vector<Held>& held) const;
  /// The points with equations of their own that a point is built on.
  void expand(PointIndex point, const Parts& parts, std::vector<PointIndex>& into) const;
  bool put_smallest(const Parts& parts);
  void write_group(const std::vector<PointIndex>& points, const std::vector<std::size_t>& equations,
                   const Parts& parts);
  Node near_of(const std::vector<PointIndex>& points) const;
  static std::string number_text(double value);
};

}  // namespace clearloci::mechanism
