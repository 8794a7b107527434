// The sink that notifies systemd's watchdog while the pipeline makes progress.
#include "pipeline/sinks/service_sink.h"

#include "core/format.h"
#include "hand/status_name.h"

namespace barehand {
namespace {
constexpr std::int64_t kServicePeriodUs = 1'000'000;
constexpr std::int64_t kSilenceUs = 2'000'000;  // after this time without a frame, the status line reports it
}  // namespace

ServiceSink::ServiceSink(ServiceManager& manager, std::function<PipelineHeartbeat()> heartbeat,
                         std::function<PipelineHealth()> health, std::function<std::vector<TrackStatus>()> statuses,
                         const Clock& clock)
    : manager_(manager),
      heartbeat_(std::move(heartbeat)),
      health_(std::move(health)),
      statuses_(std::move(statuses)),
      clock_(clock),
      frame_us_(clock.steady_us()),
      status_us_(clock.steady_us()) {}

Result<void> ServiceSink::consume(const TrackedFrame&) {
  frame_us_ = clock_.steady_us();
  return idle();
}

Result<void> ServiceSink::idle() {
  feed_watchdog();
  if (clock_.steady_us() - status_us_ >= kServicePeriodUs) update_status();
  return {};
}

void ServiceSink::feed_watchdog() {
  const PipelineHeartbeat now = heartbeat_();
  const bool worked = now.inside > 0 ? now.finished > fed_at_.finished : now.answers > fed_at_.answers;
  if (!worked) return;
  fed_at_ = now;
  manager_.alive();
}

void ServiceSink::update_status() {
  const std::int64_t now_us = clock_.steady_us();
  const PipelineHealth health = health_();
  const std::vector<TrackStatus> hands = statuses_();
  std::string text = "hand: " + (hands.empty() ? "searching" : status_list(hands));
  if (now_us - frame_us_ >= kSilenceUs)
    text = formatted("no frames for %lld s", static_cast<long long>((now_us - frame_us_) / 1'000'000));
  const double rate =
      static_cast<double>(health.published - status_published_) * 1e6 / static_cast<double>(now_us - status_us_);
  manager_.status(text + formatted("; %.1f frames/s; %lld published, %lld dropped, %lld failed, %lld unreadable", rate,
                                   static_cast<long long>(health.published), static_cast<long long>(health.dropped),
                                   static_cast<long long>(health.failed), static_cast<long long>(health.skipped)));
  status_us_ = now_us;
  status_published_ = health.published;
}

}  // namespace barehand
