// The connection to one live page in a browser.
#include "io/web/view_client.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

namespace barehand {
namespace {
// Minimum time between two transmissions of a hand's skin, which changes often while its profile is being learnt [us].
constexpr std::int64_t kSkinPeriodUs = 2'000'000;
}  // namespace

ViewClient::ViewClient(WebSocket socket, const Clock& clock, Handlers handlers)
    : socket_(socket), clock_(clock), handlers_(std::move(handlers)) {}

ViewClient::~ViewClient() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
  handlers_.gone(*this);
}

void ViewClient::start() {
  thread_ = std::thread([this] { run(); });
}

bool ViewClient::receive(std::string_view text) {
  const auto request = parse_view_request(text);
  const Result<void> followed = request ? follow(*request) : tl::unexpected(request.error());

  const std::lock_guard lock(mutex_);
  if (!followed) {
    reply(followed.error());
  } else if (const auto* settings = std::get_if<ViewSettings>(&*request)) {
    next_.settings = *settings;
    asked_ = true;
    under_way_ = 0;
    next_at_us_ = 0;

    // Send the last frame again, so that the client gets what it has requested even if no frame follows (a paused log).
    frames_.repeat();
  } else if (std::holds_alternative<ViewAcknowledge>(*request) && under_way_ > 0) {
    --under_way_;
  }
  changed_.notify_all();
  // After a farewell the client is still read, until it closes, so that it loses nothing of what was sent.
  return !broken_ || next_.farewell;
}

/// Executes commands that concern the program as a whole.
Result<void> ViewClient::follow(const ViewRequest& request) {
  if (const auto* command = std::get_if<RecordCommand>(&request)) return handlers_.record(*command);
  if (const auto* command = std::get_if<PlayerCommand>(&request)) handlers_.play(*command);
  return {};
}

void ViewClient::reply(const Error& error) {
  const nlohmann::json reply{{"type", "error"}, {"text", error.message()}};
  constexpr auto replace = nlohmann::json::error_handler_t::replace;  // the client's message need not be UTF-8
  replies_.add(reply.dump(-1, ' ', false, replace));
}

void ViewClient::post(ViewFramePtr frame) {
  {
    const std::lock_guard lock(mutex_);
    if (ending_) return;
    frames_.post(std::move(frame));
  }
  changed_.notify_all();
}

void ViewClient::post_status(StatusText status) {
  {
    const std::lock_guard lock(mutex_);
    next_.status = std::move(status);
  }
  changed_.notify_all();
}

void ViewClient::end(const Farewell& farewell) {
  {
    const std::lock_guard lock(mutex_);
    next_.farewell = farewell;
  }
  changed_.notify_all();
}

bool ViewClient::is_told() const {
  const std::lock_guard lock(mutex_);
  return broken_ || (!next_.status && !sending_);
}

QueueHealth ViewClient::health() const {
  const std::lock_guard lock(mutex_);
  return frames_.health();
}

void ViewClient::run() {
  Due due;
  while (wait(due)) {
    const bool sent = send(due);
    if (!sent && !due.farewell) socket_.disconnect();
    const std::lock_guard lock(mutex_);
    sending_ = false;
    if (!sent) broken_ = true;
  }
}

bool ViewClient::has_due(std::int64_t now_us) const {
  if (broken_) return false;
  return next_.status || !replies_.empty() || next_.farewell || has_due_frame(now_us);
}

bool ViewClient::has_due_frame(std::int64_t now_us) const {
  if (!frames_.waiting() || !asked_) return false;
  const bool window_open = next_.settings.window == 0 || under_way_ < next_.settings.window;
  return next_.farewell || (window_open && now_us >= next_at_us_);
}

/// Waits until something may be sent, and moves it to `due`. Returns false when the client is being destroyed.
bool ViewClient::wait(Due& due) {
  std::unique_lock lock(mutex_);

  // Sleep until something arrives, or until the next frame is allowed.
  while (!ending_ && !has_due(clock_.steady_us())) {
    const std::int64_t early_us = frames_.waiting() ? next_at_us_ - clock_.steady_us() : 0;
    if (early_us > 0 && !broken_)
      changed_.wait_for(lock, std::chrono::microseconds(early_us));
    else
      changed_.wait(lock);
  }
  if (ending_) return false;

  // Take the newest status, the replies, the settings and the farewell.
  sending_ = true;
  due.status = std::exchange(next_.status, nullptr);
  due.replies = replies_.take();
  due.farewell = next_.farewell;
  due.settings = next_.settings;
  due.frame = nullptr;

  // Take the frame unless too many are unacknowledged or the requested rate does not allow it yet.
  if (const std::int64_t now_us = clock_.steady_us(); has_due_frame(now_us)) {
    due.frame = frames_.take();
    if (next_.settings.window > 0) ++under_way_;
    next_at_us_ = now_us + static_cast<std::int64_t>(1e6 / next_.settings.rate * 0.9);
  }
  return true;
}

bool ViewClient::send(const Due& due) {
  for (const std::string& reply : due.replies)
    if (!socket_.send_text(reply)) return false;
  if (due.status && !socket_.send_text(*due.status)) return false;
  if (due.frame && !send_frame(*due.frame, due.settings)) return false;
  if (due.farewell) socket_.ask_to_close(*due.farewell);
  return !due.farewell;  // nothing may follow it
}

bool ViewClient::send_frame(const ViewFrame& frame, const ViewSettings& settings) {
  bytes_.clear();
  write_new_skins(frame);
  frame.write_states(clock_.utime(), bytes_);
  const auto append = [&](std::span<const std::uint8_t> chunk) {
    bytes_.insert(bytes_.end(), chunk.begin(), chunk.end());
  };
  append(frame.cloud(settings.cloud));
  append(frame.picture(settings.picture, settings.large));
  return socket_.send_binary(bytes_);
}

void ViewClient::write_new_skins(const ViewFrame& frame) {
  for (std::size_t side = 0; side < skins_.size(); ++side) {
    const ViewSkinPtr& skin = frame.content().skins[side];
    const std::int64_t now_us = clock_.steady_us();
    const bool early = skins_[side] && now_us - skin_sent_us_[side] < kSkinPeriodUs;
    if (!skin || skin == skins_[side] || early) continue;
    bytes_.insert(bytes_.end(), skin->bytes().begin(), skin->bytes().end());
    skins_[side] = skin;
    skin_sent_us_[side] = now_us;
  }
}

}  // namespace barehand
