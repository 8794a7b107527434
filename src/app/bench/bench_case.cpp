// Runs one case of `barehand bench`: tracks stored frames and measures time and memory.
#include "app/bench/bench_case.h"

#include <algorithm>
#include <mutex>

#include "barehand/hand_state_t.hpp"
#include "core/parallel/parallel.h"
#include "core/process_usage.h"
#include "drivers/lcm/layouts.h"
#include "drivers/lcm/lcm_listener.h"
#include "pipeline/pipeline.h"
#include "pipeline/sinks/publish_sink.h"
#include "pipeline/track_stages.h"

namespace barehand {
namespace {

constexpr int kMemoryPoints = 50;  // points of the memory curve over a run

/// Starts the measurement after the warm-up, and records time and memory from then on.
class MeasuringSink : public Sink {
 public:
  MeasuringSink(const BenchConditions& conditions, std::int64_t stored_bytes, const Clock& clock)
      : conditions_(conditions), stored_bytes_(stored_bytes), clock_(clock) {}

  std::string name() const override { return "measure"; }
  bool only_hands() const override { return true; }
  Result<void> consume(const TrackedFrame& tracked) override {
    const bool all_tracked = std::ranges::all_of(
        tracked.estimates, [](const HandEstimatePtr& hand) { return hand->status == TrackStatus::tracking; });
    note_first_pose(*tracked.frame, all_tracked);
    if (++seen_ == conditions_.warm_up) start();

    if (seen_ <= conditions_.warm_up) return {};
    tracked_ += all_tracked;

    // Sample the memory at equal steps.
    const std::int64_t step = std::max<std::int64_t>(1, conditions_.frames / kMemoryPoints);
    if ((seen_ - conditions_.warm_up) % step == 0)
      resident_mb_.push_back(static_cast<double>(memory_usage().resident - stored_bytes_) / kMegabyte);

    // Move the end of the measurement to this frame.
    end_us_ = clock_.steady_us();
    cpu_end_ = cpu_seconds();
    return {};
  }

  void start() {
    if (on_start) on_start();
    start_us_ = clock_.steady_us();
    cpu_start_ = cpu_seconds();
  }

  /// Writes the figures of the counted frames to `out`.
  void report(BenchResult& out) const {
    const auto counted = static_cast<double>(std::max<std::int64_t>(1, seen_ - conditions_.warm_up));
    out.seconds = static_cast<double>(end_us_ - start_us_) * 1e-6;
    out.frames_per_second = counted / std::max(out.seconds, 1e-9);
    out.cpu_seconds_per_frame = (cpu_end_ - cpu_start_) / counted;
    if (conditions_.rate) out.first_pose_seconds = first_pose_seconds_;
    out.tracked_fraction = static_cast<double>(tracked_) / counted;
    out.resident_mb = resident_mb_;
  }

  /// Called when the warm-up is over.
  std::function<void()> on_start;

 private:
  // Called before a frame is counted.
  void note_first_pose(const RgbdFrame& frame, bool all_tracked) {
    if (seen_ == 0) first_capture_ = frame.utime;
    if (all_tracked && !first_pose_seconds_)
      first_pose_seconds_ = static_cast<double>(clock_.utime() - first_capture_) * 1e-6;
  }

  const BenchConditions& conditions_;
  const std::int64_t stored_bytes_;
  const Clock& clock_;
  std::int64_t seen_ = 0, tracked_ = 0, start_us_ = 0, end_us_ = 0;
  std::int64_t first_capture_ = 0;  // of the first frame [us since the epoch]
  std::optional<double> first_pose_seconds_;
  double cpu_start_ = 0, cpu_end_ = 0;
  std::vector<double> resident_mb_;
};

/// Receives the states like any other client and measures their age.
class Reception {
 public:
  Reception(std::shared_ptr<LcmBus> bus, const std::string& prefix, const Clock& clock)
      : listener_(std::move(bus), prefix + "HAND_STATE", [this, &clock](const std::string&, WireBytes message) {
          const std::int64_t age_us = clock.utime() - message_word(message, 1);
          const std::lock_guard lock(mutex_);
          ages_.add(age_us);
        }) {}

  void clear() {
    const std::lock_guard lock(mutex_);
    ages_.clear();
  }
  TimeSummary summary() const {
    const std::lock_guard lock(mutex_);
    return ages_.summary();
  }

 private:
  mutable std::mutex mutex_;
  TimeHistogram ages_;
  LcmListener listener_;  // declared last, because its thread uses the members above
};

}  // namespace

Result<BenchResult> run_case(const BenchCase& bench, const BenchConditions& conditions, const FrameStore& store,
                             const BenchScene& scene) {
  const SystemClock clock;
  RepeatLog log(make_logger(), clock);
  auto workers = make_workers(bench.threads);
  if (!workers) return tl::unexpected(workers.error());
  (*workers)->go_live();  // as with a sensor, the scan of a mean hand uses only the time that tracking leaves

  // Open LCM, through which the states are sent and received again.
  auto opened = LcmBus::open(conditions.lcm_url);
  if (!opened) return tl::unexpected(opened.error());
  const std::shared_ptr<LcmBus> bus = std::move(*opened);
  const std::string& prefix = bench.config.run.channel_prefix;
  Reception reception(bus, prefix, clock);

  // Make the source, which replays the stored frames, and the sinks, which publish and measure.
  reset_peak_memory();
  MemorySource source(store, {conditions.warm_up + conditions.frames, conditions.rate}, clock);
  MeasuringSink measure(conditions, store.bytes(), clock);

  std::unique_ptr<Pipeline> pipeline;
  auto publish = BusSink::create(
      bench.config.publish, prefix, *bus,
      {[&] { return pipeline->health(); }, static_cast<std::int64_t>(bench.config.run.health_period * 1e6), "bench"},
      clock);
  if (!publish) return tl::unexpected(publish.error());
  FindingsSink findings(**publish);

  // Make the same stages as `barehand track`.
  TrackStages stages =
      make_track_stages(bench.config, scene.hands, std::nullopt, {}, **workers, log, nullptr, scene.objects);
  PipelineOptions options;
  options.threaded = !conditions.inline_stages;
  pipeline = std::make_unique<Pipeline>(PipelineStages{source,
                                                       std::move(stages.preprocess),
                                                       std::move(stages.track),
                                                       {publish->get(), &measure, &findings},
                                                       std::move(stages.contact),
                                                       std::move(stages.grasp)},
                                        options, clock, log);

  // Begin to count when the warm-up is over.
  std::int64_t dropped_before = 0;
  measure.on_start = [&] {
    dropped_before = pipeline->take_interval_health().dropped;
    reception.clear();
  };
  if (conditions.warm_up == 0) measure.start();
  const RunResult run = pipeline->run();
  if (run.error) return tl::unexpected(*run.error);

  // Collect the figures.
  BenchResult result;
  measure.report(result);
  result.health = pipeline->take_interval_health();
  result.health.dropped -= dropped_before;
  if (conditions.rate) result.received = reception.summary();
  result.frame_bytes = store.bytes();
  result.peak_bytes = memory_usage().peak;
  return result;
}

}  // namespace barehand
