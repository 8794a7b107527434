// Finds the coefficients of lens distortion in a camera.json, and what looks like some but cannot be read.
#include "io/recording/lens_distortion.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "core/format.h"
#include "core/quote.h"

namespace barehand {
namespace {

using json_fields::Json;
using json_fields::Object;

constexpr std::array<const char*, 8> kNames = {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};  // OpenCV's order
constexpr std::array kLists = {"D",
                               "d",
                               "coeffs",
                               "dist_coeffs",
                               "distCoeffs",
                               "distortion_coefficients",
                               "distortion_coeffs",
                               "distortion_parameters",
                               "distortion"};
constexpr std::array kParts = {"distortion", "depth", "intrinsics", "depth_intrinsics", "intrinsic", "parameters"};

/// Coefficients in OpenCV's order.
struct Coefficients {
  std::vector<double> values;  ///< empty: none are given
  std::set<const Json*> read;  ///< the members of the file from which they were read
};

bool is_given(const Json& part, const char* key) { return part.contains(key) && !part.at(key).is_null(); }

/// The key of the list of coefficients in this part of the file; null if there is no such list.
const char* list_in(const Json& part) {
  for (const char* key : kLists) {
    if (!part.contains(key)) continue;
    const Json& value = part.at(key);
    const Json& list = value.is_object() && value.contains("data") ? value.at("data") : value;
    if (list.is_array() && !list.empty()) return key;
  }
  return nullptr;
}

/// The key of the part of the file that holds the coefficients; "" stands for the whole file.
std::string part_with_distortion(const Json& json) {
  for (const char* key : kParts) {
    if (!json.contains(key) || !json.at(key).is_object()) continue;
    const Json& part = json.at(key);
    if (list_in(part) || std::ranges::any_of(kNames, [&](const char* name) { return is_given(part, name); }))
      return key;
  }
  return "";
}

Result<Coefficients> coefficients_in(const Json& part, const std::string& where) {
  constexpr double kLargest = 1e9;
  Coefficients found;

  // A list is taken before single coefficients; OpenCV and ROS write it as the data of a matrix.
  if (const char* key = list_in(part)) {
    const Json& list = part.at(key);
    const bool matrix = list.is_object();
    const Object holder = matrix ? Object{list, where + ": " + key} : Object{part, where};
    const std::size_t count = matrix ? list.at("data").size() : list.size();
    auto values = holder.numbers(matrix ? "data" : key, count, -kLargest, kLargest);
    if (!values) return tl::unexpected(values.error());
    return Coefficients{*std::move(values), {&list}};
  }

  // Single coefficients that are not given are 0.
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (!is_given(part, kNames[i])) continue;
    const auto value = Object{part, where}.number(kNames[i], -kLargest, kLargest);
    if (!value) return tl::unexpected(value.error());
    found.values.resize(kNames.size(), 0);
    found.values[i] = *value;
    found.read.insert(&part.at(kNames[i]));
  }
  return found;
}

std::string in_lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
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
    std::string name = in_lower_case(json.at(key).get<std::string>());
    if (key == std::string("distortion_model") || name == "none" || is_other(name) || is_known(name)) return name;
  }
  return "";
}

/// Whether coefficients of distortion are usually found under this key.
bool is_name_of_distortion(const std::string& key) {
  const std::string name = in_lower_case(key);
  return has_part(name, {"distortion", "distcoef", "dist_coef"}) || name == "d" || name == "coeffs" ||
         name == "coefficients" || std::ranges::find(kNames, name) != kNames.end();
}

constexpr int kDeepest = 32;  // levels that are searched; a file that is damaged on purpose may have any number

/// Whether there is a number other than 0 in the value, also one that is written as a text.
bool holds_number(const Json& value, int level) {
  if (value.is_number()) return value != 0;
  if (value.is_string()) return value.get<std::string>().find_first_of("+-.[0123456789") == 0;
  return level < kDeepest && value.is_structured() &&
         std::ranges::any_of(value, [&](const Json& element) { return holds_number(element, level + 1); });
}

/// Adds to `paths` the keys, such as "depth_camera.D", of what looks like distortion and is not among what was read.
void find_unread(const Json& json, const std::set<const Json*>& read, const std::string& above, int level,
                 std::vector<std::string>& paths) {
  for (const auto& [key, value] : json.items()) {
    if (read.contains(&value)) continue;
    const std::string path = above + key;
    const std::size_t before = paths.size();
    if (value.is_structured() && level < kDeepest) find_unread(value, read, path + ".", level + 1, paths);
    if (paths.size() == before && is_name_of_distortion(key) && holds_number(value, level)) paths.push_back(path);
  }
}

std::string not_used(const std::vector<std::string>& paths) {
  const std::string more = paths.size() > 1 ? formatted(" and %zu more", paths.size() - 1) : "";
  return in_quotes(paths[0]) + more +
         ": looks like lens distortion and is not used (if these images have it, write k1, k2, p1, p2, k3, k4, k5, k6 "
         "as numbers, or as a list of numbers D in that order, both at the top)";
}

}  // namespace

Result<LensDistortion> read_distortion(const Json& json, const std::string& path) {
  constexpr std::size_t kMost = 8;  // further coefficients are for thin prisms and tilted sensors
  LensDistortion lens;
  if (const auto flag = json.find("rectified"); flag != json.end() && *flag == true) return lens;

  // Read the coefficients, and warn of others that were not understood.
  const std::string key = part_with_distortion(json);
  const Json& part = key.empty() ? json : json.at(key);
  auto found = coefficients_in(part, key.empty() ? path : path + ": " + key);
  if (!found) return tl::unexpected(found.error());
  std::vector<std::string> unread;
  find_unread(json, found->read, "", 0, unread);
  if (!unread.empty()) lens.warnings.push_back(path + ": " + not_used(unread));

  // If all are 0, there is nothing to correct.
  std::vector<double>& k = found->values;
  if (std::ranges::all_of(k, [](double value) { return value == 0; })) return lens;
  const std::string model = model_of(part).empty() ? model_of(json) : model_of(part);
  if (model == "none") return lens;

  // Warn of coefficients that cannot be used.
  const bool more =
      k.size() > kMost && std::any_of(k.begin() + kMost, k.end(), [](double value) { return value != 0; });
  if ((!model.empty() && !is_known(model)) || more) {
    lens.warnings.push_back(path + ": gives coefficients of lens distortion " +
                            (more ? "beyond k6" : "of the model \"" + model + "\"") +
                            ", which are not used: positions are wrong towards the edges of the image (undistort the "
                            "images, or give plumb_bob or rational coefficients)");
    return lens;
  }

  // Coefficients that are not given are 0.
  k.resize(kMost, 0);
  lens.coefficients = {k[0], k[1], k[2], k[3], k[4], k[5], k[6], k[7]};
  return lens;
}

}  // namespace barehand
