// A driver to copy: simulates the depth of a wall that swings back and forth.
#include "drivers/sample/plane_source.h"

#include <cmath>
#include <numbers>

namespace barehand {
namespace {

constexpr Intrinsics kCamera = {320, 240, 262.5, 262.5, 159.5, 119.5};
constexpr double kDepthUnit = 0.0001;  // metres per unit of the depth image
constexpr double kPeriod = 2;          // duration of one swing [s]

}  // namespace

Result<std::unique_ptr<PlaneSource>> PlaneSource::open(const Options& options) {
  if (options.frames <= 0) return fail("no frames are asked for", "plane", "ask for at least one");
  if (!(options.fps > 0 && options.fps <= 1000))
    return fail("no camera has this frame rate", "plane", "give 1 to 1000");
  const double farthest = 65535 * kDepthUnit;  // the largest distance that 16 bits can hold
  if (!(options.near > 0 && options.near <= options.far && options.far <= farthest))
    return fail("the distances are not in order", "plane", "0 < near <= far <= " + std::to_string(farthest));
  return std::unique_ptr<PlaneSource>(new PlaneSource(options));
}

SourceEvent PlaneSource::next(std::chrono::milliseconds) {
  if (next_ >= options_.frames) return EndOfStream{};

  // Compute the distance of the wall at this time.
  const double time = static_cast<double>(next_) / options_.fps;
  const double swing = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * time / kPeriod);
  const double z = options_.near + swing * (options_.far - options_.near);

  // Make the frame with its capture time, its number, its camera and the unit of its depth.
  auto frame = std::make_shared<RgbdFrame>();
  frame->utime = 1'000'000 + std::llround(1e6 * time);
  frame->number = next_++;
  frame->camera = kCamera;
  frame->depth_unit = kDepthUnit;
  frame->depth =
      Image<std::uint16_t>(kCamera.width, kCamera.height, static_cast<std::uint16_t>(std::lround(z / kDepthUnit)));
  return FramePtr(std::move(frame));
}

}  // namespace barehand
