// Tests which functions of the driver the observer calls, how often and on which thread.
#include <gtest/gtest.h>

#include <thread>

#include "observe/egl/egl_observer.h"
#include "tests/egl/agreement.h"
#include "tests/egl/faulty_driver.h"
#include "tests/egl/random_batch.h"

namespace barehand {
namespace {

class DriverCalls : public ::testing::Test {
 protected:
  std::unique_ptr<EglObserver> open() { return open_observer(kCap, FaultyDriver::load); }
  FaultyDriver driver_;
};

TEST_F(DriverCalls, AContextIsMadeCurrentOncePerThread) {
  const RandomBatch world = random_batch(1, 10);
  auto observer = open();
  for (int map_id = 1; map_id <= 3; ++map_id)
    for (int level = 0; level < 3; ++level) by_egl(*observer, world.batch(map_id));
  std::jthread([&] { by_egl(*observer, world.batch(4)); }).join();
  EXPECT_EQ(driver_.dispatched, 10);
  EXPECT_EQ(driver_.made_current, 1);
  EXPECT_EQ(driver_.released + driver_.threads_released, 0);

  observer.reset();
  EXPECT_EQ(driver_.made_current, 1);
  EXPECT_EQ(driver_.released, 1);
  EXPECT_EQ(driver_.threads_released, 1);

  // All calls are made on one thread, which is none of those that use the observer.
  EXPECT_EQ(driver_.threads().size(), 1u);
  EXPECT_FALSE(driver_.threads().contains(std::this_thread::get_id()));
}

TEST_F(DriverCalls, EveryObserverHasItsThread) {
  const RandomBatch world = random_batch(1, 10);
  const auto a = open(), b = open();
  by_egl(*a, world.batch());
  by_egl(*b, world.batch());
  by_egl(*a, world.batch());
  EXPECT_EQ(driver_.made_current, 2);
  EXPECT_EQ(driver_.threads().size(), 2u);
}

TEST_F(DriverCalls, BuffersOnlyGrow) {
  for (const bool stays_mapped : {true, false}) {
    driver_.stays_mapped = stays_mapped;
    const auto observer = open();
    const RandomBatch large = random_batch(1, 60), small = random_batch(2, 20), larger = random_batch(3, 200);
    by_egl(*observer, large.batch(1));
    const int made = driver_.buffers_made;
    EXPECT_GT(made, 0);
    by_egl(*observer, small.batch(2));
    by_egl(*observer, large.batch(3));
    EXPECT_EQ(driver_.buffers_made, made);
    EXPECT_LE(disagreement(by_egl(*observer, larger.batch(4)), by_cpu(larger)), kNearAnEdge);
    EXPECT_GT(driver_.buffers_made, made);
  }
}

TEST_F(DriverCalls, WithoutBuffersThatStayMappedResultsAreTheSame) {
  const RandomBatch world = random_batch(1, 150);
  const PatchDistances mapped = by_egl(*open(), world.batch());
  const int made = driver_.buffers_made;
  driver_.stays_mapped = false;
  EXPECT_EQ(disagreement(by_egl(*open(), world.batch()), mapped), 0);
  EXPECT_LT(driver_.buffers_made - made, made) << "the other way was not taken";
}

}  // namespace
}  // namespace barehand
