#include "observe/egl/egl_observer.h"

#include <gmock/gmock.h>

#include <limits>
#include <thread>

#include "tests/egl/agreement.h"
#include "tests/egl/random_batch.h"

namespace barehand {
namespace {

constexpr float kUncapped = std::numeric_limits<float>::infinity();

TEST(EglObserver, AgreesWithTheCpu) {
  for (const auto& [cap, skin_points] : {std::pair{kCap, 83}, {kUncapped, 83}, {kCap, 3}, {kCap, 256}}) {
    const RandomBatch world = random_batch(1, 150, skin_points);
    const PatchDistances expected = by_cpu(world, cap);
    EXPECT_LE(disagreement(by_egl(*open_observer(cap), world.batch()), expected), kNearAnEdge)
        << skin_points << " points, cap " << cap;
    EXPECT_GT(disagreement(by_cpu(world, 0.9f * kCap), expected), 0.5);  // the check can fail
  }
}

TEST(EglObserver, SegmentsBeforeTheFirstAreLeftOut) {
  const RandomBatch world = random_batch(2, 20);
  const PatchDistances distances = by_egl(*open_observer(), world.batch(1, 3));
  for (int s = 0; s < 3; ++s)
    for (const PatchDistance& patch : distances[s]) EXPECT_EQ(patch.total, 0);
  EXPECT_LE(disagreement(distances, by_cpu(world, kCap, 3)), kNearAnEdge);
}

TEST(EglObserver, ANewIdBringsTheNewMap) {
  RandomBatch first = random_batch(3, 20), second = random_batch(4, 60);
  second.surface = first.surface;
  const auto observer = open_observer();
  by_egl(*observer, first.batch(1));
  EXPECT_LE(disagreement(by_egl(*observer, second.batch(2)), by_cpu(second)), kNearAnEdge);
  EXPECT_GT(disagreement(by_egl(*observer, first.batch(2)), by_cpu(first)),
            0.5);  // the second map is still in the device's memory
  EXPECT_LE(disagreement(by_egl(*observer, first.batch(1)), by_cpu(first)), kNearAnEdge);
}

TEST(EglObserver, ANewSkinBringsItsMap) {
  const RandomBatch first = random_batch(3, 20, 50), second = random_batch(4, 20, 90);
  const auto observer = open_observer();
  by_egl(*observer, first.batch(1));
  EXPECT_LE(disagreement(by_egl(*observer, second.batch(1)), by_cpu(second)), kNearAnEdge);
}

TEST(EglObserver, ThreadsMayTakeTurns) {
  const RandomBatch world = random_batch(5, 30);
  const auto observer = open_observer();
  const PatchDistances here = by_egl(*observer, world.batch());
  PatchDistances there;
  std::jthread([&] { there = by_egl(*observer, world.batch()); }).join();
  EXPECT_EQ(disagreement(here, there), 0);
}

TEST(EglObserver, TwoInOneProcessKeepApart) {
  const RandomBatch a = random_batch(6, 20, 50), b = random_batch(7, 20, 90);
  const auto observer_a = open_observer(), observer_b = open_observer();
  by_egl(*observer_a, a.batch());
  by_egl(*observer_b, b.batch());
  EXPECT_LE(disagreement(by_egl(*observer_a, a.batch()), by_cpu(a)), kNearAnEdge);
}

TEST(EglObserver, WithoutEglThereIsNone) {
  const auto observer = EglObserver::open(kCap, DeviceChoice::any, "libnone.so.1");
  ASSERT_FALSE(observer);
  EXPECT_THAT(observer.error().message(), ::testing::HasSubstr("libnone.so.1"));
  EXPECT_THAT(observer.error().remedy, ::testing::HasSubstr("libegl1"));
}

TEST(EglObserver, SaysWhatItRunsOn) {
  const auto observer = open_observer();
  EXPECT_FALSE(observer->device().renderer.empty());
  EXPECT_THAT(observer->device().version, ::testing::HasSubstr("OpenGL ES 3"));
}

}  // namespace
}  // namespace barehand
