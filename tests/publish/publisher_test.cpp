#include "stages/publish/publisher.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "drivers/lcm/layouts.h"
#include "drivers/lcm/lcm_listener.h"
#include "io/lcm/lcm_bus.h"
#include "io/lcm/lcm_log_reader.h"
#include "io/lcm/lcm_log_writer.h"
#include "published_hand.h"

namespace barehand {
namespace {

constexpr std::int64_t kStart = 1'700'000'000'000'000;

HandMessages messages(std::int64_t utime = kStart) {
  HandMessageMaker maker{{}};
  return maker.process(estimate_of(*test::adult_hand(Handedness::right), {}, utime));
}

/// Stores all messages, or refuses all.
class MemorySink : public MessageSink {
 public:
  Result<void> send(const std::string& channel, std::span<const std::uint8_t> message, std::int64_t utime) override {
    if (refuse) return fail("refused");
    received[channel] = {message.begin(), message.end()};
    stamps.push_back(utime);
    return {};
  }
  bool refuse = false;
  std::map<std::string, std::vector<std::uint8_t>> received;
  std::vector<std::int64_t> stamps;
};

TEST(Publisher, SendsEveryMessageOnItsPrefixedChannel) {
  MemorySink sink;
  Publisher publisher = Publisher::create("LEFT_", {&sink}).value();
  ASSERT_TRUE(publisher.send_hand(messages()));
  ASSERT_TRUE(publisher.send(health_t{}));
  ASSERT_EQ(sink.received.size(), 4u);
  const auto state = decode_message<hand_state_t>(sink.received.at("LEFT_HAND_STATE"));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->status, hand_state_t::TRACKING);
  EXPECT_TRUE(decode_message<glove_state_t>(sink.received.at("LEFT_GLOVE_STATE")));
  EXPECT_TRUE(decode_message<hand_joints_t>(sink.received.at("LEFT_HAND_JOINTS")));
  EXPECT_TRUE(decode_message<health_t>(sink.received.at("LEFT_HEALTH")));
  EXPECT_EQ(sink.stamps[0], kStart) << "the stamp is the measurement's time";
}

TEST(Publisher, SendsContactsAndObjectsWhereThereAreSome) {
  MemorySink sink;
  Publisher publisher = Publisher::create("", {&sink}).value();
  HandMessages hand = messages();
  hand.contact = contact_state_t{};
  hand.contact->hand_id = 5;
  ASSERT_TRUE(publisher.send_findings(hand));
  object_state_t object{};
  object.object_id = 7;
  ASSERT_TRUE(publisher.send(object));
  ASSERT_EQ(sink.received.size(), 2u);
  EXPECT_EQ(decode_message<contact_state_t>(sink.received.at("CONTACT_STATE"))->hand_id, 5);
  EXPECT_EQ(decode_message<object_state_t>(sink.received.at("OBJECT_STATE"))->object_id, 7);
}

TEST(Publisher, SendsGraspsWhereTheyAreKnown) {
  MemorySink sink;
  Publisher publisher = Publisher::create("DESK_", {&sink}).value();
  HandMessages hand = messages();
  hand.grasp = grasp_state_t{};
  hand.grasp->grasp = grasp_state_t::PINCH;
  ASSERT_TRUE(publisher.send_findings(hand));
  ASSERT_EQ(sink.received.size(), 1u);
  EXPECT_EQ(decode_message<grasp_state_t>(sink.received.at("DESK_GRASP_STATE"))->grasp, grasp_state_t::PINCH);
}

TEST(Publisher, OneBrokenSinkDoesNotSilenceTheOthers) {
  MemorySink broken, healthy;
  broken.refuse = true;
  Publisher publisher = Publisher::create("", {&broken, &healthy}).value();
  EXPECT_FALSE(publisher.send_hand(messages()));
  EXPECT_EQ(healthy.received.size(), 3u);
}

TEST(Publisher, APrefixThatLcmCannotCarryIsAnError) {
  EXPECT_FALSE(Publisher::create(std::string(51, 'P'), {}));
  EXPECT_TRUE(Publisher::create(std::string(50, 'P'), {}));
}

TEST(Publisher, TwoRunsWriteTheSameLog) {
  const auto path = [](int run) {
    return std::filesystem::temp_directory_path() /
           ("barehand-publisher-" + std::to_string(::getpid()) + "-" + std::to_string(run));
  };
  const auto content = [](const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  for (const int run : {0, 1}) {
    auto log = LcmLogWriter::create(path(run), true).value();
    Publisher publisher = Publisher::create("", {log.get()}).value();
    for (int frame = 0; frame < 3; ++frame) ASSERT_TRUE(publisher.send_hand(messages(kStart + frame)));
  }
  EXPECT_GT(content(path(0)).size(), 3 * 8000u);
  EXPECT_EQ(content(path(0)), content(path(1)));
  EXPECT_EQ(LcmLogReader::open(path(0))->entries()[3].timestamp, kStart + 1);
  for (const int run : {0, 1}) std::filesystem::remove(path(run));
}

TEST(Publisher, ReachesSubscribersOnABus) {
  const std::shared_ptr<LcmBus> bus = LcmBus::open("memq://").value();
  std::atomic<int> states = 0;
  const LcmListener listener(bus, "*HAND_STATE", [&](const std::string& channel, WireBytes message) {
    if (channel == "P_HAND_STATE" && decode_message<hand_state_t>(message)) ++states;
  });
  Publisher publisher = Publisher::create("P_", {bus.get()}).value();
  for (int frame = 0; frame < 5; ++frame) ASSERT_TRUE(publisher.send_hand(messages(kStart + frame)));
  while (states < 5) std::this_thread::yield();
}

}  // namespace
}  // namespace barehand
