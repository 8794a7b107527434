#pragma once

#include "hand/surface.h"
#include "observe/sampled/observer.h"

namespace barehand {

/// Compares one sample `T_camera_segment` of a segment with the data (paper, Eq. 1). `cap` [m] limits the distance of a
/// single pixel; infinity leaves Eq. 1 as it is. The result has single precision; the order of summation is fixed for a
/// given instruction set.
PatchDistance patch_distance(const SegmentSurface& skin, const SE3& T_camera_segment, int segment, const PixelMap& map,
                             float cap);

}  // namespace barehand
