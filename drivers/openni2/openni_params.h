#pragma once

#include <string>

#include "sensor/given_intrinsics.h"

namespace barehand {

/// The wanted mode of an OpenNI2 sensor, and the times after which it is opened again.
struct OpenNiParams {
  int width = 640, height = 480, fps = 30;
  std::string colour = "registered";
  GivenIntrinsics camera;
  double latency = 0;
  double stall_timeout = 1;
  double reopen_after = 3;
};
template <class V>
void visit(V& v, OpenNiParams& p) {
  v.user("width", p.width, 64, 8192, "px, wanted width of the depth image; the sensor's nearest size is used");
  v.user("height", p.height, 48, 8192, "px, wanted height of the depth image");
  v.user("fps", p.fps, 1, 1000, "Hz, wanted frame rate; the sensor's nearest is used");
  v.user("colour", p.colour, {"registered", "always", "never"},
         "registered: use colour only if the sensor confirms that it is registered to depth; always: even if it does "
         "not confirm it; never: use depth alone");
  visit(v, p.camera);
  v.user("latency", p.latency, 0.0, 1.0,
         "s from the exposure of a frame to its earliest arrival, which sensors do not report");
  v.user("stall_timeout", p.stall_timeout, 0.1, 60.0,
         "s without depth after which a sensor counts as stalled and is reopened");
  v.user("reopen_after", p.reopen_after, 0.1, 600.0, "s of frozen or invalid depth after which the sensor is reopened");
}

}  // namespace barehand
