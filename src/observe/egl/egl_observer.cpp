#include "observe/egl/egl_observer.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "observe/egl/compare_shader.h"
#include "observe/egl/compute_program.h"
#include "observe/egl/headless_context.h"

namespace barehand {
namespace {

// A GPU runs a group as one warp; in software a group is one vector register, and more would be threads to switch.
constexpr int kHardwareLanes = 32, kSoftwareLanes = 8;
constexpr int kFloatsPerPose = 12, kFloatsPerResult = 3;

template <class T>
GLsizeiptr bytes(const std::vector<T>& values) {
  return static_cast<GLsizeiptr>(values.size() * sizeof(T));
}

void append_pose(const SE3& T, std::vector<float>& rows) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rows.push_back(static_cast<float>(T.R(i, j)));
    rows.push_back(static_cast<float>(T.t[i]));
  }
}

}  // namespace

struct EglObserver::State {
  std::unique_ptr<HeadlessContext> context;
  const Gl& gl;
  std::array<GLuint, kShaderBufferCount> buffers{};  // with the program, they go when the context does
  std::shared_ptr<const HandSurface> surface;        // on the device
  std::optional<std::uint64_t> map_id;               // of the map there
  std::vector<float> pose_rows;                      // kept for its memory

  explicit State(std::unique_ptr<HeadlessContext> c) : context(std::move(c)), gl(context->gl()) {}

  void fill(ShaderBuffer buffer, GLsizeiptr size, const void* data, GLenum usage) {
    gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, buffers[buffer]);
    gl.BufferData(GL_SHADER_STORAGE_BUFFER, size, data, usage);
  }
  Result<void> set_up(float cap);
  void upload_skin(const HandSurface& surface);
  void upload_map(const PixelMap& map);
  void upload_poses(const SampleBatch& batch);
  Result<void> read_results(int first_segment, PatchDistances& distances);
};

Result<void> EglObserver::State::set_up(float cap) {
  GLint storage_buffers = 0;
  gl.GetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &storage_buffers);
  if (storage_buffers < kShaderBufferCount)
    return fail("compute shaders have only " + std::to_string(storage_buffers) + " storage buffers", "OpenGL ES");
  const int lanes = context->device().software ? kSoftwareLanes : kHardwareLanes;
  const auto program = make_compute_program(gl, compare_shader(lanes));
  if (!program) return tl::unexpected(program.error());
  gl.UseProgram(*program);
  gl.GenBuffers(kShaderBufferCount, buffers.data());
  for (GLuint i = 0; i < kShaderBufferCount; ++i) gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffers[i]);
  gl.Uniform1f(kCapUniform, std::min(cap, std::numeric_limits<float>::max()));  // GLSL need not know infinity
  return check_gl(gl, "setting up");
}

void EglObserver::State::upload_skin(const HandSurface& surface) {
  std::vector<float> points;
  std::array<GLint, 2 * kSegmentCount> ranges{};
  for (int s = 0; s < kSegmentCount; ++s) {
    const SegmentSurface& skin = surface[s];
    ranges[2 * s] = static_cast<GLint>(points.size() / 8);
    ranges[2 * s + 1] = static_cast<GLint>(skin.size());
    for (std::size_t i = 0; i < skin.size(); ++i)
      points.insert(points.end(),
                    {skin.x[i], skin.y[i], skin.z[i], skin.area[i], skin.nx[i], skin.ny[i], skin.nz[i], 0.0f});
  }
  fill(kSkinBuffer, bytes(points), points.data(), GL_STATIC_DRAW);
  gl.Uniform2iv(kPointsUniform, kSegmentCount, ranges.data());
}

void EglObserver::State::upload_map(const PixelMap& map) {
  static_assert(sizeof(PixelMap::Cell) == 4 * sizeof(float), "the shader reads a cell as one vec4");
  fill(kCellBuffer, bytes(map.cells), map.cells.data(), GL_DYNAMIC_DRAW);
  fill(kHiddenBuffer, bytes(map.hidden), map.hidden.data(), GL_DYNAMIC_DRAW);
  gl.Uniform4f(kCameraUniform, map.fx, map.fy, map.cx, map.cy);
  gl.Uniform2i(kMapSizeUniform, map.width, map.height);
}

void EglObserver::State::upload_poses(const SampleBatch& batch) {
  pose_rows.clear();
  for (const std::vector<SE3>& of_segment : batch.poses)
    for (const SE3& pose : of_segment) append_pose(pose, pose_rows);
  fill(kPoseBuffer, bytes(pose_rows), pose_rows.data(), GL_STREAM_DRAW);
}

Result<void> EglObserver::State::read_results(int first_segment, PatchDistances& distances) {
  const std::size_t count = distances[0].size();
  const auto size = static_cast<GLsizeiptr>(kSegmentCount * count * kFloatsPerResult * sizeof(float));
  gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, buffers[kResultBuffer]);
  const auto* results =
      static_cast<const float*>(gl.MapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, size, GL_MAP_READ_BIT));
  if (!results) {
    const auto reason = check_gl(gl, "reading the distances");
    return reason ? fail("the distances cannot be read", "OpenGL ES") : reason;
  }
  for (int s = first_segment; s < kSegmentCount; ++s)
    for (std::size_t i = 0; i < count; ++i) {
      const float* r = results + kFloatsPerResult * (s * count + i);
      distances[s][i] = {r[0], r[1], r[2]};
    }
  const bool intact = gl.UnmapBuffer(GL_SHADER_STORAGE_BUFFER);
  const auto checked = check_gl(gl, "comparing samples");
  return checked && !intact ? fail("the distances were lost while being read", "OpenGL ES") : checked;
}

EglObserver::EglObserver(std::unique_ptr<HeadlessContext> context)
    : state_(std::make_unique<State>(std::move(context))) {}
EglObserver::~EglObserver() = default;

const GraphicsDevice& EglObserver::device() const { return state_->context->device(); }

Result<std::unique_ptr<EglObserver>> EglObserver::open(float cap, DeviceChoice choice, const std::string& egl_library) {
  auto context = HeadlessContext::open(choice, egl_library);
  if (!context) return tl::unexpected(context.error());
  std::unique_ptr<EglObserver> observer(new EglObserver(std::move(*context)));
  const auto current = observer->state_->context->make_current();
  if (!current) return tl::unexpected(current.error());
  const auto ready = observer->state_->set_up(cap);
  if (!ready) return tl::unexpected(ready.error());
  return observer;
}

Result<void> EglObserver::compare(const SampleBatch& batch, PatchDistances& distances) {
  const std::size_t count = batch.poses[0].size();
  for (auto& of_segment : distances) of_segment.assign(count, {});
  if (count == 0) return {};
  const auto current = state_->context->make_current();
  if (!current) return tl::unexpected(current.error());
  if (state_->surface != batch.surface) {
    state_->upload_skin(*batch.surface);
    state_->surface = batch.surface;
    state_->map_id.reset();
  }
  if (state_->map_id != batch.map_id) state_->upload_map(batch.map);
  state_->map_id = batch.map_id;
  state_->upload_poses(batch);
  const Gl& gl = state_->gl;
  gl.Uniform1i(kFirstSegmentUniform, batch.first_segment);
  state_->fill(kResultBuffer, static_cast<GLsizeiptr>(kSegmentCount * count * kFloatsPerResult * sizeof(float)),
               nullptr, GL_STREAM_READ);
  gl.DispatchCompute(static_cast<GLuint>(count), static_cast<GLuint>(kSegmentCount - batch.first_segment), 1);
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return state_->read_results(batch.first_segment, distances);
}

}  // namespace barehand
