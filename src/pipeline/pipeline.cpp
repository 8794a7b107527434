// Runs source, preprocessing, tracking and sinks, on one thread or on several.
#include "pipeline/pipeline.h"

#include <bit>
#include <thread>

#include "core/both.h"

namespace barehand {
namespace {

Overflow input_policy(const FrameSource& source) { return source.live() ? Overflow::drop_oldest : Overflow::block; }

/// A live run holds one item between two stages, since a longer queue would only add latency.
std::size_t capacity(const FrameSource& source, const PipelineOptions& options) {
  return source.live() ? 1 : options.replay_capacity;
}

/// If a frame's time stamp differs by more than this from the present time, its latency is not measured (for example
/// when a log is replayed to the bus) [us].
constexpr std::int64_t kMaxLatencyUs = 10'000'000;
/// The inline runner takes at most this many frames at once from a live source, since a source that never pauses must
/// not starve the tracker.
constexpr int kMaxBacklog = 64;

}  // namespace

Pipeline::Pipeline(PipelineStages stages, PipelineOptions options, const Clock& clock, RepeatLog& log)
    : stages_(std::move(stages)),
      options_(options),
      clock_(clock),
      log_(log),
      queues_{Queue{"input", capacity(stages_.source, options), input_policy(stages_.source)},
              Queue{"to track", capacity(stages_.source, options), Overflow::block},
              Queue{"to sinks", capacity(stages_.source, options), Overflow::block}},
      preprocess_monitor_("preprocess", clock),
      track_monitor_("track", clock),
      contact_monitor_("contact", clock),
      grasp_monitor_("grasp", clock) {
  for (const Sink* sink : stages_.sinks) sink_monitors_.push_back(std::make_unique<StageMonitor>(sink->name(), clock));
}

RunResult Pipeline::run() {
  options_.threaded ? run_threaded() : run_inline();

  // Finish the sinks, and collect the result of the run.
  finish_sinks();
  RunResult result{health(), std::nullopt, {}, stopped()};
  for (const auto& monitor : sink_monitors_)
    if (monitor->health().failed > 0) result.incomplete.push_back(monitor->name());
  std::unique_lock lock(mutex_);
  result.error = error_;
  return result;
}

void Pipeline::run_threaded() {
  // Each stage ends when its input queue is closed and empty, and then closes the next queue.
  std::jthread sinks([&] {
    while (!queues_[kToSinks].drained()) {
      if (auto item = waited_for(kToSinks, queues_[kToSinks].pop_within(options_.patience)))
        deliver(std::move(*item));
      else
        idle();
    }
  });

  std::jthread tracker([&] {
    while (auto item = pop(kToTrack))
      if (track(*item)) push(kToSinks, std::move(*item));
    queues_[kToSinks].close();
  });

  std::jthread preprocessor([&] {
    while (true) {
      // Wait for the feedback before the frame is popped: until then, a newer frame can still replace it in the queue.
      const HandEstimates feedback = take_feedback();
      auto item = pop(kInput);
      if (!item) break;
      if (preprocess(*item, feedback)) push(kToTrack, std::move(*item));
    }
    queues_[kToTrack].close();
  });

  // The calling thread serves the source.
  while (capture(options_.patience) != Capture::end) {
  }
  queues_[kInput].close();  // then each stage closes its output queue, and the threads end
}

void Pipeline::run_inline() {
  Capture captured = Capture::nothing;
  while (captured != Capture::end) {
    captured = capture(options_.patience);
    if (stages_.source.live())  // as with threads, only the newest of the frames that arrived meanwhile is kept
      for (int i = 0; i < kMaxBacklog && captured == Capture::frame; ++i) captured = capture({});
    while (auto item = try_pop(kInput)) process(std::move(*item));
    if (captured == Capture::nothing) idle();
  }
}

bool Pipeline::push(QueueIndex queue, Item item) {
  item.queued_us = clock_.steady_us();
  return queues_[queue].push(std::move(item));
}

std::optional<Pipeline::Item> Pipeline::pop(QueueIndex queue) { return waited_for(queue, queues_[queue].pop()); }

std::optional<Pipeline::Item> Pipeline::try_pop(QueueIndex queue) {
  return waited_for(queue, queues_[queue].try_pop());
}

std::optional<Pipeline::Item> Pipeline::waited_for(QueueIndex queue, std::optional<Item> item) {
  if (!item) return item;
  const std::int64_t wait_us = clock_.steady_us() - item->queued_us;
  std::unique_lock lock(mutex_);
  wait_[queue].add(wait_us);
  interval_wait_[queue].add(wait_us);
  return item;
}

void Pipeline::process(Item item) {
  const HandEstimates feedback = take_feedback();
  if (preprocess(item, feedback) && track(item)) deliver(std::move(item));
}

HandEstimates Pipeline::take_feedback() {
  return next_index_ >= kFeedbackLag ? feedback_.take(next_index_ - kFeedbackLag) : HandEstimates{};
}

Pipeline::Capture Pipeline::capture(std::chrono::milliseconds patience) {
  if (stopped() || ending_) return Capture::end;

  // Ask the source for an event; a source that throws has failed.
  SourceEvent event;
  try {
    event = stages_.source.next(patience);
  } catch (const std::exception& e) {
    event = SourceFailed{{std::string("threw: ") + e.what(), stages_.source.name(), ""}};
  }

  ++answers_;

  // Put a frame into the input queue.
  if (auto* frame = std::get_if<FramePtr>(&event)) {
    waited_ = {};
    notice_at_ = kFirstNotice;
    push(kInput, {0, clock_.steady_us(), 0, {std::move(*frame), {}, {}}});
    return Capture::frame;
  }

  // Report anything else; only a failure or the end of the source ends the run.
  if (auto* skipped = std::get_if<SkippedFrame>(&event)) {
    ++skipped_;
    log_.warn("skipped", "skipped a frame: " + skipped->error.message());
    return Capture::frame;
  }

  if (const auto* notice = std::get_if<SourceNotice>(&event)) {
    log_.logger().log(notice->trouble ? spdlog::level::warn : spdlog::level::info, notice->error.message());
    return Capture::nothing;
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

bool Pipeline::preprocess(Item& item, const HandEstimates& feedback) {
  item.index = next_index_++;

  auto observations = preprocess_monitor_.run(stages_.preprocess, item.data.frame, feedback);
  if (observations) {
    item.data.observations = std::move(*observations);
    return true;
  }

  // The tracker's estimate of this frame will be missing, so later frames get empty feedback.
  feedback_.post(item.index, {});
  ++failed_;
  report(preprocess_monitor_, item, observations.error());
  end_if_hopeless(preprocess_monitor_, observations.error());
  return false;
}

bool Pipeline::track(Item& item) {
  auto estimates = track_monitor_.run(stages_.track, item.data.observations);
  if (estimates) item.data.estimates = std::move(*estimates);
  feedback_.post(item.index, item.data.estimates);
  if (estimates) return true;
  ++failed_;
  report(track_monitor_, item, estimates.error());
  end_if_hopeless(track_monitor_, estimates.error());
  return false;
}

/// A frame without contacts is delivered all the same: its hands are known.
void Pipeline::find_contacts(Item& item) {
  if (!stages_.contact) return;
  auto contacts = contact_monitor_.run(stages_.contact, item.data.observations, item.data.estimates);
  if (contacts)
    item.data.contacts = std::move(*contacts);
  else
    report(contact_monitor_, item, contacts.error());
}

/// Likewise.
void Pipeline::find_grasps(Item& item) {
  if (!stages_.grasp) return;
  auto grasps = grasp_monitor_.run(stages_.grasp, item.data.estimates, item.data.contacts);
  if (grasps)
    item.data.grasps = std::move(*grasps);
  else
    report(grasp_monitor_, item, grasps.error());
}

void Pipeline::deliver(Item item) {
  // The hands are published before it is found what they touch and how they grasp.
  bool delivered = pass_to_sinks(item, true);
  record_latency(item);

  find_contacts(item);
  find_grasps(item);
  delivered &= pass_to_sinks(item, false);
  ++(delivered ? published_ : failed_);
}

bool Pipeline::pass_to_sinks(const Item& item, bool only_hands) {
  bool delivered = true;
  for (std::size_t i = 0; i < stages_.sinks.size(); ++i) {  // if a sink fails, the others still get the frame
    if (stages_.sinks[i]->only_hands() != only_hands) continue;
    StageMonitor& monitor = *sink_monitors_[i];
    const int missed = monitor.failures_in_a_row();
    const auto consumed = monitor.run(&Sink::consume, stages_.sinks[i], item.data);

    // Report that a sink works again after failures.
    if (consumed) {
      if (missed > 0) log_.logger().info("{} works again; it missed {} frames", monitor.name(), missed);
      continue;
    }
    delivered = false;
    // Report a lasting failure only after 1, 2, 4, 8, ... failed frames.
    if (std::has_single_bit(static_cast<unsigned>(missed) + 1)) report(monitor, item, consumed.error());
    if (!stages_.source.live()) end_if_hopeless(monitor, consumed.error());
  }

  return delivered;
}

void Pipeline::record_latency(const Item& item) {
  const std::int64_t latency = latency_us(item);
  std::unique_lock lock(mutex_);
  latency_.add(latency);
  interval_latency_.add(latency);
}

void Pipeline::idle() {
  for (std::size_t i = 0; i < stages_.sinks.size(); ++i) {
    const auto done = sink_monitors_[i]->guarded([&] { return stages_.sinks[i]->idle(); });
    if (!done) log_.warn(stages_.sinks[i]->name(), stages_.sinks[i]->name() + ": " + done.error().message());
  }
}

void Pipeline::finish_sinks() {
  // Every sink that cannot finish is named, since its file may need to be looked for.
  Result<void> ended;
  if (error_) ended = tl::unexpected(*error_);
  for (std::size_t i = 0; i < stages_.sinks.size(); ++i)
    ended = both(std::move(ended), sink_monitors_[i]->guarded([&] { return stages_.sinks[i]->finish(); }));

  std::unique_lock lock(mutex_);
  if (!ended) error_ = ended.error();
}

void Pipeline::report(const StageMonitor& stage, const Item& item, const Error& error) {
  log_.warn(stage.name(),
            "frame " + std::to_string(item.data.frame->number) + " failed in " + stage.name() + ": " + error.message());
}

void Pipeline::end_if_hopeless(const StageMonitor& stage, const Error& error) {
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

std::span<QueueHealth> Pipeline::own_queues(PipelineHealth& health) {
  return std::span(health.queues).last(kQueueCount);
}

PipelineHeartbeat Pipeline::heartbeat() const {
  // Read these counters before the queue's, so that the number of frames inside is never too small.
  const std::int64_t finished = published_ + failed_;
  const QueueHealth input = queues_[kInput].health();
  return {answers_, finished, input.pushed - input.dropped - finished};
}

PipelineHealth Pipeline::counts() const {
  PipelineHealth health;
  health.published = published_;
  health.failed = failed_;
  health.skipped = skipped_;
  health.queues = stages_.source.queues();
  for (const Queue& queue : queues_) health.queues.push_back(queue.health());
  const QueueHealth& input = own_queues(health)[kInput];
  health.captured = input.pushed;
  health.dropped = input.dropped;
  return health;
}

PipelineHealth Pipeline::health() const {
  PipelineHealth health = counts();
  health.stages = {preprocess_monitor_.health(), track_monitor_.health()};
  if (stages_.contact) health.stages.push_back(contact_monitor_.health());
  if (stages_.grasp) health.stages.push_back(grasp_monitor_.health());
  for (const auto& monitor : sink_monitors_) health.stages.push_back(monitor->health());
  std::unique_lock lock(mutex_);
  health.latency = latency_.summary();
  for (int q = 0; q < kQueueCount; ++q) own_queues(health)[q].wait = wait_[q].summary();
  return health;
}

PipelineHealth Pipeline::take_interval_health() {
  PipelineHealth health = counts();
  health.stages = {preprocess_monitor_.take_interval(), track_monitor_.take_interval()};
  if (stages_.contact) health.stages.push_back(contact_monitor_.take_interval());
  if (stages_.grasp) health.stages.push_back(grasp_monitor_.take_interval());
  for (const auto& monitor : sink_monitors_) health.stages.push_back(monitor->take_interval());
  std::unique_lock lock(mutex_);

  health.latency = interval_latency_.summary();
  for (int q = 0; q < kQueueCount; ++q) {
    own_queues(health)[q].wait = interval_wait_[q].summary();
    interval_wait_[q].clear();
  }
  interval_latency_.clear();
  return health;
}

}  // namespace barehand
