#include <gmock/gmock.h>

#include <functional>
#include <sstream>

#include "observe/egl/egl_observer.h"
#include "observe/sampled/fallback_observer.h"
#include "stages/segment_tracker/cpu_observer.h"
#include "stages/segment_tracker/make_observer.h"
#include "support/text_logger.h"
#include "tests/egl/agreement.h"
#include "tests/egl/faulty_driver.h"
#include "tests/egl/random_batch.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;

/// The lines logged so far.
struct Log {
  std::ostringstream text;
  std::shared_ptr<spdlog::logger> logger = test::text_logger(text);
  std::ptrdiff_t warnings() const {
    const std::string all = text.str();
    std::ptrdiff_t count = 0;
    for (auto at = all.find("[warning]"); at != all.npos; at = all.find("[warning]", at + 1)) ++count;
    return count;
  }
};

bool same(const PatchDistances& a, const PatchDistances& b) {
  for (int s = 0; s < kSegmentCount; ++s)
    if (!std::equal(a[s].begin(), a[s].end(), b[s].begin(), b[s].end(), [](const auto& p, const auto& q) {
          return p.distance == q.distance && p.counted == q.counted && p.total == q.total;
        }))
      return false;
  return true;
}

class LostDevice : public ::testing::Test {
 protected:
  PatchDistances compared(Observer& observer) {
    PatchDistances distances;
    observer.compare(world_.batch(), distances);
    return distances;
  }
  PatchDistances by_cpu() {
    CpuObserver cpu(kCap, workers_);
    return compared(cpu);
  }
  const RandomBatch world_ = random_batch(1, 40);
  Workers workers_{1};
  Log log_;
};

/// A device that works a given number of times, then fails and leaves an incomplete result.
class FailingDevice final : public DeviceObserver {
 public:
  explicit FailingDevice(int good_calls) : good_calls_(good_calls) {}
  Result<void> compare(const SampleBatch&, PatchDistances& distances) override {
    for (auto& of_segment : distances) of_segment.assign(1, {1, 2, 3});
    if (good_calls_-- > 0) return {};
    return fail("gone", "device");
  }

 private:
  int good_calls_;
};

TEST_F(LostDevice, ItsBatchAndAllLaterOnesGoToTheOtherObserver) {
  FallbackObserver observer(std::make_unique<FailingDevice>(1), std::make_unique<CpuObserver>(kCap, workers_),
                            log_.logger);
  EXPECT_FALSE(same(compared(observer), by_cpu()));
  EXPECT_EQ(log_.warnings(), 0);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(same(compared(observer), by_cpu()));
  EXPECT_EQ(log_.warnings(), 1);
  EXPECT_THAT(log_.text.str(), HasSubstr("device: gone"));
}

/// Tests what happens if a real driver fails while it is used.
class LostDriver : public LostDevice {
 protected:
  /// Compares three batches; calls `trouble`, which makes the driver fail, before the second one.
  void expect_fallback(const std::function<void()>& trouble, const std::string& reason) {
    FallbackObserver observer(open_observer(kCap, FaultyDriver::load), std::make_unique<CpuObserver>(kCap, workers_),
                              log_.logger);
    EXPECT_LE(disagreement(compared(observer), by_cpu()), kNearAnEdge);
    EXPECT_EQ(driver_.dispatched, 1);
    EXPECT_EQ(log_.warnings(), 0) << log_.text.str();
    trouble();
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(same(compared(observer), by_cpu()));
    EXPECT_EQ(log_.warnings(), 1) << log_.text.str();
    EXPECT_THAT(log_.text.str(), HasSubstr(reason));
  }
  FaultyDriver driver_;
};

TEST_F(LostDriver, ContextThatIsLost) {
  expect_fallback([&] { driver_.reset = GL_GUILTY_CONTEXT_RESET; }, "context was lost");
  EXPECT_EQ(driver_.threads_released, 1) << "the thread of a lost context ends";
}

TEST_F(LostDriver, ContextThatIsLostWithoutAResetStatus) {
  expect_fallback([&] { driver_.error = GL_CONTEXT_LOST; }, "context was lost");
}

TEST_F(LostDriver, ErrorOfTheDriver) {
  expect_fallback([&] { driver_.error = GL_OUT_OF_MEMORY; }, "error 0x0505");
  EXPECT_EQ(driver_.threads_released, 1);
}

TEST_F(LostDriver, FenceThatHangs) {
  expect_fallback([&] { driver_.fences_hang = true; }, "has not finished within 300.0 s");
  EXPECT_EQ(driver_.threads_released, 1);
}

TEST_F(LostDriver, CallThatDoesNotReturnIsAbandonedAndItsThreadEndsLater) {
  DeviceLimits limits = patient_limits();
  limits.call = std::chrono::milliseconds(2000);
  driver_.dispatch_blocks = true;
  auto observer = std::make_unique<FallbackObserver>(open_observer(kCap, FaultyDriver::load, limits),
                                                     std::make_unique<CpuObserver>(kCap, workers_), log_.logger);
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(same(compared(*observer), by_cpu()));
  EXPECT_EQ(log_.warnings(), 1) << log_.text.str();
  EXPECT_THAT(log_.text.str(), HasSubstr("has not returned from a call within 2.0 s"));
  observer.reset();
  EXPECT_EQ(driver_.threads_released, 0) << "the driver still has it";

  // When the blocked call continues, all objects that it uses must still exist.
  driver_.let_go();
  driver_.wait_for_thread_release();
  EXPECT_EQ(driver_.dispatched, 1);
  EXPECT_EQ(driver_.released, 1);
}

TEST_F(LostDriver, BuffersThatCannotBeMapped) {
  driver_.mapping_fails = true;
  const auto device = open_observer(kCap, FaultyDriver::load);
  PatchDistances distances;
  for (int i = 0; i < 2; ++i) {  // later calls report the same reason
    const auto done = device->compare(world_.batch(), distances);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message(), HasSubstr("a buffer cannot be mapped"));
  }
}

TEST_F(LostDevice, AutoNeverTakesSoftware) {
  SegmentTrackerParams params;
  ASSERT_EQ(params.observer, "auto");
  params.pixel_distance_cap = kCap;
  const auto observer = make_observer(params, workers_, log_.logger);
  const bool gpu = EglObserver::open(kCap, DeviceChoice::hardware).has_value();
  EXPECT_EQ(dynamic_cast<CpuObserver*>(observer.get()) == nullptr, gpu);
  EXPECT_EQ(log_.text.str().empty(), !gpu);
}

}  // namespace
}  // namespace barehand
