// Opens a recording folder (its camera, images and time stamps), and reads, checks and undistorts its frames.
#include "io/recording/recording.h"

#include <algorithm>
#include <filesystem>

#include "core/format.h"
#include "io/file_bytes.h"
#include "io/recording/camera_json.h"
#include "io/recording/colour_pairs.h"
#include "io/recording/image_file.h"
#include "io/recording/stamped_list.h"
#include "sensor/frame_order.h"

namespace barehand {
namespace {

namespace fs = std::filesystem;

/// Reads rgb.txt; empty if there is no such list. A list that is invalid or empty becomes a warning.
std::vector<StampedFile> read_colour_list(Recording& recording) {
  const std::string path = recording.directory + "/rgb.txt";
  if (is_missing(path)) return {};
  auto files = read_stamped_list(path);
  if (!files || files->empty()) {
    recording.warnings.push_back(files ? path + ": lists no images; depth is used without colour"
                                       : files.error().message() + "; depth is used without colour");
    return {};
  }
  return *std::move(files);
}

std::vector<std::int64_t> times_of(const std::vector<StampedFile>& files) {
  std::vector<std::int64_t> times;
  for (const StampedFile& file : files) times.push_back(file.utime);
  return times;
}

/// What is suspicious about the unit of time stamps in any order, by unlikely_steps(); "" if nothing is.
std::string unlikely_times(std::vector<std::int64_t> times) {
  if (times.empty()) return "";
  std::ranges::sort(times);
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  return unlikely_steps(std::move(steps), times.back(), StampUnit::seconds);
}

/// Lists the frames of depth.txt with their colour images, and marks the frames that their time stamps rule out.
void list_frames(const std::vector<StampedFile>& depth, Recording& recording) {
  // Assign a colour image to each depth image.
  const std::vector<StampedFile> colour = read_colour_list(recording);
  const ColourPairs pairs = pair_colour(times_of(depth), times_of(colour));
  FrameOrder order(StampUnit::seconds);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const StampedFile& file = depth[i];

    // Make the entry of the frame, which says why it has no colour if the recording has some.
    RecordingEntry entry{file.utime, file.file, {}, {}, {}};
    if (pairs.colour[i]) entry.colour_file = colour[*pairs.colour[i]].file;
    if (entry.colour_file.empty() && !colour.empty())
      entry.colour_fault =
          formatted("rgb.txt lists none within %.3f s of it", 1e-6 * static_cast<double>(pairs.window));

    // Mark the frame as unusable if its time stamp cannot be right.
    const auto number = static_cast<std::int64_t>(recording.entries.size());
    if (const auto used = order.number(file.utime, number); !used) entry.fault = used.error().message();
    recording.entries.push_back(std::move(entry));
  }

  // Say why most frames have no colour if the stamps of rgb.txt explain it.
  const auto coloured = std::ranges::count_if(pairs.colour, [](const auto& found) { return found.has_value(); });
  if (const std::string unlikely = unlikely_times(times_of(colour));
      !unlikely.empty() && 2 * coloured < std::ssize(depth))
    recording.warnings.push_back(recording.directory + "/rgb.txt: " + unlikely + "; most depth is used without colour");

