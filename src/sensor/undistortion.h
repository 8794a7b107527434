#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "math/camera.h"

namespace barehand {

/// Lens distortion in OpenCV's rational form and order (k1, k2, p1, p2, k3, k4, k5, k6), which is also ROS' plumb_bob
/// and rational_polynomial, and the Azure Kinect's. All 0: a pinhole.
struct Distortion {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0, k4 = 0, k5 = 0, k6 = 0;

  bool operator==(const Distortion&) const = default;
  /// Where the lens puts what an ideal pinhole would show at (x, y); both at distance 1 from the camera.
  Eigen::Vector2d distorted(double x, double y) const;
};

/// Turns the images of a lens with distortion into those of a pinhole with the same intrinsics. Every pixel takes the
/// nearest one of the lens' image: nothing is interpolated, so that no depth appears between a hand and what is behind.
class Undistortion {
 public:
  Undistortion(const Intrinsics& camera, const Distortion& distortion);

  /// The largest way of a pixel [px].
  double largest_shift() const { return largest_shift_; }

  /// Part of the pixels that the lens shows.
  double shown() const;

  /// `image` has the camera's size. Pixels that the lens does not show are 0.
  template <class T>
  Image<T> apply(const Image<T>& image) const {
    Image<T> out(image.width(), image.height());
    for (std::size_t i = 0; i < from_.size(); ++i)
      if (from_[i] >= 0) out[i] = image[static_cast<std::size_t>(from_[i])];
    return out;
  }

 private:
  std::vector<std::int32_t> from_;  ///< by pixel: index of the one it takes; < 0: none
  double largest_shift_ = 0;
};

}  // namespace barehand
