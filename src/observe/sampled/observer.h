#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/error.h"
#include "hand/surface.h"
#include "math/se3.h"
#include "observe/sampled/pixel_map.h"

namespace barehand {

// Interfaces that compare samples of the segments' poses with the data.

/// Result of comparing one sample's skin with the data (paper Sec. 4.1, 4.2). A skin point's weight is the number of
/// pixels that it covers.
struct PatchDistance {
  float distance = 0;  ///< sum of weight * d_x over the counted points (paper, Eq. 1) [pixel m]
  float counted = 0;   ///< weight of the points that are neither occluded nor without data [pixel]
  float total = 0;     ///< weight of all front-facing points [pixel]

  /// Mean over counted pixels: d hat of the paper's Eq. 2 [m]; 0 if nothing is counted.
  double mean() const { return counted > 0 ? distance / counted : 0; }
  double counted_fraction() const { return total > 0 ? counted / total : 0; }
};

/// The sampled poses of all segments at one level of the coarse-to-fine search, and the depth data (`map`) that they
/// are compared with.
struct SampleBatch {
  const std::shared_ptr<const HandSurface>& surface;  ///< equal pointers mean the same skin
  const PixelMap& map;
  /// Batches with the same `surface` and the same id have the same map, so a device need not copy the map again.
  std::uint64_t map_id;
  const std::array<std::vector<SE3>, kSegmentCount>& poses;  ///< T_camera_segment, the same number for every segment
  int first_segment = 0;                                     ///< segments with a smaller index are not compared

  /// Number of samples of all segments that are compared.
  int sample_count() const { return (kSegmentCount - first_segment) * static_cast<int>(poses[first_segment].size()); }
};
/// Results in the order of the poses; all zero for a segment that was not compared.
using PatchDistances = std::array<std::vector<PatchDistance>, kSegmentCount>;

/// Compares the sampled poses of one search level with the depth data. Any thread may call it, but only one at a time.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void compare(const SampleBatch& batch, PatchDistances& distances) = 0;
  /// Whether a device compares the samples at present; it may fail in the next call.
  virtual bool on_device() const { return false; }
};

/// Like Observer, on a device that may fail at any time. After an error `distances` is meaningless.
class DeviceObserver {
 public:
  virtual ~DeviceObserver() = default;
  virtual Result<void> compare(const SampleBatch& batch, PatchDistances& distances) = 0;
};

}  // namespace barehand
