#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/clock.h"
#include "core/statistics.h"
#include "io/lcm/lcm_bus.h"
#include "io/lcm/lcm_log_writer.h"
#include "pipeline/sink.h"
#include "pipeline/sinks/hand_message_makers.h"
#include "stages/publish/publisher.h"

namespace barehand {

/// Sends the states of all hands, one after the other, on the same channels, and those of the objects. Receivers
/// distinguish the hands by id.
class StatePublisher {
 public:
  /// `pending`: changed parameters, taken before every frame; may be null; must outlive this object.
  StatePublisher(const PublishParams& params, Publisher publisher, Slot<PublishParams>* pending)
      : makers_(params, pending), publisher_(std::move(publisher)) {}
  Result<void> send(const TrackedFrame& tracked);
  /// The hands alone, before it is known what they touch and how they grasp.
  Result<void> send_hands(const TrackedFrame& tracked);
  /// Contacts, grasps and objects of the frame whose hands were sent last.
  Result<void> send_findings(const TrackedFrame& tracked);
  Result<void> send(const health_t& health) { return publisher_.send(health); }

 private:
  HandMessageMakers makers_;
  Publisher publisher_;
};

/// Sends the hands of every frame to the bus as soon as they are tracked, and the pipeline's health once per period.
class BusSink : public Sink {
 public:
  struct Health {
    std::function<PipelineHealth()> take;  ///< returns the health since its last call
    std::int64_t period_us = 1'000'000;
    std::string source;
  };
  /// `bus`, `clock` and `pending` (changed parameters, taken before every frame; may be null) must outlive the sink.
  /// Errors: a channel prefix that is too long.
  static Result<std::unique_ptr<BusSink>> create(const PublishParams& params, const std::string& prefix, LcmBus& bus,
                                                 Health health, const Clock& clock,
                                                 Slot<PublishParams>* pending = nullptr);
  std::string name() const override { return "publish"; }
  bool only_hands() const override { return true; }
  Result<void> consume(const TrackedFrame& tracked) override;
  /// Sends the health without frames, too, so that silence means that the program is not running.
  Result<void> idle() override { return send_health_when_due(); }
  /// What was found about the hands of the frame that was consumed last.
  Result<void> send_findings(const TrackedFrame& tracked) { return states_.send_findings(tracked); }

 private:
  BusSink(StatePublisher states, Health health, const Clock& clock);
  Result<void> send_health_when_due();

  StatePublisher states_;
  Health health_;
  const Clock& clock_;
  std::int64_t next_health_us_;
};

/// Sends to the bus what was found about the hands of every frame: contacts, grasps and objects.
class FindingsSink : public Sink {
 public:
  /// `hands` sends the hands of the same frames before; it must outlive the sink.
  explicit FindingsSink(BusSink& hands) : hands_(hands) {}
  std::string name() const override { return "publish findings"; }
  Result<void> consume(const TrackedFrame& tracked) override { return hands_.send_findings(tracked); }

 private:
  BusSink& hands_;
};

/// --states-log: writes the states to an LCM log, and no health, so that equal runs write equal bytes.
class StatesLogSink : public Sink {
 public:
  /// `pending` as for BusSink::create(). Errors: `path` cannot be written; a channel prefix that is too long.
  static Result<std::unique_ptr<Sink>> create(const PublishParams& params, const std::string& prefix,
                                              const std::string& path, bool overwrite,
                                              Slot<PublishParams>* pending = nullptr);
  std::string name() const override { return "states log"; }
  Result<void> consume(const TrackedFrame& tracked) override { return states_.send(tracked); }
  /// Writes no log if there was no state.
  Result<void> finish() override { return log_->events() > 0 ? log_->finish() : Result<void>(); }

 private:
  StatesLogSink(std::unique_ptr<LcmLogWriter> log, StatePublisher states)
      : log_(std::move(log)), states_(std::move(states)) {}

  std::unique_ptr<LcmLogWriter> log_;
  StatePublisher states_;
};

}  // namespace barehand
