// Shows on the live page what trackers send over LCM.
#include "app/view/live_view.h"

#include <algorithm>

#include "core/format.h"
#include "drivers/lcm/layouts.h"
#include "io/web/view_status.h"

namespace barehand {
namespace {

constexpr std::int64_t kCompleteUs = 10'000;  // the messages of one frame arrive within this time
constexpr std::size_t kImages = 8;            // number of images that are kept until their states arrive

TimeSummary summary_of(std::int64_t count, double mean, double p50, double p95, double p99, double max) {
  return {count, mean, p50, p95, p99, max};
}

PipelineHealth health_of(const health_t& m) {
  PipelineHealth health{m.captured, m.published, m.dropped, m.failed, m.skipped, {}, {}, {}};
  health.latency =
      summary_of(m.latency_count, m.latency_mean, m.latency_p50, m.latency_p95, m.latency_p99, m.latency_max);
  for (const stage_health_t& s : m.stages)
    health.stages.push_back({s.name, summary_of(s.count, s.mean, s.p50, s.p95, s.p99, s.max), s.failed});
  for (const queue_health_t& q : m.queues)
    health.queues.push_back({q.name,
                             static_cast<std::size_t>(q.capacity),
                             static_cast<std::size_t>(q.depth),
                             q.pushed,
                             q.popped,
                             q.dropped,
                             {}});
  return health;
}

std::int64_t utime_of(const ReceivedMessage& message) { return message_word(message.bytes, 1); }

}  // namespace

LiveView::LiveView(std::shared_ptr<LcmBus> bus, Options options, ShownHands hands, ViewServer& server,
                   const Clock& clock)
    : options_(std::move(options)),
      name_("lcm, " + bus->url()),
      hands_(std::move(hands)),
      server_(server),
      clock_(clock),
      frame_us_(clock.steady_us()),
      listener_(std::move(bus), options_.prefix + "*", [this](const std::string& channel, WireBytes message) {
        if (kind_of(message_hash(message)) != MessageKind::other)
          queue_.push({channel, std::vector<std::uint8_t>(message.begin(), message.end())});
      }) {}

void LiveView::step(std::chrono::milliseconds patience) {
  if (auto message = queue_.pop_within(patience)) take(std::move(*message));
  const std::int64_t now_us = clock_.steady_us();
  if (!gathered_.empty() && now_us - gathered_us_ >= kCompleteUs) show_gathered();
  if (now_us - status_us_ >= kStatusPeriodUs) show_status();
}

void LiveView::take(ReceivedMessage message) {
  const MessageKind kind = kind_of(message_hash(message.bytes));
  record(message, kind);
  if (kind == MessageKind::health) {
    if (const auto health = decode_message<health_t>(message.bytes)) health_ = health_of(*health);
    return;
  }
  if (kind == MessageKind::frame) return keep_image(std::move(message));
  if (!gathered_.empty() && utime_of(gathered_.front()) != utime_of(message)) show_gathered();
  if (gathered_.empty()) gathered_us_ = clock_.steady_us();
  gathered_.push_back(std::move(message));
}

/// Passes a message to the recorder as it was received. A health message belongs to no frame, so its frame time is 0.
void LiveView::record(const ReceivedMessage& message, MessageKind kind) {
  if (!options_.recorder || !options_.recorder->recording()) return;
  const std::int64_t utime = utime_of(message);
  options_.recorder->post(kind == MessageKind::health ? 0 : utime,
                          [message, utime](auto& log) { return log.send(message.channel, message.bytes, utime); });
}

void LiveView::keep_image(ReceivedMessage message) {
  if (images_.size() == kImages) images_.erase(images_.begin());
  images_.push_back(std::move(message));
}

void LiveView::show_gathered() {
  frame_us_ = clock_.steady_us();
  const std::int64_t utime = utime_of(gathered_.front());
  if (server_.has_clients()) {
    const auto image = std::ranges::find(images_, utime, utime_of);
    if (image != images_.end()) gathered_.push_back(*image);
    ViewFrame::Content content = frame_content(gathered_, hands_, {});
    content.T_world_camera = options_.T_world_camera;
    if (content.frame) content.depths = depths_.follow(typical_range(*content.frame), content.utime);
    server_.show(std::make_shared<const ViewFrame>(std::move(content)));
  }
  gathered_.clear();
}

void LiveView::show_status() {
  status_us_ = clock_.steady_us();
  ViewState state{name_, true, "", server_.clients(), health_, {}, options_.T_world_camera};
  state.drawn = hands_.names();
  state.record = options_.recorder ? options_.recorder->state() : RecorderState{};
  if (status_us_ - frame_us_ >= kNoFramesUs)
    state.trouble = formatted(
        "No tracker has sent states on %s*HAND_STATE for %lld s. Does one run, with this prefix and on this LCM "
        "network?",
        options_.prefix.c_str(), static_cast<long long>((status_us_ - frame_us_) / 1'000'000));
  server_.show_status(status_json(state));
}

}  // namespace barehand
