#pragma once

#include "observe/observation.h"

namespace barehand {

/// An observation reduced to square cells of a few millimetres, for quick scores of whole poses.
struct ScoreGrid {
  Intrinsics camera;   ///< of the cells: cell (i, j) is pixel (i, j) of this camera
  double cell = 0;     ///< size of a cell at the hand's distance [m]
  Image<float> depth;  ///< mean z of the cell's label [m]; 0 = no measurement
  Image<PixelLabel> label;
  Image<float> hand_distance;  ///< in the image plane to the nearest hand cell [m at the hand's distance]
  int hand_cells = 0;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();     ///< mean hand point, camera frame [m]
  Eigen::Vector3d palm_centre = Eigen::Vector3d::Zero();  ///< surface point where the hand is widest (maximum of
                                                          ///< the distance transform inside the hand)
  bool empty() const { return hand_cells == 0; }
  int i_lo = 0, j_lo = 0, i_hi = 0, j_hi = 0;  ///< the image's borders: what lies within is observable
};

/// Cells of about `cell` [m] at the median distance of the hand. Empty when the observation has no hand pixels.
ScoreGrid make_score_grid(const HandObservation& observation, double cell);

}  // namespace barehand
