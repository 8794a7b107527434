#include "app/pipeline.h"

#include <thread>

namespace barehand {
namespace {

Overflow door_policy(const FrameSource& source) { return source.live() ? Overflow::drop_oldest : Overflow::block; }

/// One item between the stages of a live run: more would only add age.
std::size_t capacity(const FrameSource& source, const PipelineOptions& options) {
  return source.live() ? 1 : options.replay_capacity;
}

/// Sensor clocks farther from ours than this say nothing about latency (for example a log that is played to the bus).
constexpr std::int64_t kMaxLatencyUs = 10'000'000;
/// Frames taken from a live source in one go by the inline runner: one that never pauses must not starve the tracker.
constexpr int kMaxBacklog = 64;

}  // namespace

Pipeline::Pipeline(PipelineStages stages, PipelineOptions options, const Clock& clock, RepeatLog& log)
    : stages_(std::move(stages)),
      options_(options),
      clock_(clock),
      log_(log),
      door_("door", capacity(stages_.source, options), door_policy(stages_.source)),
      to_track_("to track", capacity(stages_.source, options), Overflow::block),
      to_sinks_("to sinks", capacity(stages_.source, options), Overflow::block),
      preprocess_monitor_("preprocess", clock),
      track_monitor_("track", clock) {
  for (const Sink* sink : stages_.sinks) sink_monitors_.push_back(std::make_unique<StageMonitor>(sink->name(), clock));
}

RunResult Pipeline::run() {
  options_.threaded ? run_threaded() : run_inline();
  finish_sinks();
  RunResult result{health(), std::nullopt, {}, stopped()};
  for (const auto& monitor : sink_monitors_)
    if (monitor->health().failed > 0) result.incomplete.push_back(monitor->name());
  std::unique_lock lock(mutex_);
  result.error = error_;
  return result;
}

void Pipeline::run_threaded() {
  std::jthread sinks([&] {
    while (auto item = to_sinks_.pop()) deliver(*item);
  });
  std::jthread tracker([&] {
    while (auto item = to_track_.pop())
      if (track(*item)) to_sinks_.push(std::move(*item));
    to_sinks_.close();
  });
  std::jthread preprocessor([&] {
    while (true) {
      const HandEstimatePtr hint = take_hint();  // first: a frame that waits for it at the door can still be replaced
      auto item = door_.pop();
      if (!item) break;
      if (preprocess(*item, hint.get())) to_track_.push(std::move(*item));
    }
    to_track_.close();
  });
  while (capture(options_.patience) != Capture::end) {
  }
  door_.close();  // the rest follows downstream; the threads are joined in that order
}

void Pipeline::run_inline() {
  Capture captured = Capture::nothing;
  while (captured != Capture::end) {
    captured = capture(options_.patience);
    if (stages_.source.live())  // what arrived while the last frame was tracked: the newest wins, as with threads
      for (int i = 0; i < kMaxBacklog && captured == Capture::frame; ++i) captured = capture({});
    while (auto item = door_.try_pop()) process(std::move(*item));
  }
}

void Pipeline::process(Item item) {
  const HandEstimatePtr hint = take_hint();
  if (preprocess(item, hint.get()) && track(item)) deliver(item);
}

HandEstimatePtr Pipeline::take_hint() {
  return next_index_ >= kFeedbackLag ? feedback_.take(next_index_ - kFeedbackLag) : nullptr;
}

Pipeline::Capture Pipeline::capture(std::chrono::milliseconds patience) {
  if (stopped() || ending_) return Capture::end;
  SourceEvent event;
  try {
    event = stages_.source.next(patience);
  } catch (const std::exception& e) {
    event = SourceFailed{{std::string("threw: ") + e.what(), stages_.source.name(), ""}};
  }
  if (auto* frame = std::get_if<FramePtr>(&event)) {
    waited_ = {};
    door_.push({0, clock_.steady_us(), {std::move(*frame), nullptr, nullptr}});
    return Capture::frame;
  }
  if (auto* skipped = std::get_if<SkippedFrame>(&event)) {
    ++skipped_;
    log_.warn("skipped", "skipped a frame: " + skipped->error.message());
    return Capture::frame;
  }
  if (std::holds_alternative<Timeout>(event)) return waited(patience);
  if (auto* failed = std::get_if<SourceFailed>(&event)) end_with(failed->error);
  return Capture::end;
}

Pipeline::Capture Pipeline::waited(std::chrono::milliseconds patience) {
  waited_ += patience;
  if (waited_ >= notice_at_) {
    log_.logger().info("{}: no frames for {} s, still waiting", stages_.source.name(), waited_.count() / 1000);
    notice_at_ = 4 * waited_;
  }
  return Capture::nothing;
}

bool Pipeline::preprocess(Item& item, const HandEstimate* hint) {
  item.index = next_index_++;
  auto observation = preprocess_monitor_.run([&] { return stages_.preprocess(item.data.frame, hint); });
  if (observation) {
    item.data.observation = std::move(*observation);
    return true;
  }
  feedback_.post(item.index, nullptr);
  ++failed_;
  report(preprocess_monitor_, item, observation.error());
  return false;
}

bool Pipeline::track(Item& item) {
  auto estimate = track_monitor_.run([&] { return stages_.track(item.data.observation); });
  if (estimate) item.data.estimate = std::move(*estimate);
  feedback_.post(item.index, item.data.estimate);
  if (estimate) return true;
  ++failed_;
  report(track_monitor_, item, estimate.error());
  return false;
}

void Pipeline::deliver(const Item& item) {
  bool delivered = true;
  for (std::size_t i = 0; i < stages_.sinks.size(); ++i) {  // one that fails does not keep the frame from the others
    const auto consumed = sink_monitors_[i]->run([&] { return stages_.sinks[i]->consume(item.data); });
    if (consumed) continue;
    delivered = false;
    report(*sink_monitors_[i], item, consumed.error());
  }
  ++(delivered ? published_ : failed_);
  std::unique_lock lock(mutex_);
  latency_.add(latency_us(item));
  interval_latency_.add(latency_us(item));
}

void Pipeline::finish_sinks() {
  for (std::size_t i = 0; i < stages_.sinks.size(); ++i) {
    const auto finished = sink_monitors_[i]->guarded([&] { return stages_.sinks[i]->finish(); });
    if (!finished) end_with(finished.error());
  }
}

void Pipeline::report(const StageMonitor& stage, const Item& item, const Error& error) {
  log_.warn(stage.name(),
            "frame " + std::to_string(item.data.frame->number) + " failed in " + stage.name() + ": " + error.message());
  const int failures = stage.failures_in_a_row();
  if (failures < options_.max_failures_in_a_row) return;
  Error last = error;
  last.what = stage.name() + " failed on " + std::to_string(failures) + " frames in a row, the last time: " + last.what;
  end_with(std::move(last));
}

void Pipeline::end_with(Error error) {
  ending_ = true;
  std::unique_lock lock(mutex_);
  if (!error_) error_ = std::move(error);
}

std::int64_t Pipeline::latency_us(const Item& item) const {
  const std::int64_t since_capture = clock_.utime() - item.data.frame->utime;
  const bool clocks_agree = stages_.source.live() && since_capture >= 0 && since_capture < kMaxLatencyUs;
  return clocks_agree ? since_capture : clock_.steady_us() - item.arrived_us;
}

PipelineHealth Pipeline::counts() const {
  PipelineHealth health;
  health.published = published_;
  health.failed = failed_;
  health.skipped = skipped_;
  health.queues = {door_.health(), to_track_.health(), to_sinks_.health()};
  health.captured = health.queues[0].pushed;
  health.dropped = health.queues[0].dropped;
  return health;
}

PipelineHealth Pipeline::health() const {
  PipelineHealth health = counts();
  health.stages = {preprocess_monitor_.health(), track_monitor_.health()};
  for (const auto& monitor : sink_monitors_) health.stages.push_back(monitor->health());
  std::unique_lock lock(mutex_);
  health.latency = latency_.summary();
  return health;
}

PipelineHealth Pipeline::take_interval_health() {
  PipelineHealth health = counts();
  health.stages = {preprocess_monitor_.take_interval(), track_monitor_.take_interval()};
  for (const auto& monitor : sink_monitors_) health.stages.push_back(monitor->take_interval());
  std::unique_lock lock(mutex_);
  health.latency = interval_latency_.summary();
  interval_latency_.clear();
  return health;
}

}  // namespace barehand