  // Pass on what is suspicious about the time stamps as a whole.
  for (const std::string& warning : order.take_last_warnings())
    recording.warnings.push_back(recording.directory + "/depth.txt: " + warning);
}

/// Sets the camera of the recording. If its coefficients of distortion are plausible, the images will be undistorted.
void use_camera(CameraFile file, const std::string& path, Recording& recording) {
  constexpr double kNoticed = 0.5;  // smallest shift that is corrected [px]
  constexpr double kLeast = 0.5;    // smallest fraction of the image that must stay visible

  // Take over what the file says.
  recording.camera = file.camera;
  recording.depth_unit = file.depth_unit;
  recording.fps = file.fps;
  recording.warnings = std::move(file.warnings);
  if (file.distortion == Distortion{}) return;

  // Undistort the images if the shift is noticeable and the coefficients are plausible.
  auto undistortion = std::make_shared<const Undistortion>(file.camera, file.distortion);
  if (undistortion->shown() < kLeast) {
    recording.warnings.push_back(path +
                                 ": these coefficients of lens distortion are implausible and not used (are they in "
                                 "the order k1, k2, p1, p2, k3, k4, k5, k6?)");
  } else if (undistortion->largest_shift() > kNoticed) {
    // Report the correction, since images that are rectified already would be distorted by it.
    recording.warnings.push_back(
        path + formatted(": the images are undistorted with the coefficients given, by up to %.3g pixels (if they are "
                         "rectified already, add \"rectified\": true)",
                         undistortion->largest_shift()));
    recording.undistortion = std::move(undistortion);
  }
}

/// Checks the first image, so that a wrong camera.json stops the run instead of having every frame skipped.
Result<void> check_first_image(const Recording& recording) {
  const auto image = read_depth_png(recording.entries.front().depth_file);
  if (!image) return {};  // one bad file is a skipped frame, not a bad recording
  return check_size(image->width(), image->height(), recording.camera, recording.entries.front().depth_file);
}

/// Reads the colour image of a frame, or returns why it cannot be used.
Result<Image<Rgb>> read_frame_colour(const Recording& recording, const std::string& path) {
  auto colour = read_colour(path);
  if (!colour) return colour;
  const Intrinsics& camera = recording.camera;
  if (colour->width() != camera.width || colour->height() != camera.height)
    return fail(formatted("is %dx%d, depth is %dx%d", colour->width(), colour->height(), camera.width, camera.height),
                path, "register colour to depth: the same pixel must be the same ray");
  return colour;
}

}  // namespace

Result<Recording> open_recording(const std::string& directory) {
  // Check that there is a folder.
  std::error_code error;
  if (!fs::is_directory(directory, error))
    return fail("is not a folder" + (error ? ": " + error.message() : ""), directory, "give a recording folder");

  // Read the camera.
  Recording recording;
  recording.directory = directory;
  const std::string camera_path = directory + "/camera.json";
  auto camera = read_camera_json(camera_path);
  if (!camera) return tl::unexpected(camera.error());
  use_camera(*std::move(camera), camera_path, recording);

  // Read the list of frames, and check that the first image suits the camera.
  const std::string list = directory + "/depth.txt";
  const auto depth = read_stamped_list(list);
  if (!depth) return tl::unexpected(depth.error());
  if (depth->empty()) return fail("lists no frames", list, "the recording is empty");
  list_frames(*depth, recording);
  if (const auto first = check_first_image(recording); !first) return tl::unexpected(first.error());
  return recording;
}

Result<FramePtr> read_frame(const Recording& recording, std::int64_t number) {
  // Take over what the list and the camera say of the frame.
  const RecordingEntry& entry = recording.entries.at(static_cast<std::size_t>(number));
  auto frame = std::make_shared<RgbdFrame>();
  frame->utime = entry.utime;
  frame->number = number;
  frame->camera = recording.camera;
  frame->depth_unit = recording.depth_unit;

  // Read the depth, which must have the size of the camera's images.
  auto depth = read_depth_png(entry.depth_file);
  if (!depth) return tl::unexpected(depth.error());
  const auto depth_size = check_size(depth->width(), depth->height(), recording.camera, entry.depth_file);
  if (!depth_size) return tl::unexpected(depth_size.error());

  // Undistort the depth if the lens requires it.
  const Undistortion* lens = recording.undistortion.get();
  frame->depth = lens ? lens->apply(*depth) : std::move(*depth);

  // Tracking needs depth only, so a frame without colour is used.
  frame->colour_fault = entry.colour_fault;
  if (entry.colour_file.empty()) return frame;
  auto colour = read_frame_colour(recording, entry.colour_file);
  if (colour)
    frame->colour = lens ? lens->apply(*colour) : std::move(*colour);
  else
    frame->colour_fault = colour.error().message();
  return frame;
}

}  // namespace barehand
