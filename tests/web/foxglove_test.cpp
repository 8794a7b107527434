#include "io/foxglove/foxglove_client.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/clock.h"
#include "io/hand/hand_json.h"
#include "io/web/view_server.h"
#include "tests/lcm/test_frames.h"
#include "web/web_client.h"

namespace barehand {
namespace {

using Json = nlohmann::json;
using test::SocketClient;
using ::testing::HasSubstr;

ViewFramePtr frame(int number, bool has_pose = true) {
  ViewFrame::Content content;
  content.frame = std::make_shared<RgbdFrame>(test_frame(number));
  content.utime = content.frame->utime;
  content.number = number;
  ros::HandState& hand = content.hands.emplace_back();
  hand = {};
  hand.state.utime = content.utime;
  hand.state.handedness = hand_state_t::RIGHT;
  hand.state.has_pose = has_pose;
  for (int i = 0; i < 21; ++i) {
    hand.glove.joint_name[i] = "joint" + std::to_string(i);
    hand.glove.joint_angle[i] = 0.01 * i + number;
  }
  return std::make_shared<const ViewFrame>(std::move(content));
}

class Foxglove : public testing::TestWithParam<const char*> {
 protected:
  Foxglove() {
    ViewServer::Options options;
    options.address.port = 0;
    server_ = ViewServer::start(std::move(options), clock_).value();
  }
  int port() const { return test::port_of(server_->url()); }
  /// The server knows it when it returns.
  std::unique_ptr<SocketClient> viewer() const {
    auto client = std::make_unique<SocketClient>(port(), "/", GetParam());
    EXPECT_EQ(text_of(*client, "serverInfo")["name"], "barehand");
    return client;
  }
  /// Waits for a text message with this operation.
  static Json text_of(SocketClient& client, const std::string& op) {
    while (const auto message = client.text()) {
      Json json = Json::parse(*message);
      if (json["op"] == op) return json;
    }
    ADD_FAILURE() << "no " << op;
    return Json::object();
  }
  /// The number of a topic's channel; 0: there is none.
  static int channel(const Json& advertised, const std::string& topic) {
    for (const Json& one : advertised["channels"])
      if (one["topic"] == topic) return one["id"];
    return 0;
  }
  static void subscribe(SocketClient& client, int id, int channel) {
    client.send(R"({"op": "subscribe", "subscriptions": [{"id": )" + std::to_string(id) + R"(, "channelId": )" +
                std::to_string(channel) + "}]}");
  }
  /// The server answers in order: what was sent before has been heard.
  static void wait_until_heard(SocketClient& client) {
    client.send("?");
    text_of(client, "status");
  }

