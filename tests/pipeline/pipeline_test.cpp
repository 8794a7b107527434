#include "pipeline/pipeline.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <latch>
#include <stdexcept>

namespace barehand {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A source that returns `script(n)` in its n-th call.
class ScriptedSource : public FrameSource {
 public:
  ScriptedSource(bool live, std::function<SourceEvent(int)> script) : live_(live), script_(std::move(script)) {}
  SourceEvent next(std::chrono::milliseconds) override { return script_(calls_++); }
  bool live() const override { return live_; }
  std::string name() const override { return "script"; }
  std::vector<QueueHealth> queues() const override { return before; }
  std::vector<QueueHealth> before;

 private:
  const bool live_;
  const std::function<SourceEvent(int)> script_;
  int calls_ = 0;
};

FramePtr frame(int number) {
  auto made = std::make_shared<RgbdFrame>();
  made->number = number;
  return made;
}

std::function<SourceEvent(int)> frames_then_end(int count) {
  return [count](int n) -> SourceEvent { return n < count ? SourceEvent(frame(n)) : EndOfStream{}; };
}

class RecordingSink : public Sink {
 public:
  std::string name() const override { return "recorder"; }
  bool only_hands() const override { return wants_only_hands; }
  Result<void> consume(const TrackedFrame& tracked) override {
    if (on_frame) {
      if (auto ok = on_frame(tracked); !ok) return ok;
    }
    numbers.push_back(static_cast<int>(tracked.estimates[0]->number));
    scores.push_back(tracked.estimates[0]->score);
    return {};
  }
  Result<void> idle() override {
    ++idle_calls;
    return {};
  }
  Result<void> finish() override {
    ++finished;
    return finish_result;
  }
  std::function<Result<void>(const TrackedFrame&)> on_frame;
  Result<void> finish_result;
  bool wants_only_hands = false;
  std::vector<int> numbers;
  std::vector<double> scores;
  int finished = 0;
  std::atomic<int> idle_calls = 0;
};

/// A pipeline whose results depend on the feedback and on all frames before. It fails for given frames.
struct World {
  explicit World(bool threaded) { options.threaded = threaded; }

  RunResult run(FrameSource& source) {
    PipelineStages stages{source,
                          [this](const FramePtr& f, const HandEstimates& before) { return preprocess(f, before); },
                          [this](HandObservations& o) { return track(o); },
                          sinks,
                          contact,
                          grasp};
    pipeline = std::make_unique<Pipeline>(std::move(stages), options, clock, log);
    return pipeline->run();
  }

  Result<HandObservations> preprocess(const FramePtr& f, const HandEstimates& before) {
    const HandEstimatePtr earlier = before.empty() ? nullptr : before[0];
    feedback.push_back(earlier ? static_cast<int>(earlier->number) : -1);
    if (before_preprocess) before_preprocess(f);
    auto made = std::make_shared<HandObservation>();
    made->frame = f;
    made->noise = 1.0 / (f->number + 3) + (earlier ? earlier->score / 3 : 0);
    return HandObservations{made};
  }

  Result<HandEstimates> track(const HandObservations& observations) {
    const HandObservationPtr& observation = observations[0];
    if (before_track) {
      if (auto ok = before_track(observation->frame); !ok) return tl::unexpected(ok.error());
    }
    auto made = std::make_shared<HandEstimate>();
    made->number = observation->frame->number;
    memory = made->score = memory / 7 + observation->noise;
    return HandEstimates{made};
  }

  PipelineOptions options;
  ManualClock clock;
  RepeatLog log{make_silent_logger(), clock};
  RecordingSink sink;
  std::vector<Sink*> sinks{&sink};
  std::function<Result<FrameContactsPtr>(const HandObservations&, const HandEstimates&)> contact;
  std::function<Result<FrameGraspsPtr>(const HandEstimates&, const FrameContactsPtr&)> grasp;
  std::function<void(const FramePtr&)> before_preprocess;
  std::function<Result<void>(const FramePtr&)> before_track;
  std::vector<int> feedback;
  double memory = 0;
  std::unique_ptr<Pipeline> pipeline;
};

void expect_balanced(const PipelineHealth& health) {
  EXPECT_EQ(health.captured, health.published + health.dropped + health.failed);
  for (const QueueHealth& queue : health.queues) {
    EXPECT_EQ(queue.pushed, queue.popped + queue.dropped) << queue.name;
    EXPECT_EQ(queue.depth, 0u) << queue.name;
  }
}

class PipelineLifecycle : public ::testing::TestWithParam<bool> {
 protected:
  World world_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Runners, PipelineLifecycle, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "threaded" : "inline"; });

