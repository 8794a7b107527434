#pragma once

#include <cstdint>
#include <vector>

#include "hand/hand_pose.h"
#include "hand/surface.h"
#include "stages/prediction/coarse_grid.h"

namespace barehand {

/// Weights of the quick score of a whole pose.
struct CoarseScoreParams {
  double depth_cap = 0.025;  ///< [m] depth differences and image distances count up to this
  double background = 1.2;   ///< model where the background is seen, at the cap
  double unknown = 0.4;      ///< model where nothing is measured and no hand is near
  double hidden = 0.15;      ///< model behind an object: allowed, but seen hands are better
  double outside = 0.4;      ///< model outside the image
  double unexplained = 1.0;  ///< hand cells without model
};

template <class V>
void visit(V& v, CoarseScoreParams& p) {
  v("depth_cap", p.depth_cap, 1e-3, 1.0, "m, depth differences and image distances count up to this");
  v("background", p.background, 0.0, 100.0, "cost of a model cell where the background is seen");
  v("unknown", p.unknown, 0.0, 100.0, "cost of a model cell where nothing is measured and no hand is near");
  v("hidden", p.hidden, 0.0, 100.0, "cost of a model cell behind an object");
  v("outside", p.outside, 0.0, 100.0, "cost of a model cell outside the image");
  v("unexplained", p.unexplained, 0.0, 100.0, "cost of a hand cell without model");
}

/// The skin thinned to about one point per `spacing` x `spacing` [m], ready to be posed quickly.
struct CoarseSkin {
  struct Point {
    Eigen::Vector3f p, n;  ///< segment frame
    float width;           ///< [m] side of the square of skin for which it stands
  };
  std::array<std::vector<Point>, kSegmentCount> points;
};
CoarseSkin make_coarse_skin(const HandSurface& surface, double spacing);

/// Silhouette and depth score of a whole pose on a coarse grid: the skin is splatted into a z-buffer of cells; every
/// covered cell costs its capped depth difference (hand), or its distance to the hand (background); hand cells that
/// stay uncovered cost too. 0 = perfect; about 1 = as good as no model at all. Not thread-safe: one per thread.
class CoarseScorer {
 public:
  CoarseScorer(const CoarseGrid& grid, const CoarseSkin& skin, const CoarseScoreParams& params);

  /// Sum of the costs per hand cell; infinity when the grid is empty or the pose is not finite.
  double operator()(const HandPose& pose);

 private:
  void splat(const HandPose& pose);
  void splat_point(float x, float y, float z, float width);
  double cell_cost(std::size_t index, float z) const;

  const CoarseGrid& grid_;
  const CoarseSkin& skin_;
  CoarseScoreParams params_;
  std::vector<float> z_;  // of the pose last splatted, where stamped
  std::vector<std::uint32_t> stamp_;
  std::uint32_t now_ = 0;
  std::vector<std::int32_t> covered_;
  double outside_cost_ = 0;  // of the points that fall off the grid
};

}  // namespace barehand
