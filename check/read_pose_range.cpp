#include "check/claim_reader.hpp"
#include "check/pose_range.hpp"

namespace clearloci::check {
namespace {

class PoseRangeReader : ClaimReader {
 public:
  using ClaimReader::ClaimReader;

  PoseRangeClaim read(const Json& root) const {
    PoseRangeClaim claim;
    read_head(root, claim.head);
    if (claim.head.coordinates.size() != 1) fail("loci on a range have one coordinate");
    for (const Json& value : list(at(at(root, "pose_range"), "modes"), most_modes)) claim.modes.push_back(mode(value));
    return claim;
  }

 private:
  static constexpr std::size_t most_modes = 4096, most_places = 100'000;

  PoseRangeClaim::Mode mode(const Json& json) const {
    PoseRangeClaim::Mode mode{sides(at(json, "sides")), demands(at(json, "demands")), {}, {}, {}};
    for (const Json& each : list(at(json, "free"), most_places)) mode.free.push_back(free(each));
    for (const Json& each : list(at(json, "points"), most_places)) mode.points.push_back(point(each));
    for (const Json& each : list(at(json, "open"), most_places))
      mode.open.emplace_back(rational(item(each, 0)), rational(item(each, 1)));
    return mode;
  }

  std::vector<Reaction> reactions(const Json& json) const {
    std::vector<Reaction> reactions;
    for (const Json& each : list(json, most_demands))
      reactions.emplace_back(text(item(each, 0)), quantity(text(item(each, 1))));
    return reactions;
  }

  int sign(const Json& json) const {
    if (json != 1 && json != -1 && json != 0) fail("a sign is 1, -1 or 0");
    return json.get<int>();
  }

  PoseRangeClaim::Free free(const Json& json) const {
    PoseRangeClaim::Free free{text(at(json, "zone")),
                              rational(at(json, "from")),
                              rational(at(json, "to")),
                              sign(at(json, "assembly_mode")),
                              {},
                              {}};
    for (const Json& each : list(at(json, "signs"), most_demands))
      free.signs.emplace_back(text(item(each, 0)), quantity(text(item(each, 1))), sign(item(each, 2)));
    free.too_small = reactions(at(json, "too_small"));
    if (free.from > free.to) fail("an interval ends before it begins");
    return free;
  }

  PoseRangeClaim::Point point(const Json& json) const {
    PoseRangeClaim::Point point{kind(text(at(json, "kind"))), reactions(at(json, "vanishing")),
                                rational(at(json, "at")), false};
    const Json& certified = at(json, "certified");
    if (!certified.is_boolean()) fail("a point is certified or not");
    point.certified = certified.get<bool>();
    return point;
  }

  core::LocusKind kind(const std::string& name) const {
    using enum core::LocusKind;
    for (const core::LocusKind kind :
         {contact_loss, backlash, component, margin, preload, direct_singularity, workspace_boundary, no_limit})
      if (core::to_string(kind) == name) return kind;
    fail("an unknown kind of locus");
  }
};

}  // namespace

PoseRangeClaim read_pose_range(const nlohmann::json& root, const std::string& file) {
  return PoseRangeReader(file).read(root);
}

}  // namespace clearloci::check
