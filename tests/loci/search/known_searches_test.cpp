// A curve traced again with another tolerance: searched once, and drawn as if it had not been known.
#include "loci/search/known_searches.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "loci/curves/trace_sheet.hpp"
#include "loci/search/isolated_zeros.hpp"
#include "tests/loci/sheet_cases.hpp"

namespace clearloci::loci::sheet {
namespace {

using testing::Ring;

const Ring r{2};

core::Polynomial circle(const core::Rational& x) { return (r.x() - r(x)) * (r.x() - r(x)) + r.y() * r.y() - r(1); }

TEST(KnownSearches, SearchACurveOnce) {
  KnownSearches searches;
  int searched = 0;  // colours are asked for while a curve is searched
  const auto traced = [&](const core::Polynomial& curve, const core::Polynomial& cutter, double tolerance,
                          KnownSearches* kept) {
    SheetTraceOptions options;
    options.tolerance = tolerance;
    options.searches = kept;
    options.colour = [&](const core::Point2&) { return ++searched, 0; };
    return trace_sheet(testing::plane(), {}, {-3, -3}, {3, 3}, {curve}, {Cutter{{cutter}}}, options);
  };
  std::vector<SheetTrace> kept;
  for (const double tolerance : {1e-4, 1e-5, 1e-6}) {
    kept.push_back(traced(circle(0), circle(1), tolerance, &searches));
    EXPECT_EQ(searched, 2);  // arcs, which the other circle cuts
  }
  searched = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const SheetTrace fresh = traced(circle(0), circle(1), i == 0 ? 1e-4 : i == 1 ? 1e-5 : 1e-6, nullptr);
    ASSERT_EQ(fresh.arcs.size(), 2u);
    ASSERT_EQ(kept[i].arcs.size(), 2u);
    for (std::size_t a = 0; a < 2; ++a) {
      EXPECT_EQ(kept[i].arcs[a].arc.points, fresh.arcs[a].arc.points);
      EXPECT_EQ(kept[i].arcs[a].arc.ends, fresh.arcs[a].arc.ends);
    }
    EXPECT_TRUE(kept[i].certified);
  }
  EXPECT_EQ(searched, 6);
  EXPECT_LT(2 * kept[0].arcs[0].arc.points.size(), kept[1].arcs[0].arc.points.size());
  // Another cutter, another search.
  searched = 0;
  EXPECT_EQ(traced(circle(0), circle(core::Rational(3, 2)), 1e-4, &searches).arcs.size(), 2u);
  EXPECT_EQ(searched, 2);
}

TEST(KnownSearches, TellZeroSetsApart) {
  KnownSearches searches;
  const auto zeros = [&](const core::Polynomial& first, const core::Polynomial& second) {
    ZeroOptions options;
    options.searches = &searches;
    return isolated_zeros(testing::plane(), {}, first, second, {-3, -3}, {3, 3}, options).zeros;
  };
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(zeros(circle(0), circle(1)).size(), 2u);
    EXPECT_EQ(zeros(circle(0), r.y()).size(), 2u);
    EXPECT_EQ(zeros(circle(0), circle(core::Rational(5, 2))).size(), 0u);
  }
  EXPECT_NEAR(zeros(circle(0), circle(1))[0].x, 0.5, 1e-12);
}

// Of threads that ask for the same the first one searches; what fails does so for all.
TEST(KnownSearches, FindOnceForAllThreads) {
  using Key = KnownSearches::Key;
  KnownSearches searches;
  std::atomic<int> found = 0, failed = 0;
  const Key key = KnownSearches::key(Key::Kind::curve, testing::plane(), {}, {0, 0}, {1, 1});
  const Key other = KnownSearches::key(Key::Kind::zeros, testing::plane(), {}, {0, 0}, {1, 1});
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&] {
      const std::shared_ptr<const int> result = searches.get<int>(key, [&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        return std::make_shared<const int>(++found);
      });
      EXPECT_EQ(*result, 1);
      try {
        searches.get<int>(other, []() -> std::shared_ptr<const int> { throw std::runtime_error("none"); });
      } catch (const std::runtime_error&) {
        ++failed;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(found, 1);
  EXPECT_EQ(failed, 8);
}

// A star that is known beforehand changes what is found.
TEST(KnownSearches, TellStarsApart) {
  using Key = KnownSearches::Key;
  const auto key = [](const std::vector<Star>& stars) {
    return KnownSearches::key(Key::Kind::curve, testing::plane(), {}, {0, 0}, {1, 1}, stars);
  };
  Star star;
  star.x = 1;
  star.y = 2;
  star.roots = {0};
  const Key one = key({star});
  EXPECT_EQ(key({star}), one);
  EXPECT_FALSE(key({}) == one);
  star.singular = true;
  EXPECT_FALSE(key({star}) == one);
  star.singular = false;
  star.apex = Apex{core::Rational(1, 100), 0, {{core::Rational(1), core::Rational(0), true}}};
  const Key enclosed = key({star});
  EXPECT_FALSE(enclosed == one);
  star.apex->slope_radius = core::Rational(1, 1000);
  EXPECT_FALSE(key({star}) == enclosed);
}

}  // namespace
}  // namespace clearloci::loci::sheet