  SystemClock clock_;
  std::unique_ptr<ViewServer> server_;
};
constexpr const char* kJoints = "/right_hand/joint_states";

TEST_P(Foxglove, AViewerGetsWhatItSubscribesTo) {
  const auto client = viewer();
  server_->show(frame(1));
  const Json advertised = text_of(*client, "advertise");
  for (const Json& one : advertised["channels"]) {
    EXPECT_EQ(one["encoding"], "cdr");
    EXPECT_EQ(one["schemaEncoding"], "ros2msg");
  }
  subscribe(*client, 77, channel(advertised, kJoints));

  // Kind of message, subscription, time in nanoseconds, message.
  const std::string message = client->binary().value_or("");
  ASSERT_GT(message.size(), 13u);
  std::uint32_t subscription = 0;
  std::uint64_t time = 0;
  std::memcpy(&subscription, &message[1], 4);
  std::memcpy(&time, &message[5], 8);
  EXPECT_EQ(message[0], 1);
  EXPECT_EQ(subscription, 77u);
  EXPECT_EQ(time, static_cast<std::uint64_t>(test_frame(1).utime) * 1000);
  const ros::Bytes expected = ros::encode(ros::joint_state(frame(1)->content().hands[0]));
  EXPECT_EQ(message.substr(13), std::string(expected.begin(), expected.end()));
}

TEST_P(Foxglove, TopicsAreToldWhenTheyHaveSomethingToSay) {
  const auto client = viewer();
  server_->show(frame(1, false));
  EXPECT_EQ(channel(text_of(*client, "advertise"), kJoints), 0) << "a hand that is not seen has no joints";
  server_->show(frame(2));
  const Json more = text_of(*client, "advertise");
  EXPECT_EQ(more["channels"].size(), 2u) << more;
  EXPECT_GT(channel(more, kJoints), 0);
}

TEST_P(Foxglove, NothingComesUnaskedOrAfterTheEndOfASubscription) {
  const auto client = viewer();
  server_->show(frame(1));
  const int joints = channel(text_of(*client, "advertise"), kJoints);
  subscribe(*client, 5, joints);
  ASSERT_TRUE(client->binary());
  client->send(R"({"op": "unsubscribe", "subscriptionIds": [5]})");
  wait_until_heard(*client);
  while (server_->health().depth > 0) std::this_thread::yield();
  server_->show(frame(2));
  while (server_->health().depth > 0) std::this_thread::yield();
  subscribe(*client, 6, joints);
  std::string message = client->binary().value_or("");
  while (message.size() > 5 && message[1] == 5) message = client->binary().value_or("");  // on its way before
  ASSERT_GT(message.size(), 13u);
  EXPECT_EQ(message[1], 6);
}

TEST_P(Foxglove, WhatIsNotUnderstoodIsAnsweredAndTheViewerStays) {
  const auto client = viewer();
  const std::pair<std::string, const char*> strange[] = {
      {"nonsense", "not valid JSON"},
      {R"({"op": "subscribe", )", "not valid JSON"},
      {"[]", "no JSON object"},
      {R"({"op": 3})", "\"op\""},
      {R"({"op": "advertise", "channels": []})", "\"advertise\" is not offered"},
      {R"({"op": "subscribe"})", "\"subscriptions\""},
      {R"({"op": "unsubscribe"})", "\"subscriptionIds\""},
      {R"({"op": "subscribe", "subscriptions": [{"channelId": 2}]})", "\"id\""},
      {R"({"op": "subscribe", "subscriptions": [{"id": 1}]})", "\"channelId\""},
      {R"({"op": "subscribe", "subscriptions": [{"id": -1, "channelId": 2}]})", "\"id\""},
      {R"({"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 99999999999}]})", "\"channelId\""},
      {R"({"op": "subscribe", "subscriptions": [7]})", "\"id\""},
      {R"({"op": "unsubscribe", "subscriptionIds": ["7"]})", "\"subscriptionIds\""},
      {R"({"op": "unsubscribe", "subscriptionIds": [7]})", "Subscription 7 does not exist"},
      {"{\"op\": \"\xff\"}", "not valid JSON"}};
  for (const auto& [text, why] : strange) client->send(text);
  for (const auto& [text, why] : strange) {  // each has an answer, in their order
    const Json status = text_of(*client, "status");
    EXPECT_EQ(status["level"], 2) << text;
    EXPECT_THAT(status["message"], HasSubstr(why)) << text;
  }
  server_->show(frame(1));
  EXPECT_FALSE(text_of(*client, "advertise").empty());
}

TEST_P(Foxglove, ASubscriptionThatIsNotPossibleIsAnswered) {
  const auto client = viewer();
  subscribe(*client, 1, 1);
  EXPECT_THAT(text_of(*client, "status")["message"], HasSubstr("channel 1, which does not exist"))
      << "before it is told";
  server_->show(frame(1));
  const Json advertised = text_of(*client, "advertise");
  const int joints = channel(advertised, kJoints), beyond = static_cast<int>(advertised["channels"].size()) + 1;

  // One message may hold possible and impossible ones.
  client->send(R"({"op": "subscribe", "subscriptions": [{"id": 4, "channelId": 0}, {"id": 5, "channelId": )" +
               std::to_string(joints) + R"(}, {"id": 6, "channelId": )" + std::to_string(beyond) + "}]}");
  EXPECT_THAT(text_of(*client, "status")["message"], HasSubstr("Subscription 4 asks for channel 0"));
  EXPECT_THAT(text_of(*client, "status")["message"],
              HasSubstr("Subscription 6 asks for channel " + std::to_string(beyond)));
  const std::string message = client->binary().value_or("");
  ASSERT_GT(message.size(), 13u);
  EXPECT_EQ(message[1], 5);

  // An id twice, and too many of them.
  subscribe(*client, 5, joints);
  EXPECT_THAT(text_of(*client, "status")["message"], HasSubstr("Subscription 5 exists already"));
  for (int id = 100; id < 356; ++id) subscribe(*client, id, joints);
  EXPECT_THAT(text_of(*client, "status")["message"], HasSubstr("too many"));
}

TEST_P(Foxglove, AViewerThatDoesNotReadHoldsUpNobody) {
  const auto client = viewer();
  for (int number = 0; number < 50; ++number) server_->show(frame(number));
  while (server_->health().depth > 0) std::this_thread::yield();
  const QueueHealth health = server_->health();
  EXPECT_EQ(health.pushed, health.popped + health.dropped);
  EXPECT_EQ(health.capacity, WaitingFrames::kMost);
}

