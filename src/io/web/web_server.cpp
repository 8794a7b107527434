// An HTTP and WebSocket server on top of civetweb.
#include "io/web/web_server.h"

#include <civetweb.h>

#include <atomic>
#include <charconv>
#include <chrono>
#include <future>
#include <mutex>

#include "core/quote.h"
#include "io/web/allowed_origin.h"

namespace barehand {

/// The server's data about one connection.
struct WebConnection {
  std::unique_ptr<WebPeer> peer;
  std::string message;                // the fragments of the current message received so far
  std::atomic<bool> is_read = false;  // whether civetweb reads from it
};

namespace {

constexpr const char* kForeign =
    "Requests for other hosts and from pages of other origins are refused. "
    "The option --view-origin of track, or --origin of view, invites a page.";

constexpr std::size_t kLongestMessage = 64 << 10;  // maximum size of a client's message [bytes]
constexpr std::size_t kLongestKey = 24;            // size of a Sec-WebSocket-Key: 16 bytes in Base64 (RFC 6455)
constexpr int kContinuation = 0, kClose = 8;       // WebSocket opcodes
constexpr int kReservedBits = 0x70;                // RSV1 to RSV3 in the first byte of a frame (RFC 6455)

std::string_view header(const mg_connection* connection, const char* name) {
  const char* value = mg_get_header(connection, name);
  return value ? value : "";
}

/// The subprotocol that the client and the server have agreed on; null: none.
const char* chosen_protocol(const mg_connection* connection) {
  return mg_get_request_info(connection)->acceptedWebSocketSubprotocol;
}

/// Forgets the subprotocol of an earlier client: civetweb leaves it behind where it reuses a connection's memory.
/// Returns 0: the request goes on.
int forget_protocol(mg_connection* connection) {
  const_cast<mg_request_info*>(mg_get_request_info(connection))->acceptedWebSocketSubprotocol = nullptr;
  return 0;
}

WebConnection* connection_of(const mg_connection* connection) {
  return static_cast<WebConnection*>(mg_get_user_connection_data(connection));
}

/// Tells a client that breaks the rules why its connection ends. Returns false.
bool dismiss(mg_connection* connection, const Farewell& farewell) {
  WebSocket(connection).ask_to_close(farewell);
  return false;
}

/// The header that lets a page of an allowed origin read the response; is_allowed() has checked the origin before.
std::string allowance(const mg_connection* connection) {
  const std::string origin(header(connection, "Origin"));
  return origin.empty() ? "" : "Access-Control-Allow-Origin: " + origin + "\r\n";
}

}  // namespace

bool WebSocket::send_text(std::string_view text) { return send(MG_WEBSOCKET_OPCODE_TEXT, text.data(), text.size()); }
bool WebSocket::send_binary(std::span<const std::uint8_t> bytes) {
  return send(MG_WEBSOCKET_OPCODE_BINARY, reinterpret_cast<const char*>(bytes.data()), bytes.size());
}
bool WebSocket::send(int opcode, const char* data, std::size_t size) {
  // The result counts the written bytes of header and data. If it is less than the data alone, the frame was cut off.
  return mg_websocket_write(connection_, opcode, data, size) >= static_cast<int>(size) && size > 0;
}

void WebSocket::ask_to_close(const Farewell& farewell) {
  const std::string payload =
      std::string{static_cast<char>(farewell.code >> 8), static_cast<char>(farewell.code & 0xff)} + farewell.reason;
  (void)send(MG_WEBSOCKET_OPCODE_CONNECTION_CLOSE, payload.data(), payload.size());
}

void WebSocket::disconnect() {
  // While civetweb reads from the connection this only sets a flag for the reading thread. Before, it would close the
  // socket here, under the feet of that thread.
  const WebConnection* known = connection_of(connection_);
  if (known && known->is_read) mg_close_connection(connection_);
}

class WebServer::Impl {
 public:
  explicit Impl(Options options) : options_(std::move(options)) {}
  ~Impl() {
    if (context_) stop();
  }

  Result<int> start();

