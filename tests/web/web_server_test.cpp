#include "io/web/web_server.h"

#include <gtest/gtest.h>

#include <atomic>

#include "web/web_client.h"

namespace barehand {
namespace {

using test::answer_of;
using test::RawClient;
using test::SocketClient;
using test::status_of;
using test::upgrade;

/// Says "hello", and then what it hears.
class Echo : public WebPeer {
 public:
  explicit Echo(WebSocket socket) : socket_(socket) {}
  void start() override { socket_.send_text("hello"); }
  bool receive(std::string_view text) override {
    socket_.send_text(text);
    return text != "go";
  }

 private:
  WebSocket socket_;
};

template <class Peer = Echo>
std::unique_ptr<WebServer> serve() {
  WebServer::Options options;
  options.files = {{"/index.html", {"text/html", "<p>page</p>"}}, {"/empty.js", {"text/javascript", ""}}};
  options.allowed_origins = {"https://example.org"};
  options.connect = [](WebSocket socket) { return std::make_unique<Peer>(socket); };
  auto server = WebServer::start(std::move(options));
  EXPECT_TRUE(server) << server.error().message();
  return server ? std::move(*server) : nullptr;
}

TEST(WebServer, ServesItsFiles) {
  const auto server = serve();
  for (const char* path : {"/", "/index.html", "/index.html?a=b"}) {
    const std::string answer = answer_of(server->port(), path);
    EXPECT_EQ(status_of(answer), 200) << path;
    EXPECT_TRUE(answer.ends_with("\r\n\r\n<p>page</p>")) << answer;
    EXPECT_NE(answer.find("Content-Type: text/html"), std::string::npos);
  }
  EXPECT_EQ(status_of(answer_of(server->port(), "/empty.js")), 200);
}

TEST(WebServer, ServesNothingElse) {
  const auto server = serve();
  for (const char* path : {"/other", "/../../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd",
                           "/index.html/", "/INDEX.HTML"})
    EXPECT_EQ(status_of(answer_of(server->port(), path)) / 100, 4) << path;
}

TEST(WebServer, RefusesForeignHostsAndOrigins) {
  const auto server = serve();
  for (const char* headers : {"Host: evil.org\r\n", "Host: localhost\r\nOrigin: http://evil.org\r\n", ""}) {
    EXPECT_EQ(status_of(answer_of(server->port(), "/", headers)), 403) << headers;
    EXPECT_EQ(status_of(answer_of(server->port(), "/live", upgrade(headers))), 403) << headers;
  }
}

TEST(WebServer, LetsInvitedPagesConnect) {
  const auto server = serve();
  RawClient client(server->port());
  client.send("GET /live HTTP/1.1\r\n" + upgrade("Host: localhost\r\nOrigin: https://example.org\r\n") + "\r\n");
  EXPECT_EQ(status_of(client.read(false)), 101);
}

TEST(WebServer, SurvivesDamagedRequests) {
  const auto server = serve();
  for (const std::string& request :
       {std::string("\r\n\r\n"), std::string("GET\r\n\r\n"), std::string("GET / HTTP/9.9\r\n\r\n"),
        std::string("DELETE /index.html HTTP/1.1\r\nHost: localhost\r\n\r\n"),
        "GET / HTTP/1.1\r\nHost: " + std::string(60000, 'a') + "\r\n\r\n",
        std::string("\x16\x03\x01\x02\x00\x01\xff\r\n\r\n", 11),
        "POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 99999999999999999999\r\n\r\n" + std::string(10, 'x')}) {
    RawClient client(server->port());
    client.send(request);
    EXPECT_NE(status_of(client.read(false)), 200) << request.substr(0, 30);
  }
  EXPECT_EQ(status_of(answer_of(server->port(), "/")), 200) << "it goes on";
}

TEST(WebServer, TalksOverWebSockets) {
  const auto server = serve();
  SocketClient client(server->port());
  EXPECT_EQ(client.text(), "hello");
  client.send("one");
  EXPECT_EQ(client.text(), "one");
}

TEST(WebServer, LetsGoOfWhoeverIsToGo) {
  const auto server = serve();
  SocketClient client(server->port());
  client.send("go");
  EXPECT_TRUE(client.is_let_go());
}

TEST(WebServer, LetsGoOfClientsThatSendTooMuchAndSaysWhy) {
  const auto server = serve();
  SocketClient client(server->port());
  EXPECT_EQ(client.text(), "hello");
  client.send(std::string(64 << 10, 'x'));
  EXPECT_EQ(client.text()->size(), 64u << 10) << "as much as is allowed";
  client.send(std::string((64 << 10) + 1, 'x'));
  EXPECT_TRUE(client.is_let_go());
  EXPECT_EQ(client.farewell(), std::pair(1009, std::string("A message may have 64 KiB at most.")));
}

TEST(WebServer, RefusesFramesWithReservedBits) {
  const auto server = serve();
  const std::string told = std::string("\x03\xea") + "A frame has reserved bits";  // 1002: protocol error
  for (const char bit : {'\x40', '\x20', '\x10'}) {
    RawClient client(server->port());
    client.send("GET /live HTTP/1.1\r\n" + upgrade("Host: localhost\r\n") + "\r\n");
    ASSERT_EQ(status_of(client.read(false)), 101);
    client.send(static_cast<char>('\x81' | bit) + std::string("\x82\0\0\0\0hi", 7));
    EXPECT_NE(client.read().find(told), std::string::npos);
  }
}

TEST(WebServer, SurvivesDamagedFrames) {
  const auto server = serve();
  // Lengths that are not there, no mask, control frames that are too long, reserved opcodes.
  for (const std::string& frame :
       {std::string("\x81\xff\x7f\xff\xff\xff\xff\xff\xff\xff", 10), std::string("\x81\x05hello", 7),
        std::string("\x89\xfe\xff\xff", 4), std::string("\x8f\x80\0\0\0\0", 6), std::string("\0", 1)}) {
    RawClient client(server->port());
    client.send("GET /live HTTP/1.1\r\n" + upgrade("Host: localhost\r\n") + "\r\n");
    ASSERT_EQ(status_of(client.read(false)), 101);
    client.send(frame);
  }
  SocketClient next(server->port());
  EXPECT_EQ(next.text(), "hello");
}

TEST(WebServer, NamesTheVersionOfWebSocketsThatItSpeaks) {
  const auto server = serve();
  for (const char* version : {"Sec-WebSocket-Version: 8\r\n", ""}) {
    const std::string answer = answer_of(server->port(), "/live",
                                         "Host: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
                                         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
                                             std::string(version));
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 426 Upgrade Required\r\n")) << answer;
    EXPECT_NE(answer.find("\r\nSec-WebSocket-Version: 13\r\n"), std::string::npos) << answer;
  }
}

TEST(WebServer, AnswersRequestsForWebSocketsThatCannotBe) {
  const auto server = serve();
  const std::string keyless = "Host: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n";
  EXPECT_EQ(status_of(answer_of(server->port(), "/live", keyless)), 400);
  EXPECT_EQ(status_of(answer_of(server->port(), "/other", upgrade("Host: localhost\r\n"))), 404);
}

TEST(WebServer, AnswersARequestForTheHeadersAloneWithoutABody) {
  const auto server = serve();
  RawClient client(server->port());
  client.send("HEAD /other HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const std::string answer = client.read();
  EXPECT_EQ(status_of(answer), 404);
  EXPECT_TRUE(answer.ends_with("\r\n\r\n")) << answer;
}

/// Asks for a WebSocket.
std::string request_for_a_socket() {
  std::string request = "GET /live HTTP/1.1\r\n";
  return request.append(upgrade("Host: localhost\r\n")).append("\r\n");
}

/// So many clients that there is no place for another one.
std::vector<std::unique_ptr<SocketClient>> as_many_clients_as_possible(int port) {
  std::vector<std::unique_ptr<SocketClient>> clients;
  for (int i = 0; i < WebServer::kMaxClients; ++i) {
    clients.push_back(std::make_unique<SocketClient>(port));
    EXPECT_EQ(clients.back()->text(), "hello");
  }
  return clients;
}

/// Whether there is a place for another client, at the latest when those have left that are leaving.
bool has_place(int port) {
  for (int attempts = 0; attempts < 100; ++attempts)
    if (SocketClient(port).text() == "hello") return true;
  return false;
}

TEST(WebServer, TellsFurtherClientsThatItIsFull) {
  const auto server = serve();
  auto clients = as_many_clients_as_possible(server->port());
  const std::string told =
      std::string("\x03\xf5") + "Barehand serves 32 pages and viewers already";  // 1013: try again later
  for (int i = 0; i < 30; ++i) {
    RawClient further(server->port());
    further.send(request_for_a_socket());
    further.send(std::string("\x88\x80mask", 6));  // its own wish to close, so that the server need not wait for one
    const std::string answer = further.read();
    EXPECT_EQ(status_of(answer), 101);
    EXPECT_NE(answer.find(told), std::string::npos) << answer;
  }

  // When one leaves, there is a place for another one.
  clients.pop_back();
  EXPECT_TRUE(has_place(server->port()));
}

/// Disconnects at once, as a sender does to which a client that resets the connection accepts nothing.
class Hasty : public Echo {
 public:
  explicit Hasty(WebSocket socket) : Echo(socket), socket_(socket) {}
  void start() override {
    socket_.disconnect();
    Echo::start();
  }

 private:
  WebSocket socket_;
};

TEST(WebServer, ADisconnectionBeforeTheFirstMessageCostsNoPlace) {
  const auto server = serve<Hasty>();
  for (int i = 0; i < WebServer::kMaxClients + WebServer::kMaxTurnedAway + 1; ++i)
    ASSERT_EQ(SocketClient(server->port()).text(), "hello") << i;
}

TEST(WebServer, RequestsWithAKeyThatIsTooLongCostNoPlace) {
  const auto server = serve();
  for (int i = 0; i < WebServer::kMaxClients + WebServer::kMaxTurnedAway; ++i) {
    const std::string answer = answer_of(server->port(), "/live",
                                         "Host: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
                                         "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: " +
                                             std::string(100, 'k') + "\r\n");
    EXPECT_NE(status_of(answer), 101);
  }
  EXPECT_TRUE(has_place(server->port()));
}

TEST(WebServer, ServesFilesWhateverFurtherClientsDo) {
  const auto server = serve();
  const auto clients = as_many_clients_as_possible(server->port());
  std::vector<std::unique_ptr<RawClient>> stubborn;
  for (int i = 0; i < 70; ++i) {
    stubborn.push_back(std::make_unique<RawClient>(server->port()));
    stubborn.back()->send(request_for_a_socket());
  }
  EXPECT_EQ(status_of(answer_of(server->port(), "/")), 200);
}

TEST(WebServer, SaysThatThePortIsTaken) {
  const auto server = serve();
  WebServer::Options options;
  options.port = server->port();
  options.port_option = "--door PORT";
  const auto second = WebServer::start(std::move(options));
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message().find(std::to_string(server->port())), std::string::npos);
  EXPECT_TRUE(second.error().remedy.ends_with("give --door PORT")) << second.error().message();
}

TEST(WebAddress, IsAPortOrAnAddressAndAPort) {
  EXPECT_EQ(parse_web_address("80")->port, 80);
  EXPECT_EQ(parse_web_address("80")->address, "127.0.0.1");
  EXPECT_EQ(parse_web_address("0.0.0.0:8765")->address, "0.0.0.0");
  for (const char* text : {"", "x", "70000", "-1", "8765x", ":8765", "localhost"})
    EXPECT_FALSE(parse_web_address(text)) << text;
}

}  // namespace
}  // namespace barehand
