// A task over its mechanism's coordinates and over all that it is asked for at once besides: parameters within their
// tolerances, and what loads may differ by. Each of these is a coordinate more, behind the file's own, over which the
// margin does not grow:
//     A(q, p) w = b(q, p) + sum l_i b_i
// so that what proves a task over poses (loci/pose/) proves it for every design and load.
// Private to analysis/.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "clearloci/verify.hpp"
#include "core/enclosure.hpp"
#include "loci/tasks/tasks.hpp"
#include "mechanism/open_design.hpp"

namespace clearloci {

class WidenedTask {
 public:
  /// Throws core::InputError for parameters that cannot be left open, for tolerances that leave a link without a
  /// length, and for more of both than cells have room for.
  WidenedTask(const mechanism::Mechanism& mechanism, const core::Task& task);

  /// Under the first and the last load, over all coordinates.
  const std::vector<mechanism::Mechanism>& loads() const { return loads_; }
  const loci::pose::PoseBeside& beside() const { return beside_; }
  /// Distances of the task's metric, over all coordinates.
  loci::pose::PoseMetric metric(const mechanism::Mechanism& mechanism, const core::Task& task) const;
  std::size_t variables() const { return open_.variables.size(); }  ///< of designs: the first of `beside`
  /// With some of the parameters within less than their tolerances.
  loci::pose::PoseBeside beside_with(const Ranges& parameters) const;

  /// The pose of a place among all coordinates.
  std::vector<double> pose_of(const std::vector<double>& at) const;
  /// A place whose values behind the pose are those of one design, and of loads that the task speaks of.
  std::vector<double> settled(std::vector<double> at) const;
  /// What a reaction takes up at least and at most within the tolerances, m or rad.
  Interval clearance(const core::Vanishing& reaction) const;
  /// The mechanism with the clearances of a settled place, under the load that lies so far from the first to the last.
  mechanism::Mechanism at_place(const std::vector<double>& at, double load) const;
  /// The parameters that have a tolerance, at a settled place.
  std::vector<std::pair<std::string, double>> design(const std::vector<double>& at) const;

 private:
  std::vector<double> parameters(const std::vector<double>& at) const;
  void add_parts(const core::LoadWithin& within, const core::Task& task);

  std::size_t poses_;  ///< coordinates of the file
  mechanism::OpenDesign open_;
  Ranges values_;                                  ///< what parameters may be
  std::vector<std::pair<double, double>> ranges_;  ///< of the open design's parameters
  std::vector<mechanism::Mechanism> loads_;
  loci::pose::PoseBeside beside_;
};

}  // namespace clearloci
