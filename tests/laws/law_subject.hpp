// A design under the law: its mechanism and request as the program gets them, and the witness: reactions by LU of the
// full matrix, compiled from the same design about the origin.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/loci.hpp"
#include "clearloci/zones.hpp"
#include "numeric/reactions.hpp"
#include "tests/laws/design_forms.hpp"
#include "tests/laws/distance_to.hpp"
#include "tests/laws/law_report.hpp"

namespace clearloci::test {

using core::Point2;

/// Reactions at a pose of one working mode.
class Witness {
 public:
  /// `shift`: of the poses asked about, from those of the mechanism, one a coordinate.
  Witness(const mechanism::Mechanism& mechanism, std::vector<double> shift)
      : model_(numeric::compile(mechanism)), shift_(std::move(shift)) {}

  const numeric::NumericModel& model() const { return model_; }

  bool reachable(std::span<const double> pose, const std::vector<int>& sides) const {
    return numeric::reachable(model_, at_home(pose), sides);
  }
  std::optional<numeric::Reactions> at(std::span<const double> pose, const std::vector<int>& sides) const;
  numeric::Posture posture(std::span<const double> pose, const std::vector<int>& sides) const {
    return numeric::posture(model_, at_home(pose), sides);
  }
  numeric::BoundedNumerators bounded(std::span<const double> pose, const std::vector<int>& sides) const {
    return numeric::bounded_numerators(model_, at_home(pose), sides);
  }
  /// A reaction; of a force the size of all components together.
  double value_of(const numeric::Reactions& reactions, const core::Vanishing& what) const;
  /// Of a joint that has contact on both components.
  bool has_force(const std::string& joint) const;

 private:
  std::vector<double> at_home(std::span<const double> pose) const;
  const std::string& name_of(mechanism::JointIndex joint) const {
    return model_.mechanism.joints[static_cast<std::size_t>(joint)].name;
  }
  double half_length(const std::string& joint) const;

  numeric::NumericModel model_;
  std::vector<double> shift_;
};

struct Subject {
  /// Throws core::InputError where the reader refuses the file.
  Subject(const LawDesign& design, Report& report_to);

  /// Of a mode of a map.
  std::vector<int> sides_of(const core::LocusMap& map, const core::WorkingMode& mode) const {
    return numeric::dyad_signs(witness.model(), map.tower, mode);
  }
  /// Poses between the nodes of a lattice over the box, so that none is special.
  std::vector<std::vector<double>> scattered(int n) const;
  /// Two lengths.
  bool is_plane() const {
    return mechanism.coordinates.size() == 2 && !mechanism.coordinates[0].angle && !mechanism.coordinates[1].angle;
  }
  double lower(std::size_t c) const { return core::to_double(mechanism.coordinates[c].lower); }
  double upper(std::size_t c) const { return core::to_double(mechanism.coordinates[c].upper); }
  double size() const;
  /// How much doubles are apart where the box is farthest from the origin.
  double spacing() const;

  const LawDesign& design;
  Report& report;
  mechanism::Mechanism mechanism;
  Witness witness;
  LociRequest request;
};

/// The loci, found within the patience; `what` they are certified and complete is told. Nothing: refused or late.
std::optional<core::LocusMap> loci_of(Subject& subject, core::Certificate* certificate = nullptr);

/// Refusals name their reason: no pose of the box can be reached, or |A| is zero in every pose.
void is_rightly_refused(Subject& subject, const std::string& message);

double area_of(const core::Polyline& ring);
bool inside(const core::Polyline& ring, const Point2& at);
bool inside(const core::Zone& zone, const Point2& at);
/// The steps of the law, each of one design.
void judge_loci(Subject& subject);
void judge_validation(Subject& subject);
void judge_engines(Subject& subject);
void judge_margins(Subject& subject);
void judge_zones(Subject& subject);
void judge_task(Subject& subject);
void judge_certificate(Subject& subject);
void judge_study(Subject& subject);

}  // namespace clearloci::test
