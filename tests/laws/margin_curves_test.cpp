// The curves |f| = f_min of weighted designs: every change of sign of |f| - f_min along the lines of a grid, reactions
// solved numerically, is next to an arc of such a curve or in a place that is said to be open; and the curves are
// certified. CLEARLOCI_DESIGNS=n tries more designs, CLEARLOCI_FIRST=k other ones.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "analysis/loci.hpp"
#include "analysis/zones.hpp"
#include "mechanism/read.hpp"
#include "numeric/reactions.hpp"
#include "numeric/turns.hpp"
#include "tests/laws/distance_to.hpp"
#include "tests/laws/margin_designs.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using test::distance_to;

using core::LocusKind;
using core::Point2;

unsigned number_of(const char* name, unsigned usual) {
  const char* const wanted = std::getenv(name);
  return wanted != nullptr ? static_cast<unsigned>(std::atoi(wanted)) : usual;
}

bool names(const std::vector<core::Vanishing>& vanishing, const std::string& joint) {
  return std::any_of(vanishing.begin(), vanishing.end(), [&](const core::Vanishing& candidate) {
    return candidate.joint == joint && candidate.quantity == core::Quantity::f;
  });
}

class Margins {
 public:
  Margins(const mechanism::Mechanism& mechanism, const core::LocusMap& map, double bound)
      : model_(numeric::compile(mechanism)), map_(map), bound_(bound) {
    for (std::size_t c = 0; c < 2; ++c) {
      low_[c] = core::to_double(map.lower[c]);
      high_[c] = core::to_double(map.upper[c]);
    }
  }

  /// How many crossings there are, and those that are neither on an arc nor open.
  struct Count {
    int all = 0, open = 0;
    std::vector<Point2> missing;
  };
  Count count(const std::string& joint, const core::WorkingMode& mode, int lines) {
    sides_ = numeric::dyad_signs(model_, map_.tower, mode);
    columns_.clear();
    for (std::size_t k = 0; k < model_.unknowns.size(); ++k) {
      const mechanism::Unknown& unknown = model_.unknowns[k];
      const bool force = unknown.quantity == core::Quantity::fx || unknown.quantity == core::Quantity::fy;
      if (force && model_.mechanism.joints[static_cast<std::size_t>(unknown.joint)].name == joint)
        columns_.push_back(k);
    }
    Count result;
    if (columns_.size() != 2) return result;
    for (const std::size_t axis : {0u, 1u})
      for (int line = 0; line < lines; ++line) {
        const std::size_t other = 1 - axis;
        Point2 at = {0, 0};
        at[other] = low_[other] + (line + 0.4142) / lines * (high_[other] - low_[other]);
        along(axis, at, 6 * lines, joint, mode, result);
      }
    return result;
  }

 private:
  /// Sign of |N|^2 - (bound |A|)^2; none: out of reach, or rounding hides it.
  std::optional<int> sign(const Point2& at) const {
    const numeric::BoundedNumerators numerators = numeric::bounded_numerators(model_, at, sides_);
    if (!numerators.reachable) return std::nullopt;
    const double x = numerators.values[columns_[0]].value, y = numerators.values[columns_[1]].value,
                 d = numerators.determinant.value;
    const double size = std::hypot(x, y), limit = bound_ * std::abs(d);
    const double error = numerators.values[columns_[0]].error + numerators.values[columns_[1]].error +
                         bound_ * numerators.determinant.error;
    if (std::abs(size - limit) <= error) return std::nullopt;
    return size > limit ? 1 : -1;
  }

  void along(std::size_t axis, Point2 at, int steps, const std::string& joint, const core::WorkingMode& mode,
             Count& result) const {
    std::optional<int> last;
    double from = 0;
    for (int step = 0; step <= steps; ++step) {
      at[axis] = low_[axis] + (step + 0.236) / (steps + 1) * (high_[axis] - low_[axis]);
      const std::optional<int> this_sign = sign(at);
      if (this_sign && last && *this_sign != *last) {
        double a = from, b = at[axis];
        bool lost = false;
        for (int halving = 0; halving < 40 && !lost; ++halving) {
          Point2 middle = at;
          middle[axis] = (a + b) / 2;
          const std::optional<int> sign_there = sign(middle);
          if (!sign_there) break;
          (*sign_there == *last ? a : b) = middle[axis];
        }
        Point2 crossing = at;
        crossing[axis] = (a + b) / 2;
        if (b - a < 1e-6) judge(crossing, joint, mode, result);
      }
      last = this_sign;
      from = at[axis];
    }
  }

