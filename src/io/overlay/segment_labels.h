#pragma once

#include <opencv2/core.hpp>

#include "io/overlay/overlay_view.h"

namespace barehand {

/// Writes the names of a hand's segments in two columns beside it, each joined by a line with the middle of its
/// segment. `camera` is that of the picture (R, G, B).
void draw_segment_names(const HandEstimate& estimate, const Intrinsics& camera, cv::Mat& picture);

}  // namespace barehand
