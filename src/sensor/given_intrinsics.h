#pragma once

#include <string>

#include "core/error.h"
#include "sensor/camera_limits.h"

namespace barehand {

/// Intrinsics that the user states for a depth camera that reports none, or wrong ones [pixels]. All are 0 if the user
/// states none.
struct GivenIntrinsics {
  double fx = 0, fy = 0, cx = 0, cy = 0;

  bool any() const { return fx != 0 || fy != 0 || cx != 0 || cy != 0; }
  Intrinsics of_size(int width, int height) const { return {width, height, fx, fy, cx, cy}; }
};

template <class V>
void visit(V& v, GivenIntrinsics& p) {
  v.user("fx", p.fx, 0.0, kLargestFocal,
         "px, focal length of the depth camera; give all four, or leave all at 0 for none");
  v.user("fy", p.fy, 0.0, kLargestFocal, "px, vertical focal length");
  v.user("cx", p.cx, -kLargestFocal, kLargestFocal, "px, principal point");
  v.user("cy", p.cy, -kLargestFocal, kLargestFocal, "px, vertical principal point");
}

/// Returns an error that names `where` if only some of the four are given, or if no camera can have them.
inline Result<void> check(const GivenIntrinsics& given, const std::string& where = "fx, fy, cx, cy") {
  const bool whole = given.fx != 0 && given.fy != 0 && given.cx != 0 && given.cy != 0;
  if (!given.any() || (whole && plausible(given.of_size(1, 1)))) return {};
  return fail("no camera has these intrinsics", where, "give all four, focal lengths from 1 to 1e5 px");
}

}  // namespace barehand
