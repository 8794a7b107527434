#pragma once

#include <array>
#include <span>
#include <vector>

#include "math/se3.h"
#include "object/known_object.h"
#include "stages/contact/observed_space.h"
#include "stages/contact/surface_cells.h"

namespace barehand {

/// What has been seen of one object, fused in its own frame: its surface as small discs (surfels), one in each cell of
/// a grid of 4 mm, and the cells that were seen to be empty. Cells that are neither are unknown.
class ObjectModel {
 public:
  /// Points farther than this from the surface do not belong to it [m].
  static constexpr float kFar = 0.008f;

  /// Whether the model has enough surface to compare points with.
  bool has_surface() const { return surfels_.size() >= 8; }
  /// How badly the points of a frame agree with the model at a pose of it: their mean distance from it, kFar at most,
  /// plus kFar times the fraction of its surface that the frame contradicts [m].
  double misfit(const SE3& T_camera_object, std::span<const SurfacePoint* const> points,
                const ObservedSpace& space) const;
  /// How much contradicts a pose: the share of the surface that this frame contradicts, since it sees empty space there
  /// or measures nothing although the surface faces the camera, or the share of the points at places that were seen to
  /// be empty, whichever is larger.
  double contradiction(const SE3& T_camera_object, std::span<const SurfacePoint* const> points,
                       const ObservedSpace& space) const;
  /// The predicted pose, shifted so that the mean of the visible surface coincides with the mean of the points.
  SE3 centred(const SE3& predicted, std::span<const SurfacePoint* const> points, const ObservedSpace& space) const;
  /// The pose near a predicted one at which the points lie on the model's surface, by point-to-plane ICP. Directions in
  /// which the surface slides along itself stay as predicted. `covariance`: that of the pose's boxplus twist.
  SE3 align(const SE3& predicted, std::span<const SurfacePoint* const> points, Matrix6d& covariance) const;
  /// Adds the points of a frame, if the pose is `credible`, and the space that is seen to be empty, and removes surfels
  /// in this space.
  void fuse(const SE3& T_camera_object, std::span<const SurfacePoint* const> points, const ObservedSpace& space,
            bool credible = true);
  /// Appends the surfels that are hidden in this frame, in the camera frame.
  void append_hidden(const SE3& T_camera_object, const ObservedSpace& space, std::int32_t object,
                     std::vector<SurfacePoint>& points) const;
  /// Whether a place in the object's frame was seen to be empty.
  bool seen_empty(const Eigen::Vector3f& p) const;
  /// Whether a place in the object's frame is within about kFar of the surface.
  bool near(const Eigen::Vector3f& p) const {
    const std::int32_t c = cell_of(p);
    return c >= 0 && cells_[c].around > 0;
  }
  /// The surface as far as it is known, in the object's frame.
  std::vector<SurfaceSample> surface() const;
  /// Corners of the surface's bounding box in the object's frame [m].
  std::array<Eigen::Vector3f, 2> bounds() const;

 private:
  struct Surfel {
    Eigen::Vector3f p, n;
    float weight = 0;  // number of frames that saw it, roughly
    std::int32_t cell = 0;
  };
  struct Cell {
    std::int16_t surfel = -1;  // index into surfels_
    std::uint8_t empty = 0;    // number of frames that saw the cell empty
    std::uint8_t around = 0;   // number of surfels up to two cells away
  };

  double contradicted(const SE3& T_camera_object, const ObservedSpace& space) const;
  std::int32_t cell_of(const Eigen::Vector3f& p) const;
  int nearest(const Eigen::Vector3f& p) const;
  void count_around(std::int32_t cell, int change);
  void add(const Eigen::Vector3f& p, const Eigen::Vector3f& n);
  void remove_contradicted(const SE3& T_camera_object, const ObservedSpace& space);
  void see_empty_cells(const SE3& T_camera_object, const ObservedSpace& space);

  std::vector<Surfel> surfels_;
  std::vector<Cell> cells_;  // empty until something was added
  int layer_ = 0;            // layer of cells at which see_empty_cells() begins
};

}  // namespace barehand
