#pragma once

#include <array>
#include <vector>

#include "observe/observation.h"

namespace barehand {

/// Which places in space a frame shows to be empty. Up to the surface that a ray met, space is empty; behind it, and
/// where nothing was measured, there may be anything.
class ObservedSpace {
 public:
  enum class Occupancy { unknown, empty, surface };

  /// Looks at the regions of interest of all hands of a frame.
  void observe(const HandObservations& observations);
  /// What is seen at a place (camera frame [m]). A surface is as thick as the sensor's error.
  Occupancy at(const Eigen::Vector3f& p) const;
  /// Whether nothing was measured in the direction of a place, nor around it, although it is in view.
  bool blank(const Eigen::Vector3f& p) const;
  bool empty(const Eigen::Vector3f& p) const { return at(p) == Occupancy::empty; }

 private:
  struct View {
    const HandObservation* observation = nullptr;
    float fx = 0, fy = 0, cx = 0, cy = 0;  // intrinsics of the region of interest [px]
    float margin = 0;                      // half the thickness that a surface has because of the sensor's error [m]

    /// The pixel of the region that shows a place in front of the camera.
    std::array<int, 2> pixel_of(const Eigen::Vector3f& p) const {
      return {static_cast<int>(fx * p.x() / p.z() + cx + 0.5f), static_cast<int>(fy * p.y() / p.z() + cy + 0.5f)};
    }
  };
  std::vector<View> views_;
};

}  // namespace barehand
