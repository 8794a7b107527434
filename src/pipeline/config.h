#pragma once

#include "drivers/openni2/openni_params.h"
#include "io/config/config_file.h"
#include "io/config/config_writer.h"
#include "pipeline/run_params.h"
#include "sensor/camera_placement.h"
#include "sensor/given_intrinsics.h"
#include "stages/contact/contact_params.h"
#include "stages/detection/params.h"
#include "stages/grasp/grasp_params.h"
#include "stages/preprocess/params.h"
#include "stages/publish/publish_params.h"
#include "tracking/tracker_params.h"

namespace barehand {

/// All values of a configuration file: one group per stage.
struct Config {
  RunParams run;
  DetectionParams detection;
  PreprocessParams preprocess;
  TrackerParams tracker;
  ContactParams contact;
  GraspParams grasp;
  PublishParams publish;
  CameraPlacement world;
  GivenIntrinsics foreign_camera;
  OpenNiParams openni2;
};
template <class V>
void visit(V& v, Config& c) {
  // The settings of the run come first, then those of the stages in the order in which a frame passes them.
  v("run", c.run, "settings of the run as a whole");
  v("detection", c.detection, "detection of hands by neural networks");
  v("preprocess", c.preprocess, "from frames to observations of a hand");
  v("tracker", c.tracker, "from observations to hand poses");
  v("contact", c.contact, "what the hands touch");
  v("grasp", c.grasp, "how the hands grasp");

  // These settings are for the output, the surroundings and the cameras.
  v("publish", c.publish, "from estimates to LCM messages");
  v("world", c.world, "the room in which the camera stands, for the live page");
  v("foreign_camera", c.foreign_camera, "intrinsics for kinect.frame_msg_t and bot_core.images_t, which carry none");
  v("openni2", c.openni2,
    "wanted mode of an OpenNI2 sensor, and when it is reopened; fx, fy, cx and cy replace the sensor's own");

  // The hold time of the published pose has no key of its own: it is that of the tracker.
  c.publish.hold_time = c.tracker.loss.hold_time;
}

}  // namespace barehand
