// The connected Foxglove viewers.
#include "io/foxglove/foxglove_clients.h"

#include <algorithm>

#include "io/ros/urdf.h"

namespace barehand {

std::unique_ptr<WebPeer> FoxgloveClients::connect(WebSocket socket) {
  auto client = std::make_unique<FoxgloveClient>(socket, [this](const FrameClient& gone) { forget(gone); });
  const std::lock_guard lock(mutex_);
  clients_.insert(client.get());
  count_ = static_cast<int>(clients_.size());
  if (frame_) client->post(frame_);
  return client;
}

void FoxgloveClients::forget(const FrameClient& client) {
  const QueueHealth last = closed(client.health());
  const std::lock_guard lock(mutex_);
  add_counts(last, gone_);
  clients_.erase(const_cast<FrameClient*>(&client));
  count_ = static_cast<int>(clients_.size());
  if (clients_.empty()) frame_ = nullptr;  // it would be outdated when the next client connects
}

void FoxgloveClients::show(const ViewFramePtr& frame) {
  const std::lock_guard lock(mutex_);
  for (std::size_t side = 0; side < profiles_.size(); ++side)
    if (const ViewSkinPtr& skin = frame->content().skins[side]) profiles_[side] = skin->profile();
  if (!clients_.empty()) frame_ = frame;
  for (FrameClient* client : clients_) client->post(frame);
}

void FoxgloveClients::set_profile(std::shared_ptr<const HandProfile> profile) {
  const std::lock_guard lock(mutex_);
  profiles_[static_cast<std::size_t>(profile->handedness)] = std::move(profile);
}

void FoxgloveClients::add_health(QueueHealth& all) const {
  const std::lock_guard lock(mutex_);
  all.capacity += clients_.size();
  add_counts(gone_, all);
  for (const FrameClient* client : clients_) add_counts(client->health(), all);
}

void FoxgloveClients::end(const Farewell& farewell) {
  const std::lock_guard lock(mutex_);
  for (FrameClient* client : clients_) client->end(farewell);
}

Result<WebFile> FoxgloveClients::urdf(const std::string& path, const std::string& base) const {
  constexpr std::array<const char*, 2> kPaths = {"/left_hand.urdf", "/right_hand.urdf"};  // by Handedness
  const auto wanted = std::ranges::find(kPaths, path);
  if (wanted == kPaths.end()) return fail("There is no such file.");
  const auto side = static_cast<std::size_t>(wanted - kPaths.begin());

  // Describe the hand, or say which hands are tracked.
  auto profiles = [&] {
    const std::lock_guard lock(mutex_);
    return profiles_;
  }();
  if (profiles[side]) return WebFile{"application/xml", ros::urdf(*profiles[side])};
  const std::string what = "The " + std::string(to_string(static_cast<Handedness>(side))) + " hand is not tracked.";
  const std::size_t other = 1 - side;
  if (!profiles[other]) return fail(what + " No hand is known yet; ask again when one was seen.");
  return fail(what + " Only the " + std::string(to_string(static_cast<Handedness>(other))) + " hand is: " + base +
              kPaths[other]);
}

}  // namespace barehand
