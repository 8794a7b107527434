#include "core/parallel/parallel.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

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

TEST(Workers, DoAsideBeforeTheyReturnWhereNothingIsLive) {
  for (const int threads : {1, 3}) {
    Workers workers(threads);
    std::thread::id where;
    int cores = 0;
    bool known = false;
    EXPECT_FALSE(workers.does_long_work());
    auto result = workers.run_in_background([&](Workers& w) {
      known = workers.does_long_work();
      where = std::this_thread::get_id();
      cores = w.threads();
      return 7;
    });

    // The task ran on this thread, with all cores, and is finished.
    EXPECT_TRUE(known);
    EXPECT_FALSE(workers.does_long_work());
    EXPECT_EQ(where, std::this_thread::get_id());
    EXPECT_EQ(cores, threads);
    ASSERT_EQ(result.wait_for(std::chrono::seconds(0)), std::future_status::ready);
    EXPECT_EQ(result.get(), 7);
  }
}

TEST(Workers, DoAsideMeanwhileAndGiveWayWhereFramesComeByThemselves) {
  Workers workers(2);
  workers.go_live();
  std::promise<void> returned;
  auto result = workers.run_in_background([&](Workers& alone) {
    returned.get_future().wait();  // would never end if run_in_background() waited for it
    EXPECT_FALSE(workers.does_long_work()) << "nobody waits for it";
    EXPECT_EQ(alone.threads(), 1);
    return getpriority(PRIO_PROCESS, static_cast<id_t>(gettid()));
  });
  returned.set_value();
  EXPECT_EQ(result.get(), 19);
  EXPECT_LT(getpriority(PRIO_PROCESS, static_cast<id_t>(gettid())), 19);
}

TEST(Workers, WhatIsDoneAsideThrowsWhereItIsAskedFor) {
  for (const bool live : {false, true}) {
    Workers workers(1);
    if (live) workers.go_live();
    auto result = workers.run_in_background([](Workers&) -> int { throw std::runtime_error("no"); });
    EXPECT_THROW(result.get(), std::runtime_error) << live;
  }
}

TEST(Workers, RefusesAbsurdCounts) {
  for (const int threads : {0, -1, 257, 1 << 30}) EXPECT_FALSE(make_workers(threads)) << threads;
  ASSERT_TRUE(make_workers(2));
  EXPECT_EQ((*make_workers(2))->threads(), 2);
}

}  // namespace
}  // namespace barehand
