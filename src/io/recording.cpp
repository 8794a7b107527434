#include "io/recording.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/file_bytes.h"
#include "io/image_file.h"
#include "io/json_fields.h"
#include "io/stamped_list.h"
#include "math/camera_limits.h"

namespace barehand {
namespace {

namespace fs = std::filesystem;

Result<int> whole_number(const json_fields::Object& object, const char* key) {
  const auto value = object.number(key, 1, 16384);
  if (!value) return tl::unexpected(value.error());
  if (*value != std::floor(*value)) return fail(std::string("\"") + key + "\" is no whole number", object.where);
  return static_cast<int>(*value);
}

Result<void> read_camera(const std::string& path, Recording& recording) {
  if (is_missing(path))
    return fail("is missing: without the camera's intrinsics depth has no scale", path,
                "write width, height, fx, fy, cx, cy and depth_units_per_metre, see docs/formats.md");
  const auto json = json_fields::read_json(path);
  if (!json) return tl::unexpected(json.error());
  if (!json->is_object()) return fail("holds no JSON object", path, "see docs/formats.md");
  const json_fields::Object object{*json, path};
  Intrinsics& camera = recording.camera;
  const auto put = [](auto& target) { return [&target](auto value) { target = value; }; };
  double units = 0;
  return whole_number(object, "width")
      .map(put(camera.width))
      .and_then([&] { return whole_number(object, "height").map(put(camera.height)); })
      .and_then([&] { return object.number("fx", 1, kLargestFocal).map(put(camera.fx)); })
      .and_then([&] { return object.number("fy", 1, kLargestFocal).map(put(camera.fy)); })
      .and_then([&] { return object.number("cx", -kLargestFocal, kLargestFocal).map(put(camera.cx)); })
      .and_then([&] { return object.number("cy", -kLargestFocal, kLargestFocal).map(put(camera.cy)); })
      .and_then([&] { return object.number("depth_units_per_metre", 1, 1e7).map(put(units)); })
      .and_then([&] { return object.number_or("fps", 0, 0, 10000).map(put(recording.fps)); })
      .and_then([&]() -> Result<void> {
        recording.depth_unit = 1 / units;
        if (plausible(camera)) return {};
        return fail("\"width\" and \"height\" make too large an image", path,
                    "it must have at most 4096 x 4096 pixels");
      });
}

/// The typical time between two frames [us].
std::int64_t frame_interval(const std::vector<StampedFile>& depth) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < depth.size(); ++i) steps.push_back(depth[i].utime - depth[i - 1].utime);
  if (steps.empty()) return 50'000;
  std::nth_element(steps.begin(), steps.begin() + steps.size() / 2, steps.end());
  return std::max<std::int64_t>(steps[steps.size() / 2], 1);
}

/// The file nearest in time, or "" if none lies within one frame interval: older colour belongs to another pose.
std::string nearest_file(const std::vector<StampedFile>& sorted, std::int64_t utime, std::int64_t window) {
  const auto after = std::lower_bound(sorted.begin(), sorted.end(), utime,
                                      [](const StampedFile& file, std::int64_t t) { return file.utime < t; });
  auto best = after;
  if (after == sorted.end() || (after != sorted.begin() && utime - std::prev(after)->utime <= after->utime - utime))
    best = after == sorted.begin() ? after : std::prev(after);
  if (best == sorted.end() || std::abs(best->utime - utime) > window) return {};
  return best->file;
}

Result<std::vector<StampedFile>> read_colour_list(const std::string& directory) {
  const std::string path = directory + "/rgb.txt";
  if (is_missing(path)) return std::vector<StampedFile>{};
  auto files = read_stamped_list(path);
  if (files)
    std::stable_sort(files->begin(), files->end(),
                     [](const StampedFile& a, const StampedFile& b) { return a.utime < b.utime; });
  return files;
}

Result<void> check_order(const std::vector<StampedFile>& depth, const std::string& path) {
  if (depth.empty()) return fail("lists no frames", path, "the recording is empty");
  for (std::size_t i = 1; i < depth.size(); ++i)
    if (depth[i].utime < depth[i - 1].utime)
      return fail("line " + std::to_string(depth[i].line) + ": the time stamp goes back", path,
                  "put the lines in order of time");
  return {};
}

/// One look at the start, so that a wrong camera.json stops the run instead of having every frame skipped.
Result<void> check_first_image(const Recording& recording) {
  const auto image = read_depth_png(recording.entries.front().depth_file);
  if (!image) return {};  // one bad file is a skipped frame, not a bad recording
  return check_size(image->width(), image->height(), recording.camera, recording.entries.front().depth_file);
}

}  // namespace

Result<Recording> open_recording(const std::string& directory) {
  std::error_code error;
  if (!fs::is_directory(directory, error))
    return fail("is no folder" + (error ? ": " + error.message() : ""), directory, "name a recording folder");
  Recording recording;
  recording.directory = directory;
  if (const auto camera = read_camera(directory + "/camera.json", recording); !camera)
    return tl::unexpected(camera.error());
  const std::string list = directory + "/depth.txt";
  const auto depth = read_stamped_list(list);
  if (!depth) return tl::unexpected(depth.error());
  if (const auto order = check_order(*depth, list); !order) return tl::unexpected(order.error());
  const auto colour = read_colour_list(directory);
  if (!colour) return tl::unexpected(colour.error());

  const std::int64_t window = frame_interval(*depth);
  for (const StampedFile& file : *depth) {
    const bool repeats = !recording.entries.empty() && recording.entries.back().utime == file.utime;
    recording.entries.push_back({file.utime, file.file, nearest_file(*colour, file.utime, window), repeats});
  }
  if (const auto first = check_first_image(recording); !first) return tl::unexpected(first.error());
  return recording;
}

Result<FramePtr> read_frame(const Recording& recording, std::int64_t number) {
  const RecordingEntry& entry = recording.entries.at(static_cast<std::size_t>(number));
  auto frame = std::make_shared<RgbdFrame>();
  frame->utime = entry.utime;
  frame->number = number;
  frame->camera = recording.camera;
  frame->depth_unit = recording.depth_unit;
  auto depth = read_depth_png(entry.depth_file);
  if (!depth) return tl::unexpected(depth.error());
  const auto depth_size = check_size(depth->width(), depth->height(), recording.camera, entry.depth_file);
  if (!depth_size) return tl::unexpected(depth_size.error());
  frame->depth = std::move(*depth);
  if (entry.colour_file.empty()) return frame;
  auto colour = read_colour(entry.colour_file);
  if (!colour) return tl::unexpected(colour.error());
  const auto colour_size = check_size(colour->width(), colour->height(), recording.camera, entry.colour_file);
  if (!colour_size) return tl::unexpected(colour_size.error());
  frame->colour = std::move(*colour);
  return frame;
}

}  // namespace barehand
