// The command-line options that `barehand record` and `barehand convert` have in common.
#include <CLI/CLI.hpp>

#include "app/record/run_copy.h"
#include "app/shared/outputs.h"
#include "io/lcm/message_sink.h"

namespace barehand {

void add_copy_options(CLI::App& command, CopyRequest& request) {
  CopyRequest& r = request;

  // Add options for which frames are copied.
  command.add_option("--start", r.source.start, "first frame of a recording");
  command.add_option("--step", r.source.step, "every N-th frame")->check(CLI::PositiveNumber)->capture_default_str();
  command.add_option("--frames", r.frames, "stop after this many frames")->check(CLI::Range(1, 1'000'000'000));
  command.add_option("--channel", r.source.channel,
                     "glob of the LCM channels, or of an MCAP file's topics with depth; default: live the first of "
                     "*RGBD_FRAME that brings a frame, in a file the only one that has some");

  // Add options for the camera of live frames and of messages from other programs.
  command.add_option("--config", r.config, "as for track; only the groups openni2 and foreign_camera matter");
  command.add_option(
      "--fx", r.source.foreign.fx,
      "focal length [px] of frames that come without (kinect, bot_core, some bags), or instead of an OpenNI2 sensor's "
      "own; give all four");
  command.add_option("--fy", r.source.foreign.fy, "vertical focal length [px]");
  command.add_option("--cx", r.source.foreign.cx, "principal point [px]");
  command.add_option("--cy", r.source.foreign.cy, "vertical principal point [px]");

  // Add options for how the images are encoded.
  command.add_option("--colour", r.colour, "png and raw are lossless; raw is for logs only")
      ->check(CLI::IsMember({"png", "jpeg", "raw", "none"}))
      ->capture_default_str();
  command.add_option("--jpeg-quality", r.jpeg_quality, "JPEG quality of --colour jpeg in a log")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command.add_option("--depth", r.depth, "how a log holds depth; all are lossless, rvl is smallest and fastest")
      ->check(CLI::IsMember({"rvl", "zlib", "raw"}))
      ->capture_default_str();

  // Add options for the written file.
  command.add_option("--out-channel", r.out_channel, "LCM channel in the written log")
      ->check([](const std::string& name) {
        return name.empty() || name.size() > kLongestChannel ? "channel names have 1 to 63 bytes" : "";
      })
      ->capture_default_str();
  add_overwrite_option(command, r.overwrite);
}

}  // namespace barehand
