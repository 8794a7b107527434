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

/// What the shader compares in one dispatch, besides the contents of the buffers. Sizes are counts.
struct ShaderJob {
  std::array<GLint, 2 * kSegmentCount> points{};  ///< a segment's first skin point and their number
  int skin_points = 0, cells = 0;
  std::array<float, 4> camera{};           ///< fx, fy, cx, cy of the map [pixel]
  std::array<int, 2> map_size{};           ///< columns, rows
  int first_segment = 0, per_segment = 0;  ///< segments that are looked at; samples of each
  bool new_skin = true, new_map = true;    ///< to be sent

  int samples() const { return kSegmentCount * per_segment; }
};

/// The comparison as the graphics driver sees it: a context, a program and buffers. All functions are for one thread,
/// from open() to the destruction; only job() and the memory of the buffers are for the thread that orders the work,
/// while none is done.
class DeviceComparison {
 public:
  /// Finds EGL's functions.
  using Loader = std::function<Result<Egl>()>;

  /// `cap` [m] as in patch_distance; `fence_limit`: how long the device may take for one dispatch.
  DeviceComparison(float cap, DeviceChoice choice, Loader load, std::chrono::nanoseconds fence_limit)
      : cap_(cap), choice_(choice), load_(std::move(load)), fence_limit_(fence_limit) {}

  /// Error: no such device, or too old (less than OpenGL ES 3.1, five storage buffers).
  Result<void> open();
  /// Makes room for the job.
  Result<void> reserve();
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
