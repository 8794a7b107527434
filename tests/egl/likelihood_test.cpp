#include <gtest/gtest.h>

#include <cmath>

#include "core/log.h"
#include "observe/sampled/fallback_observer.h"
#include "stages/segment_tracker/segment_tracker.h"
#include "support/scene.h"
#include "tests/egl/agreement.h"

namespace barehand {
namespace {

/// Samples of one level for every segment, around an upright capsule whose left half is behind an object.
SegmentSamples sample_by(std::shared_ptr<Observer> observer, bool observe_palm) {
  SegmentTrackerParams params;
  params.samples = 200;
  params.observe_palm = observe_palm;
  Workers workers(1);
  const auto surface = std::make_shared<HandSurface>(make_cylinder_surface(capsule_profile(), 100));
  SegmentTracker tracker(params, surface, workers, std::move(observer));
  HandPose predicted;
  predicted.fill(upright_pose());
  Vector6d box;
  box << 0.008, 0.008, 0.008, 0.3, 0.3, 0.3;
  Proposals proposals;
  proposals.fill({{upright_pose(), box}});
  const Intrinsics camera = small_camera();
  const HandObservation o = make_observation(camera, [&](int u, int v) {
    return u < 48 ? ScenePixel{0.37f, PixelLabel::object} : upright_capsule(camera, u, v);
  });
  return tracker.sample(tracker.prepare(o, predicted), proposals, {1, 0, 4, 5});
}

class EglLikelihood : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(ObservePalm, EglLikelihood, ::testing::Bool());

TEST_P(EglLikelihood, IsThatOfTheCpu) {
  const SegmentSamples cpu = sample_by(nullptr, GetParam());
  const SegmentSamples egl = sample_by(
      std::make_shared<FallbackObserver>(open_observer(distance_cap({})), nullptr, make_silent_logger()), GetParam());
  int different = 0;
  double spread = 0;
  for (int s = 0; s < kSegmentCount; ++s)
    for (std::size_t i = 0; i < cpu.log_likelihood[s].size(); ++i) {
      // 0.1 um at the largest distance, 8 mm, and the last level's sigma, 1 mm, is 0.0016 in log L (Eq. 3).
      different += std::abs(cpu.log_likelihood[s][i] - egl.log_likelihood[s][i]) > 0.002;
      spread = std::max(spread, -cpu.log_likelihood[s][i]);
    }
  EXPECT_LE(different, 6);  // of 3200: samples with a point on a pixel's edge
  EXPECT_GT(spread, 5);
  EXPECT_NE(cpu.log_likelihood, egl.log_likelihood) << "the CPU was compared with itself";
}

}  // namespace
}  // namespace barehand
