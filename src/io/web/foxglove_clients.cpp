// The connected Foxglove viewers.
#include "io/web/foxglove_clients.h"

#include "io/ros/urdf.h"

namespace barehand {

std::unique_ptr<WebPeer> FoxgloveClients::connect(WebSocket socket) {
  auto client = std::make_unique<FoxgloveClient>(socket, [this](const FoxgloveClient& gone) { forget(gone); });
  const std::lock_guard lock(mutex_);
  clients_.insert(client.get());
  count_ = static_cast<int>(clients_.size());
  if (frame_) client->post(frame_);
  return client;
}

void FoxgloveClients::forget(const FoxgloveClient& client) {
  const QueueHealth last = closed(client.health());
  const std::lock_guard lock(mutex_);
  add_counts(last, gone_);
  clients_.erase(const_cast<FoxgloveClient*>(&client));
  count_ = static_cast<int>(clients_.size());
  if (clients_.empty()) frame_ = nullptr;  // it would be outdated when the next client connects
}

void FoxgloveClients::show(const ViewFramePtr& frame) {
  const std::lock_guard lock(mutex_);
  for (std::size_t side = 0; side < profiles_.size(); ++side)
    if (const ViewSkinPtr& skin = frame->content().skins[side]) profiles_[side] = skin->profile();
  if (!clients_.empty()) frame_ = frame;
  for (FoxgloveClient* client : clients_) client->post(frame);
}

void FoxgloveClients::set_profile(std::shared_ptr<const HandProfile> profile) {
  const std::lock_guard lock(mutex_);
  profiles_[static_cast<std::size_t>(profile->handedness)] = std::move(profile);
}

void FoxgloveClients::add_health(QueueHealth& all) const {
  const std::lock_guard lock(mutex_);
  all.capacity += clients_.size();
  add_counts(gone_, all);
  for (const FoxgloveClient* client : clients_) add_counts(client->health(), all);
}

std::optional<WebFile> FoxgloveClients::urdf(const std::string& path) const {
  std::shared_ptr<const HandProfile> profile;
  {
    const std::lock_guard lock(mutex_);
    if (path == "/left_hand.urdf") profile = profiles_[0];
    if (path == "/right_hand.urdf") profile = profiles_[1];
  }
  if (!profile) return std::nullopt;
  return WebFile{"application/xml", ros::urdf(*profile)};
}

}  // namespace barehand
