#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "io/foxglove/foxglove_client.h"

namespace barehand {

/// All connected viewers, and the robot descriptions that they may fetch. May be used on any thread; no call waits for
/// a client.
class FoxgloveClients {
 public:
  /// Creates the object for a new viewer.
  std::unique_ptr<WebPeer> connect(WebSocket socket);
  int count() const { return count_; }
  /// Sends a frame to all viewers, and remembers the profiles of its hands.
  void show(const ViewFramePtr& frame);
  /// Remembers a profile before a frame shows it.
  void set_profile(std::shared_ptr<const HandProfile> profile);
  /// Ends all connections: see FrameClient::end().
  void end(const Farewell& farewell);
  /// Adds the counts of frames of all clients since the start to `all`.
  void add_health(QueueHealth& all) const;
  /// The description of a hand as a robot, for the paths "/right_hand.urdf" and "/left_hand.urdf", made from its last
  /// profile. Error: another path, or a hand that is not tracked; then it names the hands that are, with their URLs,
  /// which begin with `base`.
  Result<WebFile> urdf(const std::string& path, const std::string& base) const;

 private:
  void forget(const FrameClient& client);

  std::atomic<int> count_ = 0;
  mutable std::mutex mutex_;  // protects the members below
  std::set<FrameClient*> clients_;
  QueueHealth gone_;    // counts of the clients that have left
  ViewFramePtr frame_;  // the newest frame, for clients that connect; null without clients
  std::array<std::shared_ptr<const HandProfile>, 2> profiles_;  // by Handedness
};

}  // namespace barehand
