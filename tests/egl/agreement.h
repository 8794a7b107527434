#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>

#include "observe/egl/egl_functions.h"
#include "observe/egl/egl_observer.h"
#include "stages/segment_tracker/cpu_observer.h"
#include "tests/egl/random_batch.h"

namespace barehand {

inline constexpr float kCap = 0.008f;  // m

/// Time limits that a working driver keeps even on a busy machine.
inline DeviceLimits patient_limits() {
  constexpr std::chrono::minutes kLong(5);
  return {kLong, kLong, kLong, kLong};
}

/// An observer with the OpenGL ES renderer of this machine. `load` provides EGL's functions.
inline std::unique_ptr<EglObserver> open_observer(float cap, std::function<Result<Egl>()> load,
                                                  const DeviceLimits& limits = patient_limits()) {
  auto observer = EglObserver::open(cap, DeviceChoice::any, std::move(load), limits);
  if (!observer) throw std::runtime_error(observer.error().message());
  return std::move(*observer);
}
inline std::unique_ptr<EglObserver> open_observer(float cap = kCap) {
  return open_observer(cap, [] { return load_egl(kEglLibrary); });
}

inline PatchDistances by_egl(DeviceObserver& observer, const SampleBatch& batch) {
  PatchDistances distances;
  const auto done = observer.compare(batch, distances);
  EXPECT_TRUE(done) << done.error().message();
  return distances;
}

inline PatchDistances by_cpu(const RandomBatch& world, float cap = kCap, int first_segment = 0) {
  Workers workers(1);
  PatchDistances distances;
  CpuObserver(cap, workers).compare(world.batch(1, first_segment), distances);
  return distances;
}

/// Whether mean distances agree within 0.1 um and weights within 1e-5 of the sample's total weight. Samples with a
/// point very near to a pixel's edge or the silhouette may differ more, since rounding decides on which side the point
/// is.
inline bool agree(const PatchDistance& a, const PatchDistance& b) {
  const double weight = 1e-5 * std::max(a.total, b.total);
  return std::abs(a.mean() - b.mean()) <= 1e-7 && std::abs(a.counted - b.counted) <= weight &&
         std::abs(a.total - b.total) <= weight;
}

/// The fraction of the samples that differ.
inline double disagreement(const PatchDistances& a, const PatchDistances& b) {
  int samples = 0, different = 0;
  for (int s = 0; s < kSegmentCount; ++s) {
    if (a[s].size() != b[s].size()) return 1;
    for (std::size_t i = 0; i < a[s].size(); ++i) different += !agree(a[s][i], b[s][i]);
    samples += static_cast<int>(a[s].size());
  }
  return static_cast<double>(different) / samples;
}
inline constexpr double kNearAnEdge = 0.002;  // fraction of samples that may differ, see agree()

}  // namespace barehand