TEST_P(PipelineLifecycle, FinishDrainsEverything) {
  ScriptedSource source(false, frames_then_end(20));
  const RunResult result = world_.run(source);
  EXPECT_FALSE(result.error);
  EXPECT_FALSE(result.stopped);
  EXPECT_EQ(world_.sink.numbers.size(), 20u);
  EXPECT_TRUE(std::is_sorted(world_.sink.numbers.begin(), world_.sink.numbers.end()));
  EXPECT_EQ(world_.sink.finished, 1);
  EXPECT_EQ(result.health.published, 20);
  EXPECT_EQ(result.health.stages[0].time.count, 20);
  EXPECT_EQ(result.health.latency.count, 20);
  expect_balanced(result.health);
}

TEST_P(PipelineLifecycle, SinksGetTheContactsOfTheirFrameAndDoWithoutThoseThatFailed) {
  world_.contact = [](const HandObservations&, const HandEstimates& estimates) -> Result<FrameContactsPtr> {
    if (estimates[0]->number == 3) return fail("bad");
    auto contacts = std::make_shared<FrameContacts>();
    contacts->objects.emplace_back().id = static_cast<std::int32_t>(estimates[0]->number);
    return contacts;
  };
  std::vector<int> got;
  world_.sink.on_frame = [&](const TrackedFrame& tracked) -> Result<void> {
    got.push_back(tracked.contacts ? tracked.contacts->objects[0].id : -1);
    return {};
  };
  ScriptedSource source(false, frames_then_end(6));
  const RunResult result = world_.run(source);
  EXPECT_THAT(got, ElementsAre(0, 1, 2, -1, 4, 5));
  EXPECT_EQ(result.health.published, 6);
  EXPECT_EQ(result.health.stages[2].name, "contact");
  EXPECT_EQ(result.health.stages[2].failed, 1);
}

TEST_P(PipelineLifecycle, SinksThatNeedOnlyHandsDoNotWaitForContacts) {
  std::string order;
  RecordingSink prompt;
  prompt.wants_only_hands = true;
  prompt.on_frame = [&](const TrackedFrame& tracked) -> Result<void> {
    EXPECT_FALSE(tracked.contacts);
    order += 'h';
    return {};
  };
  world_.contact = [&](const HandObservations&, const HandEstimates&) -> Result<FrameContactsPtr> {
    order += 'c';
    return std::make_shared<FrameContacts>();
  };
  world_.sink.on_frame = [&](const TrackedFrame& tracked) -> Result<void> {
    EXPECT_TRUE(tracked.contacts);
    order += 's';
    return {};
  };
  world_.sinks.push_back(&prompt);
  ScriptedSource source(false, frames_then_end(3));
  const RunResult result = world_.run(source);
  EXPECT_EQ(order, "hcshcshcs");
  EXPECT_EQ(result.health.published, 3);
  EXPECT_EQ(result.health.latency.count, 3);
}

TEST_P(PipelineLifecycle, SinksGetTheGraspsOfTheirFrameAndDoWithoutThoseThatFailed) {
  world_.grasp = [](const HandEstimates& estimates, const FrameContactsPtr&) -> Result<FrameGraspsPtr> {
    if (estimates[0]->number == 2) return fail("bad");
    auto grasps = std::make_shared<FrameGrasps>(1);
    (*grasps)[0].grasp = static_cast<int>(estimates[0]->number);
    return grasps;
  };
  std::vector<int> got;
  world_.sink.on_frame = [&](const TrackedFrame& tracked) -> Result<void> {
    got.push_back(tracked.grasps ? (*tracked.grasps)[0].grasp : -1);
    return {};
  };
  ScriptedSource source(false, frames_then_end(4));
  const RunResult result = world_.run(source);
  EXPECT_THAT(got, ElementsAre(0, 1, -1, 3));
  EXPECT_EQ(result.health.stages[2].name, "grasp");
  EXPECT_EQ(result.health.stages[2].failed, 1);
}

TEST_P(PipelineLifecycle, HintIsTheEstimateTwoFramesBack) {
  ScriptedSource source(false, frames_then_end(6));
  world_.run(source);
  EXPECT_THAT(world_.feedback, ElementsAre(-1, -1, 0, 1, 2, 3));
}

