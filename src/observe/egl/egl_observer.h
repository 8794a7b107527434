#pragma once

#include <memory>
#include <string>

#include "observe/egl/graphics_device.h"
#include "observe/observer.h"

namespace barehand {

class HeadlessContext;

/// Compares all samples of a level in one dispatch of a compute shader: what CpuObserver does, up to single precision.
/// A skin goes to the device once, a map once per frame, poses once per level; 12 bytes per sample come back. The
/// paper (Sec. 4.1) renders the samples into one texture and averages its pixels; here every skin point brings the
/// number of pixels it covers as its weight, so that CPU and GPU agree.
/// Usable from any thread, one at a time; it holds no thread's context between calls.
class EglObserver final : public DeviceObserver {
 public:
  /// `cap` [m] as in patch_distance. Error: no such device, or too old (less than OpenGL ES 3.1, five storage buffers).
  static Result<std::unique_ptr<EglObserver>> open(float cap, DeviceChoice choice,
                                                   const std::string& egl_library = kEglLibrary);
  ~EglObserver() override;

  Result<void> compare(const SampleBatch& batch, PatchDistances& distances) override;
  const GraphicsDevice& device() const;

 private:
  explicit EglObserver(std::unique_ptr<HeadlessContext> context);
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace barehand
