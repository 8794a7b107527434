#pragma once

#include <cstdint>
#include <vector>

#include "hand/hand_pose.h"
#include "stages/search/coarse_skin.h"
#include "stages/search/score_grid.h"

namespace barehand {

/// Weights of the coarse score of a whole pose (CoarseScorer). Costs are per cell of the grid.
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
/// stay uncovered cost too. 0 = perfect; about 1 = as good as no model at all. Not thread-safe.
class CoarseScorer {
 public:
  /// `skin` must outlive the scorer; `grid` is copied.
  CoarseScorer(const ScoreGrid& grid, const CoarseSkin& skin, const CoarseScoreParams& params);

  /// The sum of the costs of all cells divided by the number of hand cells; infinity if the grid is empty or the pose
  /// is not finite.
  double operator()(const HandPose& pose);

 private:
  /// Coefficients of the cost of every cell. If the model covers a cell at depth z, the cost is
  /// slope * min(|z - data|, depth_cap) + (z < data ? front : behind); if it does not, `empty`. If the forearm covers
  /// it at depth z, the cost is slope * min(|z - data|, depth_cap) + forearm + (z < data - sleeve_depth ? bare : 0).
  /// The arrays have a border of one cell around the grid.
  struct CellCosts {
    std::vector<float> data, slope, front, behind, empty, forearm, bare;
  };
  void prepare(const ScoreGrid& grid);
  void prepare_cell(const ScoreGrid& grid, std::size_t from, std::size_t to);
  bool find_cells(std::size_t count);
  void splat(const CoarseSkin::Part& part, const SE3& T, std::vector<float>& z_buffer);
  double outside_cost(const CoarseSkin::Part& part) const;
  double border_cost(float u, float v, float z) const;
  double sum_of_costs() const;
  /// Number of empty cells before the first cell of the z-buffers, so that every cell has a left, an upper and an upper
  /// left neighbour.
  std::size_t before_grid() const { return static_cast<std::size_t>(camera_.width) + 1; }

  const CoarseSkin& skin_;
  CoarseScoreParams params_;
  Intrinsics camera_;  // camera with one pixel per cell, including the cells of the border
  float shrink_ = 0;   // distance by which the points are pulled inwards [m]
  float image_lo_u_ = 0, image_lo_v_ = 0, image_hi_u_ = 0, image_hi_v_ = 0;
  int hand_cells_ = 0;
  CellCosts costs_;
  /// z-buffers. A point covers 2 x 2 cells, but its depth is stored only in the top left one; infinite if nothing was
  /// drawn.
  std::vector<float> hand_z_, forearm_z_;
  // For every point of the part that is being splatted: its pixel, its depth [m], and a number that is negative if the
  // skin there faces the camera.
  std::vector<float> u_, v_, z_, facing_;
  // For these points: 1 if the point is drawn, otherwise 0; the indices of the drawn points; the cell of each point.
  std::vector<std::int32_t> drawn_, visible_, cell_;
  bool leaves_grid_ = false;  // whether a point that faces the camera lies outside the grid
};

}  // namespace barehand