TEST_P(PipelineLifecycle, MeasuresTheWaitInEveryQueueThatWasPassed) {
  // The clock advances while the source is asked for the second frame; with threads, frame 0 may have passed all
  // queues by then.
  ScriptedSource source(false, [this](int n) -> SourceEvent {
    world_.clock.advance(n == 1 ? 5000 : 0);
    return n < 3 ? SourceEvent(frame(n)) : EndOfStream{};
  });

  // Every queue has measured all waits.
  const RunResult result = world_.run(source);
  for (const QueueHealth& queue : result.health.queues) {
    EXPECT_EQ(queue.wait.count, queue.popped) << queue.name;
    if (queue.popped > 0) {
      EXPECT_LE(queue.wait.max, 0.005) << queue.name;
    }
  }
  EXPECT_EQ(result.health.queues[0].wait.count, 3);
}

TEST_P(PipelineLifecycle, HintIsNullWhereTheFrameFailed) {
  ScriptedSource source(false, frames_then_end(7));
  world_.before_preprocess = [](const FramePtr& f) { f->number == 1 ? throw std::runtime_error("bad") : void(); };
  world_.before_track = [](const FramePtr& f) -> Result<void> {
    return f->number == 3 ? Result<void>(fail("bad")) : Result<void>();
  };
  const RunResult result = world_.run(source);
  EXPECT_THAT(world_.feedback, ElementsAre(-1, -1, 0, -1, 2, -1, 4));
  EXPECT_THAT(world_.sink.numbers, ElementsAre(0, 2, 4, 5, 6));
  EXPECT_EQ(result.health.failed, 2);
  expect_balanced(result.health);
}

TEST_P(PipelineLifecycle, StopDrainsWhatIsInFlightAndFlushes) {
  // Stop after some frames.
  ScriptedSource endless(false, frames_then_end(1 << 30));
  world_.sink.on_frame = [&](const TrackedFrame& tracked) -> Result<void> {
    if (tracked.frame->number == 5) world_.pipeline->request_stop();
    return {};
  };

  // All frames that were taken have been delivered.
  const RunResult result = world_.run(endless);
  EXPECT_TRUE(result.stopped);
  EXPECT_FALSE(result.error);
  EXPECT_EQ(world_.sink.finished, 1);
  ASSERT_GE(world_.sink.numbers.size(), 6u);
  for (int i = 0; i < static_cast<int>(world_.sink.numbers.size()); ++i) EXPECT_EQ(world_.sink.numbers[i], i);
  EXPECT_EQ(result.health.captured, result.health.published);
  expect_balanced(result.health);
}

TEST_P(PipelineLifecycle, StopTokenStopsBeforeTheFirstFrame) {
  std::stop_source stop;
  stop.request_stop();
  world_.options.stop = stop.get_token();
  ScriptedSource endless(false, frames_then_end(1 << 30));
  const RunResult result = world_.run(endless);
  EXPECT_TRUE(result.stopped);
  EXPECT_EQ(result.health.captured, 0);
  EXPECT_EQ(world_.sink.finished, 1);
}

TEST_P(PipelineLifecycle, ThrowingStageCostsItsFrameOnly) {
  // Two frames on which the stage throws.
  ScriptedSource source(false, frames_then_end(9));
  world_.before_track = [](const FramePtr& f) -> Result<void> {
    if (f->number == 4) throw std::runtime_error("four");
    if (f->number == 5) throw 5;
    return {};
  };

  // Only these two frames are missing.
  const RunResult result = world_.run(source);
  EXPECT_FALSE(result.error);
  EXPECT_TRUE(result.incomplete.empty());
  EXPECT_THAT(world_.sink.numbers, ElementsAre(0, 1, 2, 3, 6, 7, 8));
  EXPECT_EQ(result.health.stages[1].failed, 2);
  EXPECT_EQ(result.health.failed, 2);
  expect_balanced(result.health);
}

TEST_P(PipelineLifecycle, ManyFailuresInARowEndTheRunAndKeepWhatIsWritten) {
  ScriptedSource endless(false, frames_then_end(1 << 30));
  world_.options.max_failures_in_a_row = 5;
  world_.before_track = [](const FramePtr& f) -> Result<void> {
    return f->number >= 3 ? Result<void>(fail("no memory")) : Result<void>();
  };
  const RunResult result = world_.run(endless);
  ASSERT_TRUE(result.error);
  EXPECT_THAT(result.error->message(), HasSubstr("track failed on 5 frames in a row"));
  EXPECT_THAT(result.error->message(), HasSubstr("no memory"));
  EXPECT_THAT(world_.sink.numbers, ElementsAre(0, 1, 2));
  EXPECT_EQ(world_.sink.finished, 1);
  expect_balanced(result.health);
}

