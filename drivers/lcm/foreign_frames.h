#pragma once

#include "bot_core/images_t.hpp"
#include "core/error.h"
#include "kinect/frame_msg_t.hpp"
#include "math/camera_limits.h"
#include "math/frame.h"

namespace barehand {

/// What other projects' frame types leave out. All 0: not given, and their frames are errors.
struct ForeignCamera {
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< pixels, of the depth image

  bool given() const { return fx != 0 || fy != 0 || cx != 0 || cy != 0; }
};
/// Error: one of the four is given without the others, or none that a camera can have.
Result<void> check_given(const ForeignCamera& camera);

template <class V>
void visit(V& v, ForeignCamera& p) {
  v("fx", p.fx, 0.0, kLargestFocal,
    "focal length [px] of kinect.frame_msg_t and bot_core.images_t, which carry none; all four 0 = not given");
  v("fy", p.fy, 0.0, kLargestFocal, "focal length [px], vertical");
  v("cx", p.cx, -kLargestFocal, kLargestFocal, "principal point [px], horizontal");
  v("cy", p.cy, -kLargestFocal, kLargestFocal, "principal point [px], vertical");
}

/// Depth in millimetres, raw or zlib; colour raw RGB or JPEG of the same size (colour of another size cannot be
/// registered to the depth and is left out). Anything else is an error.
Result<FramePtr> decode_kinect(const kinect::frame_msg_t& message, const ForeignCamera& camera, std::int64_t number);

/// The images DEPTH_MM or DEPTH_MM_ZIPPED and, where there is one of the same size, LEFT as RGB, BGR, grey or JPEG.
Result<FramePtr> decode_images(const bot_core::images_t& message, const ForeignCamera& camera, std::int64_t number);

}  // namespace barehand
