#pragma once

#include "hand/surface.h"
#include "observe/observer.h"

namespace barehand {

/// `T_camera_segment`: the sample. `cap` [m] bounds a single pixel's distance (infinity: Eq. 1 as it is). Exact up to
/// single precision; the order of sums is fixed for a given instruction set.
PatchDistance patch_distance(const SegmentSurface& skin, const SE3& T_camera_segment, int segment, const PixelMap& map,
                             float cap);

}  // namespace barehand
