// Reads a recording's camera from camera.json.
#include "io/recording/camera_json.h"

#include <cmath>

#include "io/file_bytes.h"
#include "io/hand/json_fields.h"
#include "io/recording/lens_distortion.h"
#include "sensor/camera_limits.h"

namespace barehand {
namespace {

Result<int> whole_number(const json_fields::Object& object, const char* key) {
  const auto value = object.number(key, 1, 16384);
  if (!value) return tl::unexpected(value.error());
  if (*value != std::floor(*value)) return fail(std::string("\"") + key + "\" is not a whole number", object.where);
  return static_cast<int>(*value);
}

Result<void> read_numbers(const json_fields::Object& object, CameraFile& file) {
  Intrinsics& camera = file.camera;
  const auto put = [](auto& target) { return [&target](auto value) { target = value; }; };
  double units = 0;

  // Read field by field, until the first error.
  return whole_number(object, "width")
      .map(put(camera.width))
      .and_then([&] { return whole_number(object, "height").map(put(camera.height)); })
      .and_then([&] { return object.number("fx", 1, kLargestFocal).map(put(camera.fx)); })
      .and_then([&] { return object.number("fy", 1, kLargestFocal).map(put(camera.fy)); })
      .and_then([&] { return object.number("cx", -kLargestFocal, kLargestFocal).map(put(camera.cx)); })
      .and_then([&] { return object.number("cy", -kLargestFocal, kLargestFocal).map(put(camera.cy)); })
      .and_then([&] { return object.number("depth_units_per_metre", 1, 1e7).map(put(units)); })
      .and_then([&] { return object.number_or("fps", 0, 0, 10000).map(put(file.fps)); })

      // Check the size of the image as a whole.
      .and_then([&]() -> Result<void> {
        file.depth_unit = 1 / units;
        if (plausible(camera)) return {};
        return fail("\"width\" and \"height\" make too large an image", object.where,
                    "it must have at most 4096 x 4096 pixels");
      });
}

}  // namespace

Result<CameraFile> read_camera_json(const std::string& path) {
  if (is_missing(path))
    return fail("is missing: without the camera's intrinsics depth has no scale", path,
                "write width, height, fx, fy, cx, cy and depth_units_per_metre, see docs/formats.md");
  const auto json = json_fields::read_json(path);
  if (!json) return tl::unexpected(json.error());
  if (!json->is_object()) return fail("does not hold a JSON object", path, "see docs/formats.md");
  CameraFile file;
  if (const auto read = read_numbers({*json, path}, file); !read) return tl::unexpected(read.error());
  auto lens = read_distortion(*json, path);
  if (!lens) return tl::unexpected(lens.error());
  file.distortion = lens->coefficients;
  file.warnings = std::move(lens->warnings);
  return file;
}

}  // namespace barehand
