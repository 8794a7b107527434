#include "io/recording_writer.h"

#include <filesystem>
#include <fstream>

#include "core/format.h"
#include "io/image_file.h"
#include "io/json_fields.h"

namespace barehand {
namespace {

namespace fs = std::filesystem;

std::string image_name(const char* folder, std::int64_t number, const std::string& ending) {
  return formatted("%s/%06lld.", folder, static_cast<long long>(number)) + ending;
}

std::string stamp_text(std::int64_t utime) {
  return formatted("%lld.%06lld", static_cast<long long>(utime / 1'000'000), static_cast<long long>(utime % 1'000'000));
}

}  // namespace

Result<RecordingWriter> RecordingWriter::create(const std::string& directory, Options options) {
  std::error_code error;
  if (fs::exists(directory + "/depth.txt", error))
    return fail("already holds a recording", directory, "choose another folder or remove it first");
  fs::create_directories(directory + "/depth", error);
  if (error) return fail("cannot be made: " + error.message(), directory, "check the path and its permissions");
  RecordingWriter writer;
  writer.directory_ = directory;
  writer.options_ = std::move(options);
  return writer;
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
  return append("depth.txt", "# timestamp filename\n");
}

Result<void> RecordingWriter::append(const std::string& list, const std::string& line) const {
  const std::string path = directory_ + "/" + list;
  std::error_code error;
  const auto size = fs::file_size(path, error);
  std::ofstream file(path, std::ios::app);
  file << line;
  file.close();
  if (file) return {};
  fs::resize_file(path, error ? 0 : size, error);  // half a line would make the whole list unreadable
  return fail("cannot be written", path, "check permissions and free space");
}

Result<std::int64_t> RecordingWriter::write(const RgbdFrame& frame) {
  if (!started_)
    if (const auto started = start(frame); !started) return tl::unexpected(started.error());
  started_ = true;
  if (!(frame.camera == camera_) || frame.depth_unit != depth_unit_)
    return fail("the camera changed at frame " + std::to_string(count_), directory_, "a recording has one camera");
  if (frame.utime < last_utime_)
    return fail("the time goes back at frame " + std::to_string(count_), directory_,
                "a folder cannot hold that, an LCM log can");

  const std::string depth_file = image_name("depth", count_, "png");
  if (const auto written = write_depth_png(directory_ + "/" + depth_file, frame.depth); !written)
    return tl::unexpected(written.error());
  if (!frame.colour.empty()) {
    const std::string colour_file = image_name("rgb", count_, options_.colour_ending);
    std::error_code ignored;  // a folder that cannot be made shows when the image is written
    fs::create_directories(directory_ + "/rgb", ignored);
    const auto written = write_colour(directory_ + "/" + colour_file, frame.colour).and_then([&] {
      return append("rgb.txt", stamp_text(frame.utime) + " " + colour_file + "\n");
    });
    if (!written) return tl::unexpected(written.error());
  }
  const auto appended = append("depth.txt", stamp_text(frame.utime) + " " + depth_file + "\n");
  if (!appended) return tl::unexpected(appended.error());
  last_utime_ = frame.utime;
  return count_++;
}

}  // namespace barehand
