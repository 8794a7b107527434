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

/// One sample's skin against the data (paper Sec. 4.1, 4.2). Weights are the pixels that the skin points cover.
struct PatchDistance {
  float distance = 0;  ///< sum of weight * d_x over the counted points (Eq. 1) [pixel m]
  float counted = 0;   ///< weight of the points that are neither occluded nor without data [pixel]
  float total = 0;     ///< weight of all front-facing points [pixel]

  /// Mean over counted pixels: d hat of Eq. 2 [m]; 0 where nothing is counted.
  double mean() const { return counted > 0 ? distance / counted : 0; }
  double counted_fraction() const { return total > 0 ? counted / total : 0; }
};

/// All samples of one level and the frame they are compared with.
struct SampleBatch {
  const std::shared_ptr<const HandSurface>& surface;  ///< the skin; the same pointer, the same skin
  const PixelMap& map;
  std::uint64_t map_id;                                      ///< equal ids with one skin, equal maps: no need to copy
  const std::array<std::vector<SE3>, kSegmentCount>& poses;  ///< T_camera_segment, equally many per segment
  int first_segment = 0;                                     ///< those before it are not looked at

  /// Of all segments that are looked at.
  int sample_count() const { return (kSegmentCount - first_segment) * static_cast<int>(poses[first_segment].size()); }
};
/// In the order of the poses; all zero for a segment that was not looked at.
using PatchDistances = std::array<std::vector<PatchDistance>, kSegmentCount>;

/// Where the samples of a level are compared with the data. One call at a time, from any thread.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void compare(const SampleBatch& batch, PatchDistances& distances) = 0;
  /// Whether a device does it, as far as is known; it may be lost in the next call.
  virtual bool on_device() const { return false; }
};

/// The same on a device that may be lost at any time. After an error `distances` holds nothing of use.
class DeviceObserver {
 public:
  virtual ~DeviceObserver() = default;
  virtual Result<void> compare(const SampleBatch& batch, PatchDistances& distances) = 0;
};

}  // namespace barehand
