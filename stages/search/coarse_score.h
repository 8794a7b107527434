#pragma once

#include <cstdint>
#include <vector>

#include "hand/hand_pose.h"
#include "stages/search/coarse_skin.h"
#include "stages/search/score_grid.h"

namespace barehand {

/// Weights of the quick score of a whole pose; each is the cost of one cell.
struct CoarseScoreParams {
  double depth_cap = 0.05;
  double background = 1.2;
  double unknown = 0.4;
  double hidden = 0.03;
  double outside = 0.4;
  double unexplained = 1.0;
  double no_forearm = 0.6;
  double sleeve_depth = 0.03;
  bool operator==(const CoarseScoreParams&) const = default;
};

template <class V>
void visit(V& v, CoarseScoreParams& p) {
  v("depth_cap", p.depth_cap, 1e-3, 1.0, "m, upper limit of depth differences and image distances");
  v("background", p.background, 0.0, 100.0, "cost of a model cell where the background is seen");
  v("unknown", p.unknown, 0.0, 100.0, "cost of a model cell where nothing is measured and no hand is near");
  v("hidden", p.hidden, 0.0, 100.0, "cost of a model cell behind an object");
  v("outside", p.outside, 0.0, 100.0, "cost of a model cell outside the image");
  v("unexplained", p.unexplained, 0.0, 100.0, "cost of a hand cell that the model does not cover");
  v("no_forearm", p.no_forearm, 0.0, 100.0, "cost of a forearm cell where the background is seen");
  v("sleeve_depth", p.sleeve_depth, 0.0, 1.0, "m, a surface this close to the forearm counts as its sleeve");
}

/// Silhouette and depth score of a whole pose on a coarse grid: the skin is splatted into a z-buffer of cells; every
/// covered cell costs its capped depth difference (hand), or its distance to the hand (background); hand cells that
/// stay uncovered cost too. 0 = perfect; about 1 = as good as no model at all. Refers to the skin; one per thread.
class CoarseScorer {
 public:
  CoarseScorer(const ScoreGrid& grid, const CoarseSkin& skin, const CoarseScoreParams& params);

  /// Sum of the costs per hand cell; infinity when the grid is empty or the pose is not finite.
  double operator()(const HandPose& pose);

 private:
  /// Cost of model depth z over a cell: slope min(|z - data|, cap) + (z < data ? front : behind); without model
  /// `empty`. Of forearm depth: the first term + forearm + (z is in front by more than sleeve_depth ? bare : 0).
  /// Arrays over the cells with a border of one cell, so that splats need no range check.
  struct CellCosts {
    std::vector<float> data, slope, front, behind, empty, forearm, bare;
  };
  void prepare(const ScoreGrid& grid);
  void prepare_cell(const ScoreGrid& grid, std::size_t from, std::size_t to);
  bool judge(std::size_t count);
  void splat(const CoarseSkin::Part& part, const SE3& T, std::vector<float>& z_buffer);
  double outside_cost(const CoarseSkin::Part& part) const;
  double border_cost(float u, float v, float z) const;
  double sum_of_costs() const;
  /// Empty cells in front of the z-buffers' first, so that each has three neighbours.
  std::size_t before_grid() const { return static_cast<std::size_t>(camera_.width) + 1; }

  const CoarseSkin& skin_;
  CoarseScoreParams params_;
  Intrinsics camera_;  // of the bordered cells
  float shrink_ = 0;   // [m]
  float image_lo_u_ = 0, image_lo_v_ = 0, image_hi_u_ = 0, image_hi_v_ = 0;
  int hand_cells_ = 0;
  CellCosts costs_;
  /// z-buffers of the first of the 2 x 2 cells that a point covers; infinite where nothing was drawn.
  std::vector<float> hand_z_, forearm_z_;
  std::vector<float> u_, v_, z_, facing_;             // of the part being splatted; facing < 0: towards the camera
  std::vector<std::int32_t> drawn_, visible_, cell_;  // of that part: 1 where it is drawn; indices of those; where
  bool leaves_grid_ = false;
};

}  // namespace barehand
