#pragma once

#include <array>

#include "hand/hand_pose.h"
#include "hand/surface.h"
#include "observe/pixel_map.h"
#include "stages/segment_tracker/segment_tracker_params.h"

namespace barehand {

/// Depth of one segment's predicted skin on a coarse grid over its patch, continued beyond its outline by the depth of
/// the nearest skin point, so that samples that leave the outline find a label, too. Keeps its memory.
struct PredictedPatch {
  struct ImagePoint {
    float u, v, z;
  };
  std::vector<ImagePoint> points;  ///< the skin that faces the camera, in pixels of the map and [m]
  int u0 = 0, v0 = 0;              ///< of the first cell, in pixels of the map
  int cell = 1;                    ///< side of a cell [pixel], below the spacing of the skin points
  int columns = 0, rows = 0;       ///< 0: the segment is outside the region of interest
  float outline_sq = 0;            ///< cells nearer to a skin point than this lie on the segment [pixel^2]
  std::vector<float> z;            ///< [m]
  std::vector<float> gap_sq;       ///< squared distance to the nearest skin point [pixel^2]

  void predict(const SegmentSurface& skin, const SE3& T_camera_segment, const PixelMap& map, double margin);
};

/// What the hand itself hides at a predicted pose (Sec. 4.2), by the rule of `params.self_occlusion`.
class SelfOcclusion {
 public:
  /// Sets bit s of `map.hidden` where segment s is hidden.
  void label(const HandSurface& surface, const HandPose& predicted, const SegmentTrackerParams& params, PixelMap& map,
             Workers& workers);

 private:
  void label_by_data(float threshold, PixelMap& map) const;
  void label_by_model(float threshold, PixelMap& map);

  std::array<PredictedPatch, kSegmentCount> patches_;
  std::vector<float> front_;  ///< nearest predicted skin, a pixel of the map [m]
};

}  // namespace barehand
