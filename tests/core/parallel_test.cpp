#include "core/parallel.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>
#include <vector>

namespace barehand {
namespace {

TEST(Workers, EveryIndexOnce) {
  for (const int threads : {1, 2, 4}) {
    Workers workers(threads);
    std::vector<int> calls(1000, 0);
    workers.for_each_index(1000, [&](int i) { ++calls[i]; });
    EXPECT_EQ(calls, std::vector<int>(1000, 1)) << threads;
  }
}

TEST(Workers, OneThreadRunsInlineAndInOrder) {
  Workers workers(1);
  std::vector<int> order;
  const auto self = std::this_thread::get_id();
  workers.for_each_index(5, [&](int i) {
    EXPECT_EQ(std::this_thread::get_id(), self);
    order.push_back(i);
  });
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(Workers, NothingToDoForZero) {
  Workers workers(2);
  workers.for_each_index(0, [](int) { FAIL(); });
}

TEST(Workers, MayBeNestedAndSharedByThreads) {
  Workers workers(3);
  std::vector<std::vector<int>> counts(2, std::vector<int>(64, 0));
  {
    std::vector<std::jthread> callers;
    for (int t = 0; t < 2; ++t)
      callers.emplace_back([&, t] {
        workers.for_each_index(
            8, [&](int i) { workers.for_each_index(8, [&](int j) { counts[t][8 * i + j] = 8 * i + j; }); });
      });
  }
  for (const auto& count : counts)
    for (int i = 0; i < 64; ++i) EXPECT_EQ(count[i], i);
}

TEST(Workers, ExceptionReachesTheCaller) {
  for (const int threads : {1, 3}) {
    Workers workers(threads);
    EXPECT_THROW(workers.for_each_index(9, [](int i) { i == 5 ? throw std::runtime_error("five") : void(); }),
                 std::runtime_error);
  }
}

TEST(Workers, RefusesAbsurdCounts) {
  for (const int threads : {0, -1, 257, 1 << 30}) EXPECT_FALSE(make_workers(threads)) << threads;
  ASSERT_TRUE(make_workers(2));
  EXPECT_EQ((*make_workers(2))->threads(), 2);
}

}  // namespace
}  // namespace barehand
