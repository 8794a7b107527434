#pragma once

#include "app/run_params.h"
#include "app/tracker_params.h"
#include "drivers/lcm/foreign_frames.h"
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
};
template <class V>
void visit(V& v, Config& c) {
  v("run", c.run, "the run as a whole");
  v("preprocess", c.preprocess, "from frames to observations of a hand");
  v("tracker", c.tracker, "from observations to hand poses");
  v("publish", c.publish, "from estimates to LCM messages");
  v("foreign_camera", c.foreign_camera, "intrinsics for frames of other projects that come without");
}

}  // namespace barehand
