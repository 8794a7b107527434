#pragma once

#include <arpa/inet.h>
#include <civetweb.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace barehand::test {

/// A TCP connection to this machine.
class RawClient {
 public:
  explicit RawClient(int port) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{20, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    EXPECT_EQ(connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  ~RawClient() { close(socket_); }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  void send(const std::string& bytes) { ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL); }
  /// Up to the end of the connection, or to the first empty line.
  std::string read(bool to_end = true) {
    std::string all;
    char piece[4096];
    for (ssize_t size = 0; (size = recv(socket_, piece, sizeof piece, 0)) > 0;) {
      all.append(piece, static_cast<std::size_t>(size));
      if (!to_end && all.find("\r\n\r\n") != std::string::npos) break;
    }
    return all;
  }

 private:
  const int socket_;
};

/// The port of a server's address, such as http://localhost:8765.
inline int port_of(const std::string& url) { return std::stoi(url.substr(url.rfind(':') + 1)); }

/// The answer to an HTTP request of this path and these further header lines.
inline std::string answer_of(int port, const std::string& path, const std::string& headers = "Host: localhost\r\n") {
  RawClient client(port);
  client.send("GET " + path + " HTTP/1.1\r\n" + headers + "\r\n");
  return client.read();
}
/// 200, 404 ...; 0: no answer.
inline int status_of(const std::string& answer) {
  return answer.starts_with("HTTP/1.1 ") ? std::atoi(answer.c_str() + 9) : 0;
}
inline std::string upgrade(const std::string& headers) {
  return headers +
         "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
}

/// A WebSocket client that keeps what it hears.
class SocketClient {
 public:
  /// `protocol`: the subprotocol to ask for; "": none.
  explicit SocketClient(int port, const char* path = "/live", const std::string& protocol = "") {
    char error[200] = "";
    // The library has no argument for subprotocols, but takes the next header line behind the origin.
    const std::string origin = "http://localhost\r\nSec-WebSocket-Protocol: " + protocol;
    connection_ = mg_connect_websocket_client("localhost", port, 0, error, sizeof error, path,
                                              protocol.empty() ? nullptr : origin.c_str(), on_data, on_close, this);
    EXPECT_NE(connection_, nullptr) << error;
  }
  ~SocketClient() {
    if (!connection_) return;
    mg_websocket_client_write(connection_, MG_WEBSOCKET_OPCODE_CONNECTION_CLOSE, "", 0);  // the end comes sooner
    mg_close_connection(connection_);
  }
  SocketClient(const SocketClient&) = delete;
  SocketClient& operator=(const SocketClient&) = delete;

  void send(const std::string& text) {
    mg_websocket_client_write(connection_, MG_WEBSOCKET_OPCODE_TEXT, text.data(), text.size());
  }
  /// The next text or binary message; none: nothing came for long, or the connection ended.
  std::optional<std::string> text() { return next(texts_); }
  std::optional<std::string> binary() { return next(binaries_); }
  /// Whether the server has let go of it; waits for that.
  bool is_let_go() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return closed_; });
  }
  /// The code and the reason with which the server asked to close the connection; code 0: it did not. Call it after
  /// is_let_go().
  std::pair<int, std::string> farewell() const { return farewell_; }

 private:
  static constexpr std::chrono::seconds kPatience{20};

  std::optional<std::string> next(std::deque<std::string>& queue) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kPatience, [&] { return !queue.empty() || closed_; });
    if (queue.empty()) return std::nullopt;
    std::string first = std::move(queue.front());
    queue.pop_front();
    return first;
  }
  static int on_data(mg_connection*, int bits, char* data, std::size_t size, void* self) {
    auto& client = *static_cast<SocketClient*>(self);
    const std::lock_guard lock(client.mutex_);
    if ((bits & 0xf) == MG_WEBSOCKET_OPCODE_TEXT) client.texts_.emplace_back(data, size);
    if ((bits & 0xf) == MG_WEBSOCKET_OPCODE_BINARY) client.binaries_.emplace_back(data, size);
    if ((bits & 0xf) == MG_WEBSOCKET_OPCODE_CONNECTION_CLOSE && size >= 2)
      client.farewell_ = {static_cast<unsigned char>(data[0]) << 8 | static_cast<unsigned char>(data[1]),
                          std::string(data + 2, size - 2)};
    client.changed_.notify_all();
    return 1;
  }
  static void on_close(const mg_connection*, void* self) {
    auto& client = *static_cast<SocketClient*>(self);
    const std::lock_guard lock(client.mutex_);
    client.closed_ = true;
    client.changed_.notify_all();
  }

  mg_connection* connection_ = nullptr;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> texts_, binaries_;
  bool closed_ = false;
  std::pair<int, std::string> farewell_;
};

/// One part of a binary message.
struct Chunk {
  char kind;
  int index;
  std::string payload;

  template <class T>
  T at(std::size_t position) const {
    T value;
    EXPECT_LE(position + sizeof value, payload.size());
    std::memcpy(&value, payload.data() + position, sizeof value);
    return value;
  }
};
inline std::vector<Chunk> chunks_of(const std::string& bytes) {
  std::vector<Chunk> chunks;
  for (std::size_t at = 0; at + 8 <= bytes.size();) {
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + at + 4, 4);
    EXPECT_LE(at + 8 + length, bytes.size());
    chunks.push_back({bytes[at], bytes[at + 1], bytes.substr(at + 8, length)});
    at += 8 + (length + 3) / 4 * 4;
  }
  return chunks;
}
inline std::string kinds_of(const std::vector<Chunk>& chunks) {
  std::string kinds;
  for (const Chunk& chunk : chunks) kinds += chunk.kind;
  return kinds;
}

}  // namespace barehand::test