TEST_P(Foxglove, TheProtocolIsAgreedOn) {
  test::RawClient client(port());
  client.send("GET / HTTP/1.1\r\n" +
              test::upgrade("Host: localhost\r\nSec-WebSocket-Protocol: other, " + std::string(GetParam()) + "\r\n") +
              "\r\n");
  EXPECT_THAT(client.read(false), HasSubstr("Sec-WebSocket-Protocol: " + std::string(GetParam()) + "\r\n"));
}

TEST_P(Foxglove, AViewerThatHasGoneLeavesNoTraceInLaterConnections) {
  viewer();
  for (int i = 0; i < 100; ++i) {  // more often than the server has threads, each of which remembers its last client
    test::RawClient page(port());
    page.send("GET /live HTTP/1.1\r\n" + test::upgrade("Host: localhost\r\n") + "\r\n");
    const std::string answer = page.read(false);
    ASSERT_EQ(test::status_of(answer), 101) << i << answer;
    ASSERT_THAT(answer, Not(HasSubstr("Sec-WebSocket-Protocol"))) << i;
  }
}
INSTANTIATE_TEST_SUITE_P(Protocols, Foxglove, testing::ValuesIn(kFoxgloveProtocols),
                         [](const auto& one) { return one.index == 0 ? "Sdk" : "WebSocket"; });

class FoxgloveServer : public Foxglove {};
INSTANTIATE_TEST_SUITE_P(All, FoxgloveServer, testing::Values(""));

TEST_P(FoxgloveServer, OtherProtocolsAndOriginsAreRefused) {
  const std::string mqtt = "Sec-WebSocket-Protocol: mqtt\r\n", own = "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n";
  for (const auto& [path, protocol] :
       {std::pair("/", std::string()), std::pair("/", mqtt), std::pair("/live", mqtt), std::pair("/live", own)}) {
    const std::string answer = test::answer_of(port(), path, test::upgrade("Host: localhost\r\n" + protocol));
    EXPECT_EQ(test::status_of(answer), 404) << path << protocol;
    EXPECT_THAT(answer, HasSubstr("The WebSocket at /live has no subprotocol. Those of the one at / are: "
                                  "foxglove.sdk.v1, foxglove.websocket.v1."));
  }
  test::RawClient foreign(port());
  foreign.send("GET / HTTP/1.1\r\n" +
               test::upgrade("Host: localhost\r\nOrigin: https://example.org\r\n"
                             "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n") +
               "\r\n");
  EXPECT_EQ(test::status_of(foreign.read(false)), 403);
  EXPECT_EQ(server_->clients(), 0);
}

TEST_P(FoxgloveServer, TheHandIsServedAsARobotWithItsLengths) {
  EXPECT_EQ(test::status_of(test::answer_of(port(), "/right_hand.urdf")), 404);
  const auto profile = std::make_shared<const HandProfile>(
      load_profile(std::string(BAREHAND_CONFIGS) + "/hands/adult_right.json").value());
  server_->set_profile(profile);
  const std::string answer = test::answer_of(port(), "/right_hand.urdf");
  EXPECT_EQ(test::status_of(answer), 200);
  EXPECT_THAT(answer, HasSubstr("<robot name=\"right_hand\">"));

  // A frame may show it with other lengths.
  ViewFrame::Content content;
  content.skins[static_cast<std::size_t>(Handedness::right)] =
      std::make_shared<const ViewSkin>(std::make_shared<const HandProfile>(scaled(*profile, 1.1)));
  server_->show(std::make_shared<const ViewFrame>(std::move(content)));
  const std::string larger = test::answer_of(port(), "/right_hand.urdf");
  EXPECT_EQ(test::status_of(larger), 200);
  EXPECT_NE(larger, answer);
  // A hand that is not tracked is answered in words.
  const std::string left = test::answer_of(port(), "/left_hand.urdf", "Host: localhost:8765\r\n");
  EXPECT_EQ(test::status_of(left), 404);
  EXPECT_THAT(left, HasSubstr("Content-Type: text/plain"));
  EXPECT_THAT(left, HasSubstr("The left hand is not tracked. Only the right hand is: "
                              "http://localhost:8765/right_hand.urdf"));
}

TEST_P(FoxgloveServer, SaysThatNoHandIsKnown) {
  const std::string answer = test::answer_of(port(), "/right_hand.urdf");
  EXPECT_EQ(test::status_of(answer), 404);
  EXPECT_THAT(answer, HasSubstr("The right hand is not tracked. No hand is known yet"));
  EXPECT_THAT(test::answer_of(port(), "/hand.urdf"), HasSubstr("There is no such file."));
}

}  // namespace
}  // namespace barehand
