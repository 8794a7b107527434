#include "sensor/camera_warnings.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/format.h"

namespace barehand {
namespace {

// Finds unlikely intrinsics and their probable cause.

struct Size {
  int width, height;
};
/// Image sizes of common depth and colour cameras: Kinect v1 and v2, Azure Kinect, RealSense, Orbbec, Xtion.
constexpr std::array<Size, 22> kCommonSizes = {
    {{160, 120},   {320, 240},  {320, 288},  {424, 240},  {480, 270},   {480, 360},  {512, 424}, {512, 512},
     {640, 360},   {640, 400},  {640, 480},  {640, 576},  {800, 600},   {848, 480},  {960, 540}, {1024, 768},
     {1024, 1024}, {1280, 720}, {1280, 800}, {1280, 960}, {1280, 1024}, {1920, 1080}}};

constexpr double kNarrowest = 10, kWidest = 150;  // plausible fields of view [degrees]
// Largest plausible distance of the principal point from the image centre, as a fraction of the image size.
constexpr double kFarOff = 0.2;
// A principal point within this distance of an image's centre, as a fraction of its size, identifies the image size.
constexpr double kNear = 0.05;
// Largest plausible ratio of the two focal lengths, since pixels are nearly square.
constexpr double kOblong = 1.25;

/// Distance of the coordinate `c` [px] from the image centre, as a fraction of the image size.
double off_centre(double c, int size) { return std::abs(c - 0.5 * (size - 1)) / size; }

/// Field of view [degrees] of an image side of `size` pixels.
double field_of_view(double focal, int size) { return 2 * std::atan(0.5 * size / focal) * 180 / std::numbers::pi; }

/// The common image size whose centre is nearest to the principal point; none if no centre is near it.
std::optional<Size> size_for(const Intrinsics& camera) {
  std::optional<Size> best;
  double least = 2 * kNear;
  for (const Size& size : kCommonSizes) {
    const double u = off_centre(camera.cx, size.width), v = off_centre(camera.cy, size.height);
    if (u > kNear || v > kNear || u + v >= least) continue;
    least = u + v;
    best = size;
  }
  return best;
}

}  // namespace

std::vector<std::string> camera_warnings(const Intrinsics& camera) {
  std::vector<std::string> warnings;

  // Check the field of view.
  const double wide = field_of_view(camera.fx, camera.width), high = field_of_view(camera.fy, camera.height);
  for (const auto& [name, focal, size, angle] :
       {std::tuple("fx", camera.fx, camera.width, wide), std::tuple("fy", camera.fy, camera.height, high)}) {
    if (angle >= kNarrowest && angle <= kWidest) continue;
    warnings.push_back(
        formatted("%s = %.6g is a field of view of %.3g degrees over %d pixels: is it in pixels, and of "
                  "this image size?",
                  name, focal, angle, size));
    break;  // one warning is enough, since the other focal length is most likely wrong in the same way
  }

  // Check that the pixels are roughly square.
  if (std::max(camera.fx, camera.fy) > kOblong * std::min(camera.fx, camera.fy))
    warnings.push_back(
        formatted("fx = %.6g and fy = %.6g differ by more than a quarter: is one of them of another image "
                  "size?",
                  camera.fx, camera.fy));

  // Check the principal point.
  if (off_centre(camera.cx, camera.width) > kFarOff || off_centre(camera.cy, camera.height) > kFarOff) {
    const auto size = size_for(camera);

    // Guess the cause from the numbers.
    const std::string cause =
        size ? formatted("these look like the intrinsics of a %dx%d image", size->width, size->height)
        : std::abs(camera.cx) <= 1 && std::abs(camera.cy) <= 1
            ? "these look like fractions of the image size, but must be in pixels"
            : "are the intrinsics of this camera and image size?";

    // Warn of it, together with the cause.
    warnings.push_back(
        formatted("the principal point (cx, cy) = (%.6g, %.6g) is far from the middle of the %dx%d image: ", camera.cx,
                  camera.cy, camera.width, camera.height) +
        cause);
  }
  return warnings;
}

}  // namespace barehand
