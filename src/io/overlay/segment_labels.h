#pragma once

#include <opencv2/core.hpp>

#include "io/overlay/overlay_view.h"

namespace barehand {

/// Writes the names of a hand's segments in two columns to the left and right of the hand, each connected by a line to
/// the middle of its segment. `camera` is the camera of the image `picture` (R, G, B).
void draw_segment_names(const HandEstimate& estimate, const Intrinsics& camera, cv::Mat& picture);

}  // namespace barehand
