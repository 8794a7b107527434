#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <string>

#include "io/foxglove/foxglove_client.h"
#include "io/web/frame_clients.h"

namespace barehand {

/// All connected viewers, and the robot descriptions that they may fetch. May be used on any thread; no call waits for
/// a client.
class FoxgloveClients {
 public:
  /// Creates the object for a new viewer.
  std::unique_ptr<WebPeer> connect(WebSocket socket);
  int count() const { return clients_.count(); }
  /// Sends a frame to all viewers, and remembers the profiles of its hands.
  void show(const ViewFramePtr& frame);
  /// Remembers a profile before a frame shows it.
  void set_profile(std::shared_ptr<const HandProfile> profile);
  /// As those of FrameClients.
  void end(const Farewell& farewell) { clients_.end(farewell); }
  void add_health(QueueHealth& all) const { clients_.add_health(all); }
  /// The description of a hand as a robot, for the paths "/right_hand.urdf" and "/left_hand.urdf", made from its last
  /// profile. Error: another path, or a hand that is not tracked; then it names the hands that are, with their URLs,
  /// which begin with `base`.
  Result<WebFile> urdf(const std::string& path, const std::string& base) const;

 private:
  FrameClients clients_;
  mutable std::mutex mutex_;                                    // protects the profiles
  std::array<std::shared_ptr<const HandProfile>, 2> profiles_;  // by Handedness
};

}  // namespace barehand
