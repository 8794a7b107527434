#include "io/web/view_server.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/log.h"
#include "support/temp_folder.h"
#include "web/web_client.h"

namespace barehand {
namespace {

using test::chunks_of;
using test::SocketClient;

class ViewServerTest : public testing::Test {
 protected:
  void SetUp() override {
    serve({{"127.0.0.1", 0}, {}, [this](const PlayerCommand& command) { commands_.push_back(command); }, nullptr});
  }
  void serve(ViewServer::Options options) {
    auto server = ViewServer::start(std::move(options), clock_);
    ASSERT_TRUE(server) << server.error().message();
    server_ = std::move(*server);
  }
  int port() const { return test::port_of(server_->url()); }
  void show(std::int64_t number) {
    ViewFrame::Content content;
    content.number = number;
    server_->show(std::make_shared<const ViewFrame>(std::move(content)));
  }
  void show(std::int64_t first, std::int64_t last) {
    for (std::int64_t number = first; number <= last; ++number) show(number);
  }
  /// Number of the next frame that a client hears of.
  static std::int64_t next_number(SocketClient& client) {
    const auto message = client.binary();
    return message ? chunks_of(*message).at(0).at<std::int64_t>(8) : -1;
  }
  /// The server answers in order: what was sent before has been heard.
  static void wait_until_heard(SocketClient& client) {
    client.send("?");
    while (true) {
      const auto text = client.text();
      ASSERT_TRUE(text);
      if (nlohmann::json::parse(*text)["type"] == "error") return;
    }
  }
  /// Sends a client's wish, and waits until the server has heard it.
  static void ask(SocketClient& client, const char* wish) {
    client.send(wish);
    wait_until_heard(client);
  }