 private:
  void stop();
  /// Answers an HTTP request.
  int answer(mg_connection* connection) const;
  static bool refuse(const mg_connection* connection, int status, const std::string& text);
  bool is_allowed(const mg_connection* connection) const;
  bool admit(const mg_connection* connection, bool speaks_it);
  std::string spoken() const;
  void ready(mg_connection* connection);
  static bool receive(mg_connection* connection, int bits, std::string_view data);
  void closed(const mg_connection* connection);

  static int on_request(mg_connection* connection, void* self) { return static_cast<Impl*>(self)->answer(connection); }
  static int on_connect(const mg_connection* connection, void* self) {
    // Without a list of subprotocols, civetweb chooses one that the client names, whichever it is.
    return static_cast<Impl*>(self)->admit(connection, chosen_protocol(connection) == nullptr) ? 0 : 1;
  }
  static int on_connect_protocol(const mg_connection* connection, void* self) {
    return static_cast<Impl*>(self)->admit(connection, chosen_protocol(connection) != nullptr) ? 0 : 1;
  }
  static void on_ready(mg_connection* connection, void* self) { static_cast<Impl*>(self)->ready(connection); }
  static int on_data(mg_connection* connection, int bits, char* data, std::size_t size, void*) {
    return receive(connection, bits, {data, size}) ? 1 : 0;
  }
  static void on_close(const mg_connection* connection, void* self) { static_cast<Impl*>(self)->closed(connection); }

  Result<WebFile> file_of(const mg_connection* connection) const;

  const Options options_;
  std::vector<const char*> protocol_names_;
  mg_websocket_subprotocols protocols_{};  // civetweb keeps a pointer to this member
  mg_context* context_ = nullptr;
  std::atomic<int> open_ = 0, clients_ = 0;  // WebSockets; those of them with a peer

