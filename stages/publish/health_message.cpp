// Converts the pipeline's health to an LCM message.
#include "stages/publish/health_message.h"

namespace barehand {

health_t health_message(const PipelineHealth& health, std::int64_t utime, const std::string& source) {
  health_t out{};
  out.utime = utime;
  out.source = source;

  // State what happened to the frames.
  out.captured = health.captured;
  out.published = health.published;
  out.dropped = health.dropped;
  out.failed = health.failed;
  out.skipped = health.skipped;

  // State the latency.
  out.latency_count = health.latency.count;
  out.latency_mean = health.latency.mean;
  out.latency_p50 = health.latency.p50;
  out.latency_p95 = health.latency.p95;
  out.latency_p99 = health.latency.p99;
  out.latency_max = health.latency.max;

  // List the stages.
  for (const StageHealth& stage : health.stages) {
    const TimeSummary& time = stage.time;
    out.stages.push_back({stage.name, time.count, time.mean, time.p50, time.p95, time.p99, time.max, stage.failed});
  }

  // List the queues.
  for (const QueueHealth& queue : health.queues) {
    out.queues.push_back({queue.name, static_cast<std::int32_t>(queue.depth), static_cast<std::int32_t>(queue.capacity),
                          queue.pushed, queue.popped, queue.dropped});
  }
  out.n_stages = static_cast<std::int32_t>(out.stages.size());
  out.n_queues = static_cast<std::int32_t>(out.queues.size());
  return out;
}

}  // namespace barehand
