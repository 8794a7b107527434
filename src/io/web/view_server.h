#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "core/clock.h"
#include "core/statistics.h"
#include "io/foxglove/foxglove_clients.h"
#include "io/lcm/log_recorder.h"
#include "io/web/frame_clients.h"
#include "io/web/view_client.h"

namespace barehand {

/// Serves the live page and the data that it shows. Posting a frame or a status never waits for a client.
class ViewServer {
 public:
  struct Options {
    WebAddress address;
    std::vector<std::string> allowed_origins;  ///< origins of other web pages that may connect
    /// Called with commands of clients, on threads of the server. Empty: there is nothing to play.
    std::function<void(const PlayerCommand&)> on_command;
    /// The recorder that clients start and stop; must outlive the server. Null: nothing can be recorded.
    LogRecorder* recorder = nullptr;
    const char* port_option = "another port";  ///< as in WebServer::Options
  };
  /// `clock` must outlive the server. Errors: the port is taken, the page's files are missing.
  static Result<std::unique_ptr<ViewServer>> start(Options options, const Clock& clock);
  /// Sends every client the data that are waiting for it, and a request to close the connection (Farewell). Waits up to
  /// a second until all clients have disconnected.
  ~ViewServer();

  std::string url() const { return web_->url(); }
  /// Makes a hand available as a robot description before the first frame shows it.
  void set_profile(std::shared_ptr<const HandProfile> profile) { foxglove_.set_profile(std::move(profile)); }
  /// Whether a client is connected; if none is, no frame need be made for show().
  bool has_clients() const { return clients() > 0; }
  int clients() const { return pages_.count() + foxglove_.count(); }
  /// Sends the newest frame to all clients. May be called on any thread.
  void show(const ViewFramePtr& frame);
  /// Sends a status (JSON) to all clients and, until the next status, to those that connect later. May be called on any
  /// thread.
  void show_status(std::string json);
  /// Waits until the last status has been sent to every client that reads, but no longer than `patience`.
  void flush(std::chrono::milliseconds patience) const;
  /// Sets the reason that clients get for the closed connection when the server is destroyed. The default says that the
  /// program was stopped.
  void set_farewell(Farewell farewell) { farewell_ = std::move(farewell); }
  /// Counts the frames for all clients together since the start. The capacity is that of the clients that are
  /// connected.
  QueueHealth health() const;

 private:
  ViewServer(const Options& options, const Clock& clock)
      : on_command_(options.on_command), recorder_(options.recorder), clock_(clock) {}
  std::unique_ptr<WebPeer> connect(WebSocket socket);
  Result<void> play(const PlayerCommand& command);
  Result<void> record(const RecordCommand& command, int client);

  const std::function<void(const PlayerCommand&)> on_command_;
  LogRecorder* const recorder_;
  const Clock& clock_;
  std::atomic<int> last_client_ = 0;  // number of the page that connected last
  Farewell farewell_;
  FrameClients pages_;
  FoxgloveClients foxglove_;
  std::unique_ptr<WebServer> web_;  // declared last, so destroyed first: it disconnects all clients
};

}  // namespace barehand
