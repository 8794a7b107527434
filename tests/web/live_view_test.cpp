#include "app/view/live_view.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/log.h"
#include "drivers/lcm/wire.h"
#include "io/lcm/lcm_log_reader.h"
#include "publish/published_hand.h"
#include "stages/publish/hand_messages.h"
#include "support/temp_folder.h"
#include "web/web_client.h"

namespace barehand {
namespace {

TEST(LiveView, ShowsWhatATrackerSends) {
  const SystemClock clock;
  auto server = ViewServer::start({{"127.0.0.1", 0}, {}, {}, nullptr}, clock);
  ASSERT_TRUE(server) << server.error().message();
  test::SocketClient client(test::port_of((*server)->url()));
  client.send(R"({"type": "want"})");
  client.send("?");
  ASSERT_TRUE(client.text());

  auto opened = LcmBus::open("memq://");
  ASSERT_TRUE(opened) << opened.error().message();
  const std::shared_ptr<LcmBus> bus = std::move(*opened);
  ShownHands hands({test::adult_hand(Handedness::left), test::adult_hand(Handedness::right)});
  LiveView live(bus, {"DESK_", {}, nullptr}, std::move(hands), **server, clock);
  HandMessages made = HandMessageMaker({}).process(estimate_of(*test::adult_hand(), {}, 7'000'000));
  ASSERT_TRUE(bus->send("OTHER_HAND_STATE", encode_message(made.state), 1));
  made.state.frame_number = 42;
  ASSERT_TRUE(bus->send("DESK_HAND_STATE", encode_message(made.state), 1));
  ASSERT_TRUE(bus->send("DESK_GLOVE_STATE", encode_message(made.glove), 1));

  while ((*server)->health().pushed == 0) live.step(std::chrono::milliseconds(20));
  const auto chunks = test::chunks_of(client.binary().value());
  ASSERT_EQ(test::kinds_of(chunks), "SFLL");
  EXPECT_EQ(chunks[1].at<std::int64_t>(0), 7'000'000);
  EXPECT_EQ(chunks[1].at<std::int64_t>(8), 42);
}

TEST(LiveView, RecordsWhatComesAsItComes) {
  // A tracker sends the states of one frame, and something that is no tracker's.
  const test::TempFolder folder;
  const SystemClock clock;
  LogRecorder recorder({folder.path()}, make_silent_logger(), clock);
  auto server = ViewServer::start({{"127.0.0.1", 0}, {}, {}, &recorder}, clock);
  ASSERT_TRUE(server) << server.error().message();
  auto opened = LcmBus::open("memq://");
  ASSERT_TRUE(opened) << opened.error().message();
  const std::shared_ptr<LcmBus> bus = std::move(*opened);
  ShownHands hands({test::adult_hand(Handedness::left), test::adult_hand(Handedness::right)});
  LiveView live(bus, {"DESK_", {}, &recorder}, std::move(hands), **server, clock);
  const HandMessages made = HandMessageMaker({}).process(estimate_of(*test::adult_hand(), {}, 7'000'000));
  ASSERT_TRUE(recorder.start(1));
  ASSERT_TRUE(bus->send("DESK_NOTE", std::vector<std::uint8_t>(40), 1));
  ASSERT_TRUE(bus->send("DESK_HAND_STATE", encode_message(made.state), 1));
  ASSERT_TRUE(bus->send("DESK_GLOVE_STATE", encode_message(made.glove), 1));
  while (recorder.state().frames == 0) live.step(std::chrono::milliseconds(20));
  live.step(std::chrono::milliseconds(20));
  recorder.finish();

  auto log = LcmLogReader::open(folder / recorder.state().file);
  ASSERT_TRUE(log) << log.error().message();
  ASSERT_EQ(log->entries().size(), 2u);
  EXPECT_EQ(log->entries()[0].channel, "DESK_HAND_STATE");
  EXPECT_EQ(log->entries()[0].timestamp, 7'000'000);
  EXPECT_EQ(log->read(log->entries()[0]).value(), encode_message(made.state));
  EXPECT_EQ(log->entries()[1].channel, "DESK_GLOVE_STATE");
}

TEST(LiveView, SaysThatNobodySends) {
  const SystemClock clock;
  ManualClock time(1'000'000);
  auto server = ViewServer::start({{"127.0.0.1", 0}, {}, {}, nullptr}, clock);
  ASSERT_TRUE(server);
  test::SocketClient client(test::port_of((*server)->url()));
  auto bus = LcmBus::open("memq://");
  ASSERT_TRUE(bus);
  LiveView live(std::move(*bus), {"DESK_", {}, nullptr}, ShownHands({}, {"", "anna.json"}), **server, time);
  time.advance(9'000'000);
  live.step(std::chrono::milliseconds(0));
  const auto status = nlohmann::json::parse(client.text().value());
  EXPECT_NE(status["trouble"].get<std::string>().find("DESK_"), std::string::npos);
  EXPECT_EQ(status["drawn"], nlohmann::json({"", "anna.json"}));
}

}  // namespace
}  // namespace barehand
