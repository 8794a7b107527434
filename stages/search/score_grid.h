#pragma once

#include "observe/observation.h"

namespace barehand {

/// An observation reduced to square cells of a few millimetres, for fast scoring of whole poses.
struct ScoreGrid {
  Intrinsics camera;   ///< camera whose pixel (i, j) is cell (i, j)
  double cell = 0;     ///< size of a cell at the hand's distance [m]
  Image<float> depth;  ///< mean depth of those pixels of the cell that have its label [m]; 0: no measurement
  Image<PixelLabel> label;
  Image<float> hand_distance;  ///< distance to the nearest hand cell, parallel to the image plane at hand depth [m]
  int hand_cells = 0;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();     ///< mean hand point, camera frame [m]
  Eigen::Vector3d palm_centre = Eigen::Vector3d::Zero();  ///< surface point where the hand is widest (maximum of
                                                          ///< the distance transform inside the hand)
  bool empty() const { return hand_cells == 0; }
  /// Borders of the whole image [cells]; only points within them can be observed.
  int i_lo = 0, j_lo = 0, i_hi = 0, j_hi = 0;
};

/// Makes a grid with cells of about `cell` [m] at the median depth of the hand; empty if no hand pixel has depth.
ScoreGrid make_score_grid(const HandObservation& observation, double cell);

}  // namespace barehand