  std::mutex mutex_;  // protects the member below
  // The WebSockets with a peer. civetweb forgets its pointer to one that WebSocket::disconnect() closes just when the
  // client goes.
  std::map<const mg_connection*, std::unique_ptr<WebConnection>> connections_;
};

Result<int> WebServer::Impl::start() {
  // Every WebSocket occupies one of the server's threads while it is open.
  const std::string threads = std::to_string(kMaxClients + kMaxTurnedAway + 8),
                    stuck = std::to_string(kStuckSeconds * 1000);
  const std::string port = options_.address + ":" + std::to_string(options_.port);
  const char* settings[] = {"listening_ports",
                            port.c_str(),
                            "num_threads",
                            threads.c_str(),
                            "tcp_nodelay",
                            "1",
                            "request_timeout_ms",
                            stuck.c_str(),
                            "websocket_timeout_ms",
                            stuck.c_str(),
                            "enable_websocket_ping_pong",
                            "yes",
                            "access_control_allow_origin",
                            "",
                            "enable_directory_listing",
                            "no",
                            nullptr};

  // Start to listen on the port.
  mg_callbacks callbacks{};
  callbacks.log_message = [](const mg_connection*, const char*) { return 1; };  // no logging: start() returns the error
  callbacks.begin_request = forget_protocol;
  // civetweb itself refuses what is damaged, and WebSockets of other versions and at other paths.
  callbacks.http_error = [](mg_connection* connection, int status, const char* text) {
    refuse(connection, status, text);
    return 0;
  };
  context_ = mg_start(&callbacks, this, settings);
  if (!context_)
    return fail(
        "cannot listen on " + port, "live page",
        "another program may have the port, or the address is not this machine's; give " + options_.port_option);

  // Set the handlers.
  mg_set_request_handler(context_, "**", on_request, this);
  mg_set_websocket_handler(context_, options_.socket_path.c_str(), on_connect, on_ready, on_data, on_close, this);
  if (options_.connect_protocol) {
    for (const std::string& name : options_.protocols) protocol_names_.push_back(name.c_str());
    protocols_ = {static_cast<int>(protocol_names_.size()), protocol_names_.data()};
    mg_set_websocket_handler_with_subprotocols(context_, "/", &protocols_, on_connect_protocol, on_ready, on_data,
                                               on_close, this);
  }

  // Return the port, which the system has chosen if 0 was given.
  mg_server_port ports[1] = {};
  return mg_get_server_ports(context_, 1, ports) == 1 ? ports[0].port : options_.port;
}

/// Stops the server. Without connections, civetweb checks only every other second whether it is to stop, so connections
/// are made until it has stopped.
void WebServer::Impl::stop() {
  constexpr auto kPatience = std::chrono::milliseconds(20);
  mg_server_port port{};
  mg_get_server_ports(context_, 1, &port);
  auto stopped = std::async(std::launch::async, [this] { mg_stop(context_); });
  const std::string host = options_.address == "0.0.0.0" ? "127.0.0.1" : options_.address;
  while (stopped.wait_for(kPatience) != std::future_status::ready) {
    char ignored[1];
    if (mg_connection* knock = mg_connect_client(host.c_str(), port.port, 0, ignored, 0)) mg_close_connection(knock);
  }
}

bool WebServer::Impl::is_allowed(const mg_connection* connection) const {
  const std::string_view host = header(connection, "Host");
  return is_own_host(host) && is_allowed_origin(header(connection, "Origin"), host, options_.allowed_origins);
}

Result<WebFile> WebServer::Impl::file_of(const mg_connection* connection) const {
  const std::string path = mg_get_request_info(connection)->local_uri;
  if (const auto file = options_.files.find(path == "/" ? "/index.html" : path); file != options_.files.end())
    return file->second;
  if (!options_.made_file) return fail("There is no such file.");
  return options_.made_file(path, "http://" + std::string(header(connection, "Host")));
}

int WebServer::Impl::answer(mg_connection* connection) const {
  const std::string_view method = mg_get_request_info(connection)->request_method;

  // Refuse requests that do not come from an allowed page or are not for one of the files.
  if (!is_allowed(connection))
    refuse(connection, 403, kForeign);
  else if (method != "GET" && method != "HEAD")
    refuse(connection, 405, "Files can be read only.");
  else if (const auto file = file_of(connection); !file)
    refuse(connection, 404, file.error().message());

  // Send the file, with headers that keep out scripts and connections of other origins.
  else {
    mg_printf(connection,
              "HTTP/1.1 200 OK\r\nContent-Type: %s\r\nContent-Length: %zu\r\nCache-Control: no-cache\r\n"
              "X-Content-Type-Options: nosniff\r\nX-Frame-Options: DENY\r\nReferrer-Policy: no-referrer\r\n"
              "Content-Security-Policy: default-src 'self'; img-src 'self' blob: data:; connect-src 'self' ws:\r\n"
              "%sConnection: close\r\n\r\n",
              file->type.c_str(), file->bytes.size(), allowance(connection).c_str());
    if (method == "GET") mg_write(connection, file->bytes.data(), file->bytes.size());
  }
  return 1;  // the request has been handled, whatever the status
}

/// Answers with an HTTP error. civetweb's own function for it sends no status line to a client that asks for a
/// WebSocket. Returns false.
bool WebServer::Impl::refuse(const mg_connection* connection, int status, const std::string& text) {
  constexpr int kUpgradeRequired = 426;
  const char* method = mg_get_request_info(connection)->request_method;  // null if the request is damaged
  const bool head = method && std::string_view(method) == "HEAD";
  mg_printf(const_cast<mg_connection*>(connection),  // constant only because civetweb declares its handlers so
            "HTTP/1.1 %d %s\r\nContent-Type: text/plain; charset=utf-8\r\nContent-Length: %zu\r\n"
            "Cache-Control: no-cache\r\n%s\r\n%s",
            status, mg_get_response_code_text(connection, status), text.size(),
            status == kUpgradeRequired
                ? "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nConnection: Upgrade, close\r\n"
                : "Connection: close\r\n",
            head ? "" : text.c_str());
  return false;
}

/// What the server's WebSockets speak, for a client that asked for something else.
std::string WebServer::Impl::spoken() const {
  return "The WebSocket at " + options_.socket_path + " has no subprotocol." +
         (options_.connect_protocol ? " Those of the one at / are: " + comma_list(options_.protocols) + "." : "");
}

/// Decides whether a client gets its WebSocket. `speaks_it`: it asked for what is spoken at its path.
bool WebServer::Impl::admit(const mg_connection* connection, bool speaks_it) {
  if (!is_allowed(connection)) return refuse(connection, 403, kForeign);
  if (!speaks_it) return refuse(connection, 404, spoken());
  // civetweb fails to answer a longer key, and does not report that the connection has ended.
  if (header(connection, "Sec-WebSocket-Key").size() > kLongestKey)
    return refuse(connection, 400, "The key of the WebSocket is too long.");
  if (++open_ <= kMaxClients + kMaxTurnedAway) return true;
  --open_;
  return refuse(connection, 503, "Too many pages and viewers are connected.");
}

void WebServer::Impl::ready(mg_connection* connection) {
  // A page cannot see why a request for a WebSocket fails, so the reason is given when it is open.
  if (++clients_ > kMaxClients) {
    --clients_;
    const std::string places = std::to_string(kMaxClients);
    return WebSocket(connection)
        .ask_to_close(
            {Farewell::kTryAgainLater, "Barehand serves " + places + " pages and viewers already, and no more."});
  }

  // Create the program's side of the connection.
  auto made = std::make_unique<WebConnection>();
  const auto& connect = chosen_protocol(connection) ? options_.connect_protocol : options_.connect;
  made->peer = connect(WebSocket(connection));
  WebConnection& known = *made;
  mg_set_user_connection_data(connection, &known);
  {
    const std::lock_guard lock(mutex_);
    connections_[connection] = std::move(made);
  }
  known.peer->start();
}

bool WebServer::Impl::receive(mg_connection* connection, int bits, std::string_view data) {
  WebConnection* known = connection_of(connection);
  const int opcode = bits & 0xf;
  const bool last = (bits & 0x80) != 0;
  if (!known || opcode == kClose) return false;
  known->is_read = true;
  if (bits & kReservedBits)
    return dismiss(connection,
                   {Farewell::kProtocolError, "A frame has reserved bits, and no extension was agreed on."});
  if (opcode > kClose) return true;  // civetweb handles ping and pong
  if (opcode != kContinuation) known->message.clear();
  if (known->message.size() + data.size() > kLongestMessage)
    return dismiss(connection, {Farewell::kTooLong, "A message may have 64 KiB at most."});
  known->message.append(data);
  return !last || known->peer->receive(known->message);
}

void WebServer::Impl::closed(const mg_connection* connection) {
  const auto known = [&] {
    const std::lock_guard lock(mutex_);
    return connections_.extract(connection);
  }();
  if (known) {
    known.mapped()->peer->gone();
    --clients_;
  }
  --open_;
}

WebServer::WebServer() = default;
WebServer::~WebServer() = default;

Result<std::unique_ptr<WebServer>> WebServer::start(Options options) {
  std::unique_ptr<WebServer> server(new WebServer);
  server->impl_ = std::make_unique<Impl>(std::move(options));
  const auto port = server->impl_->start();
  if (!port) return tl::unexpected(port.error());
  server->port_ = *port;
  return server;
}

std::string WebServer::url() const { return "http://localhost:" + std::to_string(port_); }

Result<WebAddress> parse_web_address(const std::string& text) {
  WebAddress out;
  std::string_view port = text;
  if (const auto colon = text.rfind(':'); colon != std::string::npos) {
    out.address = text.substr(0, colon);
    port.remove_prefix(colon + 1);
  }
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), out.port);
  const bool number = error == std::errc() && end == port.data() + port.size() && out.port >= 0 && out.port < 65536;
  if (!number || out.address.empty())
    return fail("is no port from 0 to 65535", text.empty() ? "\"\"" : text,
                "give PORT, or ADDRESS:PORT such as 0.0.0.0:8765 for the whole network");
  return out;
}

}  // namespace barehand
