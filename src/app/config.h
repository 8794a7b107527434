#pragma once

#include "app/run_params.h"
#include "app/tracker_params.h"
#include "drivers/lcm/foreign_frames.h"
#include "drivers/openni2/openni_params.h"
#include "io/config_file.h"
#include "stages/preprocess/params.h"
#include "stages/publish/publish_params.h"

namespace barehand {

/// Everything a configuration file says: one group per stage.
struct Config {
  RunParams run;
  PreprocessParams preprocess;
  TrackerParams tracker;
  PublishParams publish;
  ForeignCamera foreign_camera;
  OpenNiParams openni2;
};
template <class V>
void visit(V& v, Config& c) {
  v("run", c.run, "the run as a whole");
  v("preprocess", c.preprocess, "from frames to observations of a hand");
  v("tracker", c.tracker, "from observations to hand poses");
  v("publish", c.publish, "from estimates to LCM messages");
  v("foreign_camera", c.foreign_camera, "intrinsics for frames of other projects that come without");
  v("openni2", c.openni2, "what is wanted of an OpenNI2 sensor, and when it is opened again");
}

}  // namespace barehand
