#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <utility>

#include "hand/segments.h"
#include "observe/egl/headless_context.h"
#include "observe/egl/shader_buffers.h"

namespace barehand {

// The part of the comparison of samples that runs on a graphics device.

/// What the shader compares in one dispatch, besides the contents of the buffers. Sizes are counts.
struct ShaderJob {
  /// For each segment, the index of its first skin point and the number of its points.
  std::array<GLint, 2 * kSegmentCount> points{};
  int skin_points = 0, cells = 0;
  std::array<float, 4> camera{};           ///< fx, fy, cx, cy of the map [pixel]
  std::array<int, 2> map_size{};           ///< columns and rows of the map
  int first_segment = 0, per_segment = 0;  ///< first segment that is compared, and number of samples per segment
  bool new_skin = true, new_map = true;    ///< whether skin and map must be sent

  int samples() const { return kSegmentCount * per_segment; }
};

/// The part of the comparison that calls the graphics driver: a context, a program and buffers. All functions must be
/// called on one thread, from open() to the destructor. Only job() and the buffers' memory may be used by another
/// thread, the one that requests comparisons, and only while none is in progress.
class DeviceComparison {
 public:
  /// Finds EGL's functions.
  using Loader = std::function<Result<Egl>()>;

  /// `cap`: upper limit of a single pixel's distance [m]; infinity: none. `fence_limit`: how long the device may take
  /// for one dispatch.
  DeviceComparison(float cap, DeviceChoice choice, Loader load, std::chrono::nanoseconds fence_limit)
      : cap_(cap), choice_(choice), load_(std::move(load)), fence_limit_(fence_limit) {}

  /// Fails if there is no such device, or if it lacks OpenGL ES 3.1 or has fewer than five storage buffers.
  Result<void> open();
  /// Enlarges every buffer that is too small for the job.
  Result<void> reserve();
  /// Whether all buffers are large enough for the job.
  bool has_room() const;
  /// Sends what is new, compares, and waits for the distances.
  Result<void> compare();

  const GraphicsDevice& device() const { return context_->device(); }
  ShaderJob& job() { return job_; }

  UploadBuffer skin{kSkinBuffer}, cells{kCellBuffer}, hidden{kHiddenBuffer}, poses{kPoseBuffer};
  ReadBackBuffer results{kResultBuffer};

 private:
  void send();
  Result<void> wait_for_device();

  float cap_;
  DeviceChoice choice_;
  Loader load_;
  std::chrono::nanoseconds fence_limit_;
  std::unique_ptr<HeadlessContext> context_;
  ShaderJob job_;
};

}  // namespace barehand
