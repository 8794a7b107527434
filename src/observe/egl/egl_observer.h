#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "observe/egl/graphics_device.h"
#include "observe/sampled/observer.h"

namespace barehand {

struct Egl;

/// How long a driver may take before it is given up. Each is far beyond what a device that works needs, and all of them
/// together stay below the service's watchdog.
struct DeviceLimits {
  std::chrono::milliseconds open{10'000};  ///< loading a driver and compiling the shader
  std::chrono::milliseconds fence{2'000};  ///< the device's work on one call
  std::chrono::milliseconds call{4'000};   ///< the whole call, for drivers that do not return
  std::chrono::milliseconds close{2'000};  ///< taking the context down
};

/// Compares all samples of a level in one dispatch of a compute shader: what CpuObserver does, up to single precision.
/// A skin goes to the device once, a map once per frame, poses once per level; 12 bytes per sample come back. The
/// paper (Sec. 4.1) renders the samples into one texture and averages its pixels; here every skin point brings the
/// number of pixels it covers as its weight, so that CPU and GPU agree.
/// One thread of its own makes all calls of the driver; a level's work is handed to it and waited for, as the tracker
/// needs the distances before it can draw the next level's samples. After an error it is not used again.
class EglObserver final : public DeviceObserver {
 public:
  /// `cap` [m] as in patch_distance. Error: no such device, or too old (less than OpenGL ES 3.1, five storage buffers).
  static Result<std::unique_ptr<EglObserver>> open(float cap, DeviceChoice choice,
                                                   const std::string& egl_library = kEglLibrary);
  /// The same with EGL's functions from elsewhere.
  static Result<std::unique_ptr<EglObserver>> open(float cap, DeviceChoice choice,
                                                   std::function<Result<Egl>()> load_functions,
                                                   const DeviceLimits& limits);
  ~EglObserver() override;

  Result<void> compare(const SampleBatch& batch, PatchDistances& distances) override;
  const GraphicsDevice& device() const { return device_; }

 private:
  struct Thread;
  EglObserver(std::unique_ptr<Thread> thread, const DeviceLimits& limits);
  Result<void> compare_on_device(const SampleBatch& batch, PatchDistances& distances);

  std::unique_ptr<Thread> thread_;
  DeviceLimits limits_;
  GraphicsDevice device_;
  std::optional<Error> lost_;                   // why it is not used any more
  std::shared_ptr<const HandSurface> surface_;  // on the device
  std::optional<std::uint64_t> map_id_;         // of the map there
};

}  // namespace barehand
