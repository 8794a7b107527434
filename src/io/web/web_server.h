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

// An HTTP and WebSocket server.

/// Why the server closes a connection.
struct Farewell {
  static constexpr int kDone = 1000;             ///< nothing more will be sent, so the client should not connect again
  static constexpr int kStopped = 1001;          ///< the program stops and may be started again
  static constexpr int kProtocolError = 1002;    ///< the client breaks the rules of the WebSocket protocol
  static constexpr int kTooLong = 1009;          ///< the client has sent a message that is too long
  static constexpr int kTryAgainLater = 1013;    ///< too many clients are connected now
  int code = kStopped;                           ///< close code of the WebSocket protocol (RFC 6455)
  std::string reason = "Barehand was stopped.";  ///< for the user; at most 123 bytes
};

/// Sends messages to one connected client. Not thread-safe.
class WebSocket {
 public:
  explicit WebSocket(mg_connection* connection) : connection_(connection) {}
  /// Sends a message; blocks until the client accepts it. Returns false if nothing more can be sent: the client is
  /// gone, or has accepted nothing for kStuckSeconds.
  bool send_text(std::string_view text);
  bool send_binary(std::span<const std::uint8_t> bytes);
  /// Asks the client to close the connection; a browser passes the code and the reason to the page's script.
  void ask_to_close(const Farewell& farewell);
  /// Ends the connection of a client to which nothing more can be sent. The server does it within kStuckSeconds. A
  /// client that has sent no message yet is left to the server's pings.
  void disconnect();

 private:
  bool send(int opcode, const char* data, std::size_t size);
  mg_connection* connection_;
};

/// The program's side of one connection.
class WebPeer {
 public:
  virtual ~WebPeer() = default;
  /// Called when the connection is established; from now on, messages may be sent.
  virtual void start() = 0;
  /// Called with a complete message of the client, on a thread of the server. Returns false to disconnect the client.
  virtual bool receive(std::string_view text) = 0;
  /// Called once when the client is gone, on a thread of the server. When it returns the socket must not be used any
  /// more, and the peer is destroyed.
  virtual void gone() {}
};

struct WebFile {
  std::string type;  ///< MIME type
  std::string bytes;
};

/// An HTTP and WebSocket server with its own threads. Files are served from memory, so no request accesses the disk.
/// Requests for other hosts or from other origins are refused (allowed_origin.h).
class WebServer {
 public:
  static constexpr int kMaxClients = 32;    ///< maximum number of WebSockets with a peer
  static constexpr int kMaxTurnedAway = 8;  ///< maximum number of further WebSockets that are being refused
  static constexpr int kStuckSeconds = 10;  ///< a client that accepts nothing for this time is disconnected

  struct Options {
    std::string address = "127.0.0.1";         ///< address of the network interface; 0.0.0.0: all interfaces
    int port = 0;                              ///< TCP port; 0: any free port
    std::string port_option = "another port";  ///< what the user gives instead if the port is taken: "--view=PORT"
    std::map<std::string, WebFile> files;      ///< by path, such as "/index.html", which is also served as "/"
    std::vector<std::string> allowed_origins;  ///< origins of other web pages that may connect
    std::string socket_path = "/live";
    /// Creates the peer of a client at `socket_path`; called on threads of the server.
    std::function<std::unique_ptr<WebPeer>(WebSocket)> connect;
    std::vector<std::string> protocols;  ///< subprotocols of the WebSocket at "/"; only used with connect_protocol
    /// Creates the peer of a client at "/" that asked for one of `protocols`. Empty: there is no such WebSocket.
    std::function<std::unique_ptr<WebPeer>(WebSocket)> connect_protocol;
    /// Makes the file at a path that is not in `files`. `base`: the server's URL as the client calls it, such as
    /// "http://localhost:8765". Error: there is no such file; its message is sent to the client. May be empty.
    std::function<Result<WebFile>(const std::string& path, const std::string& base)> made_file;
  };

  /// Starts the server. Error: the port is taken or must not be used.
  static Result<std::unique_ptr<WebServer>> start(Options options);
  /// Disconnects all clients.
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  int port() const { return port_; }
  /// The URL for a browser on this machine, such as "http://localhost:8765".
  std::string url() const;

 private:
  class Impl;
  WebServer();
  std::unique_ptr<Impl> impl_;
  int port_ = 0;
};

/// An address given by a user as PORT or ADDRESS:PORT.
struct WebAddress {
  std::string address = "127.0.0.1";
  int port = 8765;
};
Result<WebAddress> parse_web_address(const std::string& text);

}  // namespace barehand
