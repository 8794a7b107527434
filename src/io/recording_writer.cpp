#include "io/recording_writer.h"

#include <cmath>
#include <filesystem>

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
  depth_list_.open(directory_ + "/depth.txt");
  depth_list_ << "# timestamp filename" << std::endl;
  if (!depth_list_) return fail("cannot be written", directory_ + "/depth.txt", "check permissions and free space");
  return {};
}

Result<void> RecordingWriter::append(std::ofstream& list, const std::string& list_name, std::int64_t utime,
                                     const std::string& file) {
  if (!list.is_open()) list.open(directory_ + "/" + list_name);
  list << stamp_text(utime) + " " + file + "\n" << std::flush;
  if (!list) return fail("cannot be written", directory_ + "/" + list_name, "check permissions and free space");
  return {};
}

Result<std::int64_t> RecordingWriter::write(const RgbdFrame& frame) {
  if (count_ == 0)
    if (const auto started = start(frame); !started) return tl::unexpected(started.error());
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
      return append(colour_list_, "rgb.txt", frame.utime, colour_file);
    });
    if (!written) return tl::unexpected(written.error());
  }
  const auto appended = append(depth_list_, "depth.txt", frame.utime, depth_file);
  if (!appended) return tl::unexpected(appended.error());
  last_utime_ = frame.utime;
  return count_++;
}

}  // namespace barehand
