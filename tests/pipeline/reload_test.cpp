#include "pipeline/reload.h"

#include <gmock/gmock.h>

#include "drivers/lcm/layouts.h"
#include "hand/skin.h"
#include "io/lcm/lcm_log_reader.h"
#include "pipeline/sinks/publish_sink.h"
#include "pipeline/track_stages.h"
#include "support/painted_hand.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Reload, HandsOutTheGroupsThatChanged) {
  PendingParams pending;
  Reload reload({}, pending);
  Config wanted;
  wanted.tracker.choice.ambiguity_margin = 0.5;
  wanted.tracker.fusion.levels = 2;
  const Reload::Changes changes = reload.apply(wanted);
  EXPECT_THAT(changes.made, ElementsAre("tracker.ambiguity_margin: 0.15 -> 0.5", "tracker.fusion.levels: 4 -> 2"));
  EXPECT_THAT(changes.for_restart, IsEmpty());
  EXPECT_EQ(pending.tracker.take()->choice.ambiguity_margin, 0.5);
  EXPECT_FALSE(pending.preprocess.take());
  EXPECT_FALSE(pending.bus.take());
}

TEST(Reload, SaysWhatStaysUntilARestartAndKeepsIt) {
  // Change values that can be reloaded and values that need a restart.
  PendingParams pending;
  Reload reload({}, pending);
  Config wanted;
  wanted.run.channel_prefix = "LEFT_";
  wanted.tracker.shape_fit.enabled = !wanted.tracker.shape_fit.enabled;
  wanted.tracker.refinement.objects.enabled = false;
  wanted.tracker.loss.hold_time = wanted.publish.hold_time = 2;  // one key of the file sets both
  const Reload::Changes changes = reload.apply(wanted);
  EXPECT_THAT(changes.made, ElementsAre("tracker.loss.hold_time: 0.5 -> 2"));
  EXPECT_THAT(changes.for_restart,
              ElementsAre("run.channel_prefix: \"\" -> \"LEFT_\"", "tracker.refinement.objects.enabled: true -> false",
                          "tracker.shape_fit.enabled: true -> false"));
  EXPECT_EQ(pending.tracker.take()->shape_fit.enabled, Config{}.tracker.shape_fit.enabled);
  EXPECT_EQ(pending.bus.take()->hold_time, 2) << "one key serves the tracker and what is published";
  EXPECT_EQ(pending.states_log.take()->hold_time, 2);

  // A second call lists only what still waits for a restart.
  EXPECT_EQ(reload.apply(wanted).for_restart.size(), 3u) << "still not in force";
  EXPECT_THAT(reload.apply(wanted).made, IsEmpty());
}

TEST(Reload, PreprocessWorksWithTheNewParametersFromTheNextFrameOn) {
  // A frame that shows a hand.
  const auto profile = test::adult_hand();
  const auto seen = test::observe_skin(make_blended_skin(*profile, 0.004), test::facing_pose(*profile, 0.5));
  auto frame = std::make_shared<RgbdFrame>(*seen->frame);
  frame->depth_unit = 0.001;
  frame->depth.reset(frame->camera.width, frame->camera.height);
  for (std::size_t i = 0; i < frame->depth.size(); ++i)
    frame->depth[i] = static_cast<std::uint16_t>(seen->depth[i] / frame->depth_unit);

  // The stages find it.
  ManualClock clock;
  RepeatLog log(make_silent_logger(), clock);
  Workers workers(1);
  PendingParams pending;
  const TrackStages stages = make_track_stages({}, {profile}, std::nullopt, {}, workers, log, &pending);
  EXPECT_TRUE(stages.preprocess(frame, {})->front()->hand_present);

  // With another range of depth they do not.
  PreprocessParams near;
  near.max_depth = 0.3;
  pending.preprocess.put(near);
  EXPECT_FALSE(stages.preprocess(frame, {})->front()->hand_present);
}

TEST(Reload, WhatIsPublishedFollowsFromTheNextFrameOn) {
  // A tracked hand that is lost in the next frame.
  const test::TempFolder folder;
  const auto profile = test::adult_hand();
  auto estimate = std::make_shared<HandEstimate>();
  estimate->utime = 1'000'000;
  estimate->status = TrackStatus::tracking;
  estimate->profile = profile;
  const HandPose pose = test::facing_pose(*profile, 0.5);
  for (int s = 0; s < kSegmentCount; ++s) estimate->segments[s].T_camera_segment = pose[s];
  auto lost = std::make_shared<HandEstimate>(*estimate);
  lost->utime += 100'000;
  lost->status = TrackStatus::lost;

  // Between the frames the hold time becomes zero.
  Slot<PublishParams> pending;
  {
    auto sink = StatesLogSink::create({}, "", folder / "states.lcmlog", false, &pending).value();
    ASSERT_TRUE(sink->consume({nullptr, {}, {estimate}}));
    PublishParams no_hold;
    no_hold.hold_time = 0;
    pending.put(no_hold);
    ASSERT_TRUE(sink->consume({nullptr, {}, {lost}}));
  }

  // The log shows that the lost hand is not held.
  auto log = LcmLogReader::open(folder / "states.lcmlog").value();
  std::vector<int> has_pose;
  for (const LogEntry& entry : log.entries()) {
    if (entry.channel != "HAND_STATE") continue;
    hand_state_t state;
    const auto bytes = log.read(entry).value();
    ASSERT_GT(state.decode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
    has_pose.push_back(state.has_pose);
  }
  EXPECT_THAT(has_pose, ElementsAre(1, 0)) << "not held for the old hold_time";
}

}  // namespace
}  // namespace barehand
