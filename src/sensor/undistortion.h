#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "math/camera.h"

namespace barehand {

// Removal of the lens distortion of images.

/// Lens distortion in OpenCV's rational form and order (k1, k2, p1, p2, k3, k4, k5, k6), which is also ROS' plumb_bob
/// and rational_polynomial, and the Azure Kinect's. All 0: a pinhole.
struct Distortion {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0, k4 = 0, k5 = 0, k6 = 0;

  bool operator==(const Distortion&) const = default;
  /// Where the lens images the point that an ideal pinhole camera would show at (x, y). Both are positions in the plane
  /// z = 1.
  Eigen::Vector2d distorted(double x, double y) const;
};

/// Converts images of a lens with distortion to those of a pinhole camera with the same intrinsics. Every pixel takes
/// the value of the nearest pixel in the distorted image: interpolation would invent depths between a hand and its
/// background.
class Undistortion {
 public:
  Undistortion(const Intrinsics& camera, const Distortion& distortion);

  /// Largest displacement of a pixel [px].
  double largest_shift() const { return largest_shift_; }

  /// Fraction of the undistorted image's pixels that lie within the distorted image.
  double shown() const;

  /// Undistorts `image`, which must have the camera's size. Pixels that the distorted image does not show become 0.
  template <class T>
  Image<T> apply(const Image<T>& image) const {
    Image<T> out(image.width(), image.height());
    for (std::size_t i = 0; i < from_.size(); ++i)
      if (from_[i] >= 0) out[i] = image[static_cast<std::size_t>(from_[i])];
    return out;
  }

 private:
  std::vector<std::int32_t> from_;  ///< for each pixel, the index of its source pixel; negative if there is none
  double largest_shift_ = 0;
};

}  // namespace barehand