  void judge(const Point2& at, const std::string& joint, const core::WorkingMode& mode, Count& result) const {
    ++result.all;
    const double near = 3 * map_.tolerance + 1e-6;
    for (const core::LocusCurve& curve : map_.curves) {
      if (curve.kind != LocusKind::margin || curve.mode != mode || !names(curve.vanishing, joint)) continue;
      for (const core::Arc& arc : curve.arcs)
        if (distance_to(arc.points, at) <= near) return;
    }
    for (const core::OpenRegion& region : map_.open) {
      if (region.kind != LocusKind::margin || region.mode != mode || !names(region.vanishing, joint)) continue;
      bool inside = true;
      for (std::size_t c = 0; c < 2; ++c)
        inside = inside && at[c] >= region.lower[c] - near && at[c] <= region.upper[c] + near;
      if (inside) {
        ++result.open;
        return;
      }
    }
    result.missing.push_back(at);
  }

  numeric::NumericModel model_;
  const core::LocusMap& map_;
  double bound_;
  Point2 low_{}, high_{};
  std::vector<int> sides_;
  std::vector<std::size_t> columns_;
};

/// Whether all is certified.
bool hold(const mechanism::Mechanism& mechanism, const std::string& bound, int lines) {
  LociRequest request;
  request.quantities = {core::Quantity::f};
  request.min_force = core::Rational(bound);
  request.min_force->canonicalize();
  const core::LocusMap map = trace_loci(mechanism, request);
  const bool certified =
      std::all_of(map.curves.begin(), map.curves.end(), [](const auto& curve) { return curve.certified; });
  EXPECT_EQ(map.complete, map.open.empty());
  Margins margins(mechanism, map, core::to_double(*request.min_force));
  int all = 0;
  for (const core::WorkspaceRegion& region : map.workspace)
    for (const mechanism::Joint& joint : mechanism.joints) {
      const Margins::Count count = margins.count(joint.name, region.mode, lines);
      all += count.all;
      EXPECT_TRUE(count.missing.empty()) << joint.name << ": " << count.missing.size() << " of " << count.all
                                         << " crossings are on no arc, the first at (" << count.missing.front()[0]
                                         << ", " << count.missing.front()[1] << ")";
    }
  testing::Test::RecordProperty("crossings", all);
  return certified && map.complete;
}

class MarginCurves : public testing::TestWithParam<unsigned> {};

// Where a node lies on the workspace boundary, as with legs of 3, 4 and 5 parts, it stays open.
TEST_P(MarginCurves, HoldEveryCrossing) {
  const unsigned designs = number_of("CLEARLOCI_DESIGNS", 12) / 4, first = number_of("CLEARLOCI_FIRST", 0);
  unsigned open = 0;
  for (unsigned i = 0; i < designs; ++i) {
    const unsigned seed = first + GetParam() * designs + i;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const test::MarginDesign design = test::random_margin_design(seed);
    SCOPED_TRACE(design.text + "--min-force " + design.min_force);
    if (!hold(mechanism::parse_mechanism(design.text, "random.yaml"), design.min_force, 30)) ++open;
  }
  EXPECT_LE(open, 1 + designs / 20);
}

struct Kept {
  const char *file, *bound;
};

class KeptMarginCurves : public testing::TestWithParam<Kept> {};

TEST_P(KeptMarginCurves, HoldEveryCrossing) {
  EXPECT_TRUE(hold(mechanism::read_mechanism(source_dir() + "/" + GetParam().file), GetParam().bound, 60));
}

INSTANTIATE_TEST_SUITE_P(Files, KeptMarginCurves,
                         testing::Values(Kept{"examples/five_bar_weights.yaml", "10"},
                                         Kept{"examples/five_bar_weights.yaml", "20"},
                                         Kept{"examples/five_bar_weights.yaml", "50"},
                                         Kept{"tests/corpus/loci/five_bar_margin_by_the_rim.yaml", "50"},
                                         Kept{"tests/corpus/loci/five_bar_margin_heavy.yaml", "498/10"},
                                         Kept{"tests/corpus/loci/prrr_r_margin_sprung.yaml", "20"}));

/// Zones between margins that touch, or meet in one point, are certified and fill the workspace.
void hold_zones(const std::string& name, LociRequest request) {
  SCOPED_TRACE(name);
  const core::Zones map = find_zones(mechanism::read_mechanism(source_dir() + "/tests/corpus/loci/" + name), {request});
  EXPECT_GT(map.zones.size(), 20u);
  double sum = 0;
  for (const core::Zone& zone : map.zones) {
    EXPECT_TRUE(zone.certified) << zone.id;
    sum += zone.size;
  }
  EXPECT_NEAR(sum, map.modes.front().workspace, 1e-4 * sum);
}

TEST(ZonesBetweenMargins, OfForcesAndOfTheirPartsAlongGuides) {
  LociRequest request;
  request.min_force = 30;
  hold_zones("prrrp_margins_touch.yaml", request);
}

TEST(ZonesBetweenMargins, ThatMeetInOnePoint) {
  LociRequest request;
  request.min_force = 10;
  request.min_couple = 8;
  hold_zones("one_rail_margins_meet.yaml", request);
}

INSTANTIATE_TEST_SUITE_P(Parts, MarginCurves, testing::Range(0u, 4u));

}  // namespace
}  // namespace clearloci
