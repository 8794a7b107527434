#include "tracking/track.h"

#include <gtest/gtest.h>

#include "hand/articulated_pose.h"
#include "math/angles.h"
#include "stages/search/start_templates.h"
#include "support/adult_hand.h"

namespace barehand {
namespace {

constexpr int kLittle = 4;
constexpr double kUsualScore = 0.001, kAmbiguousScore = 0.004;  // [m]

/// A hand whose little finger is hidden and would be closed on an object if it were bent by 60 degrees.
class TrackTest : public testing::Test {
 protected:
  /// Flexion of the little finger's root [degrees] after a frame that is explained with this score.
  double flexion_after(double score) {
    // Follow a straight hand that is usually explained well.
    const HandPose straight = posed(profile_, {{palm_orientation(0.3, 0.2, 0.5), {0.02, -0.01, 0.5}}, {}});
    Track track(params_);
    track.motion.restart(straight, 0);
    track.baseline.update(kUsualScore);

    // Continue with the same pose.
    Hypothesis best;
    best.refined.pose = straight;
    best.refined.score = score;
    best.refined.matched.fill(1);
    for (int k = 0; k < 3; ++k) best.refined.matched[segment_of(kLittle, k)] = 0;
    best.refined.holds[kLittle].closed = {60 * kDegree, 60 * kDegree, 40 * kDegree};
    best.prediction.emplace();
    best.prediction->utime = 33'333;
    best.prediction->dt = 1.0 / 30;
    track.continue_with(best, profile_, params_);
    return joint_angles(profile_, track.motion.pose(), segment_of(kLittle, 0)).flexion / kDegree;
  }

  const HandProfile profile_ = *test::adult_hand(Handedness::right);
  const TrackerParams params_;
};

TEST_F(TrackTest, ClosesAHiddenFingerOnAnObject) { EXPECT_GT(flexion_after(kUsualScore), 5); }

TEST_F(TrackTest, ClosesNoFingerIfFingersMayBeConfused) { EXPECT_NEAR(flexion_after(kAmbiguousScore), 0, 1); }

TEST_F(TrackTest, OtherParametersLeaveItsStateAsItIs) {
  Track track(params_);
  track.state.start_tracking();
  TrackEvidence no_data;
  no_data.dt = 1.0 / 30;
  while (track.state.update(no_data) != TrackPhase::lost) ASSERT_NE(track.state.phase(), TrackPhase::searching);
  track.change(params_);
  EXPECT_EQ(track.state.phase(), TrackPhase::lost);
}

}  // namespace
}  // namespace barehand
