// The connection to one live page in a browser.
#include "io/web/view_client.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace barehand {
namespace {
// Minimum time between two transmissions of a hand's skin, which changes often while its profile is being learnt [us].
constexpr std::int64_t kSkinPeriodUs = 2'000'000;
// A frame that comes late leaves the next ones less time. Within this time [us] they may catch up with the rate that
// the client wishes, so that a source of this very rate loses none.
constexpr std::int64_t kCatchUpUs = 250'000;

/// The shortest mean time between frames [us], a tenth below the wish, since clocks differ.
std::int64_t interval_us(const ViewSettings& settings) { return static_cast<std::int64_t>(1e6 / settings.rate * 0.9); }
}  // namespace

ViewClient::ViewClient(WebSocket socket, const Clock& clock, Handlers handlers)
    : FrameClient(socket, handlers.gone), clock_(clock), handlers_(std::move(handlers)) {}

void ViewClient::execute(std::string_view text) {
  const auto request = parse_view_request(text);
  const Result<void> followed = request ? follow(*request) : tl::unexpected(request.error());

  const std::lock_guard lock(mutex_);
  if (!followed) {
    reply(followed.error());
  } else if (const auto* settings = std::get_if<ViewSettings>(&*request)) {
    settings_ = *settings;
    under_way_ = 0;
    next_at_us_ = 0;
    frames_.keep(room());

    // Send the last frame again, so that the client gets what it has requested even if no frame follows (a paused log).
    frames_.repeat();
  } else if (std::holds_alternative<ViewAcknowledge>(*request) && under_way_ > 0) {
    --under_way_;
  }
}

/// Executes commands that concern the program as a whole.
Result<void> ViewClient::follow(const ViewRequest& request) {
  if (const auto* command = std::get_if<RecordCommand>(&request)) return handlers_.record(*command);
  if (const auto* command = std::get_if<PlayerCommand>(&request)) return handlers_.play(*command);
  return {};
}

void ViewClient::reply(const Error& error) {
  const nlohmann::json reply{{"type", "error"}, {"text", error.message()}};
  constexpr auto replace = nlohmann::json::error_handler_t::replace;  // the client's message need not be UTF-8
  replies_.add(reply.dump(-1, ' ', false, replace));
}

std::optional<std::int64_t> ViewClient::delay_us() const {
  if (!settings_) return std::nullopt;
  if (is_ending()) return 0;
  if (settings_->window > 0 && under_way_ >= settings_->window) return std::nullopt;
  return std::max<std::int64_t>(0, next_at_us_ - clock_.steady_us());
}

std::size_t ViewClient::room() const {
  if (!settings_ || is_ending()) return WaitingFrames::kMost;
  const std::int64_t now_us = clock_.steady_us();
  const std::int64_t spare_us = std::min(now_us - next_at_us_, kCatchUpUs);
  std::int64_t frames = spare_us < 0 ? 0 : 1 + spare_us / interval_us(*settings_);
  if (settings_->window > 0) frames = std::min<std::int64_t>(frames, settings_->window - under_way_);
  return static_cast<std::size_t>(std::max<std::int64_t>(frames, 0));
}

void ViewClient::on_frame() {
  if (settings_->window > 0) ++under_way_;
  next_at_us_ = std::max(next_at_us_, clock_.steady_us() - kCatchUpUs) + interval_us(*settings_);
}

bool ViewClient::send_frame(const ViewFrame& frame) {
  const ViewSettings settings = [&] {
    const std::lock_guard lock(mutex_);
    return *settings_;
  }();
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
