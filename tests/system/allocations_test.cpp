// Tests that processing a frame allocates no memory from the heap in the steady state.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "stages/contact/contact_stage.h"
#include "stages/preprocess/preprocess.h"
#include "stages/publish/hand_messages.h"
#include "support/adult_hand.h"
#include "support/painted_frame.h"
#include "tracking/two_hand_tracker.h"

namespace {
std::atomic<std::int64_t> allocations = 0;
}

[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* block = std::malloc(size)) return block;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto unit = static_cast<std::size_t>(alignment);
  if (void* block = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) return block;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* block) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }

namespace barehand {
namespace {

struct Counts {
  double preprocess = 0, track = 0, contact = 0, publish = 0;
};

/// The mean number of allocations per frame while a swaying hand is tracked, after a warm-up. `hands` is the number of
/// hands that the tracker searches for; only the first one is in view.
Counts allocations_per_frame(TrackerParams params, int hands = 1) {
  params.shape_fit.scans = 0;                 // a scan of the hand is no steady state
  constexpr int kWarmUp = 40, kCounted = 20;  // two swings of the hand, and one
  const Intrinsics camera{320, 240, 262.5, 262.5, 159.5, 119.5};
  auto measured = std::make_shared<HandProfile>(*test::adult_hand());
  measured->origin = ProfileOrigin::measured;  // fitting a mean hand to the person is no steady state either
  const std::shared_ptr<const HandProfile> profile = measured;
  const Skin skin = make_blended_skin(*profile, 0.004);
  Workers workers(1);
  Preprocessor preprocessor({}, hands);
  TwoHandTracker tracker(params, TwoHandTracker::Profiles(hands, profile), 1, workers);
  ContactStage contact({});
  HandMessageMaker maker({});
  HandPose pose = test::facing_pose(*profile, 0.5, 0.4);
  tracker.start_at(0, pose);
  HandEstimates estimates;
  Counts counts;
  for (int k = 0; k < kWarmUp + kCounted; ++k) {
    for (SE3& T : pose) T.t.x() += k % 20 < 10 ? 0.001 : -0.001;
    const std::shared_ptr<RgbdFrame> frame = test::paint_frame(skin, pose, camera);
    frame->utime = k * 33'000;
    frame->sensor = "left";
    const std::int64_t start = allocations;
    HandObservations observations = preprocessor.process(frame, estimates).value();
    const std::int64_t preprocessed = allocations;
    estimates = tracker.process(observations);
    const std::int64_t tracked = allocations;
    const FrameContactsPtr contacts = contact.process(observations, estimates).value();
    const std::int64_t touched = allocations;
    for (const HandEstimatePtr& estimate : estimates) maker.process(*estimate);
    if (k < kWarmUp) continue;
    EXPECT_EQ(estimates[0]->status, TrackStatus::tracking);
    counts.preprocess += static_cast<double>(preprocessed - start) / kCounted;
    counts.track += static_cast<double>(tracked - preprocessed) / kCounted;
    counts.contact += static_cast<double>(touched - tracked) / kCounted;
    counts.publish += static_cast<double>(allocations - touched) / kCounted;
  }
  return counts;
}

TEST(Allocations, AreCounted) {
  const std::int64_t before = allocations;
  auto made = std::make_unique<int>(1);
  EXPECT_EQ(allocations - before, 1);
}

/// The bound is not zero because a buffer may still grow for a frame with more data than all before. An allocation in
/// every frame would give 1 or more.
void expect_none(const Counts& counts) {
  EXPECT_LT(counts.preprocess, 0.25);
  EXPECT_LT(counts.track, 0.25);
  EXPECT_LT(counts.contact, 0.25);
  EXPECT_LT(counts.publish, 0.25);
}

TEST(Allocations, AreNoneInSteadyState) { expect_none(allocations_per_frame({})); }

TEST(Allocations, AreNoneWithoutSampling) {
  TrackerParams params;
  params.sampling = false;
  expect_none(allocations_per_frame(params));
}

TEST(Allocations, AreNoneWhereSamplesAreComparedThroughEgl) {
  TrackerParams params;
  params.segment_tracker.observer = "egl";
  expect_none(allocations_per_frame(params));
}

TEST(Allocations, AreNoneWhileASecondHandIsAway) { expect_none(allocations_per_frame({}, 2)); }

}  // namespace
}  // namespace barehand
