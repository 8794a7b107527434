#include "tracking/hypotheses/second_opinion.h"

#include <gtest/gtest.h>

#include "hand/articulated_pose.h"
#include "support/painted_hand.h"
#include "support/rendered_person.h"
#include "tracking/quick_tracker.h"

namespace barehand {
namespace {

/// An observed hand, and another pose that may be followed.
class SecondOpinionTest : public ::testing::Test {
 protected:
  /// Returns what comes in the frame after a second look and `n` - 1 more frames. `followed`: the pose in all of them;
  /// its hand moves by `motion` before the last one.
  std::optional<HandPose> after(int n, const HandPose& followed, const SE3& motion = {}) {
    SecondOpinion opinion(context_);
    HandObservation looked_at = *seen_;
    looked_at.second_look = std::make_shared<const DetectedHand>(test::detected_hand(*profile_, look_, 6, 0.01));
    if (by_detection_) std::swap(looked_at.second_look, looked_at.detected);
    Hypothesis hypothesis;
    hypothesis.refined = hand_.refinement.evaluate(*seen_, followed);
    EXPECT_FALSE(opinion.next(looked_at, hand_, hypothesis, ambiguous_, 0));
    for (int i = 1; i < n; ++i) EXPECT_FALSE(opinion.next(*seen_, hand_, hypothesis, false, i)) << i;
    for (SE3& segment : hypothesis.refined.pose) segment = motion * segment;
    return opinion.next(*seen_, hand_, hypothesis, false, n);
  }
  /// The pose with some fingers bent.
  HandPose with_bent(std::initializer_list<int> fingers) const {
    HandPose pose = pose_;
    for (const int finger : fingers) pose = with_finger_of(pose, bent_, finger);
    return pose;
  }

  Workers workers_{1};
  const std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  const HandPose pose_ = test::facing_pose(*profile_, 0.5), bent_ = test::facing_pose(*profile_, 0.5, 0.8);
  const HandObservationPtr seen_ = test::observe_skin(make_blended_skin(*profile_, 0.004), pose_);
  const TrackerContext context_{test::quick_tracker(), 1, workers_, make_silent_logger(), nullptr};
  const HandModel hand_{context_.params, profile_, workers_, nullptr};
  HandPose look_ = pose_;      // what the second look sees
  bool by_detection_ = false;  // whether the detection sees it, and not a second look
  bool ambiguous_ = false;     // whether the followed pose is ambiguous
};

TEST_F(SecondOpinionTest, IsABetterPoseTwoFramesLater) {
  EXPECT_FALSE(after(1, bent_));
  const auto better = after(2, bent_);
  ASSERT_TRUE(better);
  for (int s = 0; s < kSegmentCount; ++s) EXPECT_LT(((*better)[s].t - pose_[s].t).norm(), 0.003) << s;
}

TEST_F(SecondOpinionTest, MovesWithTheFollowedPalm) {
  const SE3 motion = {exp_so3({0.1, 0.2, 0.3}), {0.02, 0, 0.01}};
  const auto still = after(2, bent_), moved = after(2, bent_, motion);
  ASSERT_TRUE(still && moved);
  for (int s = 0; s < kSegmentCount; ++s) EXPECT_LT(boxminus((*moved)[s], motion * (*still)[s]).norm(), 1e-9) << s;
}

TEST_F(SecondOpinionTest, TakesTheFingerAloneThatTheLookSeesRight) {
  look_ = with_bent({3, 4});  // as a whole it is worse than what is followed
  const auto better = after(2, with_bent({1}));
  ASSERT_TRUE(better);
  for (int s = 0; s < kSegmentCount; ++s) EXPECT_LT(((*better)[s].t - pose_[s].t).norm(), 0.003) << s;

  EXPECT_FALSE(after(2, pose_));
}

TEST_F(SecondOpinionTest, OfAnAmbiguousHandIsThatOfTheDetection) {
  by_detection_ = true;
  EXPECT_FALSE(after(2, bent_));
  ambiguous_ = true;
  EXPECT_TRUE(after(2, bent_));
}

TEST_F(SecondOpinionTest, IsNoneIfTheFollowedPoseIsRight) { EXPECT_FALSE(after(2, pose_)); }

}  // namespace
}  // namespace barehand
