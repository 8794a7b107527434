#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "core/clock.h"
#include "core/statistics.h"
#include "io/lcm/log_recorder.h"
#include "io/web/foxglove_clients.h"
#include "io/web/view_client.h"

namespace barehand {

/// Serves the live page and what it shows. Whoever posts never waits for a client.
class ViewServer {
 public:
  struct Options {
    WebAddress address;
    std::vector<std::string> invited;  ///< foreign origins whose pages may connect
    /// Commands of clients, on threads of the server. Empty: there is nothing to play.
    std::function<void(const PlayerCommand&)> on_command;
    LogRecorder* recorder =
        nullptr;  ///< what clients start and stop; null: nothing can be recorded. Outlives the server
  };
  /// `clock` outlives it. Errors: the port is taken, the page's files are missing.
  static Result<std::unique_ptr<ViewServer>> start(Options options, const Clock& clock);
  ~ViewServer();

  std::string url() const { return web_->url(); }
  /// A hand that frames may show: it can be fetched as a robot before they do.
  void know(std::shared_ptr<const HandProfile> profile) { foxglove_.know(std::move(profile)); }
  /// Whether anybody looks; else nothing need be made for show().
  bool has_clients() const { return clients() > 0; }
  int clients() const { return clients_count_ + foxglove_.count(); }
  /// Any thread: the newest frame, of all clients.
  void show(const ViewFramePtr& frame);
  /// Any thread: JSON, to those who are there and, until the next one, to those who come.
  void show_status(std::string json);
  /// Waits until the last status has been sent to every client that reads, but no longer than `patience`.
  void flush(std::chrono::milliseconds patience) const;
  /// Frames for clients since the start, of all of them together. The capacity is one frame a client.
  QueueHealth health() const;

 private:
  ViewServer(const Options& options, const Clock& clock)
      : on_command_(options.on_command), recorder_(options.recorder), clock_(clock) {}
  std::unique_ptr<WebPeer> connect(WebSocket socket);
  Result<void> record(const RecordCommand& command, int client);
  void forget(const ViewClient& client);

  const std::function<void(const PlayerCommand&)> on_command_;
  LogRecorder* const recorder_;
  const Clock& clock_;
  std::atomic<int> clients_count_ = 0;

  mutable std::mutex mutex_;  // protects the members down to the blank line
  std::set<ViewClient*> clients_;
  int last_client_ = 0;  // its number
  QueueHealth gone_;     // of the clients that have left
  ViewFramePtr frame_;
  StatusText status_;

  FoxgloveClients foxglove_;
  std::unique_ptr<WebServer> web_;  // destroyed first: it lets all clients go
};

}  // namespace barehand
