#include "drivers/lcm/foreign_frames.h"
#include "drivers/openni2/openni_params.h"
#include "fuzz/memory_file.h"
#include "io/config/config_file.h"
#include "io/config/config_writer.h"
#include "pipeline/run_params.h"
#include "sensor/camera_placement.h"
#include "stages/publish/publish_params.h"

namespace {

/// Five groups of the configuration, which contain every type of value. The others would be read in the same way, but
/// reading all takes ten times as long.
struct Groups {
  barehand::RunParams run;
  barehand::PublishParams publish;
  barehand::CameraPlacement world;
  barehand::GivenIntrinsics foreign_camera;
  barehand::OpenNiParams openni2;
};
template <class V>
void visit(V& v, Groups& p) {
  v("run", p.run, "");
  v("publish", p.publish, "");
  v("world", p.world, "");
  v("foreign_camera", p.foreign_camera, "");
  v("openni2", p.openni2, "");
}

}  // namespace

/// Input: a configuration file. An accepted one must be the same after printing and reading it, and its camera pose in
/// the room must be a rigid motion.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  const fuzz::MemoryFile file(data, size);
  const auto config = load_config<Groups>(file.path());
  if (!config) return 0;
  const std::string text = print_config(*config, ConfigKeys::user);
  const fuzz::MemoryFile printed(text.data(), text.size());
  const auto again = load_config<Groups>(printed.path());
  CHECK(again && print_config(*again) == print_config(*config));
  if (const auto world = world_from(config->world); world && *world) CHECK((*world)->all_finite());
  return 0;
}
