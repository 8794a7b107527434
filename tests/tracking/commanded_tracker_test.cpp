#include "tracking/commanded_tracker.h"

#include <gmock/gmock.h>

#include <set>
#include <sstream>

#include "hand/skin.h"
#include "support/painted_hand.h"
#include "support/temp_folder.h"
#include "support/text_logger.h"
#include "tracking/quick_tracker.h"

namespace barehand {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A tracker that observes an open hand facing the camera, and a queue of commands for it.
class CommandedTrackerTest : public ::testing::Test {
 protected:
  HandObservationPtr seen(const HandObservation& what) { return test::stamped(what, utime_ += 33'000); }
  HandEstimatePtr next() {
    HandObservations observations{seen(*hand_)};
    return tracker_.process(observations)->front();
  }
  void send(Command command) { waiting_.push_back(std::move(command)); }

  const std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  const HandPose pose_ = test::facing_pose(*profile_, 0.5);
  const HandObservationPtr hand_ = test::observe_skin(make_blended_skin(*profile_, 0.004), pose_);
  ManualClock clock_;
  RepeatLog log_{make_silent_logger(), clock_};
  Workers workers_{1};
  std::vector<Result<Command>> waiting_;
  Slot<TrackerParams> params_;
  CommandedTracker tracker_{
      test::quick_tracker(), {profile_}, 1, workers_, [this] { return std::exchange(waiting_, {}); }, log_, &params_};
  std::int64_t utime_ = 1'000'000;
};

TEST_F(CommandedTrackerTest, StartsAtTheGivenPose) {
  Command command;
  command.kind = Command::Kind::initialise;
  command.pose = pose_;
  send(command);
  const HandEstimatePtr estimate = next();
  EXPECT_EQ(estimate->status, TrackStatus::tracking);
  EXPECT_LT((estimate->segments[kPalm].T_camera_segment.t - pose_[kPalm].t).norm(), 0.005);
}

TEST_F(CommandedTrackerTest, UsesTheGivenProfile) {
  EXPECT_EQ(next()->handedness, Handedness::right);
  Command command;
  command.kind = Command::Kind::set_profile;
  command.profile = test::read_text(BAREHAND_CONFIGS "/hands/adult_left.json");
  send(command);
  EXPECT_EQ(next()->handedness, Handedness::left);
}

TEST_F(CommandedTrackerTest, IgnoresWhatItCannotReadAndWhatIsForOthers) {
  Command foreign, broken;
  foreign.kind = broken.kind = Command::Kind::set_profile;
  foreign.profile = test::read_text(BAREHAND_CONFIGS "/hands/adult_left.json");
  foreign.sensor = "another camera";
  broken.profile = "{\"handedness\": \"left\"}";
  send(foreign);
  send(broken);
  waiting_.push_back(fail("truncated"));
  EXPECT_EQ(next()->handedness, Handedness::right);
}

TEST_F(CommandedTrackerTest, AFloodOfCommandsLeavesTimeToTrack) {
  tracker_.start_at(pose_);
  next();
  std::set<std::int32_t> hands;
  for (int frame = 0; frame < 20; ++frame) {
    for (int i = 0; i < 5; ++i) {
      send(Command{});
      Command start;
      start.kind = Command::Kind::initialise;
      start.pose = pose_;
      send(start);
    }
    const HandEstimatePtr estimate = next();
    EXPECT_EQ(estimate->status, TrackStatus::tracking);
    hands.insert(estimate->hand_id);
  }
  EXPECT_EQ(hands.size(), static_cast<std::size_t>(CommandedTracker::kBurst));
}

TEST_F(CommandedTrackerTest, WhatHadToWaitIsFollowedInTheEnd) {
  tracker_.start_at(pose_);
  for (int i = 0; i <= CommandedTracker::kBurst; ++i) {  // one more than the tracker executes at once
    Command start;
    start.kind = Command::Kind::initialise;
    start.pose = pose_;
    send(start);
    next();
  }
  const std::int32_t before = next()->hand_id;
  std::int32_t last = before;
  for (int frame = 0; frame < CommandedTracker::kPause && last == before; ++frame) last = next()->hand_id;
  EXPECT_NE(last, before);
}

TEST_F(CommandedTrackerTest, OtherParametersKeepTheHand) {
  tracker_.start_at(pose_);
  const HandEstimatePtr before = next();
  TrackerParams params = test::quick_tracker();
  params.refinement.iterations += 1;
  params_.put(params);
  const HandEstimatePtr after = next();
  EXPECT_EQ(after->status, TrackStatus::tracking);
  EXPECT_EQ(after->hand_id, before->hand_id);
  EXPECT_NEAR(after->profile->hand_length(), before->profile->hand_length(), 0.001) << "as fitted so far";
  EXPECT_LT((after->segments[kPalm].T_camera_segment.t - pose_[kPalm].t).norm(), 0.005);
}

TEST_F(CommandedTrackerTest, OtherParametersAreInForceAtOnce) {
  tracker_.start_at(pose_);
  EXPECT_EQ(next()->status, TrackStatus::tracking);
  TrackerParams params = test::quick_tracker();
  params.loss.min_hand_pixels = 1'000'000;
  params_.put(params);
  EXPECT_EQ(next()->status, TrackStatus::holding);
}

TEST_F(CommandedTrackerTest, ResetForgetsTheHand) {
  tracker_.start_at(pose_);
  const std::int32_t before = next()->hand_id;
  send(Command{});
  EXPECT_NE(next()->hand_id, before);
}

TEST_F(CommandedTrackerTest, AProfileGoesToTheHandOfItsSide) {
  const auto left = std::make_shared<const HandProfile>(mirrored(*profile_));
  for (const bool late : {false, true}) {  // before the first frame, and after it
    std::ostringstream out;
    RepeatLog log(test::text_logger(out), clock_);
    CommandedTracker tracker(
        test::quick_tracker(), {profile_, left}, 1, workers_, [this] { return std::exchange(waiting_, {}); }, log);
    HandEstimates hands;
    const auto step = [&] {
      HandObservations observations{seen(*hand_), seen(HandObservation())};
      hands = *tracker.process(observations);
    };
    if (late) step();
    for (const char* side : {"left", "right"}) {
      Command command;
      command.kind = Command::Kind::set_profile;
      command.profile = test::read_text(BAREHAND_CONFIGS "/hands/adult_" + std::string(side) + ".json");
      send(command);
    }
    step();
    EXPECT_EQ(hands[0]->handedness, Handedness::right);
    EXPECT_EQ(hands[1]->handedness, Handedness::left);
    EXPECT_THAT(out.str(), AllOf(Not(HasSubstr("ignored")), Not(HasSubstr("faster")))) << out.str();
    EXPECT_NE(out.str().find("use the given"), out.str().rfind("use the given")) << "both: " << out.str();
  }
}

}  // namespace
}  // namespace barehand