  SystemClock clock_;
  std::vector<PlayerCommand> commands_;
  std::unique_ptr<ViewServer> server_;
};

TEST_F(ViewServerTest, SendsNoFrameBeforeItIsAsked) {
  SocketClient client(port());
  wait_until_heard(client);
  show(1);
  show(2);
  EXPECT_EQ(server_->health().popped, 0);
  client.send(R"({"type": "want", "window": 1})");
  EXPECT_EQ(next_number(client), 2) << "the newest one";
}

TEST_F(ViewServerTest, ABurstLosesNoFrames) {
  for (const char* wish : {R"({"type": "want"})", R"({"type": "want", "window": 12, "rate": 1000})"}) {
    while (server_->clients() > 0) std::this_thread::yield();  // a second client would get the first one's last frame
    SocketClient client(port());
    ask(client, wish);
    show(1, 12);
    for (int number = 1; number <= 12; ++number) ASSERT_EQ(next_number(client), number) << wish;
  }
  EXPECT_EQ(server_->health().dropped, 0);
}

TEST_F(ViewServerTest, SendsNoMoreThanTheRateThatIsWished) {
  SocketClient client(port());
  ask(client, R"({"type": "want", "rate": 0.1})");
  show(1);
  EXPECT_EQ(next_number(client), 1);
  show(2, 12);
  EXPECT_EQ(server_->health().popped, 1);
  EXPECT_EQ(server_->health().depth, 1u) << "the newest one, which waits for its time";
}

TEST_F(ViewServerTest, SendsTheNewestFrameToAClientThatIsSlow) {
  SocketClient client(port());
  ask(client, R"({"type": "want", "window": 1, "rate": 1000})");
  show(1);
  EXPECT_EQ(next_number(client), 1);
  show(2, 50);
  const QueueHealth stuck = server_->health();
  EXPECT_EQ(stuck.pushed, 50);
  EXPECT_EQ(stuck.popped, 1) << "it has not acknowledged the first";
  EXPECT_EQ(stuck.dropped, 48);
  EXPECT_EQ(stuck.depth, 1u);
  client.send(R"({"type": "ack"})");
  EXPECT_EQ(next_number(client), 50);
}

TEST_F(ViewServerTest, SendsTheFrameAgainWhereTheWishChanges) {
  SocketClient client(port());
  ask(client, R"({"type": "want", "window": 1})");
  show(7);
  EXPECT_EQ(next_number(client), 7);
  client.send(R"({"type": "want", "window": 1, "cloud": "scene"})");
  EXPECT_EQ(next_number(client), 7);
}

TEST_F(ViewServerTest, WaitsForNoClientThatDoesNotRead) {
  test::RawClient stuck(port());
  stuck.send("GET /live HTTP/1.1\r\n" + test::upgrade("Host: localhost\r\n") + "\r\n");
  ASSERT_EQ(test::status_of(stuck.read(false)), 101);
  // {"type":"want"}, with a mask of zeros.
  stuck.send(std::string("\x81\x8f\0\0\0\0", 6) + R"({"type":"want"})");
  SocketClient quick(port());
  ask(quick, R"({"type": "want", "window": 1, "rate": 1000})");

  // Far more than the buffers of the operating system hold.
  ViewFrame::Content content;
  content.messages.push_back({"HAND_STATE", {}});
  content.messages[0].bytes.resize(1 << 20);
  for (int number = 1; number <= 40; ++number) {
    content.number = number;
    server_->show(std::make_shared<const ViewFrame>(content));
    EXPECT_EQ(next_number(quick), number);
    quick.send(R"({"type": "ack"})");
  }
  const QueueHealth health = server_->health();
  EXPECT_GT(health.dropped, 0) << "those for the client that is stuck";
  EXPECT_EQ(health.pushed, health.popped + health.dropped + static_cast<std::int64_t>(health.depth));
}

TEST_F(ViewServerTest, AFloodOfRequestsHoldsUpNobody) {
  test::RawClient flood(port());
  flood.send("GET /live HTTP/1.1\r\n" + test::upgrade("Host: localhost\r\n") + "\r\n");
  ASSERT_EQ(test::status_of(flood.read(false)), 101);
  SocketClient quick(port());
  ask(quick, R"({"type": "want", "window": 1, "rate": 1000})");

  // Wishes, commands and nonsense, with masks of zeros; none of the answers is read.
  const auto message = [](const std::string& text) {
    return std::string("\x81", 1) + static_cast<char>(0x80 | text.size()) + std::string(4, '\0') + text;
  };
  std::string requests;
  for (int i = 0; i < 5000; ++i)
    requests += message(R"({"type":"want"})") + message(R"({"type":"pause"})") + message("?");
  flood.send(requests);
  for (int number = 1; number <= 20; ++number) {
    show(number);
    EXPECT_EQ(next_number(quick), number);
    quick.send(R"({"type": "ack"})");
  }
  const QueueHealth health = server_->health();
  EXPECT_EQ(health.pushed, health.popped + health.dropped + static_cast<std::int64_t>(health.depth));
}

TEST_F(ViewServerTest, CountsClientsThatHaveGone) {
  {
    SocketClient client(port());
    ask(client, R"({"type": "want", "window": 1})");
    show(1, 3);
    EXPECT_EQ(server_->clients(), 1);
  }
  while (server_->clients() > 0) std::this_thread::yield();
  const QueueHealth health = server_->health();
  EXPECT_EQ(health.pushed, 3);
  EXPECT_EQ(health.depth, 0u);
  EXPECT_EQ(health.popped + health.dropped, 3);
  EXPECT_EQ(health.capacity, 0u);
}

TEST_F(ViewServerTest, TellsTheStatusToThoseWhoComeLater) {
  server_->show_status(R"({"type": "status", "source": "here"})");
  SocketClient client(port());
  EXPECT_EQ(nlohmann::json::parse(client.text().value())["source"], "here");
}

TEST_F(ViewServerTest, ALastWordReachesThoseWhoReadBeforeTheEnd) {
  SocketClient client(port());
  wait_until_heard(client);
  server_->show_status(R"({"type": "status", "source": "the last"})");
  server_->flush(std::chrono::seconds(20));
  server_.reset();
  EXPECT_EQ(nlohmann::json::parse(client.text().value())["source"], "the last");
}

TEST_F(ViewServerTest, TellsItsClientsWhyItEnds) {
  SocketClient page(port()), stranger(port(), "/", "foxglove.sdk.v1");
  ask(page, R"({"type": "want", "window": 1})");
  ASSERT_TRUE(stranger.text());
  show(1);
  EXPECT_EQ(next_number(page), 1);
  show(2);  // waits, because the first one is not acknowledged
  server_->show_status(R"({"type": "status", "source": "the last"})");
  server_->set_farewell({Farewell::kDone, "All is shown."});
  server_.reset();

  // The last frame and status arrive before.
  EXPECT_EQ(next_number(page), 2);
  EXPECT_EQ(nlohmann::json::parse(page.text().value())["source"], "the last");
  for (SocketClient* client : {&page, &stranger}) {
    EXPECT_TRUE(client->is_let_go());
    EXPECT_EQ(client->farewell(), std::pair(1000, std::string("All is shown.")));
  }
}

TEST_F(ViewServerTest, MayComeBackUnlessItSaysOtherwise) {
  SocketClient client(port());
  wait_until_heard(client);
  server_.reset();
  EXPECT_TRUE(client.is_let_go());
  EXPECT_EQ(client.farewell(), std::pair(1001, std::string("Barehand was stopped.")));
}

TEST_F(ViewServerTest, AnswersEveryMessageThatIsWrong) {
  SocketClient client(port());
  for (const char* text : {"{", R"({"type": 7})", R"({"type": "want", "rate": "fast"})"}) client.send(text);
  for (const char* expected : {"is not valid JSON at line 1, column 2", "\"type\" is 7", "\"rate\" is \"fast\""}) {
    const auto answer = nlohmann::json::parse(client.text().value());
    EXPECT_NE(answer["text"].get<std::string>().find(expected), std::string::npos) << answer;
  }
}

TEST_F(ViewServerTest, HandsCommandsOn) {
  SocketClient client(port());
  client.send(R"({"type": "seek", "value": 12})");
  wait_until_heard(client);
  ASSERT_EQ(commands_.size(), 1u);
  EXPECT_EQ(commands_[0].kind, PlayerCommand::Kind::seek);
  EXPECT_EQ(commands_[0].value, 12);
}

TEST_F(ViewServerTest, SaysWhereNothingCanBeRecorded) {
  SocketClient client(port());
  client.send(R"({"type": "record", "on": true})");
  const auto answer = nlohmann::json::parse(client.text().value());
  EXPECT_EQ(answer["type"], "error");
  EXPECT_NE(answer["text"].get<std::string>().find("nothing can be recorded"), std::string::npos);
}

TEST_F(ViewServerTest, SaysWhereThereIsNoLogToPlay) {
  server_.reset();
  serve({{"127.0.0.1", 0}, {}, {}, nullptr});
  SocketClient client(port());
  for (const char* command : {R"({"type": "play"})", R"({"type": "seek", "value": 12})"}) {
    client.send(command);
    const auto answer = nlohmann::json::parse(client.text().value());
    EXPECT_EQ(answer["type"], "error");
    EXPECT_NE(answer["text"].get<std::string>().find("no log is played here"), std::string::npos) << answer;
  }

  // The connection goes on.
  client.send(R"({"type": "want"})");
  show(1);
  EXPECT_EQ(next_number(client), 1);
}

class RecordingServerTest : public ViewServerTest {
 protected:
  void SetUp() override {
    recorder_ = std::make_unique<LogRecorder>(LogRecorder::Options{folder_.path()}, make_silent_logger(), clock_);
    serve({{"127.0.0.1", 0}, {}, {}, recorder_.get()});
  }

