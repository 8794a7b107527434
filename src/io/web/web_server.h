#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

struct mg_connection;

namespace barehand {

/// The way to one connected client. Its owner uses it from one thread at a time.
class WebSocket {
 public:
  explicit WebSocket(mg_connection* connection) : connection_(connection) {}
  /// False: the client is gone, or took nothing for kStuckSeconds; nothing more can be sent. Blocks until then.
  bool send_text(std::string_view text);
  bool send_binary(std::span<const std::uint8_t> bytes);

 private:
  bool send(int opcode, const char* data, std::size_t size);
  mg_connection* connection_;
};

/// What the program keeps of one connected client. It is destroyed when the client is gone, and must not use its
/// socket afterwards.
class WebPeer {
 public:
  virtual ~WebPeer() = default;
  /// The client is there: from now on it may be sent to.
  virtual void start() = 0;
  /// A whole message of the client, on a thread of the server. False: the client is let go.
  virtual bool hear(std::string_view text) = 0;
};

struct WebFile {
  std::string type;  ///< MIME
  std::string bytes;
};

/// An HTTP and WebSocket server with threads of its own. It serves files from memory, so no request reaches the
/// disk, and WebSockets. Hosts and origins that are not this machine's own are refused (own_origin.h).
class WebServer {
 public:
  static constexpr int kMaxClients = 32;    ///< WebSockets at a time; more are refused
  static constexpr int kStuckSeconds = 10;  ///< a client that takes nothing for so long is let go

  struct Options {
    std::string address = "127.0.0.1";     ///< of the interface; 0.0.0.0: all of them
    int port = 0;                          ///< 0: any that is free
    std::map<std::string, WebFile> files;  ///< by path: "/index.html"; "/" stands for that one
    std::vector<std::string> invited;      ///< foreign origins whose pages may connect
    std::string socket_path = "/live";
    std::function<std::unique_ptr<WebPeer>(WebSocket)> connect;  ///< called on threads of the server
    std::vector<std::string> protocols;  ///< subprotocols of the WebSocket at "/"; none: there is no such socket
    std::function<std::unique_ptr<WebPeer>(WebSocket)> connect_protocol;  ///< a client that asked for one of them
    std::function<std::optional<WebFile>(const std::string&)> made_file;  ///< by path: what is no fixed file, if any
  };

  /// Errors: the port is taken, or may not be used.
  static Result<std::unique_ptr<WebServer>> start(Options options);
  /// Lets all clients go.
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  int port() const { return port_; }
  /// For a browser on this machine, "http://localhost:8765".
  std::string url() const;

 private:
  class Impl;
  WebServer();
  std::unique_ptr<Impl> impl_;
  int port_ = 0;
};

/// What a user gives as PORT or ADDRESS:PORT.
struct WebAddress {
  std::string address = "127.0.0.1";
  int port = 8765;
};
Result<WebAddress> parse_web_address(const std::string& text);

}  // namespace barehand
