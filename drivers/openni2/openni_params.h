#pragma once

#include <string>

#include "sensor/given_intrinsics.h"

namespace barehand {

/// The wanted mode of an OpenNI2 sensor, and the times after which it is opened again.
struct OpenNiParams {
  int width = 640, height = 480, fps = 30;
  std::string colour = "registered";
  GivenIntrinsics camera;  ///< replaces the sensor's own intrinsics
  double latency = 0;
  double stall_timeout = 1;
  double reopen_after = 3;
};
template <class V>
void visit(V& v, OpenNiParams& p) {
  v.user("width", p.width, 64, 8192, "px, wanted size of the depth image; the sensor's nearest is taken");
  v.user("height", p.height, 48, 8192, "px");
  v.user("fps", p.fps, 1, 1000, "Hz, wanted rate; the sensor's nearest is taken");
  v.user("colour", p.colour, {"registered", "always", "never"},
         "registered: only if the sensor confirms that colour lies over depth; always: unconfirmed, too; never: depth "
         "alone");
  visit(v, p.camera);
  v.user("latency", p.latency, 0.0, 1.0, "s from the exposure to the earliest arrival of a frame; nothing tells it");
  v.user("stall_timeout", p.stall_timeout, 0.1, 60.0,
         "s without depth until a sensor counts as stalled and is opened again");
  v.user("reopen_after", p.reopen_after, 0.1, 600.0, "s of frozen or senseless depth until the sensor is opened again");
}

}  // namespace barehand
