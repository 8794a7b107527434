#pragma once

#include <functional>
#include <vector>

#include "pipeline/pipeline.h"
#include "pipeline/service_manager.h"
#include "pipeline/sink.h"

namespace barehand {

/// Feeds systemd's watchdog while the pipeline makes progress, and updates the service's status line. Progress means:
/// a frame has left the pipeline or, if none is inside, the source has returned from a call. A source, stage or sink
/// that hangs therefore ends the feeding, and systemd restarts the service.
class ServiceSink : public Sink {
 public:
  /// `statuses`: those of the hands, as they are published. `manager` and `clock` must outlive the sink.
  ServiceSink(ServiceManager& manager, std::function<PipelineHeartbeat()> heartbeat,
              std::function<PipelineHealth()> health, std::function<std::vector<TrackStatus>()> statuses,
              const Clock& clock);

  std::string name() const override { return "service"; }
  Result<void> consume(const TrackedFrame& tracked) override;
  Result<void> idle() override;

 private:
  void feed_watchdog();
  void update_status();

  ServiceManager& manager_;
  const std::function<PipelineHeartbeat()> heartbeat_;
  const std::function<PipelineHealth()> health_;
  const std::function<std::vector<TrackStatus>()> statuses_;
  const Clock& clock_;
  PipelineHeartbeat fed_at_;  // counters when the watchdog was fed last
  std::int64_t frame_us_,     // time of the last frame; steady clock
      status_us_,             // time of the last status line; steady clock
      status_published_ = 0;  // number of frames published when the last status line was sent
};

}  // namespace barehand
