#pragma once

#include <array>

#include "hand/hand_pose.h"
#include "hand/surface.h"
#include "observe/sampled/pixel_map.h"
#include "stages/segment_tracker/segment_tracker_params.h"

namespace barehand {

// Finds pixels where the hand hides its own segments.

/// The predicted depth of one segment's skin on a coarse grid around it. Beyond the outline, a cell has the depth of
/// the nearest skin point, so that samples outside the outline find a value, too. The buffers are kept between calls.
struct PredictedPatch {
  struct ImagePoint {
    float u, v, z;
  };
  std::vector<ImagePoint> points;  ///< skin points that face the camera; u, v in pixels of the map, z [m]
  int u0 = 0, v0 = 0;              ///< pixel of the map at the corner of the first cell
  int cell = 1;                    ///< side of a cell [pixel], smaller than the spacing of the skin points
  int columns = 0, rows = 0;       ///< size of the grid [cells]; 0: the segment is outside the region of interest
  float outline_sq = 0;            ///< cells closer to a skin point than this lie within the outline [pixel^2]
  std::vector<float> z;            ///< depth of every cell [m]
  std::vector<float> gap_sq;       ///< squared distance of every cell to the nearest skin point [pixel^2]

  /// Computes the grid for a predicted pose. The grid includes a margin of `margin` [m] around the segment.
  void predict(const SegmentSurface& skin, const SE3& T_camera_segment, const PixelMap& map, double margin);
};

/// Finds the pixels where the hand hides its own segments at the predicted pose (paper, Sec. 4.2); the setting
/// `self_occlusion` selects the rule.
class SelfOcclusion {
 public:
  /// Sets bit s of `map.hidden` in all pixels where segment s is hidden.
  void label(const HandSurface& surface, const HandPose& predicted, const SegmentTrackerParams& params, PixelMap& map,
             Workers& workers);

 private:
  void label_by_data(float threshold, PixelMap& map) const;
  void label_by_model(float threshold, PixelMap& map);

  std::array<PredictedPatch, kSegmentCount> patches_;
  std::vector<float> front_;  ///< depth of the nearest predicted skin at each pixel of the map [m]
};

}  // namespace barehand
