// Writes a recording folder.
#include "io/recording/recording_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>

#include "core/format.h"
#include "io/hand/json_fields.h"
#include "io/recording/image_file.h"

namespace barehand {
namespace {

namespace fs = std::filesystem;

std::string image_name(const char* folder, std::int64_t number, const std::string& ending) {
  return formatted("%s/%06lld.", folder, static_cast<long long>(number)) + ending;
}

std::string stamp_text(std::int64_t utime) {
  const auto us = static_cast<unsigned long long>(std::abs(utime));
  return formatted("%s%llu.%06llu", utime < 0 ? "-" : "", us / 1'000'000, us % 1'000'000);
}

}  // namespace

Result<RecordingWriter> RecordingWriter::create(const std::string& directory, Options options) {
  std::error_code error;
  // Refuse a folder that contains parts of another recording.
  const std::string unfinished = directory + "/depth.txt" + std::string(kUnfinished);
  if (fs::exists(unfinished, error))
    return fail("holds a recording that was not finished", directory,
                "choose another folder, or rename " + unfinished + " to depth.txt to use it");
  for (const char* name : {"depth.txt", "rgb.txt", "camera.json"})
    if (fs::exists(directory + "/" + name, error))
      return fail(std::string("already holds a recording: there is ") + name, directory,
                  "choose another folder or remove it first: recordings in folders are never replaced");

  // Refuse a folder with images that a list no longer names.
  for (const char* name : {"depth", "rgb"})
    if (const std::string images = directory + "/" + name;
        fs::is_directory(images, error) && !fs::is_empty(images, error))
      return fail("already holds images", images, "choose another folder or remove them first");

  // Create the folder, and note whether it was new, so that an empty recording leaves nothing behind.
  RecordingWriter writer;
  writer.directory_ = directory;
  writer.options_ = std::move(options);
  writer.made_ = !fs::exists(directory, error);
  fs::create_directories(directory + "/depth", error);
  if (error) return fail("cannot be created: " + error.message(), directory, "check the path and its permissions");
  return writer;
}

RecordingWriter::~RecordingWriter() {
  const bool moved_away = !depth_list_ || depth_list_->draft().empty();
  if (!moved_away && count_ > 0) (void)finish();
}

Result<void> RecordingWriter::start(const RgbdFrame& first) {
  camera_ = first.camera;
  depth_unit_ = first.depth_unit;
  json_fields::Json json = {{"width", camera_.width},
                            {"height", camera_.height},
                            {"fx", camera_.fx},
                            {"fy", camera_.fy},
                            {"cx", camera_.cx},
                            {"cy", camera_.cy},
                            {"depth_units_per_metre", json_fields::rounded(1 / depth_unit_)}};
  if (options_.fps > 0) json["fps"] = options_.fps;
  if (const auto written = json_fields::write_json(directory_ + "/camera.json", json); !written) return written;
  return append(depth_list_, "depth.txt", "# timestamp filename\n");
}

Result<void> RecordingWriter::append(std::optional<AtomicFile>& list, const char* name, const std::string& line) const {
  // The draft is created with the first line.
  const bool first = !list;
  if (first) {
    auto made = AtomicFile::create(directory_ + "/" + name, false);
    if (!made) return tl::unexpected(made.error());
    list.emplace(std::move(*made));
  }

  std::error_code error;
  const auto size = fs::file_size(list->draft(), error);
  std::ofstream file(list->draft(), std::ios::app);
  file << line;
  file.close();
  if (file) return {};

  // Cut an incomplete line off, since it would make the whole list unreadable.
  const std::string path = list->draft();
  fs::resize_file(path, error ? 0 : size, error);
  if (first) list.reset();
  return fail("cannot be written", path, "check permissions and free space");
}

Result<void> RecordingWriter::finish() {
  if (std::exchange(finished_, true)) return {};

  // Remove the traces of a recording without frames.
  std::error_code ignored;
  if (count_ == 0) {
    depth_list_.reset();
    rgb_list_.reset();
    fs::remove(directory_ + "/camera.json", ignored);
    fs::remove(directory_ + "/depth", ignored);  // only if they are empty
    fs::remove(directory_ + "/rgb", ignored);
    if (made_) fs::remove(directory_, ignored);
    return {};
  }

  // Write the images to the disk first, all at once.
  if (const int folder = open(directory_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); folder >= 0) {
    (void)syncfs(folder);
    close(folder);
  }

  // Finish the list of depth last, since its name marks the recording as complete.
  const auto colour = rgb_list_ ? rgb_list_->finish() : Result<void>();
  const auto depth = depth_list_->finish();
  return colour ? depth : colour;
}

Result<std::int64_t> RecordingWriter::write(const RgbdFrame& frame) {
  // Check that the frame fits the recording, which starts with the first one.
  if (finished_) return fail("the recording is finished, nothing more is written", directory_);
  if (!depth_list_)
    if (const auto started = start(frame); !started) return tl::unexpected(started.error());
  if (!(frame.camera == camera_) || frame.depth_unit != depth_unit_)
    return fail("the camera changed at frame " + std::to_string(count_), directory_, "a recording has one camera");

  // Write the depth image.
  const std::string depth_file = image_name("depth", count_, "png");
  if (const auto written = write_depth_png(directory_ + "/" + depth_file, frame.depth); !written)
    return tl::unexpected(written.error());

  // Write the colour image, if there is one, and its line of the list.
  if (!frame.colour.empty()) {
    const std::string colour_file = image_name("rgb", count_, options_.colour_ending);
    std::error_code ignored;  // a folder that cannot be created is reported when the image is written
    fs::create_directories(directory_ + "/rgb", ignored);
    const auto written = write_colour(directory_ + "/" + colour_file, frame.colour).and_then([&] {
      return append(rgb_list_, "rgb.txt", stamp_text(frame.utime) + " " + colour_file + "\n");
    });
    if (!written) return tl::unexpected(written.error());
  }

  // List the depth image last, so that a listed frame is complete.
  const auto appended = append(depth_list_, "depth.txt", stamp_text(frame.utime) + " " + depth_file + "\n");
  if (!appended) return tl::unexpected(appended.error());
  return count_++;
}

}  // namespace barehand