TEST_P(PipelineLifecycle, FailuresWithASuccessBetweenGoOn) {
  ScriptedSource source(false, frames_then_end(20));
  world_.options.max_failures_in_a_row = 2;
  world_.before_track = [](const FramePtr& f) -> Result<void> {
    return f->number % 2 ? Result<void>(fail("odd")) : Result<void>();
  };
  const RunResult result = world_.run(source);
  EXPECT_FALSE(result.error);
  EXPECT_EQ(result.health.failed, 10);
}

TEST_P(PipelineLifecycle, FailingSinkCountsTheFrameAndEndsARunThatCannotWrite) {
  // A sink that cannot write from frame 4 on.
  ScriptedSource endless(false, frames_then_end(1 << 30));
  world_.options.max_failures_in_a_row = 3;
  world_.sink.on_frame = [](const TrackedFrame& tracked) -> Result<void> {
    return tracked.frame->number >= 4 ? Result<void>(fail("disk full")) : Result<void>();
  };

  // The run ends with the sink's error.
  const RunResult result = world_.run(endless);
  ASSERT_TRUE(result.error);
  EXPECT_THAT(result.error->message(), HasSubstr("disk full"));
  EXPECT_THAT(result.incomplete, ElementsAre("recorder"));
  EXPECT_EQ(result.health.published, 4);
  EXPECT_GE(result.health.failed, 3);
  EXPECT_EQ(world_.sink.finished, 1);
  expect_balanced(result.health);
}

TEST_P(PipelineLifecycle, FailingSinkOfALiveRunIsWaitedFor) {
  std::atomic<int> consumed = 0;
  int delivered = 0;

  // The next frame comes when the last one was consumed, so that none is dropped at the input queue.
  ScriptedSource source(true, [&](int) -> SourceEvent {
    if (delivered > consumed) return Timeout{};
    if (delivered == 10) return EndOfStream{};
    return frame(delivered++);
  });

  // The sink fails more often than a replay would allow.
  world_.options.max_failures_in_a_row = 3;
  world_.sink.on_frame = [&](const TrackedFrame&) -> Result<void> {
    if (++consumed <= 8) return fail("network down");
    return {};
  };

  // The run goes on until the sink works again.
  const RunResult result = world_.run(source);
  EXPECT_FALSE(result.error);
  EXPECT_EQ(result.health.failed, 8);
  EXPECT_EQ(result.health.published, 2);
  EXPECT_THAT(result.incomplete, ElementsAre("recorder"));
}

TEST_P(PipelineLifecycle, PulseTellsWhatMovesAndWhatIsInside) {
  // Get the counts of progress (the heartbeat) while the last frame is in the sink.
  ScriptedSource source(false, frames_then_end(5));
  PipelineHeartbeat inside;
  world_.sink.on_frame = [&](const TrackedFrame& tracked) -> Result<void> {
    if (tracked.frame->number == 4) inside = world_.pipeline->heartbeat();
    return {};
  };
  world_.run(source);

  // Check the counts at that moment and at the end.
  EXPECT_EQ(inside.finished, 4);
  EXPECT_EQ(inside.inside, 1) << "the one that the sink holds";
  EXPECT_GE(inside.answers, 5);
  const PipelineHeartbeat after = world_.pipeline->heartbeat();
  EXPECT_EQ(after.answers, 6) << "five frames and the end";
  EXPECT_EQ(after.finished, 5);
  EXPECT_EQ(after.inside, 0);
}

TEST_P(PipelineLifecycle, SinkThatCannotFinishIsAnError) {
  ScriptedSource source(false, frames_then_end(2));
  world_.sink.finish_result = fail("cannot flush");
  const RunResult result = world_.run(source);
  ASSERT_TRUE(result.error);
  EXPECT_EQ(result.error->what, "cannot flush");
}

TEST_P(PipelineLifecycle, EverySinkThatCannotFinishIsNamed) {
  ScriptedSource source(false, frames_then_end(2));
  RecordingSink other;
  world_.sinks.push_back(&other);
  world_.sink.finish_result = fail("cannot flush", "a.csv", "it is in a.csv.unfinished");
  other.finish_result = fail("cannot rename", "b.csv");
  const RunResult result = world_.run(source);
  ASSERT_TRUE(result.error);
  EXPECT_EQ(result.error->message(), "a.csv: cannot flush (it is in a.csv.unfinished); b.csv: cannot rename");
}