  const test::TempFolder folder_;
  std::unique_ptr<LogRecorder> recorder_;
};

TEST_F(RecordingServerTest, EveryClientStartsAndStops) {
  SocketClient first(port()), second(port());
  first.send(R"({"type": "record", "on": true})");
  wait_until_heard(first);
  EXPECT_TRUE(recorder_->recording());
  second.send(R"({"type": "record", "on": true})");
  wait_until_heard(second);
  EXPECT_TRUE(recorder_->recording()) << "it goes on";
  recorder_->post(1, [](MessageSink& log) { return log.send("A", {}, 1); });
  second.send(R"({"type": "record", "on": false})");
  wait_until_heard(second);
  EXPECT_FALSE(recorder_->recording());
  EXPECT_EQ(recorder_->state().note, "Stopped from another page.");
}

TEST_F(RecordingServerTest, TellsTheClientWhyNothingIsRecorded) {
  std::filesystem::remove_all(folder_.path());
  SocketClient client(port());
  client.send(R"({"type": "record", "on": true})");
  const auto answer = nlohmann::json::parse(client.text().value());
  EXPECT_EQ(answer["type"], "error");
  EXPECT_NE(answer["text"].get<std::string>().find(folder_.path()), std::string::npos) << answer;
}

TEST_F(RecordingServerTest, ObeysNoCommandThatSaysMoreAndNoPageOfAnotherOrigin) {
  SocketClient client(port());
  client.send(R"({"type": "record", "on": true, "folder": "/tmp"})");
  EXPECT_EQ(nlohmann::json::parse(client.text().value())["type"], "error");

  // The server refuses the handshake, and nothing that follows it is heard.
  test::RawClient foreign(port());
  foreign.send("GET /live HTTP/1.1\r\n" + test::upgrade("Host: localhost\r\nOrigin: https://evil.example\r\n") +
               "\r\n" + std::string("\x81\x9e\0\0\0\0", 6) + R"({"type": "record", "on": true})");
  EXPECT_NE(test::status_of(foreign.read()), 101);
  EXPECT_FALSE(recorder_->recording());
}

TEST_F(ViewServerTest, AnswersWhatItDoesNotUnderstand) {
  SocketClient client(port());
  client.send("\xff\xfe no JSON");
  const auto answer = nlohmann::json::parse(client.text().value());
  EXPECT_EQ(answer["type"], "error");
}

}  // namespace
}  // namespace barehand
