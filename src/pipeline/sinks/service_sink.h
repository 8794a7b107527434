#pragma once

#include <functional>

#include "pipeline/pipeline.h"
#include "pipeline/service_manager.h"
#include "pipeline/sink.h"

namespace barehand {

/// Feeds systemd's watchdog while the pipeline works, and keeps the status line. Fed by progress alone: frames that
/// were inside have left, or there are none inside and the source answers that there are none. A source, a stage or a
/// sink that hangs starves it.
class ServiceSink : public Sink {
 public:
  /// `manager` and `clock` outlive the sink.
  ServiceSink(ServiceManager& manager, std::function<PipelinePulse()> pulse, std::function<PipelineHealth()> health,
              const Clock& clock);

  std::string name() const override { return "service"; }
  Result<void> consume(const TrackedFrame& tracked) override;
  Result<void> idle() override;

 private:
  void feed();
  void tell();

  ServiceManager& manager_;
  const std::function<PipelinePulse()> pulse_;
  const std::function<PipelineHealth()> health_;
  const Clock& clock_;
  PipelinePulse fed_at_;
  HandEstimates hands_;                                   // of the last frame
  std::int64_t frame_us_, told_us_, told_published_ = 0;  // of the last frame, of the last status line
};

}  // namespace barehand