TEST_P(PipelineLifecycle, UnreadableFramesAreSkippedAndCounted) {
  ScriptedSource source(false, [](int n) -> SourceEvent {
    if (n == 2 || n == 3) return SkippedFrame{{"corrupt PNG", "", ""}};
    return n < 6 ? SourceEvent(frame(n)) : EndOfStream{};
  });
  const RunResult result = world_.run(source);
  EXPECT_FALSE(result.error);
  EXPECT_THAT(world_.sink.numbers, ElementsAre(0, 1, 4, 5));
  EXPECT_EQ(result.health.skipped, 2);
  EXPECT_EQ(result.health.captured, 4);
  expect_balanced(result.health);
}

TEST_P(PipelineLifecycle, NoticesOfTheSourceCostNothing) {
  ScriptedSource source(false, [](int n) -> SourceEvent {
    if (n == 2 || n == 3) return SourceNotice{{"the sensor was unplugged", "", ""}, n == 2};
    return n < 6 ? SourceEvent(frame(n)) : EndOfStream{};
  });
  const RunResult result = world_.run(source);
  EXPECT_FALSE(result.error);
  EXPECT_THAT(world_.sink.numbers, ElementsAre(0, 1, 4, 5));
  EXPECT_EQ(result.health.skipped, 0);
  EXPECT_EQ(result.health.captured, 4);
}

TEST_P(PipelineLifecycle, SinksHearThatNoFramesCome) {
  World world(GetParam());
  world.options.patience = std::chrono::milliseconds(5);
  ScriptedSource source(true, [&](int n) -> SourceEvent {
    if (n == 0) return frame(0);
    return world.sink.idle_calls < 3 ? SourceEvent(Timeout{}) : EndOfStream{};
  });
  const RunResult result = world.run(source);  // ends only if the sink's idle() is called
  EXPECT_EQ(result.health.published, 1);
  EXPECT_GE(world.sink.idle_calls, 3);
}

TEST_P(PipelineLifecycle, SourceThatFailsOrThrowsEndsTheRunWithItsError) {
  for (const bool throws : {false, true}) {
    World world(GetParam());
    ScriptedSource source(false, [&](int n) -> SourceEvent {
      if (n < 3) return frame(n);
      if (throws) throw std::runtime_error("unplugged");
      return SourceFailed{{"unplugged", "usb", ""}};
    });

    // The frames before it are delivered, and the error is reported.
    const RunResult result = world.run(source);
    ASSERT_TRUE(result.error);
    EXPECT_THAT(result.error->message(), HasSubstr("unplugged"));
    EXPECT_THAT(world.sink.numbers, ElementsAre(0, 1, 2));
    EXPECT_EQ(world.sink.finished, 1);
    expect_balanced(result.health);
  }
}

