// Formats the counts and times at the end of a run.
#include "pipeline/summary.h"

#include "core/format.h"

namespace barehand {
namespace {

std::string time_row(const std::string& name, const TimeSummary& time) {
  if (time.count == 0) return "";
  return formatted("  %-16s %8lld %8.2f %8.2f %8.2f %8.2f %8.2f\n", name.c_str(), static_cast<long long>(time.count),
                   time.mean * 1e3, time.p50 * 1e3, time.p95 * 1e3, time.p99 * 1e3, time.max * 1e3);
}

/// A line such as "dropped by transit 12, input 2"; empty if no frame was dropped.
std::string drops(const std::vector<QueueHealth>& queues) {
  std::string text;
  for (const QueueHealth& queue : queues)
    if (queue.dropped > 0)
      text += (text.empty() ? "dropped by " : ", ") + queue.name + " " + std::to_string(queue.dropped);
  return text.empty() ? text : text + "\n";
}

}  // namespace

std::string summary(const PipelineHealth& health, const std::vector<StatusCounts>& hands, double seconds) {
  std::string text = formatted("%lld frames in %.1f s (%.1f frames/s): %lld published, %lld dropped, %lld failed",
                               static_cast<long long>(health.captured), seconds,
                               seconds > 0 ? static_cast<double>(health.published) / seconds : 0.0,
                               static_cast<long long>(health.published), static_cast<long long>(health.dropped),
                               static_cast<long long>(health.failed));
  text += formatted("; %lld unreadable ones skipped\n", static_cast<long long>(health.skipped)) + drops(health.queues);

  // Add how often each hand was tracked, held, lost and searched for.
  for (const StatusCounts& hand : hands)
    text += formatted(
        "%s: tracked in %lld frames, held in %lld, lost in %lld, searched for in %lld\n",
        hands.size() == 1 ? "hand" : (std::string(to_string(hand.handedness)) + " hand").c_str(),
        static_cast<long long>(hand.of(TrackStatus::tracking)), static_cast<long long>(hand.of(TrackStatus::holding)),
        static_cast<long long>(hand.of(TrackStatus::lost)), static_cast<long long>(hand.of(TrackStatus::searching)));

  // Add the times of the stages and the latency.
  text += formatted("  %-16s %8s %8s %8s %8s %8s %8s\n", "time [ms]", "frames", "mean", "median", "p95", "p99", "max");
  for (const StageHealth& stage : health.stages) text += time_row(stage.name, stage.time);
  return text + time_row("latency", health.latency);
}

std::string health_line(const PipelineHealth& health) {
  std::string text =
      formatted("captured %lld, published %lld, dropped %lld, failed %lld, skipped %lld; latency %.1f ms;",
                static_cast<long long>(health.captured), static_cast<long long>(health.published),
                static_cast<long long>(health.dropped), static_cast<long long>(health.failed),
                static_cast<long long>(health.skipped), health.latency.p50 * 1e3);

  // Add the median time of each stage.
  for (const StageHealth& stage : health.stages)
    text += formatted(" %s %.1f ms", stage.name.c_str(), stage.time.p50 * 1e3);

  // Add the fill level and the losses of each queue.
  for (const QueueHealth& queue : health.queues) {
    text += formatted(" [%s %zu/%zu", queue.name.c_str(), queue.depth, queue.capacity);
    if (queue.dropped > 0) text += formatted(", %lld dropped", static_cast<long long>(queue.dropped));
    text += "]";
  }
  return text;
}

}  // namespace barehand
