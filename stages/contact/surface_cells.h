#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "hand/hand_pose.h"
#include "observe/observation.h"
#include "observe/surface_point.h"

namespace barehand {

/// Finds surfaces near a hand that belong neither to a hand nor to its forearm: the object pixels of an observation and
/// what is connected with them in depth, on a grid of cells of about 3.5 mm. Reuses its memory.
class SurfaceCells {
 public:
  /// Appends the points of observation `k`, whose estimate must have a pose. Components are numbered from the size of
  /// `open` on; for each one `open` gets whether it continues out of the hand's region, as a table or a body does.
  /// `on_skin`: whether a place is on the hand's skin. What preprocessing labelled as hand but is not on the skin is
  /// an object that has the colour of skin.
  void collect(const HandObservations& observations, const HandEstimates& estimates, std::size_t k,
               const std::function<bool(const Eigen::Vector3f&)>& on_skin, std::vector<SurfacePoint>& points,
               std::vector<bool>& open);

 private:
  void fill_cells(const HandObservations& observations, const HandEstimate& estimate, std::size_t k,
                  const std::function<bool(const Eigen::Vector3f&)>& on_skin);
  std::array<int, 2> pixel_of(const HandObservation& seen, int c, int r);
  void grow(std::vector<bool>& open);
  bool has_surface(std::int32_t cell);
  void fit(std::int32_t cell);

  int step_ = 1;                  // pixels per cell
  float spacing_ = 0;             // of the cells at a depth of 1 m [m]
  Image<Eigen::Vector3f> place_;  // position of each cell that is not hand or arm, camera frame [m]; z = 0: none
  // Position and normal of each cell's surface. Zero normal: it has none; position with z = 0: not fitted yet.
  Image<Eigen::Vector3f> fitted_, normal_;
  Image<std::uint8_t> beyond_;     // 1: a surface that is too far from the hand to be observed
  Image<std::int32_t> component_;  // component of each cell; kSeed: object, kOther: not reached yet
  std::vector<std::int32_t> stack_;
  std::vector<std::pair<float, std::array<int, 2>>> block_;  // depth and pixel of what a cell shows of an object
};

}  // namespace barehand
