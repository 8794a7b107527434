// The connected clients of one protocol, and what new ones get at once.
#include "io/web/frame_clients.h"

#include <algorithm>

namespace barehand {

void FrameClients::add(FrameClient& client) {
  const std::lock_guard lock(mutex_);
  clients_.insert(&client);
  count_ = static_cast<int>(clients_.size());
  if (status_) client.post_status(status_);
  if (frame_) client.post(frame_);
  if (farewell_) client.end(*farewell_);
}

void FrameClients::forget(FrameClient& client) {
  const QueueHealth last = closed(client.health());
  const std::lock_guard lock(mutex_);
  add_counts(last, gone_);
  clients_.erase(&client);
  count_ = static_cast<int>(clients_.size());
  if (clients_.empty()) frame_ = nullptr;  // it would be outdated when the next client connects
}

void FrameClients::show(const ViewFramePtr& frame) {
  const std::lock_guard lock(mutex_);
  frame_ = frame;
  for (FrameClient* client : clients_) client->post(frame);
}

void FrameClients::show_status(const StatusText& status) {
  const std::lock_guard lock(mutex_);
  status_ = status;
  for (FrameClient* client : clients_) client->post_status(status);
}

void FrameClients::end(const Farewell& farewell) {
  const std::lock_guard lock(mutex_);
  farewell_ = farewell;
  for (FrameClient* client : clients_) client->end(farewell);
}

bool FrameClients::are_told() const {
  const std::lock_guard lock(mutex_);
  return std::ranges::all_of(clients_, [](const FrameClient* client) { return client->is_told(); });
}

void FrameClients::add_health(QueueHealth& all) const {
  const std::lock_guard lock(mutex_);
  add_counts(gone_, all);
  for (const FrameClient* client : clients_) add_counts(client->health(), all);
}

}  // namespace barehand
