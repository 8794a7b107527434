#include "tracking/two_hand_tracker.h"

#include <gtest/gtest.h>

#include <sstream>
#include <utility>

#include "hand/skin.h"
#include "support/painted_hand.h"
#include "support/rendered_person.h"
#include "support/text_logger.h"
#include "tracking/quick_tracker.h"

namespace barehand {
namespace {

/// A tracker of a right and a left hand, and an observation of each.
class TwoHandTrackerTest : public ::testing::Test {
 protected:
  enum Side { kRight, kLeft };
  static constexpr double kRightX = 0.1, kLeftX = -0.1;

  /// The observation of a hand with its wrist at `x` [m].
  static HandObservationPtr seen(const HandProfile& profile, double flexion, double x) {
    HandPose pose = test::facing_pose(profile, 0.5, flexion);
    for (SE3& T : pose) T.t.x() += x;
    return test::observe_skin(make_blended_skin(profile, 0.004), pose);
  }
  static HandObservationPtr nothing() { return std::make_shared<HandObservation>(); }
  static HandObservationPtr at(std::int64_t utime, const HandObservation& observation, bool followed) {
    const auto copy = test::stamped(observation, utime);
    copy->followed = followed;
    return copy;
  }
  /// Processes the next frame; `followed`: preprocessing found the k-th hand where the feedback predicted it.
  HandEstimates next(TwoHandTracker& tracker, const HandObservationPtr& first, const HandObservationPtr& second,
                     std::array<bool, 2> followed) {
    utime_ += 33'000;
    HandObservations observations;
    for (const HandObservationPtr& o : {first, second})
      observations.push_back(at(utime_, *o, followed[observations.size()]));
    return tracker.process(observations);
  }
  HandEstimates next(TwoHandTracker& tracker, const HandObservationPtr& only) {
    HandObservations observations{at(utime_ += 33'000, *only, false)};
    return tracker.process(observations);
  }
  HandEstimates next_times(int frames, TwoHandTracker& tracker, const HandObservationPtr& first,
                           const HandObservationPtr& second, std::array<bool, 2> followed = {}) {
    HandEstimates last;
    for (int i = 0; i < frames; ++i) last = next(tracker, first, second, followed);
    return last;
  }

  const std::shared_ptr<const HandProfile> right_ = test::adult_hand();
  const std::shared_ptr<const HandProfile> left_ = test::adult_hand(Handedness::left);
  const HandObservationPtr right_hand_ = seen(*right_, 0.2, kRightX), left_hand_ = seen(*left_, 0.5, kLeftX);
  Workers workers_{1};
  TwoHandTracker tracker_{test::quick_tracker(), {right_, left_}, 1, workers_};
  std::int64_t utime_ = 1'000'000;
};

TEST_F(TwoHandTrackerTest, EveryHandFindsItsSideWhateverTheOrder) {
  HandEstimates found;
  for (int i = 0; i < 6 && (i == 0 || found[kRight]->status != TrackStatus::tracking); ++i)
    found = next_times(1, tracker_, left_hand_, right_hand_);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[kRight]->status, TrackStatus::tracking);
  EXPECT_EQ(found[kLeft]->status, TrackStatus::tracking);
  EXPECT_EQ(found[kLeft]->handedness, Handedness::left);
  EXPECT_NEAR(found[kRight]->segments[kPalm].T_camera_segment.t.x(), kRightX, 0.04);
  EXPECT_NEAR(found[kLeft]->segments[kPalm].T_camera_segment.t.x(), kLeftX, 0.04);
  EXPECT_NE(found[kRight]->hand_id, found[kLeft]->hand_id);
}

TEST_F(TwoHandTrackerTest, AHandAloneIsNotTakenForTheOtherOne) {
  HandEstimates found;
  for (int i = 0; i < 6 && (i == 0 || found[kLeft]->status != TrackStatus::tracking); ++i) {
    found = next_times(1, tracker_, left_hand_, nothing());
    EXPECT_EQ(found[kRight]->status, TrackStatus::searching);
  }
  EXPECT_EQ(found[kLeft]->status, TrackStatus::tracking);
}

TEST_F(TwoHandTrackerTest, AHandStaysWithItsSideUntilItIsFollowed) {
  HandEstimates found;
  for (int i = 0; i < 6 && (i == 0 || found[kLeft]->status != TrackStatus::tracking); ++i)
    found = next(tracker_, left_hand_, nothing(), {});
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(found[kLeft]->status, TrackStatus::tracking) << i;
    EXPECT_EQ(found[kRight]->status, TrackStatus::searching) << i;
    found = next(tracker_, left_hand_, nothing(), {});
  }
  // Now the right hand is nearer, so preprocessing lists it first.
  found = next(tracker_, right_hand_, left_hand_, {});
  EXPECT_EQ(found[kLeft]->status, TrackStatus::tracking);
  EXPECT_NEAR(found[kLeft]->segments[kPalm].T_camera_segment.t.x(), kLeftX, 0.04);
}

TEST_F(TwoHandTrackerTest, AProfileOfTheOtherSideIsNotBentToTheHand) {
  TwoHandTracker only_left(test::quick_tracker(), {left_}, 1, workers_),
      only_right(test::quick_tracker(), {right_}, 1, workers_);
  HandEstimates refused, taken;
  for (int i = 0; i < 4; ++i) {
    refused = next(only_left, right_hand_);
    taken = next(only_right, right_hand_);
  }
  EXPECT_EQ(refused[0]->status, TrackStatus::searching);
  EXPECT_EQ(taken[0]->status, TrackStatus::tracking);
}

TEST_F(TwoHandTrackerTest, AHandOfTheOtherSideIsGivenUpWhereThatTurnsOutLater) {
  // Track a right hand with its profile.
  TrackerParams params = test::quick_tracker();
  params.choice.confident_score = 0;  // so that every start is verified
  std::ostringstream said;
  TwoHandTracker only_right(params, {right_}, 1, workers_, test::text_logger(said));
  HandEstimates last;
  for (int i = 0; i < 4; ++i) last = next(only_right, right_hand_);
  ASSERT_EQ(last[0]->status, TrackStatus::tracking);

  // A left hand takes its place, palm for palm. The right hand's profile explains it badly, but keeps tracking it for
  // a while.
  const HandObservationPtr left_hand = seen(*left_, 0.2, kRightX);
  int frames = 0;
  while (++frames < 60 && last[0]->status == TrackStatus::tracking) last = next(only_right, left_hand);

  // In the end the other side is recognised.
  EXPECT_NE(last[0]->status, TrackStatus::tracking);
  EXPECT_NE(said.str().find("looks like a left hand"), std::string::npos) << said.str() << frames;
  EXPECT_GT(frames, 10);
}

TEST_F(TwoHandTrackerTest, AHandAloneGoesOverToTheOtherSideWhereThatTurnsOutLater) {
  HandEstimates last;
  for (int i = 0; i < 6 && (i == 0 || last[kRight]->status != TrackStatus::tracking); ++i)
    last = next(tracker_, right_hand_, nothing(), {});
  ASSERT_EQ(last[kRight]->status, TrackStatus::tracking);

  // A left hand takes the place, palm for palm. The right hand's profile explains it badly, but keeps tracking it for
  // a while. As in the pipeline, preprocessing follows the hand that was tracked two frames ago.
  const HandObservationPtr left_hand = seen(*left_, 0.2, kRightX);
  HandEstimates before = last, feedback = last;
  int handed_over = 0, id = 0;
  for (int frame = 1; frame < 60; ++frame) {
    const bool right_followed = feedback[kRight]->status == TrackStatus::tracking,
               left_followed = feedback[kLeft]->status == TrackStatus::tracking;
    feedback = std::exchange(before, last);
    const HandObservationPtr none = nothing();
    last = next(tracker_, left_followed ? none : left_hand, left_followed ? left_hand : none,
                {right_followed, left_followed});

    // Once the left hand is tracked, it remains so, and the right one does not return.
    if (!handed_over && last[kLeft]->status == TrackStatus::tracking) {
      handed_over = frame;
      id = last[kLeft]->hand_id;
    }
    if (!handed_over) continue;
    ASSERT_EQ(last[kLeft]->status, TrackStatus::tracking) << frame;
    ASSERT_NE(last[kRight]->status, TrackStatus::tracking) << frame;
    ASSERT_EQ(last[kLeft]->hand_id, id) << frame;
  }
  EXPECT_GT(handed_over, 10);
}

TEST_F(TwoHandTrackerTest, PutsTheObservationsInTheOrderOfTheHands) {
  HandEstimates found;
  for (int i = 0; i < 6; ++i) {
    HandObservations observations{at(utime_ += 33'000, *left_hand_, false), at(utime_, *right_hand_, false)};
    const HandObservationPtr left = observations[0];
    found = tracker_.process(observations);
    if (found[kRight]->status != TrackStatus::tracking) continue;
    EXPECT_EQ(observations[kLeft], left) << i;
  }
  EXPECT_EQ(found[kRight]->status, TrackStatus::tracking);
  EXPECT_EQ(found[kLeft]->status, TrackStatus::tracking);
}

TEST_F(TwoHandTrackerTest, WhatIsNoHandToEitherSideDoesNotKeepTheOtherOneFromStarting) {
  auto patch = std::make_shared<HandObservation>(*left_hand_);
  patch->hand_pixels.resize(50);  // fewer points than a search needs
  HandEstimates found;
  for (int i = 0; i < 6 && (i == 0 || found[kRight]->status != TrackStatus::tracking); ++i)
    found = next(tracker_, right_hand_, patch, {});
  EXPECT_EQ(found[kRight]->status, TrackStatus::tracking);
}

TEST_F(TwoHandTrackerTest, AnotherPersonsHandGetsAnIdOfItsOwn) {
  const HandEstimates before = next_times(4, tracker_, right_hand_, left_hand_);
  tracker_.use(kRight, right_);
  const HandEstimates after = next_times(4, tracker_, right_hand_, left_hand_);
  ASSERT_EQ(before[kRight]->status, TrackStatus::tracking);
  ASSERT_EQ(after[kRight]->status, TrackStatus::tracking);
  EXPECT_NE(after[kRight]->hand_id, before[kRight]->hand_id);
  EXPECT_NE(after[kRight]->hand_id, after[kLeft]->hand_id);
}

TEST_F(TwoHandTrackerTest, BesideATrackedHandTheOtherOneIsFoundLater) {
  next_times(4, tracker_, right_hand_, nothing());
  const HandEstimates alone = next_times(2, tracker_, right_hand_, nothing(), {true, false});
  EXPECT_EQ(alone[kRight]->status, TrackStatus::tracking);
  EXPECT_EQ(alone[kLeft]->status, TrackStatus::searching);
  const HandEstimates both = next_times(9, tracker_, right_hand_, left_hand_, {true, false});
  EXPECT_EQ(both[kRight]->status, TrackStatus::tracking);
  EXPECT_EQ(both[kRight]->hand_id, alone[kRight]->hand_id);
  EXPECT_EQ(both[kLeft]->status, TrackStatus::tracking);
}

TEST_F(TwoHandTrackerTest, OneThreadAndTwoGiveTheSame) {
  Workers two(2);
  TwoHandTracker other(test::quick_tracker(), {right_, left_}, 1, two);
  const HandEstimates one = next_times(4, tracker_, right_hand_, left_hand_);
  utime_ = 1'000'000;
  const HandEstimates same = next_times(4, other, right_hand_, left_hand_);
  for (int k = 0; k < 2; ++k)
    for (int s = 0; s < kSegmentCount; ++s)
      EXPECT_EQ(one[k]->segments[s].T_camera_segment.t, same[k]->segments[s].T_camera_segment.t);
}

class ProfileOfAnotherSize : public TwoHandTrackerTest, public ::testing::WithParamInterface<double> {
 protected:
  /// The log of tracking the right hand with a measured profile that is scaled by `size`.
  std::string said(double size) {
    auto profile = std::make_shared<HandProfile>(scaled(*right_, size));
    profile->origin = ProfileOrigin::measured;
    std::ostringstream out;
    TwoHandTracker tracker(test::quick_tracker(), {profile}, 1, workers_, test::text_logger(out));
    HandPose pose = test::facing_pose(*right_, 0.5, 0.2);
    for (SE3& T : pose) T.t.x() += kRightX;
    tracker.start_at(0, pose);
    for (int i = 0; i < 71; ++i) {
      const HandEstimates estimates = next(tracker, right_hand_);
      EXPECT_EQ(estimates[0]->status, TrackStatus::tracking);
      confidence_ = estimates[0]->segments[kPalm].confidence;
    }
    return out.str();
  }
  double confidence_ = 0;  ///< confidence of the palm in the last frame of said()
};

INSTANTIATE_TEST_SUITE_P(Sizes, ProfileOfAnotherSize, ::testing::Values(0.88, 1.0, 1.14));

TEST_P(ProfileOfAnotherSize, IsTrackedWithAndSaid) {
  const double size = GetParam();
  const std::string text = said(size);
  EXPECT_EQ(text.find("% larger") != std::string::npos, size < 1) << text;
  EXPECT_EQ(text.find("% smaller") != std::string::npos, size > 1) << text;
  EXPECT_EQ(confidence_ < 0.3, size != 1) << confidence_ << ": the scale may be wrong instead";
}

/// A hand whose joints are detected.
class StartOfDetectedHand : public TwoHandTrackerTest {
 protected:
  /// An observed hand with a detection that is one with these log odds.
  static HandObservationPtr detected(const HandProfile& profile, double flexion, double hand_log_odds = 6) {
    const HandPose pose = test::facing_pose(profile, 0.5, flexion);
    const auto observation = test::observe_skin(make_blended_skin(profile, 0.004), pose);
    observation->detected =
        std::make_shared<const DetectedHand>(test::detected_hand(profile, pose, 3, 0.005, hand_log_odds));
    return observation;
  }
  static TrackerParams params() {
    TrackerParams params = test::quick_tracker();
    params.loss.lost_score = params.loss.recovered_score = 0.02;  // tracked however bad the score is
    return params;
  }
};

/// The observed hand is `size` times as large as the profile's, as with a wrong unit of depth.
struct SizeOfStart {
  double size;
  ProfileOrigin origin;
  bool reported;
  friend std::ostream& operator<<(std::ostream& out, const SizeOfStart& start) {
    return out << start.size << (start.origin == ProfileOrigin::mean ? "_of_a_mean_hand" : "_of_a_measured_hand");
  }
};

class DetectedSizeOfStart : public StartOfDetectedHand, public ::testing::WithParamInterface<SizeOfStart> {};

INSTANTIATE_TEST_SUITE_P(Sizes, DetectedSizeOfStart,
                         ::testing::Values(SizeOfStart{0.5, ProfileOrigin::measured, true},
                                           SizeOfStart{0.71, ProfileOrigin::measured, true},
                                           SizeOfStart{0.8, ProfileOrigin::measured, true},
                                           SizeOfStart{1.0, ProfileOrigin::measured, false},
                                           SizeOfStart{1.25, ProfileOrigin::measured, true},
                                           SizeOfStart{0.75, ProfileOrigin::mean, false},  // a child
                                           SizeOfStart{1.0, ProfileOrigin::mean, false}));

TEST_P(DetectedSizeOfStart, IsDoubtedAtOnceUnlessItIsTheProfilesOrFitted) {
  for (const double flexion : {0.15, 0.6}) {
    auto profile = std::make_shared<HandProfile>(*right_);
    profile->origin = GetParam().origin;
    std::ostringstream out;
    TwoHandTracker tracker(params(), {profile}, 1, workers_, test::text_logger(out));
    const HandObservationPtr hand = detected(scaled(*right_, GetParam().size), flexion);
    for (int frame = 0; frame < 3; ++frame) {
      const HandEstimates estimates = next(tracker, hand);
      ASSERT_EQ(estimates[0]->status, TrackStatus::tracking);
      if (GetParam().reported) {
        EXPECT_LT(estimates[0]->segments[kPalm].confidence, 0.3) << flexion;
      }
    }
    EXPECT_EQ(out.str().find("profile") != std::string::npos, GetParam().reported) << flexion << ": " << out.str();
  }
}

TEST_F(StartOfDetectedHand, KeepsItsSizeWhereNoCopyExplainsItBetter) {
  auto profile = std::make_shared<HandProfile>(*right_);
  profile->origin = ProfileOrigin::measured;
  auto hand = std::make_shared<HandObservation>(*detected(*right_, 0.15));
  const auto wrong = detected(scaled(*right_, 0.8), 0.15);
  hand->detected = wrong->detected;
  std::ostringstream out;
  TwoHandTracker tracker(params(), {profile}, 1, workers_, test::text_logger(out));
  for (int frame = 0; frame < 3; ++frame) next(tracker, hand);
  EXPECT_EQ(out.str(), "");
}

TEST_F(StartOfDetectedHand, NeedsNoGoodScoreOfTwoSidesWhereTheDetectionConfirmsOne) {
  const HandObservationPtr hand = detected(*right_, 0.15);
  const double score = next(tracker_, hand, nothing(), {})[kRight]->score;

  // Thresholds at which this hand's score counts as bad.
  TrackerParams strict = test::quick_tracker();
  strict.loss.lost_score = strict.loss.recovered_score = 0.7 * score;
  TwoHandTracker tracker(strict, {right_, left_}, 1, workers_);
  const HandEstimates found = next(tracker, hand, nothing(), {});
  EXPECT_EQ(found[kRight]->status, TrackStatus::tracking) << score;
  EXPECT_EQ(found[kLeft]->status, TrackStatus::searching);
}

TEST_F(StartOfDetectedHand, IsReadAsAHandOfEitherSideWhereTheNetworksCannotTell) {
  // The networks read a right hand rather as a left one, whose joints are those of the mirrored hand.
  const auto first_frame = [&](bool either) {
    auto hand = std::make_shared<HandObservation>(*detected(*right_, 0.6, 2));
    auto joints = std::make_shared<DetectedHand>(*hand->detected);
    if (either) joints->other_joints = joints->joints;
    joints->right_log_odds = -0.5;
    joints->side = Handedness::left;
    joints->joints = test::detected_hand(*left_, test::facing_pose(*left_, 0.5, 0.1), 3).joints;
    std::swap(joints->joints[kWristLandmark], joints->joints[landmark_of(2, 3)]);  // they make no left hand
    hand->detected = joints;
    TwoHandTracker tracker(test::quick_tracker(), {right_, left_}, 1, workers_);
    return next(tracker, hand, nothing(), {});
  };
  EXPECT_EQ(first_frame(true)[kRight]->status, TrackStatus::tracking);
  EXPECT_EQ(first_frame(false)[kRight]->status, TrackStatus::searching);
}

TEST_F(StartOfDetectedHand, IsRefusedAtOnceWhereTheNetworksAreSureOfTheOtherSide) {
  const auto start_with = [&](double right_log_odds) {
    auto hand = std::make_shared<HandObservation>(*detected(*right_, 0.15));
    auto joints = std::make_shared<DetectedHand>(*hand->detected);
    joints->right_log_odds = right_log_odds;
    hand->detected = joints;
    std::ostringstream out;
    TwoHandTracker tracker(params(), {right_}, 1, workers_, test::text_logger(out));
    const bool tracked = next(tracker, hand)[0]->status == TrackStatus::tracking;
    EXPECT_EQ(out.str().find("looks like a left hand") == std::string::npos, tracked) << out.str();
    return tracked;
  };
  EXPECT_TRUE(start_with(10));
  EXPECT_TRUE(start_with(-1)) << "the networks are not sure";
  EXPECT_FALSE(start_with(-10));
}

TEST_F(StartOfDetectedHand, IsOfNoSideThatTheNetworksExcludeThoughItsPoseExplainsTheData) {
  const auto left_starts = [&](double right_log_odds, Handedness side) {
    auto hand = std::make_shared<HandObservation>(*detected(*left_, 0.15));
    auto joints = std::make_shared<DetectedHand>(*hand->detected);
    joints->right_log_odds = right_log_odds;
    joints->side = side;
    hand->detected = joints;
    TwoHandTracker tracker(test::quick_tracker(), {right_, left_}, 1, workers_);
    return next(tracker, hand, nothing(), {})[kLeft]->status == TrackStatus::tracking;
  };
  EXPECT_TRUE(left_starts(-5, Handedness::left));
  EXPECT_FALSE(left_starts(5, Handedness::right));
}

/// A detection that is hardly more probable to be a hand than anything else. It is `aside` [m] away from data that the
/// model explains well.
class AmbiguousDetection : public StartOfDetectedHand {
 protected:
  /// The number of the first of 40 frames in which a hand is tracked; 0 if there is none.
  int first_tracked(double aside, double hand_log_odds = 1) {
    auto hand = std::make_shared<HandObservation>(*detected(*right_, 0.15, hand_log_odds));
    auto joints = std::make_shared<DetectedHand>(*hand->detected);
    joints->right_log_odds = 0.3;
    for (DetectedJoint& joint : joints->joints) joint.position.x() += aside;
    hand->detected = joints;
    TwoHandTracker tracker(test::quick_tracker(), {right_}, 1, workers_);
    for (int frame = 1; frame <= 40; ++frame)
      if (next(tracker, hand)[0]->status == TrackStatus::tracking) return frame;
    return 0;
  }
};

TEST_F(AmbiguousDetection, IsAHandWhereAPoseExplainsIt) { EXPECT_EQ(first_tracked(0), 1); }

TEST_F(AmbiguousDetection, IsAHandAfterSomeFramesWhereOneDoesNotDecide) {
  const int first = first_tracked(0.025, 2.2);
  EXPECT_GT(first, 1);
  EXPECT_LT(first, 20);
}

TEST_F(AmbiguousDetection, IsNoneWhereThePoseThatExplainsItIsAnother) { EXPECT_EQ(first_tracked(0.045), 0); }

TEST_F(AmbiguousDetection, IsNoneWhereTheNetworksSeeSomethingElse) { EXPECT_EQ(first_tracked(0, -2), 0); }

}  // namespace
}  // namespace barehand