TEST_P(PipelineLifecycle, LiveLatencyIsFromCaptureAndReplayLatencyFromArrival) {
  for (const bool live : {true, false}) {
    World world(GetParam());
    world.clock.advance(5'000'000);

    // One frame, captured 20 ms before it arrives; preprocessing takes 3 ms.
    ScriptedSource source(live, [&](int n) -> SourceEvent {
      auto made = std::make_shared<RgbdFrame>();
      made->utime = 4'980'000;
      return n == 0 ? SourceEvent(FramePtr(made)) : EndOfStream{};
    });
    world.before_preprocess = [&](const FramePtr&) { world.clock.advance(3'000); };

    // Only a live run counts from the capture.
    const RunResult result = world.run(source);
    EXPECT_DOUBLE_EQ(result.health.latency.max, live ? 0.023 : 0.003);
    EXPECT_DOUBLE_EQ(result.health.stages[0].time.max, 0.003);
  }
}

TEST_P(PipelineLifecycle, IntervalHealthStartsAfresh) {
  ScriptedSource source(false, frames_then_end(3));
  world_.run(source);
  EXPECT_EQ(world_.pipeline->take_interval_health().stages[1].time.count, 3);
  const PipelineHealth second = world_.pipeline->take_interval_health();
  EXPECT_EQ(second.stages[1].time.count, 0);
  EXPECT_EQ(second.latency.count, 0);
  EXPECT_EQ(second.published, 3);
}

TEST(PipelineRunners, ThreadedAndInlineGiveIdenticalResults) {
  World threaded(true), single(false);
  for (World* world : {&threaded, &single}) {
    ScriptedSource source(false, frames_then_end(200));
    world->before_track = [](const FramePtr& f) -> Result<void> {
      return f->number % 17 == 3 ? Result<void>(fail("bad")) : Result<void>();
    };
    world->run(source);
  }
  EXPECT_EQ(threaded.feedback, single.feedback);
  EXPECT_EQ(threaded.sink.numbers, single.sink.numbers);
  EXPECT_EQ(threaded.sink.scores, single.sink.scores);  // exactly equal
}

TEST(PipelineRunners, SlowConsumerHoldsUpAReplayAndLosesNothing) {
  World world(true);
  world.options.replay_capacity = 1;

  // Frames in flight: one in every stage and queue, and one that the source cannot push.
  constexpr int kInFlight = 7;
  std::latch full(kInFlight);
  std::atomic<int> calls = 0;

  // The first frame leaves the sink when all places are full.
  ScriptedSource source(false, [&](int n) -> SourceEvent {
    ++calls;
    if (n < kInFlight) full.count_down();
    return frames_then_end(30)(n);
  });
  world.sink.on_frame = [&](const TrackedFrame& tracked) -> Result<void> {
    if (tracked.frame->number == 0) {
      full.wait();
      EXPECT_EQ(calls, kInFlight);
    }
    return {};
  };

  // No frame is lost.
  const RunResult result = world.run(source);
  EXPECT_EQ(result.health.published, 30);
  EXPECT_EQ(result.health.dropped, 0);
  expect_balanced(result.health);
}

TEST(PipelineRunners, LiveFramesAreDroppedAtTheDoorAndTheNewestWinsThreaded) {
  World world(true);

  // All frames arrive while the first one is tracked.
  std::latch all_sent(1);
  ScriptedSource source(true, [&](int n) -> SourceEvent {
    if (n < 20) return frame(n);
    if (n == 20) all_sent.count_down();
    return EndOfStream{};
  });
  world.before_track = [&](const FramePtr&) -> Result<void> {
    all_sent.wait();  // slower than the sensor
    return {};
  };

  // Frames were dropped at the input queue only, and the newest one was kept.
  const RunResult result = world.run(source);
  EXPECT_GE(result.health.dropped, 17);  // at most one is tracked, one waits for the tracker and one at the input queue
  EXPECT_EQ(result.health.queues[0].dropped, result.health.dropped);
  EXPECT_EQ(result.health.queues[1].dropped + result.health.queues[2].dropped, 0);
  EXPECT_EQ(world.sink.numbers.back(), 19);
  EXPECT_EQ(result.health.captured, 20);
  expect_balanced(result.health);
}

TEST(PipelineRunners, HealthNamesTheQueuesOfTheSourceFirst) {
  World world(false);
  ScriptedSource source(true, frames_then_end(1));
  source.before = {{"transit", 0, 0, 8, 1, 7, {}}};
  const PipelineHealth health = world.run(source).health;
  ASSERT_EQ(health.queues.size(), 4u);
  EXPECT_EQ(health.queues[0].name, "transit");
  EXPECT_EQ(health.queues[1].name, "input");
  EXPECT_EQ(health.captured, 1);
  EXPECT_EQ(health.dropped, 0) << "what was lost before it came counts apart";
}

TEST(PipelineRunners, LiveFramesAreDroppedAtTheDoorAndTheNewestWinsInline) {
  World world(false);
  ScriptedSource source(true, [](int n) -> SourceEvent {
    if (n == 1 || n == 6) return Timeout{};
    return n < 9 ? SourceEvent(frame(n)) : EndOfStream{};
  });
  const RunResult result = world.run(source);
  EXPECT_THAT(world.sink.numbers, ElementsAre(0, 5, 8));
  EXPECT_EQ(result.health.dropped, 4);
  expect_balanced(result.health);
}

TEST(PipelineRunners, InlineTracksALiveSourceThatNeverPauses) {
  World world(false);
  ScriptedSource source(true, frames_then_end(1 << 30));
  world.sink.on_frame = [&](const TrackedFrame&) -> Result<void> {
    world.pipeline->request_stop();
    return {};
  };
  EXPECT_TRUE(world.run(source).stopped);
  EXPECT_EQ(world.sink.numbers.size(), 1u);
}

}  // namespace
}  // namespace barehand
