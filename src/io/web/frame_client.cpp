// One client of the live page's server, and the thread that sends it what is due.
#include "io/web/frame_client.h"

#include <chrono>
#include <utility>

namespace barehand {

void FrameClient::start() {
  thread_ = std::thread([this] { run(); });
}

void FrameClient::gone() {
  {
    const std::lock_guard lock(mutex_);
    gone_ = true;
  }
  changed_.notify_all();
  thread_.join();
  on_gone_(*this);
}

bool FrameClient::receive(std::string_view text) {
  execute(text);
  changed_.notify_all();
  // After a farewell the client is still read, until it closes, so that it loses nothing of what was sent.
  const std::lock_guard lock(mutex_);
  return !broken_ || farewell_;
}

void FrameClient::post(ViewFramePtr frame) {
  {
    const std::lock_guard lock(mutex_);
    if (gone_) return;
    frames_.post(std::move(frame), room());
  }
  changed_.notify_all();
}

void FrameClient::post_status(StatusText status) {
  {
    const std::lock_guard lock(mutex_);
    status_ = std::move(status);
  }
  changed_.notify_all();
}

void FrameClient::end(const Farewell& farewell) {
  {
    const std::lock_guard lock(mutex_);
    farewell_ = farewell;
  }
  changed_.notify_all();
}

bool FrameClient::is_told() const {
  const std::lock_guard lock(mutex_);
  return broken_ || (!status_ && !sending_);
}

QueueHealth FrameClient::health() const {
  const std::lock_guard lock(mutex_);
  return frames_.health();
}

void FrameClient::run() {
  Due due;
  while (wait(due)) {
    const bool sent = send(due);
    if (!sent && !due.farewell) socket_.disconnect();
    const std::lock_guard lock(mutex_);
    sending_ = false;
    if (!sent) broken_ = true;
  }
}

/// How long the waiting frame must still wait; none: there is none, or it waits for the client.
std::optional<std::int64_t> FrameClient::frame_delay_us() const {
  return frames_.any() && !broken_ ? delay_us() : std::nullopt;
}

bool FrameClient::has_due() const {
  if (broken_) return false;
  return status_ || !replies_.empty() || farewell_ || frame_delay_us() == 0;
}

/// Waits until something may be sent, and moves it to `due`. Returns false when the client is gone.
bool FrameClient::wait(Due& due) {
  std::unique_lock lock(mutex_);

  // Sleep until something arrives, or until the next frame is allowed.
  while (!gone_ && !has_due()) {
    if (const auto early_us = frame_delay_us())
      changed_.wait_for(lock, std::chrono::microseconds(*early_us));
    else
      changed_.wait(lock);
  }
  if (gone_) return false;

  // Take what is due.
  sending_ = true;
  due = {nullptr, std::exchange(status_, nullptr), replies_.take(), farewell_};
  if (frame_delay_us() == 0) {
    due.frame = frames_.take();
    on_frame();
  }
  return true;
}

bool FrameClient::send(const Due& due) {
  for (const std::string& reply : due.replies)
    if (!socket_.send_text(reply)) return false;
  if (due.status && !socket_.send_text(*due.status)) return false;
  if (due.frame && !send_frame(*due.frame)) return false;
  if (due.farewell) socket_.ask_to_close(*due.farewell);
  return !due.farewell;  // nothing may follow it
}

}  // namespace barehand
