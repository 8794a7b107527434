#pragma once

#include <functional>
#include <memory>
#include <string>

#include "app/sink.h"
#include "core/clock.h"
#include "core/slot.h"
#include "core/statistics.h"
#include "io/lcm_bus.h"
#include "io/lcm_log_writer.h"
#include "stages/publish/publisher.h"

namespace barehand {

/// Sends the states of every frame, and the health now and then, to the bus.
class BusSink : public Sink {
 public:
  struct Health {
    std::function<PipelineHealth()> take;  ///< since the last call
    std::int64_t period_us = 1'000'000;
    std::string source;
  };
  /// `bus`, `clock` and `news` (may be null; looked at before every frame) outlive the sink. Errors: a channel prefix
  /// that is too long.
  static Result<std::unique_ptr<Sink>> create(const PublishParams& params, const std::string& prefix, LcmBus& bus,
                                              Health health, const Clock& clock, Slot<PublishParams>* news = nullptr);
  std::string name() const override { return "publish"; }
  Result<void> consume(const TrackedFrame& tracked) override;
  /// The health goes on without frames: silence means that the program is gone.
  Result<void> idle() override { return send_health_when_due(); }

 private:
  BusSink(const PublishParams& params, Publisher publisher, Health health, const Clock& clock,
          Slot<PublishParams>* news);
  Result<void> send_health_when_due();

  HandMessageMaker maker_;
  Publisher publisher_;
  Health health_;
  const Clock& clock_;
  Slot<PublishParams>* const news_;
  std::int64_t next_health_us_;
};

/// --states-log: the states alone, so that equal runs write equal bytes.
class StatesLogSink : public Sink {
 public:
  /// An existing file is replaced. `news` as above.
  static Result<std::unique_ptr<Sink>> create(const PublishParams& params, const std::string& prefix,
                                              const std::string& path, Slot<PublishParams>* news = nullptr);
  std::string name() const override { return "states log"; }
  Result<void> consume(const TrackedFrame& tracked) override;

 private:
  StatesLogSink(const PublishParams& params, std::unique_ptr<LcmLogWriter> log, Publisher publisher,
                Slot<PublishParams>* news);

  HandMessageMaker maker_;
  std::unique_ptr<LcmLogWriter> log_;
  Publisher publisher_;
  Slot<PublishParams>* const news_;
};

}  // namespace barehand
