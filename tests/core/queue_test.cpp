#include "core/queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <numeric>
#include <thread>
#include <vector>

namespace barehand {
namespace {

template <typename T>
bool balanced(const BoundedQueue<T>& queue) {
  const QueueHealth h = queue.health();
  return h.pushed == h.popped + h.dropped + static_cast<std::int64_t>(h.depth);
}

TEST(BoundedQueue, KeepsOrder) {
  BoundedQueue<int> queue("q", 3, Overflow::block);
  for (int i : {1, 2, 3}) EXPECT_TRUE(queue.push(i));
  for (int i : {1, 2, 3}) EXPECT_EQ(queue.pop(), i);
}

TEST(BoundedQueue, DropsTheOldestAndCountsIt) {
  BoundedQueue<int> queue("q", 2, Overflow::drop_oldest);
  for (int i = 0; i < 5; ++i) queue.push(i);
  EXPECT_EQ(queue.health().dropped, 3);
  EXPECT_EQ(queue.health().depth, 2u);
  EXPECT_TRUE(balanced(queue));
  EXPECT_EQ(queue.pop(), 3);
  EXPECT_EQ(queue.pop(), 4);
  EXPECT_TRUE(balanced(queue));
}

TEST(BoundedQueue, BlockingProducerLosesNothing) {
  BoundedQueue<int> queue("q", 2, Overflow::block);
  std::jthread producer([&] {
    for (int i = 0; i < 1000; ++i) queue.push(i);
    queue.close();
  });
  std::vector<int> received;
  while (auto item = queue.pop()) received.push_back(*item);
  std::vector<int> expected(1000);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(received, expected);
  EXPECT_EQ(queue.health().dropped, 0);
  EXPECT_TRUE(balanced(queue));
}

TEST(BoundedQueue, CloseLetsConsumersDrain) {
  BoundedQueue<int> queue("q", 2, Overflow::block);
  queue.push(7);
  queue.close();
  EXPECT_FALSE(queue.push(8));
  EXPECT_EQ(queue.pop(), 7);
  EXPECT_EQ(queue.pop(), std::nullopt);
  EXPECT_EQ(queue.health().pushed, 1);
}

TEST(BoundedQueue, PopWithinGivesUpAndDrainedSaysWhenItIsOver) {
  BoundedQueue<int> queue("test", 2, Overflow::block);
  EXPECT_FALSE(queue.pop_within(std::chrono::milliseconds(1)));
  EXPECT_FALSE(queue.drained());
  queue.push(7);
  queue.close();
  EXPECT_FALSE(queue.drained()) << "an item is left";
  EXPECT_EQ(queue.pop_within(std::chrono::milliseconds(1)), 7);
  EXPECT_TRUE(queue.drained());
}

TEST(BoundedQueue, CloseWakesBlockedProducerAndConsumer) {
  // A producer waits for space, a consumer for an item.
  BoundedQueue<int> full("full", 1, Overflow::block), empty("empty", 1, Overflow::block);
  full.push(1);
  std::latch running(2);
  bool pushed = true;
  std::optional<int> popped = 0;

  // Closing wakes both.
  {
    std::jthread producer([&] { running.count_down(), pushed = full.push(2); });
    std::jthread consumer([&] { running.count_down(), popped = empty.pop(); });
    running.wait();
    full.close();
    empty.close();
  }
  EXPECT_FALSE(pushed);
  EXPECT_EQ(popped, std::nullopt);
}

TEST(BoundedQueue, CountsHoldWithManyThreads) {
  for (const Overflow overflow : {Overflow::block, Overflow::drop_oldest}) {
    BoundedQueue<int> queue("q", 3, overflow);

    // Several producers and consumers at once.
    std::atomic<int> received = 0;
    {
      std::vector<std::jthread> consumers, producers;
      for (int t = 0; t < 3; ++t)
        consumers.emplace_back([&] {
          while (queue.pop()) ++received;
        });
      for (int t = 0; t < 3; ++t)
        producers.emplace_back([&] {
          for (int i = 0; i < 500; ++i) queue.push(i);
        });

      // The consumers end when the queue is closed and empty.
      producers.clear();
      queue.close();
    }

    // The counts agree; a blocking queue loses nothing.
    const QueueHealth health = queue.health();
    EXPECT_EQ(health.pushed, 1500);
    EXPECT_EQ(health.popped, received);
    EXPECT_EQ(health.depth, 0u);
    EXPECT_TRUE(balanced(queue));
    if (overflow == Overflow::block) {
      EXPECT_EQ(received, 1500);
    }
  }
}

}  // namespace
}  // namespace barehand
