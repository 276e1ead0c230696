#include "analysis/range_certificate.hpp"

#include <algorithm>

#include "analysis/loci_by_cells.hpp"
#include "analysis/pose_demands.hpp"
#include "analysis/singular_modes.hpp"
#include "analysis/task_demands.hpp"
#include "core/errors.hpp"
#include "mechanism/posture_sample.hpp"
#include "numeric/model.hpp"

namespace clearloci {
namespace {

using core::RangeCertificate;
using core::Rational;

/// Of the range: what is claimed ends so far beside a locus.
const Rational beside(1, 100'000'000);

class RangeClaims {
 public:
  RangeClaims(const mechanism::Mechanism& mechanism, const LociRequest& request, const core::LocusMap& map)
      : mechanism_(mechanism),
        request_(request),
        map_(map),
        model_(numeric::compile(mechanism)),
        lower_(mechanism.coordinates.front().lower),
        upper_(mechanism.coordinates.front().upper),
        hair_(beside * (upper_ - lower_)) {
    result_.coordinate = mechanism.coordinates.front().name;
  }

  RangeCertificate::Mode& mode(const core::WorkingMode& mode, bool reached = true) {
    const auto found = std::find(modes_.begin(), modes_.end(), mode);
    if (found != modes_.end()) return result_.modes[static_cast<std::size_t>(found - modes_.begin())];
    modes_.push_back(mode);
    RangeCertificate::Mode& added = result_.modes.emplace_back();
    added.sides = numeric::dyad_signs(model_, map_.tower, mode);
    constexpr std::size_t poses = 24;
    std::vector<std::string> notes;
    const std::vector<core::TaskDemand> asked = demands_of(mechanism_, request_);
    // Where no pose is within reach none tells what is never loaded.
    added.demands = reached ? loaded_demands({model_}, added.sides, asked, mechanism::spread_poses(mechanism_, poses),
                                             notes, LeastSizes::are_left_out)
                            : asked;
    // Bounds of efforts are the model's.
    std::erase_if(added.demands, [](const core::TaskDemand& demand) { return demand.bound.has_value(); });
    for (const core::IsolatedPoint& point : map_.isolated_points)
      if (point.mode == mode) added.points.push_back(point);
    for (const core::OpenRegion& open : map_.open)
      if (open.mode == mode) added.open.push_back({Rational(open.lower.front()), Rational(open.upper.front())});
    return added;
  }

  /// Up to a hair beside its ends, where these are not those of the range.
  void add(RangeCertificate::Mode& mode, double from, double to, RangeCertificate::Free free = {}) const {
    free.from = Rational(from) <= lower_ + hair_ ? lower_ : Rational(Rational(from) + hair_);
    free.to = Rational(to) >= upper_ - hair_ ? upper_ : Rational(Rational(to) - hair_);
    if (!(free.from < free.to)) return;
    const double middle = core::to_double(Rational((free.from + free.to) / 2));
    free.too_small = too_small_at(model_, mode.demands, {middle}, mode.sides);
    mode.free.push_back(std::move(free));
  }

  /// Where no mode is within reach, the claim is that the whole range is out of reach in each; out of time nothing is
  /// claimed.
  RangeCertificate done() {
    std::vector<std::string> notes;
    if (result_.modes.empty() && !map_.out_of_time)
      for (const DyadSides& sides : regular_modes(mechanism_, requested_modes(mechanism_, request_), notes))
        mode(mode_of(sides, map_.tower), false);
    for (const RangeCertificate::Mode& mode : result_.modes)
      if (mode.demands.empty())
        throw core::InputError({.file = "--certificate"}, "none of the reactions asked for is certified",
                               "leave it out, or ask for f, M or F");
    return std::move(result_);
  }

 private:
  const mechanism::Mechanism& mechanism_;
  const LociRequest& request_;
  const core::LocusMap& map_;
  const numeric::NumericModel model_;
  Rational lower_, upper_, hair_;
  RangeCertificate result_;
  std::vector<core::WorkingMode> modes_;
};

}  // namespace

RangeCertificate range_certificate(const mechanism::Mechanism& mechanism, const LociRequest& request,
                                   const core::LocusMap& map) {
  RangeClaims claims(mechanism, request, map);
  for (const core::ReachableInterval& interval : map.reachable) {
    RangeCertificate::Mode& mode = claims.mode(interval.mode);
    std::vector<double> cuts = {interval.from};
    for (const core::IsolatedPoint& point : mode.points)
      if (point.at.front() > interval.from && point.at.front() < interval.to) cuts.push_back(point.at.front());
    cuts.push_back(interval.to);
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 1; i < cuts.size(); ++i) claims.add(mode, cuts[i - 1], cuts[i]);
  }
  return claims.done();
}

RangeCertificate range_certificate(const mechanism::Mechanism& mechanism, const LociRequest& request,
                                   const core::Zones& zones) {
  const core::LocusMap map = ends_of_zones(mechanism, zones);
  RangeClaims claims(mechanism, request, map);
  for (const core::Zone& zone : zones.zones)
    claims.add(claims.mode(zone.mode), zone.lower.front(), zone.upper.front(),
               {zone.id, {}, {}, zone.assembly_mode, zone.signs});
  return claims.done();
}

}  // namespace clearloci
