#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <set>

#include "io/web/frame_client.h"

namespace barehand {

/// The connected clients of one protocol. May be used on any thread; no call waits for a client.
class FrameClients {
 public:
  /// Adds a new client, which gets the newest status and frame. It must be forgotten when it is gone.
  void add(FrameClient& client);
  void forget(FrameClient& client);
  int count() const { return count_; }
  /// Sends a frame to all clients.
  void show(const ViewFramePtr& frame);
  /// Sends a status to all clients and, until the next one, to those that are added later.
  void show_status(const StatusText& status);
  /// Ends all connections, also those of clients that are added later: see FrameClient::end().
  void end(const Farewell& farewell);
  /// Whether FrameClient::is_told() holds for all clients.
  bool are_told() const;
  /// Adds the counts of frames of all clients since the start to `all`, and the capacities of those that are connected.
  void add_health(QueueHealth& all) const;

 private:
  std::atomic<int> count_ = 0;
  mutable std::mutex mutex_;  // protects the members below
  std::set<FrameClient*> clients_;
  QueueHealth gone_;    // counts of the clients that have left
  ViewFramePtr frame_;  // the newest frame; null without clients
  StatusText status_;   // the newest status
  std::optional<Farewell> farewell_;
};

}  // namespace barehand
