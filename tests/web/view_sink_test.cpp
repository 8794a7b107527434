#include "pipeline/sinks/view_sink.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/log.h"
#include "drivers/lcm/frame_message.h"
#include "drivers/lcm/wire.h"
#include "io/lcm/lcm_log_reader.h"
#include "publish/published_hand.h"
#include "support/temp_folder.h"
#include "web/web_client.h"

namespace barehand {
namespace {

using test::chunks_of;
using test::SocketClient;

TrackedFrame tracked(std::int64_t utime) {
  auto frame = std::make_shared<RgbdFrame>();
  frame->utime = utime;
  frame->number = utime / 1000;
  frame->camera = {64, 48, 50, 50, 32, 24};
  frame->depth.reset(64, 48, 500);
  TrackedFrame out{frame, {}, {}};
  const auto contacts = std::make_shared<FrameContacts>();
  contacts->hands.resize(1);
  contacts->objects.emplace_back().id = 7;
  out.contacts = contacts;
  out.grasps = std::make_shared<const FrameGrasps>(1);
  static const auto profile = test::adult_hand();  // that of every frame, so that the skin stays the same
  HandEstimate estimate = estimate_of(*profile, {}, utime);
  estimate.profile = profile;
  out.estimates.push_back(std::make_shared<const HandEstimate>(std::move(estimate)));
  return out;
}

TEST(ViewSink, SendsWhatTheBusGets) {
  SystemClock clock;
  auto server = ViewServer::start({{"127.0.0.1", 0}, {}, {}, nullptr}, clock);
  ASSERT_TRUE(server) << server.error().message();
  const PublishParams params;
  ViewSink sink(params, **server, {"test", true, [] { return PipelineHealth{}; }}, clock);
  SocketClient client(test::port_of((*server)->url()));
  client.send(R"({"type": "want", "cloud": "hand"})");
  client.send("?");
  ASSERT_TRUE(client.text());

  const TrackedFrame frame = tracked(3'000'000);
  ASSERT_TRUE(sink.consume(frame));
  const auto chunks = chunks_of(client.binary().value());
  ASSERT_EQ(test::kinds_of(chunks), "SFLLLLLLD");
  const HandMessages messages = HandMessageMaker(params).process(*frame.estimates[0]);
  const auto state = encode_message(messages.state), glove = encode_message(messages.glove),
             joints = encode_message(messages.joints);
  EXPECT_EQ(chunks[2].payload, "\x0aHAND_STATE" + std::string(state.begin(), state.end()));
  EXPECT_EQ(chunks[3].payload, "\x0bGLOVE_STATE" + std::string(glove.begin(), glove.end()));
  EXPECT_EQ(chunks[4].payload, "\x0bHAND_JOINTS" + std::string(joints.begin(), joints.end()));
  EXPECT_TRUE(
      chunks[5].payload.starts_with("\x0d"
                                    "CONTACT_STATE"));
  EXPECT_TRUE(
      chunks[6].payload.starts_with("\x0b"
                                    "GRASP_STATE"));
  EXPECT_TRUE(
      chunks[7].payload.starts_with("\x0c"
                                    "OBJECT_STATE"));

  ASSERT_TRUE(sink.consume(tracked(3'033'000)));
  EXPECT_EQ(test::kinds_of(chunks_of(client.binary().value())).find('S'), std::string::npos) << "the skin comes once";
}

TEST(ViewSink, RecordsFramesAndStatesAlsoWhereNobodyLooks) {
  // Record two frames.
  const test::TempFolder folder;
  SystemClock clock;
  LogRecorder recorder({folder.path()}, make_silent_logger(), clock);
  auto server = ViewServer::start({{"127.0.0.1", 0}, {}, {}, &recorder}, clock);
  ASSERT_TRUE(server) << server.error().message();
  const PublishParams params;
  ViewSink sink(params, **server, {"test", true, [] { return PipelineHealth{}; }, {}, {}, "DESK_", &recorder}, clock);
  const TrackedFrame frame = tracked(3'000'000);
  ASSERT_TRUE(sink.consume(tracked(2'900'000))) << "before";
  ASSERT_TRUE(recorder.start(1));
  ASSERT_TRUE(sink.consume(frame) && sink.consume(tracked(3'033'000)));
  ASSERT_TRUE(sink.finish());

  // The log holds what the bus gets, and the frames.
  auto log = LcmLogReader::open(folder / recorder.state().file);
  ASSERT_TRUE(log) << log.error().message();
  std::vector<std::string> channels;
  for (const LogEntry& entry : log->entries()) channels.push_back(entry.channel);
  const std::vector<std::string> once = {"DESK_RGBD_FRAME",  "DESK_HAND_STATE",    "DESK_GLOVE_STATE",
                                         "DESK_HAND_JOINTS", "DESK_CONTACT_STATE", "DESK_GRASP_STATE",
                                         "DESK_OBJECT_STATE"};
  std::vector<std::string> twice = once;
  twice.insert(twice.end(), once.begin(), once.end());
  EXPECT_EQ(channels, twice);
  HandMessageMaker bus(params);
  bus.process(*tracked(2'900'000).estimates[0]);
  const HandMessages messages = bus.process(*frame.estimates[0]);
  EXPECT_EQ(log->read(log->entries()[1]).value(), encode_message(messages.state));
  const auto image = decode_frame_message(log->read(log->entries()[0]).value(), {}, 0);
  ASSERT_TRUE(image) << image.error().message();
  EXPECT_EQ((*image)->utime, 3'000'000);
  EXPECT_EQ((*image)->number, 3000);
  EXPECT_EQ((*image)->depth.at(5, 5), 500);
}

TEST(ViewSink, TellsTheStateOfTheRecorderAtOnce) {
  const test::TempFolder folder;
  SystemClock clock;
  ManualClock time(1'000'000);
  LogRecorder recorder({folder.path()}, make_silent_logger(), clock);
  auto server = ViewServer::start({{"127.0.0.1", 0}, {}, {}, &recorder}, clock);
  ASSERT_TRUE(server);
  ViewSink sink({}, **server, {"test", true, [] { return PipelineHealth{}; }, {}, {}, "", &recorder}, time);
  SocketClient client(test::port_of((*server)->url()));
  ASSERT_TRUE(sink.idle());
  auto status = nlohmann::json::parse(client.text().value());
  EXPECT_EQ(status["record"]["folder"], folder.path());
  EXPECT_EQ(status["record"]["recording"], false);
  client.send(R"({"type": "record", "on": true})");
  while (!recorder.recording()) std::this_thread::yield();
  ASSERT_TRUE(sink.idle()) << "long before the next status is due";
  status = nlohmann::json::parse(client.text().value());
  EXPECT_EQ(status["record"]["recording"], true);
  EXPECT_EQ(status["record"]["file"], recorder.state().file);
}

/// A viewer that comes later sees the hand where the bus says that it is, and not where a filter begins anew.
TEST(ViewSink, SmoothsOnWhileNobodyLooks) {
  SystemClock clock;
  auto server = ViewServer::start({{"127.0.0.1", 0}, {}, {}}, clock);
  ASSERT_TRUE(server) << server.error().message();
  const PublishParams params;
  ViewSink sink(params, **server, {"test", true, [] { return PipelineHealth{}; }}, clock);
  HandMessageMaker bus(params);
  const auto moved = [](int number) {
    TrackedFrame frame = tracked(3'000'000 + 33'000 * number);
    HandEstimate estimate = *frame.estimates[0];
    for (SegmentState& segment : estimate.segments) segment.T_camera_segment.t.x() += 0.02 * number;
    frame.estimates[0] = std::make_shared<const HandEstimate>(estimate);
    return frame;
  };
  for (int number = 0; number < 3; ++number) {
    ASSERT_TRUE(sink.consume(moved(number)));
    bus.process(*moved(number).estimates[0]);
  }

  SocketClient client(test::port_of((*server)->url()));
  client.send(R"({"type": "want"})");
  client.send("?");
  ASSERT_TRUE(client.text());
  ASSERT_TRUE(sink.consume(moved(3)));
  const auto state = encode_message(bus.process(*moved(3).estimates[0]).state);
  const auto chunks = chunks_of(client.binary().value());
  ASSERT_EQ(test::kinds_of(chunks), "SFLLLLLL");
  EXPECT_EQ(chunks[2].payload, "\x0aHAND_STATE" + std::string(state.begin(), state.end()));
}

PipelineHealth health(std::int64_t captured, std::int64_t published, std::int64_t failed) {
  PipelineHealth health;
  health.captured = captured;
  health.published = published;
  health.failed = failed;
  return health;
}

/// The page's status when nothing was tracked for 5 s.
nlohmann::json silent_status(ViewSink::Input input) {
  SystemClock clock;
  ManualClock time(1'000'000);
  auto server = ViewServer::start({{"127.0.0.1", 0}, {}, {}, nullptr}, clock);
  EXPECT_TRUE(server);
  ViewSink sink({}, **server, std::move(input), time);
  SocketClient client(test::port_of((*server)->url()));
  client.send("?");
  EXPECT_TRUE(client.text());
  time.advance(5'000'000);
  EXPECT_TRUE(sink.idle());
  return nlohmann::json::parse(client.text().value());
}

TEST(ViewSink, SaysThatNoFramesCome) {
  ViewSink::Input input{"test", true, [] { return PipelineHealth{}; }};
  input.if_silent = "Is it plugged in?";
  const auto status = silent_status(std::move(input));
  EXPECT_EQ(status["type"], "status");
  EXPECT_EQ(status["trouble"], "No frame has come yet, for 5 s. Is it plugged in?");
  EXPECT_EQ(status["record"]["folder"], "") << "nothing can be recorded";
  EXPECT_EQ(status["health"]["queues"].back()["name"], "view");
  EXPECT_TRUE(status["health"]["latency"]["mean"].is_number());
}

TEST(ViewSink, SaysThatAFrameIsBeingTracked) {
  ViewSink::Input input{"test", false, [] { return health(3, 1, 1); }};
  input.if_silent = "Is it plugged in?";
  input.held_up_by = [] { return ""; };
  EXPECT_EQ(silent_status(std::move(input))["trouble"],
            "Tracking the first frame has taken 5 s so far. Is the processor busy with other work?");
}

TEST(ViewSink, SaysWhatHoldsUpTheTracker) {
  ViewSink::Input input{"test", false, [] { return health(3, 1, 0); }};
  input.held_up_by = [] { return "The hand is being scanned."; };
  EXPECT_EQ(silent_status(std::move(input))["trouble"], "The hand is being scanned. So far it has taken 5 s.");
}

TEST(ViewSink, SaysAtTheEndHowManyFramesWereTracked) {
  SystemClock clock;
  auto server = ViewServer::start({{"127.0.0.1", 0}, {}, {}, nullptr}, clock);
  ASSERT_TRUE(server);
  ManualClock time(1'000'000);
  ViewSink sink({}, **server, {"test", false, [] { return health(7, 7, 0); }}, time);
  SocketClient client(test::port_of((*server)->url()));
  client.send("?");
  ASSERT_TRUE(client.text());
  time.advance(5'000'000);
  ASSERT_TRUE(sink.finish());
  const auto status = nlohmann::json::parse(client.text().value());
  EXPECT_EQ(status["health"]["published"], 7);
  EXPECT_EQ(status["trouble"], "") << "no more frames are expected";
}

}  // namespace
}  // namespace barehand
