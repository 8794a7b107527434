#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "observe/egl/graphics_device.h"
#include "observe/sampled/observer.h"

namespace barehand {

// The observer that uses a graphics device through EGL and OpenGL ES.

struct Egl;

/// Time limits after which a driver is given up. Each is far longer than a working device needs, and their sum is below
/// the service's watchdog time.
struct DeviceLimits {
  std::chrono::milliseconds open{10'000};  ///< limit for loading a driver and compiling the shader
  std::chrono::milliseconds fence{2'000};  ///< limit for the device's work on one call of compare()
  std::chrono::milliseconds call{4'000};   ///< limit for the whole call, since a driver may never return
  std::chrono::milliseconds close{2'000};  ///< limit for destroying the context
};

/// Compares all sampled poses of one search level in one dispatch of a compute shader. The results are those of
/// CpuObserver, up to single-precision rounding. A skin is sent to the device once, a pixel map once per frame, poses
/// once per level; 12 bytes per sample come back. The paper (Sec. 4.1) renders the samples into one texture and
/// averages its pixels; here every skin point is weighted by the number of pixels that it covers, so that CPU and GPU
/// agree. A separate thread makes all calls of the driver. compare() waits for it, because the tracker needs the
/// distances before it can draw the next level's samples. After an error the device is not used again.
class EglObserver final : public DeviceObserver {
 public:
  /// `cap`: upper limit of a single pixel's distance [m]; infinity: none. Fails if there is no such device, or if it
  /// lacks OpenGL ES 3.1 or has fewer than five storage buffers.
  static Result<std::unique_ptr<EglObserver>> open(float cap, DeviceChoice choice,
                                                   const std::string& egl_library = kEglLibrary);
  /// Opens a device with the given loader of EGL's functions and the given time limits.
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
  std::optional<Error> lost_;                   // why the device is not used any more; none while it works
  std::shared_ptr<const HandSurface> surface_;  // the skin that is on the device
  std::optional<std::uint64_t> map_id_;         // id of the map that is on the device
};

}  // namespace barehand
