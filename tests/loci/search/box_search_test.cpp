#include "loci/search/box_search.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <thread>
#include <vector>

#include "loci/search/halves.hpp"

namespace clearloci::loci {
namespace {

std::vector<int> taken(BoxSearch<int> left) {
  std::vector<int> all;
  while (!left.empty()) all.push_back(left.take());
  return all;
}

TEST(BoxSearch, TakesBoxesInItsOrder) {
  for (const auto& [order, expected] : {std::pair(SearchOrder::breadth_first, std::vector{1, 2, 3}),
                                        std::pair(SearchOrder::depth_first, std::vector{3, 2, 1}),
                                        std::pair(SearchOrder::least_key_first, std::vector{2, 3, 1})}) {
    BoxSearch<int> left(order);
    left.push(1, 0.5);
    left.push(2, -0.5);
    left.push(3, 0.25);
    EXPECT_EQ(left.next().box, expected.front());
    EXPECT_EQ(taken(left), expected);
  }
}

TEST(BoxSearch, TakesOnlyBoxesOfSmallKeys) {
  BoxSearch<int> left(SearchOrder::least_key_first);
  std::mt19937 random(7);
  for (int i = 0; i < 100; ++i) left.push(i, std::uniform_real_distribution(0.0, 1.0)(random));
  const auto few = left.take(10, 2), small = left.take(100, 0.5);
  EXPECT_EQ(few.size(), 10u);
  double last = 0;
  for (const auto* const some : {&few, &small})
    for (const auto& entry : *some) {
      EXPECT_LE(last, entry.key);
      last = entry.key;
    }
  EXPECT_LT(last, 0.5);
  EXPECT_GE(left.next().key, 0.5);
  EXPECT_EQ(few.size() + small.size() + left.size(), 100u);
}

TEST(SearchMeter, EndsASearchWithItsBudget) {
  SearchMeter in_vain({.most_cells = 10, .most_cells_in_vain = 3});
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(in_vain.begin());
  EXPECT_FALSE(in_vain.begin());
  EXPECT_TRUE(in_vain.cost().out_of_cells);
  SearchMeter proving({.most_cells = 10, .most_cells_in_vain = 3});
  proving.prove();
  while (proving.begin(4)) continue;
  EXPECT_EQ(proving.cost().cells, 12);  // the last ones began when there were 8
  SearchMeter late({.deadline = std::chrono::steady_clock::now()});
  EXPECT_FALSE(late.begin());
  EXPECT_TRUE(late.cost().out_of_time);
  EXPECT_FALSE(late.cost().out_of_cells);
  SearchMeter stopped({});
  stopped.stop();
  EXPECT_FALSE(stopped.begin());
  EXPECT_FALSE(stopped.cost().out_of_time || stopped.cost().out_of_cells);
}

TEST(SearchMeter, CountsFromAnyThread) {
  SearchMeter meter({});
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 1000; ++i) meter.begin();
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(meter.cost().cells, 4000);
}

TEST(Halves, MeetAndAreTheWholeTogether) {
  const std::vector<core::Interval> box = {{0, 1}, {-2, 6}};
  const auto [low, high] = halves_of(box, 1);
  EXPECT_EQ(low[1].lower(), -2);
  EXPECT_EQ(low[1].upper(), high[1].lower());
  EXPECT_EQ(high[1].upper(), 6);
  for (const auto& half : {low, high}) EXPECT_EQ(half[0].width(), 1);
}

}  // namespace
}  // namespace clearloci::loci
