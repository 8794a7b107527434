// Compares batches of samples with depth data by a compute shader.
#include "observe/egl/device_comparison.h"

#include <algorithm>
#include <limits>

#include "core/format.h"
#include "observe/egl/compute_program.h"
#include "observe/sampled/pixel_map.h"

namespace barehand {
namespace {

// Invocations in a work group. A GPU runs a group of this size as one warp. A software renderer runs it in one vector
// register; for larger groups it would have to switch between threads.
constexpr int kHardwareLanes = 32, kSoftwareLanes = 8;

/// Number of bytes that a job needs in each buffer.
struct JobBytes {
  std::size_t skin, cells, hidden, poses, results;

  explicit JobBytes(const ShaderJob& job)
      : skin(job.skin_points * kFloatsPerPoint * sizeof(float)),
        cells(job.cells * sizeof(PixelMap::Cell)),
        hidden(job.cells * sizeof(std::int32_t)),
        poses(job.samples() * kFloatsPerPose * sizeof(float)),
        results(job.samples() * kFloatsPerResult * sizeof(float)) {}
};

}  // namespace

Result<void> DeviceComparison::open() {
  const auto egl = load_();
  if (!egl) return tl::unexpected(egl.error());
  auto context = HeadlessContext::open(*egl, choice_);
  if (!context) return tl::unexpected(context.error());
  context_ = std::move(*context);
  const Gl& gl = context_->gl();

  // Check that the shader may use five storage buffers, since OpenGL ES 3.1 guarantees only four.
  GLint storage_buffers = 0;
  gl.GetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &storage_buffers);
  if (storage_buffers < kShaderBufferCount)
    return fail("compute shaders have only " + std::to_string(storage_buffers) + " storage buffers", "OpenGL ES");

  const int lanes = device().software ? kSoftwareLanes : kHardwareLanes;
  const auto program = make_compute_program(gl, compare_shader(lanes));
  if (!program) return tl::unexpected(program.error());
  gl.UseProgram(*program);
  gl.Uniform1f(kCapUniform, std::min(cap_, std::numeric_limits<float>::max()));  // GLSL need not support infinity
  return check_gl(gl, "setting up");
}

bool DeviceComparison::has_room() const {
  const JobBytes bytes(job_);
  return skin.holds(bytes.skin) && cells.holds(bytes.cells) && hidden.holds(bytes.hidden) && poses.holds(bytes.poses) &&
         results.holds(bytes.results);
}

Result<void> DeviceComparison::reserve() {
  const Gl& gl = context_->gl();
  const JobBytes bytes(job_);
  return skin.reserve(gl, bytes.skin)
      .and_then([&] { return cells.reserve(gl, bytes.cells); })
      .and_then([&] { return hidden.reserve(gl, bytes.hidden); })
      .and_then([&] { return poses.reserve(gl, bytes.poses); })
      .and_then([&] { return results.reserve(gl, bytes.results); });
}

void DeviceComparison::send() {
  const Gl& gl = context_->gl();
  const JobBytes bytes(job_);

  // Send the skin and the map only when they have changed.
  if (job_.new_skin) {
    skin.send(gl, bytes.skin);
    gl.Uniform2iv(kPointsUniform, kSegmentCount, job_.points.data());
  }

  // The map comes with the parameters of its camera.
  if (job_.new_map) {
    cells.send(gl, bytes.cells);
    hidden.send(gl, bytes.hidden);
    gl.Uniform4f(kCameraUniform, job_.camera[0], job_.camera[1], job_.camera[2], job_.camera[3]);
    gl.Uniform2i(kMapSizeUniform, job_.map_size[0], job_.map_size[1]);
  }

  // The poses are sent in every call.
  poses.send(gl, bytes.poses);
  gl.Uniform1i(kFirstSegmentUniform, job_.first_segment);
}

Result<void> DeviceComparison::compare() {
  const Gl& gl = context_->gl();
  send();
  gl.DispatchCompute(static_cast<GLuint>(job_.per_segment), static_cast<GLuint>(kSegmentCount - job_.first_segment), 1);
  results.order_after_shader(gl);
  const auto finished = wait_for_device();
  if (!finished) return finished;
  const auto received = results.receive(gl, JobBytes(job_).results);
  const auto checked = check_gl(gl, "comparing samples");
  return checked ? received : checked;
}

/// Waits for a fence with a time limit, so that a device that hangs does not block the driver forever: once the fence
/// is reached, the following calls do not have to wait.
Result<void> DeviceComparison::wait_for_device() {
  const Gl& gl = context_->gl();
  const GLsync fence = gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  const GLenum state = gl.ClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, fence_limit_.count());
  gl.DeleteSync(fence);
  if (state == GL_TIMEOUT_EXPIRED)
    return fail(
        formatted("the device has not finished within %.1f s", 1e-9 * static_cast<double>(fence_limit_.count())),
        "OpenGL ES");
  const auto checked = check_gl(gl, "waiting for the device");
  return checked && state == GL_WAIT_FAILED ? fail("waiting for the device failed", "OpenGL ES") : checked;
}

}  // namespace barehand
