#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "io/web/foxglove_client.h"

namespace barehand {

/// The viewers that are connected, and what they may fetch. Used on any thread; nobody waits for a client.
class FoxgloveClients {
 public:
  std::unique_ptr<WebPeer> connect(WebSocket socket);
  int count() const { return count_; }
  void show(const ViewFramePtr& frame);
  void know(std::shared_ptr<const HandProfile> profile);
  /// Adds the frames of all clients since the start.
  void add_health(QueueHealth& all) const;
  /// "/right_hand.urdf" and "/left_hand.urdf": the hand with the lengths that it was last shown or known with.
  /// None: another path, or no such hand is known.
  std::optional<WebFile> urdf(const std::string& path) const;

 private:
  void forget(const FoxgloveClient& client);

  std::atomic<int> count_ = 0;
  mutable std::mutex mutex_;  // protects the members below
  std::set<FoxgloveClient*> clients_;
  QueueHealth gone_;  // of the clients that have left
  ViewFramePtr frame_;
  std::array<std::shared_ptr<const HandProfile>, 2> profiles_;  // by Handedness
};

}  // namespace barehand
