#include <gmock/gmock.h>

#include <sstream>

#include "observe/egl/egl_functions.h"
#include "observe/egl/egl_observer.h"
#include "observe/fallback_observer.h"
#include "stages/segment_tracker/cpu_observer.h"
#include "stages/segment_tracker/make_observer.h"
#include "support/text_logger.h"
#include "tests/egl/random_batch.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;
constexpr float kCap = 0.008f;

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

/// Every graphics device drops out of this process, as far as EGL is concerned.
void take_displays_away() {
  const auto egl = load_egl(kEglLibrary);
  ASSERT_TRUE(egl);
  const auto terminate = reinterpret_cast<PFNEGLTERMINATEPROC>(egl->GetProcAddress("eglTerminate"));
  for (EGLDisplay display : find_displays(*egl, true)) ASSERT_TRUE(terminate(display));
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

/// Works a given number of times, then fails and leaves half a result behind.
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

TEST_F(LostDevice, ContextThatIsLostInMidStream) {
  SegmentTrackerParams params;
  params.observer = "egl";
  params.pixel_distance_cap = kCap;
  const auto observer = make_observer(params, workers_, log_.logger);
  compared(*observer);
  EXPECT_EQ(log_.warnings(), 0) << log_.text.str();
  take_displays_away();
  EXPECT_TRUE(same(compared(*observer), by_cpu()));
  EXPECT_EQ(log_.warnings(), 1) << log_.text.str();
}

TEST_F(LostDevice, AutoNeverTakesSoftware) {
  SegmentTrackerParams params;
  ASSERT_EQ(params.observer, "auto");
  params.pixel_distance_cap = kCap;
  const auto observer = make_observer(params, workers_, log_.logger);
  const bool gpu = find_graphics_device(DeviceChoice::hardware).has_value();
  EXPECT_EQ(dynamic_cast<CpuObserver*>(observer.get()) == nullptr, gpu);
  EXPECT_EQ(log_.text.str().empty(), !gpu);
}

}  // namespace
}  // namespace barehand
