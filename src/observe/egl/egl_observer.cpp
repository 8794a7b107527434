#include "observe/egl/egl_observer.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <system_error>

#include "observe/egl/device_comparison.h"
#include "observe/egl/device_thread.h"

namespace barehand {
namespace {

// Copies sample batches to the device's buffers, has them compared, and reads the distances.

void write_skin(const HandSurface& surface, float* out) {
  for (const SegmentSurface& skin : surface)
    for (std::size_t i = 0; i < skin.size(); ++i, out += kFloatsPerPoint) {
      const std::array<float, kFloatsPerPoint> point{skin.x[i],  skin.y[i],  skin.z[i],  skin.area[i],
                                                     skin.nx[i], skin.ny[i], skin.nz[i], 0.0f};
      std::copy(point.begin(), point.end(), out);
    }
}

void write_poses(const SampleBatch& batch, float* out) {
  for (const std::vector<SE3>& of_segment : batch.poses)
    for (const SE3& T : of_segment)
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) *out++ = static_cast<float>(T.R(i, j));
        *out++ = static_cast<float>(T.t[i]);
      }
}

void read_distances(const float* results, int first_segment, PatchDistances& distances) {
  const std::size_t count = distances[0].size();
  for (int s = first_segment; s < kSegmentCount; ++s)
    for (std::size_t i = 0; i < count; ++i) {
      const float* r = results + kFloatsPerResult * (s * count + i);
      distances[s][i] = {r[0], r[1], r[2]};
    }
}

void describe_skin(const HandSurface& surface, ShaderJob& job) {
  job.skin_points = 0;
  for (int s = 0; s < kSegmentCount; ++s) {
    job.points[2 * s] = job.skin_points;
    job.points[2 * s + 1] = static_cast<int>(surface[s].size());
    job.skin_points += job.points[2 * s + 1];
  }
}

void describe_map(const PixelMap& map, ShaderJob& job) {
  job.cells = static_cast<int>(map.cells.size());
  job.camera = {map.fx, map.fy, map.cx, map.cy};
  job.map_size = {map.width, map.height};
}

}  // namespace

struct EglObserver::Thread : DeviceThread<DeviceComparison> {
  using DeviceThread::DeviceThread;
};

EglObserver::EglObserver(std::unique_ptr<Thread> thread, const DeviceLimits& limits)
    : thread_(std::move(thread)), limits_(limits) {}
EglObserver::~EglObserver() = default;

Result<std::unique_ptr<EglObserver>> EglObserver::open(float cap, DeviceChoice choice, const std::string& egl_library) {
  return open(
      cap, choice, [egl_library] { return load_egl(egl_library); }, DeviceLimits{});
}

Result<std::unique_ptr<EglObserver>> EglObserver::open(float cap, DeviceChoice choice,
                                                       std::function<Result<Egl>()> load_functions,
                                                       const DeviceLimits& limits) {
  // Start the thread on which the driver is called.
  auto comparison = std::make_unique<DeviceComparison>(cap, choice, std::move(load_functions), limits.fence);
  std::unique_ptr<Thread> thread;
  try {
    thread = std::make_unique<Thread>(std::move(comparison), limits.close);
  } catch (const std::system_error& e) {  // too many threads
    return fail(std::string("no thread for the driver: ") + e.what(), "EGL");
  }

  // Open the device on that thread, within the time limit.
  const auto opened = thread->run([](DeviceComparison& device) { return device.open(); }, limits.open);
  if (!opened) return tl::unexpected(opened.error());

  // Keep the thread, and the description of its device.
  std::unique_ptr<EglObserver> observer(new EglObserver(std::move(thread), limits));
  observer->device_ = observer->thread_->state()->device();
  return observer;
}

Result<void> EglObserver::compare(const SampleBatch& batch, PatchDistances& distances) {
  if (lost_) return tl::unexpected(*lost_);
  const auto done = compare_on_device(batch, distances);
  if (!done) lost_ = done.error();
  return done;
}

Result<void> EglObserver::compare_on_device(const SampleBatch& batch, PatchDistances& distances) {
  for (auto& of_segment : distances) of_segment.assign(batch.poses[0].size(), {});
  if (batch.poses[0].empty()) return {};
  DeviceComparison& device = *thread_->state();

  // Describe the job, and find out what the device does not have yet.
  ShaderJob& job = device.job();
  job.new_skin = surface_ != batch.surface;
  job.new_map = job.new_skin || map_id_ != batch.map_id;
  if (job.new_skin) describe_skin(*batch.surface, job);
  if (job.new_map) describe_map(batch.map, job);

  // Describe the samples themselves.
  job.first_segment = batch.first_segment;
  job.per_segment = static_cast<int>(batch.poses[0].size());

  // Write the data directly to the memory that the driver reads, which is enlarged first if it is too small.
  if (!device.has_room()) {
    const auto reserved = thread_->run([](DeviceComparison& d) { return d.reserve(); }, limits_.call);
    if (!reserved) return reserved;
  }

  // Write the skin and the map if the device does not have them yet.
  if (job.new_skin) write_skin(*batch.surface, static_cast<float*>(device.skin.memory()));
  if (job.new_map) {
    static_assert(sizeof(PixelMap::Cell) == 4 * sizeof(float), "the shader reads a cell as one vec4");
    std::memcpy(device.cells.memory(), batch.map.cells.data(), batch.map.cells.size() * sizeof(PixelMap::Cell));
    std::memcpy(device.hidden.memory(), batch.map.hidden.data(), batch.map.hidden.size() * sizeof(std::int32_t));
  }

  // The poses differ in every call, so they are always written.
  write_poses(batch, static_cast<float*>(device.poses.memory()));
  surface_ = batch.surface;
  map_id_ = batch.map_id;

  // Compare on the device, and read the result back.
  const auto compared = thread_->run([](DeviceComparison& d) { return d.compare(); }, limits_.call);
  if (!compared) return compared;
  read_distances(static_cast<const float*>(device.results.memory()), batch.first_segment, distances);
  return {};
}

}  // namespace barehand
