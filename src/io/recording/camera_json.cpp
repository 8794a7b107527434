// Reads the intrinsics and the distortion of a recording's camera from camera.json.
#include "io/recording/camera_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "io/file_bytes.h"
#include "io/hand/json_fields.h"
#include "sensor/camera_limits.h"

namespace barehand {
namespace {

using json_fields::Json;

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

/// The coefficients in OpenCV's order, from a list under one of its usual names; none if there is no such list.
std::optional<std::vector<double>> listed(const Json& json) {
  for (const char* key : {"D", "d", "coeffs", "dist_coeffs", "distCoeffs", "distortion_coefficients",
                          "distortion_coeffs", "distortion_parameters", "distortion"}) {
    if (!json.contains(key)) continue;
    const Json* list = &json.at(key);
    if (list->is_object() && list->contains("data")) list = &list->at("data");  // as OpenCV and ROS write matrices
    if (!list->is_array()) continue;
    std::vector<double> values;
    for (const Json& element : *list)
      if (element.is_number()) values.push_back(element.get<double>());
    return values;
  }
  return std::nullopt;
}

/// The coefficients in OpenCV's order, from one key for each of them; none if there are no such keys.
std::optional<std::vector<double>> named(const Json& json) {
  constexpr std::array<const char*, 8> kNames = {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
  std::vector<double> values(kNames.size(), 0);
  bool any = false;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (!json.contains(kNames[i]) || !json.at(kNames[i]).is_number()) continue;
    values[i] = json.at(kNames[i]).get<double>();
    any = true;
  }
  return any ? std::optional(values) : std::nullopt;
}

bool has_part(const std::string& name, std::initializer_list<const char*> parts) {
  return std::ranges::any_of(parts, [&](const char* part) { return name.find(part) != std::string::npos; });
}

/// Whether a distortion model of this name has other formulas than struct Distortion: those for wide-angle lenses, and
/// librealsense's variants of Brown and Conrady's.
bool is_other(const std::string& model) {
  return has_part(model, {"inverse", "modified", "fisheye", "fish_eye", "equidistant", "kannala", "theta", "fov",
                          "omni", "division"});
}

/// Whether the model's coefficients are those of struct Distortion.
bool is_known(const std::string& model) {
  return !is_other(model) && has_part(model, {"plumb", "brown", "rational", "radtan", "radial", "opencv", "pinhole"});
}

/// The name of the distortion model in lower case; "" if none is stated. The key `model` may also hold the camera's
/// product name.
std::string model_of(const Json& json) {
  for (const char* key : {"distortion_model", "distortion", "model", "camera_model", "type"}) {
    if (!json.contains(key) || !json.at(key).is_string()) continue;
    std::string name = json.at(key).get<std::string>();
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (key == std::string("distortion_model") || name == "none" || is_other(name) || is_known(name)) return name;
  }
  return "";
}

/// The object that holds the coefficients of distortion: the whole file, or one of its parts.
const Json& part_with_distortion(const Json& json) {
  for (const char* key : {"distortion", "depth", "intrinsics", "depth_intrinsics", "intrinsic", "parameters"})
    if (json.contains(key) && json.at(key).is_object() && (listed(json.at(key)) || named(json.at(key))))
      return json.at(key);
  return json;
}

void read_distortion(const Json& json, const std::string& path, CameraFile& file) {
  constexpr std::size_t kMost = 8;  // further coefficients are for thin prisms and tilted sensors

  // Find the coefficients; if all are 0 or the images are rectified, there is nothing to correct.
  const Json& part = part_with_distortion(json);
  auto values = listed(part);
  if (!values || values->empty()) values = named(part);
  if (!values || std::ranges::all_of(*values, [](double k) { return k == 0; })) return;
  if (const auto flag = json.find("rectified"); flag != json.end() && *flag == true) return;

  const std::string model = model_of(part).empty() ? model_of(json) : model_of(part);
  if (model == "none") return;

  // Warn of coefficients that cannot be used.
  const bool more =
      values->size() > kMost && std::any_of(values->begin() + kMost, values->end(), [](double k) { return k != 0; });
  if ((!model.empty() && !is_known(model)) || more) {
    file.warnings.push_back(path + ": gives coefficients of lens distortion " +
                            (more ? "beyond k6" : "of the model \"" + model + "\"") +
                            ", which are not used: positions are wrong towards the edges of the image (undistort the "
                            "images, or give plumb_bob or rational coefficients)");
    return;
  }

  // Coefficients that are not given are 0.
  values->resize(kMost, 0);
  const auto& k = *values;
  file.distortion = {k[0], k[1], k[2], k[3], k[4], k[5], k[6], k[7]};
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
  read_distortion(*json, path, file);
  return file;
}

}  // namespace barehand
