#include "stages/segment_tracker/make_observer.h"

#include "observe/egl/egl_observer.h"
#include "observe/sampled/fallback_observer.h"
#include "observe/sampled/faster_observer.h"
#include "stages/segment_tracker/cpu_observer.h"

namespace barehand {

// Chooses who compares the sampled poses with the depth data: the CPU, a graphics device, or the faster of both.

std::unique_ptr<Observer> make_observer(const SegmentTrackerParams& params, Workers& workers,
                                        std::shared_ptr<spdlog::logger> log, std::shared_ptr<const Clock> clock) {
  const float cap = distance_cap(params);
  auto cpu = std::make_unique<CpuObserver>(cap, workers);
  if (params.observer == "cpu") return cpu;

  const bool by_name = params.observer == "egl";
  auto device = EglObserver::open(cap, by_name ? DeviceChoice::any : DeviceChoice::hardware);
  if (!device) {
    log->log(by_name ? spdlog::level::warn : spdlog::level::debug, "samples are compared on the CPU, not on a GPU: {}",
             device.error().message());
    return cpu;
  }

  const GraphicsDevice found = (*device)->device();
  if (!by_name)
    return std::make_unique<FasterObserver>(std::move(*device), found.renderer, std::move(cpu), std::move(log),
                                            std::move(clock));
  log->info("samples are compared on {}, {}{}", found.renderer, found.version, found.software ? " (software)" : "");
  return std::make_unique<FallbackObserver>(std::move(*device), std::move(cpu), std::move(log));
}

bool same_observer(const SegmentTrackerParams& a, const SegmentTrackerParams& b) {
  return a.observer == b.observer && distance_cap(a) == distance_cap(b);
}

}  // namespace barehand
