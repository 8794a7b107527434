#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "app/sink.h"
#include "core/feedback.h"
#include "core/log.h"
#include "core/queue.h"
#include "core/stage_monitor.h"
#include "math/source.h"

namespace barehand {

/// Preprocess gets, with the k-th frame, the estimates of frame k - kFeedbackLag: always that one, so that the threaded
/// and the inline runner give identical results. 1 would make preprocess wait for the tracker to finish the frame
/// before, and nothing would run side by side; 2 lets preprocess of one frame run while the one before is tracked.
inline constexpr std::int64_t kFeedbackLag = 2;

/// The stages that the pipeline joins. The source and the functions are used by one thread each.
struct PipelineStages {
  FrameSource& source;
  /// `hints`: see kFeedbackLag; empty for the first frames and where a stage failed.
  std::function<Result<HandObservations>(const FramePtr& frame, const HandEstimates& hints)> preprocess;
  std::function<Result<HandEstimates>(const HandObservations& observations)> track;
  std::vector<Sink*> sinks;  ///< every one gets every frame, in this order
};

struct PipelineOptions {
  bool threaded = true;                    ///< false: everything on the calling thread
  int max_failures_in_a_row = 30;          ///< of one stage or sink; then the run ends
  std::size_t replay_capacity = 4;         ///< frames waiting between two stages of a replay
  std::stop_token stop;                    ///< as request_stop(), for whoever lives longer than the pipeline
  std::chrono::milliseconds patience{50};  ///< how long one call of a live source may wait; bounds the time to stop
};

struct RunResult {
  PipelineHealth health;
  std::optional<Error> error;           ///< what ended the run early, or kept a sink from finishing
  std::vector<std::string> incomplete;  ///< names of the sinks that missed frames
  bool stopped = false;                 ///< by request_stop() or the stop token
};

/// Signs of life, all since the start of the run.
struct PipelinePulse {
  std::int64_t answers = 0;   ///< calls of the source that returned, with or without a frame
  std::int64_t finished = 0;  ///< frames that left the pipeline, published or failed
  std::int64_t inside = 0;    ///< frames on their way through it
};

/// Runs frames through source -> [door] -> preprocess -> [queue] -> track -> [queue] -> sinks, each stage on a thread
/// of its own or all of them on one. Frames of a live source are dropped at the door when the tracker is slow, the
/// newest wins; frames of a replay never. A frame on which a stage fails is counted, reported and left out. When the
/// source ends or fails, or the run is stopped, what is in flight is drained and every sink is finished. A stage that
/// fails again and again ends the run, and so does a sink of a replay; the world that the sinks of a live run write to
/// (network, disk) may come back.
class Pipeline {
 public:
  Pipeline(PipelineStages stages, PipelineOptions options, const Clock& clock, RepeatLog& log);

  /// Once. Returns when all is drained.
  RunResult run();
  /// Any thread: no more frames are taken from the source.
  void request_stop() { stop_ = true; }
  /// Any thread, any time; since the start of the run.
  PipelineHealth health() const;
  /// The same with times and latency since the last call; one caller.
  PipelineHealth take_interval_health();
  /// Any thread, any time.
  PipelinePulse pulse() const;

 private:
  struct Item {
    std::int64_t index = 0;       ///< k-th frame through the door
    std::int64_t arrived_us = 0;  ///< steady clock
    std::int64_t queued_us = 0;   ///< steady clock, when it was put into the queue it is in
    TrackedFrame data;
  };
  using Queue = BoundedQueue<Item>;
  enum QueueIndex { kDoor, kToTrack, kToSinks, kQueueCount };
  enum class Capture { frame, nothing, end };

  bool push(QueueIndex queue, Item item);
  std::optional<Item> pop(QueueIndex queue);
  std::optional<Item> try_pop(QueueIndex queue);
  std::optional<Item> waited_for(QueueIndex queue, std::optional<Item> item);
  bool stopped() const { return stop_ || options_.stop.stop_requested(); }
  Capture capture(std::chrono::milliseconds patience);
  Capture waited(std::chrono::milliseconds patience);
  void run_inline();
  void run_threaded();
  void process(Item item);
  HandEstimates take_hints();
  bool preprocess(Item& item, const HandEstimates& hints);
  bool track(Item& item);
  void deliver(const Item& item);
  void idle();
  void finish_sinks();

  void report(const StageMonitor& stage, const Item& item, const Error& error);
  void end_if_hopeless(const StageMonitor& stage, const Error& error);
  void end_with(Error error);
  std::int64_t latency_us(const Item& item) const;
  PipelineHealth counts() const;
  /// Those of the pipeline itself, indexed by QueueIndex, behind those of the source.
  static std::span<QueueHealth> own_queues(PipelineHealth& health);

  PipelineStages stages_;
  const PipelineOptions options_;
  const Clock& clock_;
  RepeatLog& log_;

  std::array<Queue, kQueueCount> queues_;
  Feedback<HandEstimates> feedback_;
  StageMonitor preprocess_monitor_, track_monitor_;
  std::vector<std::unique_ptr<StageMonitor>> sink_monitors_;
  std::atomic<bool> stop_ = false, ending_ = false;
  std::atomic<std::int64_t> published_ = 0, failed_ = 0, skipped_ = 0, answers_ = 0;
  std::int64_t next_index_ = 0;  // preprocess only
  static constexpr std::chrono::milliseconds kFirstNotice{3000};
  std::chrono::milliseconds waited_{0}, notice_at_ = kFirstNotice;  // source only

  mutable std::mutex mutex_;  // of what follows
  std::optional<Error> error_;
  TimeHistogram latency_, interval_latency_;
  std::array<TimeHistogram, kQueueCount> wait_, interval_wait_;
};

}  // namespace barehand
