// Passes frames from a source through preprocessing and tracking to the sinks, on one thread or on several.
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

#include "core/feedback.h"
#include "core/log.h"
#include "core/queue.h"
#include "core/stage_monitor.h"
#include "pipeline/sink.h"
#include "sensor/frame_source.h"

namespace barehand {

/// Preprocessing of frame k gets the estimates of exactly frame k - kFeedbackLag, so that the threaded and the inline
/// runner give identical results. With 1, preprocessing would wait until the previous frame is tracked, and nothing
/// would run in parallel; 2 lets preprocessing of one frame overlap with tracking of the one before.
inline constexpr std::int64_t kFeedbackLag = 2;

/// The stages that the pipeline connects. The source and each function are used by one thread only.
struct PipelineStages {
  FrameSource& source;
  /// `feedback`: the estimates of an earlier frame, see kFeedbackLag; empty for the first frames and where a stage
  /// failed.
  std::function<Result<HandObservations>(const FramePtr& frame, const HandEstimates& feedback)> preprocess;
  std::function<Result<HandEstimates>(HandObservations& observations)> track;
  std::vector<Sink*> sinks;  ///< every sink gets every frame, in this order
  /// What the hands touch; runs on the thread of the sinks. Empty: frames have no contacts.
  std::function<Result<FrameContactsPtr>(const HandObservations& observations, const HandEstimates& estimates)>
      contact = {};
  /// How the hands grasp; runs after the contacts, likewise. Empty: frames have no grasps.
  std::function<Result<FrameGraspsPtr>(const HandEstimates& estimates, const FrameContactsPtr& contacts)> grasp = {};
};

/// How the pipeline runs.
struct PipelineOptions {
  bool threaded = true;                    ///< false: everything on the calling thread
  int max_failures_in_a_row = 30;          ///< number of successive failures of one stage or sink that ends the run
  std::size_t replay_capacity = 4;         ///< frames waiting between two stages of a replay
  std::stop_token stop;                    ///< ends the run like request_stop(); can exist before the pipeline does
  std::chrono::milliseconds patience{50};  ///< longest wait of one call of a live source; bounds the time to stop
};

/// How a run ended.
struct RunResult {
  PipelineHealth health;
  std::optional<Error> error;           ///< why the run ended early, and which sinks could not finish
  std::vector<std::string> incomplete;  ///< names of the sinks that missed frames
  bool stopped = false;                 ///< whether request_stop() or the stop token ended the run
};

/// Counters, since the start of the run, by which a watchdog sees whether the pipeline still works.
struct PipelineHeartbeat {
  std::int64_t answers = 0;   ///< calls of the source that returned, with or without a frame
  std::int64_t finished = 0;  ///< frames that left the pipeline, published or failed
  std::int64_t inside = 0;    ///< frames in the queues and stages now
};

/// Passes frames through source -> [input queue] -> preprocess -> [queue] -> track -> [queue] -> sinks and contact,
/// each part on a thread of its own or all of them on one. If the tracker is slower than a live source, the input queue
/// drops the oldest frames; frames of a replay are never dropped. A frame on which a stage fails is counted, reported
/// and left out. When the source ends or fails, or the run is stopped, the frames in flight are processed and every
/// sink is finished. A stage that keeps failing ends the run, and so does a sink of a replay; a sink of a live run
/// does not, since the network or disk that it writes to may come back.
class Pipeline {
 public:
  /// `clock` and `log` must outlive the pipeline, and so must the source and the sinks.
  Pipeline(PipelineStages stages, PipelineOptions options, const Clock& clock, RepeatLog& log);

  /// Must be called only once. Returns when all frames are processed.
  RunResult run();
  /// Stops taking frames from the source. Any thread may call it.
  void request_stop() { stop_ = true; }
  /// Counters since the start of the run. Any thread may call it at any time.
  PipelineHealth health() const;
  /// Like health(), but times and latency are those since the last call of this function. Only one caller may use it.
  PipelineHealth take_interval_health();
  /// Counters for a watchdog. Any thread may call it at any time.
  PipelineHeartbeat heartbeat() const;

 private:
  struct Item {
    std::int64_t index = 0;       ///< number of the frame among those that entered the input queue
    std::int64_t arrived_us = 0;  ///< time at which the frame arrived, steady clock
    std::int64_t queued_us = 0;   ///< time at which it entered the queue that it is in, steady clock
    TrackedFrame data;
  };
  using Queue = BoundedQueue<Item>;
  enum QueueIndex { kInput, kToTrack, kToSinks, kQueueCount };
  enum class Capture { frame, nothing, end };

  // Access to the queues; each frame's waiting time is recorded when it leaves.
  bool push(QueueIndex queue, Item item);
  std::optional<Item> pop(QueueIndex queue);
  std::optional<Item> try_pop(QueueIndex queue);
  // Records how long the item waited in the queue, and returns it.
  std::optional<Item> waited_for(QueueIndex queue, std::optional<Item> item);
  bool stopped() const { return stop_ || options_.stop.stop_requested(); }
  // Takes one event from the source. Returns whether it was a frame (a skipped one counts), nothing, or the end.
  Capture capture(std::chrono::milliseconds patience);
  // Reports, at growing intervals, that a live source delivers no frames.
  Capture waited(std::chrono::milliseconds patience);
  void run_inline();
  void run_threaded();
  // Passes one frame through all stages on the calling thread.
  void process(Item item);
  HandEstimates take_feedback();
  bool preprocess(Item& item, const HandEstimates& feedback);
  bool track(Item& item);
  void find_contacts(Item& item);
  void find_grasps(Item& item);
  void deliver(Item item);
  // Passes the frame to the sinks that need only the hands, or to the others. Returns whether none failed.
  bool pass_to_sinks(const Item& item, bool only_hands);
  void record_latency(const Item& item);
  void idle();
  void finish_sinks();

  // Logs a failure.
  void report(const StageMonitor& stage, const Item& item, const Error& error);
  // Ends the run if the stage has failed on too many frames in a row.
  void end_if_hopeless(const StageMonitor& stage, const Error& error);
  void end_with(Error error);
  std::int64_t latency_us(const Item& item) const;
  PipelineHealth counts() const;
  /// The part of `health.queues` with the pipeline's own queues, indexed by QueueIndex; the source's queues come first.
  static std::span<QueueHealth> own_queues(PipelineHealth& health);

  PipelineStages stages_;
  const PipelineOptions options_;
  const Clock& clock_;
  RepeatLog& log_;

  std::array<Queue, kQueueCount> queues_;
  Feedback<HandEstimates> feedback_;
  StageMonitor preprocess_monitor_, track_monitor_, contact_monitor_, grasp_monitor_;
  std::vector<std::unique_ptr<StageMonitor>> sink_monitors_;
  std::atomic<bool> stop_ = false, ending_ = false;
  std::atomic<std::int64_t> published_ = 0, failed_ = 0, skipped_ = 0, answers_ = 0;
  std::int64_t next_index_ = 0;  // used by the preprocessing thread only
  static constexpr std::chrono::milliseconds kFirstNotice{3000};
  std::chrono::milliseconds waited_{0}, notice_at_ = kFirstNotice;  // used by the source's thread only

  mutable std::mutex mutex_;  // protects the members below
  std::optional<Error> error_;
  TimeHistogram latency_, interval_latency_;
  std::array<TimeHistogram, kQueueCount> wait_, interval_wait_;
};

}  // namespace barehand
