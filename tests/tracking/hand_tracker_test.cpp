#include "tracking/hand_tracker.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <string_view>
#include <vector>

#include "hand/articulated_pose.h"
#include "hand/skin.h"
#include "math/angles.h"
#include "support/painted_hand.h"
#include "support/rendered_person.h"
#include "support/text_logger.h"
#include "tracking/quick_tracker.h"

namespace barehand {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// Parameters with which the hand is never lost.
TrackerParams stubborn_tracker() {
  TrackerParams params = test::quick_tracker();
  params.loss.lost_score = 0.1;
  return params;
}

/// The names of the rules that decided about an estimate, in the order of the decisions.
std::vector<std::string_view> rules_of(const HandEstimate& estimate) {
  std::vector<std::string_view> rules;
  for (const Decision& decision : estimate.decisions) rules.push_back(decision.rule);
  return rules;
}

/// A tracker that starts with an upright hand, while the observed hand hangs down.
class UpsideDown : public testing::Test {
 protected:
  /// `second_look`: what the networks see in a second look at this frame; null: nothing.
  double error_of_next(const DetectedHand* second_look = nullptr) {
    const auto frame = test::stamped(*hand_, utime_ += 33'000);
    if (second_look) frame->second_look = std::make_shared<const DetectedHand>(*second_look);
    const HandEstimatePtr estimate = tracker_.process(*frame);
    last_rules_ = rules_of(*estimate);
    const SE3& palm = estimate->segments[kPalm].T_camera_segment;
    return estimate->status == TrackStatus::tracking ? (palm.t - pose_[kPalm].t).norm() : 1;
  }
  /// The error when a second look has had its effect, two frames later.
  double error_after(const DetectedHand& second_look) {
    error_of_next(&second_look);
    error_of_next();
    return error_of_next();
  }

  const std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  const HandPose upright_ = test::facing_pose(*profile_, 0.5);
  const HandPose pose_ = test::turned(upright_, {0, 0, 170 * kDegree}, {0, 0, 0.5});
  const HandObservationPtr hand_ = test::observe_skin(make_blended_skin(*profile_, 0.004), pose_);
  Workers workers_{1};
  HandTracker tracker_{stubborn_tracker(), profile_, 1, workers_};
  std::int64_t utime_ = 1'000'000;
  std::vector<std::string_view> last_rules_;
};

TEST_F(UpsideDown, IsTurnedByASecondLook) {
  const DetectedHand right = test::detected_hand(*profile_, pose_, 6, 0.01),
                     wrong = test::detected_hand(*profile_, upright_, 6, 0.01);
  tracker_.apply(StartAt{upright_});
  EXPECT_GT(error_after(wrong), 0.05) << "the pose explains the frame no better";
  EXPECT_LT(error_after(right), 0.005);
  EXPECT_THAT(last_rules_, Contains("second look"));
}

TEST_F(UpsideDown, IsNotTurnedByJointsThatNoHandHas) {
  DetectedHand torn = test::detected_hand(*profile_, pose_, 6, 0.01);
  for (int finger = 0; finger < kFingerCount; ++finger)
    torn.joints[landmark_of(finger, 3)].position.x() += finger % 2 == 0 ? 0.08 : -0.08;
  tracker_.apply(StartAt{upright_});
  EXPECT_GT(error_after(torn), 0.05);
}

TEST(HandTracker, PutsCrossedFingersSideBySide) {
  const std::shared_ptr<const HandProfile> profile = test::adult_hand();
  const HandPose pose = test::facing_pose(*profile, 0.5);
  const HandObservationPtr hand = test::observe_skin(make_blended_skin(*profile, 0.004), pose);
  const int middle = segment_of(2, 0), ring = segment_of(3, 0);
  const auto tip_of_ring = [&](const HandPose& p) { return distal_end(*profile, p, segment_of(3, 2)); };

  // Start with the middle and the ring finger in each other's place.
  ArticulatedPose crossed = articulated_from(*profile, pose, widened_limits(*profile, 0.3));
  crossed.angles[middle].abduction -= side_sign(profile->handedness) * 20 * kDegree;
  crossed.angles[ring].abduction += side_sign(profile->handedness) * 20 * kDegree;
  const auto error_after_two_frames = [&](bool uncross) {
    TrackerParams params = stubborn_tracker();
    params.choice.uncross_fingers = uncross;
    Workers workers(1);
    HandTracker tracker(params, profile, 1, workers);
    tracker.apply(StartAt{posed(*profile, crossed)});
    tracker.process(*test::stamped(*hand, 33'000));
    const HandEstimatePtr estimate = tracker.process(*test::stamped(*hand, 66'000));
    return (tip_of_ring(pose_of(estimate->segments)) - tip_of_ring(pose)).norm();
  };
  EXPECT_LT(error_after_two_frames(true), 0.003);
  EXPECT_GT(error_after_two_frames(false), 0.01);
}

TEST(HandTracker, IsNotConfidentInABadFrame) {
  const std::shared_ptr<const HandProfile> profile = test::adult_hand();
  const HandPose pose = test::facing_pose(*profile, 0.5);
  const HandObservationPtr hand = test::observe_skin(make_blended_skin(*profile, 0.004), pose);
  const auto confidence_if_bad_above = [&](double lost_score) {
    TrackerParams params = test::quick_tracker();
    params.loss.lost_score = params.loss.recovered_score = lost_score;
    params.loss.noise_factor = 0;
    Workers workers(1);
    HandTracker tracker(params, profile, 1, workers);
    tracker.apply(StartAt{pose});
    const HandEstimatePtr estimate = tracker.process(*test::stamped(*hand, 33'000));
    EXPECT_EQ(estimate->status, TrackStatus::tracking);
    return estimate->segments[kPalm].confidence;
  };
  EXPECT_GT(confidence_if_bad_above(0.02), 0.9);
  EXPECT_LT(confidence_if_bad_above(1e-5), 0.3);
}

TEST(HandTracker, ScansTheSkinOfAMeasuredHandAndForgetsItWithThePerson) {
  TrackerParams params = test::quick_tracker();
  params.skin_cell = 0.006;  // m: coarse, for few unknowns, but finer than what the scan corrects
  params.shape_fit.scan_after = 32;
  auto profile = std::make_shared<HandProfile>(*test::adult_hand());
  profile->origin = ProfileOrigin::measured;
  const Skin skin = make_blended_skin(scaled(*profile, 1.02), 0.004);
  Workers workers(2);
  HandTracker tracker(params, profile, 1, workers);
  std::int64_t utime = 1'000'000;
  tracker.apply(StartAt{test::facing_pose(*profile, 0.5)});
  const auto given_up = std::chrono::steady_clock::now() + std::chrono::minutes(1);  // the scan runs in the background
  for (int i = 0; !tracker.view().profile->scanned_skin; ++i) {
    ASSERT_LT(std::chrono::steady_clock::now(), given_up);
    const HandPose pose = test::facing_pose(*profile, 0.5, 0.02 * std::min(i, params.shape_fit.scan_after));
    tracker.process(*test::stamped(*test::observe_skin(skin, pose), utime += 33'000));
    ASSERT_EQ(tracker.view().status, TrackStatus::tracking);
  }
  tracker.apply(ResetTracker{});
  EXPECT_FALSE(tracker.view().profile->scanned_skin);
}

/// Tracks a hand over three frames from a start near its true pose. Keeps the last estimate and the log.
struct Followed {
  explicit Followed(const SegmentTrackerParams& samples) {
    TrackerParams params = test::quick_tracker();
    params.sampling = true;
    params.segment_tracker = samples;
    const std::shared_ptr<const HandProfile> profile = test::adult_hand();
    const HandObservationPtr hand =
        test::observe_skin(make_blended_skin(*profile, 0.004), test::facing_pose(*profile, 0.5));
    std::ostringstream text;
    Workers workers(1);
    HandTracker tracker(params, profile, 1, workers, test::text_logger(text));
    tracker.apply(StartAt{test::facing_pose(*profile, 0.5, 0.02)});
    for (int i = 1; i <= 3; ++i) last = tracker.process(*test::stamped(*hand, i * 33'000));
    log = text.str();
  }
  bool same_as(const Followed& other) const {
    for (int s = 0; s < kSegmentCount; ++s)
      if (last->segments[s].T_camera_segment.t != other.last->segments[s].T_camera_segment.t) return false;
    return true;
  }
  HandEstimatePtr last;
  std::string log;
};

TEST(HandTracker, DrawsMoreSamplesOnlyWhereADeviceComparesThem) {
  SegmentTrackerParams params;
  params.samples = 20;
  params.level_budget_ms = 1000;  // more than a level takes in software on any machine
  const auto with = [&](const char* observer, int samples_on_device) {
    params.observer = observer;
    params.samples_on_device = samples_on_device;
    return Followed(params);
  };
  EXPECT_THAT(with("egl", 26).log,
              HasSubstr("26 samples per segment and level where the GPU compares them, 20 on the"));
  EXPECT_THAT(with("egl", 0).log, Not(HasSubstr("samples per segment")));
  const Followed cpu = with("cpu", 26);
  EXPECT_THAT(cpu.log, Not(HasSubstr("samples per segment")));
  EXPECT_TRUE(cpu.same_as(with("cpu", 0)));
}

TEST(HandTracker, OpensTheDeviceAgainOnlyIfItsOwnParametersChange) {
  std::ostringstream text;
  Workers workers(1);
  TrackerParams params = test::quick_tracker();
  params.segment_tracker.observer = "egl";
  HandTracker tracker(params, test::adult_hand(), 1, workers, test::text_logger(text));
  const std::string opened = text.str();
  EXPECT_THAT(opened, HasSubstr("amples"));  // the log names the device, or the reason why there is none

  params.segment_tracker.samples += 1;
  params.choice.ambiguity_margin += 0.01;
  tracker.apply(UseParams{params});
  EXPECT_EQ(text.str(), opened);
  params.segment_tracker.pixel_distance_cap += 0.001;
  tracker.apply(UseParams{params});
  EXPECT_GT(text.str().size(), opened.size());
}

/// A tracker with a start pose that the user has given.
class GivenStart : public testing::Test {
 protected:
  HandEstimatePtr next(const HandObservation& observation) {
    return tracker_.process(*test::stamped(observation, utime_ += 33'000));
  }
  /// The observation of something that looks like a hand in this pose, but that the networks do not take for one.
  HandObservation foot_like(const HandPose& pose) const {
    HandObservation seen = *test::observe_skin(make_blended_skin(*profile_, 0.004), pose);
    seen.detected = std::make_shared<const DetectedHand>(test::detected_hand(*profile_, pose, 0.1, 0.005, -5));
    return seen;
  }

  const std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  const HandPose pose_ = test::facing_pose(*profile_, 0.5);
  const HandObservationPtr hand_ = test::observe_skin(make_blended_skin(*profile_, 0.004), pose_);
  Workers workers_{1};
  HandTracker tracker_{test::quick_tracker(), profile_, 1, workers_};
  std::int64_t utime_ = 1'000'000;
};

TEST_F(GivenStart, IsNoPoseWhereNoHandIsSeen) {
  tracker_.apply(StartAt{pose_});
  EXPECT_EQ(next(HandObservation{})->status, TrackStatus::searching);
}

TEST_F(GivenStart, WhatIsHardlyAHandIsNotTakenForALostOne) {
  tracker_.apply(StartAt{pose_});
  ASSERT_EQ(next(*hand_)->status, TrackStatus::tracking);
  for (int i = 0; i < 20; ++i) next(HandObservation{});
  ASSERT_EQ(next(HandObservation{})->status, TrackStatus::lost);

  // The networks see something that hangs down.
  const HandPose elsewhere = test::turned(pose_, {0, 0, 170 * kDegree}, {0, 0, 0.5});
  HandObservation seen = foot_like(elsewhere);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(next(seen)->status, TrackStatus::lost);
  seen.detected = std::make_shared<const DetectedHand>(test::detected_hand(*profile_, elsewhere, 5));
  next(seen);
  EXPECT_EQ(next(seen)->status, TrackStatus::tracking);
}

TEST_F(GivenStart, AFrameThatShowsOnlySomethingElseIsAsOneWithoutData) {
  tracker_.apply(StartAt{pose_});
  ASSERT_EQ(next(*hand_)->status, TrackStatus::tracking);
  const HandPose elsewhere = test::turned(test::facing_pose(*profile_, 0.9), {0, 0, 170 * kDegree}, {0, 0, 0.5});
  const HandEstimatePtr held = next(foot_like(elsewhere));
  EXPECT_EQ(held->status, TrackStatus::holding);
  EXPECT_LT((held->segments[kPalm].T_camera_segment.t - pose_[kPalm].t).norm(), 0.005);
  EXPECT_EQ(next(*hand_)->status, TrackStatus::tracking);
}

TEST_F(GivenStart, EveryDecisionIsKept) {
  tracker_.apply(StartAt{pose_});
  EXPECT_TRUE(next(*hand_)->decisions.empty()) << "nothing stood against the given pose";
  EXPECT_TRUE(next(*hand_)->decisions.empty());
  const HandEstimatePtr held = next(HandObservation{});
  ASSERT_THAT(rules_of(*held), ElementsAre("state"));
  EXPECT_EQ(held->decisions[0].winner, "holding");
  EXPECT_EQ(held->decisions[0].loser, "tracking");
  EXPECT_TRUE(next(HandObservation{})->decisions.empty()) << "decisions of a frame are not said again";
}

TEST_F(GivenStart, ElsewhereIsNoMotion) {
  tracker_.apply(StartAt{pose_});
  for (int i = 0; i < 3; ++i) next(*hand_);
  const Eigen::Vector3d by(0.05, 0, 0);
  HandPose moved = pose_;
  for (SE3& T : moved) T.t += by;
  tracker_.apply(StartAt{moved});
  const HandEstimatePtr estimate = next(*test::observe_skin(make_blended_skin(*profile_, 0.004), moved));
  ASSERT_EQ(estimate->status, TrackStatus::tracking);
  EXPECT_TRUE(estimate->segments[kPalm].velocity.array().isNaN().all()) << "a pose that was given is no motion";
}

TEST_F(GivenStart, VelocitiesAreKnownWithinATrackOnly) {
  const auto known = [&](const HandObservation& observation) {
    const HandEstimatePtr estimate = next(observation);
    int finite = 0;
    for (const SegmentState& segment : estimate->segments) finite += segment.velocity.array().isFinite().all();
    EXPECT_TRUE(finite == 0 || finite == kSegmentCount) << finite;
    return finite > 0;
  };
  tracker_.apply(StartAt{pose_});
  EXPECT_FALSE(known(*hand_)) << "the first frame";
  EXPECT_TRUE(known(*hand_));
  utime_ += 500'000;
  EXPECT_FALSE(known(*hand_)) << "after a gap";
  EXPECT_TRUE(known(*hand_));
  EXPECT_FALSE(known(HandObservation{})) << "held";
}

/// A tracked hand that leaves the view; then it returns, or a larger one.
class Return : public testing::Test {
 protected:
  static TrackerParams params() {
    TrackerParams params = test::quick_tracker();
    params.loss.hold_time = 0.1;
    params.loss.forget_time = 1;
    params.choice.confident_score = 0.001;
    return params;
  }
  void SetUp() override {
    tracker_.apply(StartAt{pose_});
    for (int i = 0; i < 5; ++i) ASSERT_EQ(status_at(*hand_), TrackStatus::tracking);
    HandObservation nothing;
    nothing.frame = hand_->frame;
    while (status_at(nothing) != TrackStatus::lost) ASSERT_LT(utime_, 2'000'000);
  }
  TrackStatus status_at(const HandObservation& observation) {
    return tracker_.process(*test::stamped(observation, utime_ += 33'000))->status;
  }
  /// The observation of a hand `size` times as large as the profile's, rotated by `turn` in the image plane [rad].
  HandObservationPtr larger(double size, double turn = 0) const {
    const HandProfile profile = scaled(*profile_, size);
    const HandPose pose = test::turned(test::facing_pose(profile, 0.5), {0, 0, turn}, {0, 0, 0.5});
    return test::observe_skin(make_blended_skin(profile, 0.004), pose);
  }

  const std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  const HandPose pose_ = test::facing_pose(*profile_, 0.5);
  const HandObservationPtr hand_ = larger(1.01);  // real skin differs a little from the model's
  Workers workers_{1};
  HandTracker tracker_{params(), profile_, 1, workers_};
  std::int64_t utime_ = 1'000'000;
};

TEST_F(Return, IsTrackedAtOnce) { EXPECT_EQ(status_at(*hand_), TrackStatus::tracking); }

TEST_F(Return, OfAHandExplainedSomewhatWorseIsTrackedIfTheNextFrameConfirmsIt) {
  EXPECT_EQ(status_at(*larger(1.03)), TrackStatus::lost);
  EXPECT_EQ(status_at(*larger(1.03)), TrackStatus::tracking);
}

TEST_F(Return, OfAHandExplainedSomewhatWorseIsNotBelievedWhileNoFrameConfirmsIt) {
  for (int i = 0; i < 4; ++i) EXPECT_EQ(status_at(*larger(1.03, (i % 2 ? 90 : -90) * kDegree)), TrackStatus::lost) << i;
}

}  // namespace
}  // namespace barehand
