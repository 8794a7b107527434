// The figures of one case of `barehand bench` as text for the user.
#include "app/bench/bench_report.h"
#include "core/format.h"

namespace barehand {
namespace {

std::string time_row(const std::string& name, const TimeSummary& time) {
  if (time.count == 0) return "";
  return formatted("  %-20s %8.2f %8.2f %8.2f %8.2f %8.2f\n", name.c_str(), time.mean * 1e3, time.p50 * 1e3,
                   time.p95 * 1e3, time.p99 * 1e3, time.max * 1e3);
}

}  // namespace

std::string bench_text(const BenchRow& row) {
  // Write the case and its total figures.
  const BenchResult& r = row.result;
  std::string text = formatted("%s, %dx%d, %d threads", row.config.c_str(), row.width, row.height, row.threads);
  if (!row.sweep.empty()) text += formatted(", %s = %g", row.sweep.c_str(), row.value);
  text += formatted(": %.1f frames/s, %.2f ms CPU per frame, tracked in %.0f %%, %lld dropped\n", r.frames_per_second,
                    r.cpu_seconds_per_frame * 1e3, r.tracked_fraction * 100, static_cast<long long>(r.health.dropped));

  if (r.first_pose_seconds)
    text +=
        formatted("  all hands tracked %.0f ms after the capture of the first frame\n", *r.first_pose_seconds * 1e3);

  // Write the memory.
  text += formatted("  resident: peak %.0f MB, of which %.0f MB are the stored frames\n", r.peak_bytes / kMegabyte,
                    r.frame_bytes / kMegabyte);

  // Write a table of times: stages, queues, and the whole path.
  text += formatted("  %-20s %8s %8s %8s %8s %8s\n", "time [ms]", "mean", "median", "p95", "p99", "max");
  for (const StageHealth& stage : r.health.stages) text += time_row(stage.name, stage.time);
  for (const QueueHealth& queue : r.health.queues) text += time_row("wait " + queue.name, queue.wait);
  return text + time_row("capture to publish", r.health.latency) + time_row("capture to reception", r.received);
}

std::string bench_text(const ObserverRow& row) {
  return formatted("%s, %d samples compared, %d threads, %s%s: %s\n", row.config.c_str(), row.trial.samples,
                   row.threads, row.device.renderer.c_str(),
                   row.device.software ? " (software, which observer: auto never uses)" : "",
                   to_text(row.trial.times).c_str());
}

}  // namespace barehand
