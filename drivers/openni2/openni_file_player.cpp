// OpenNiFilePlayer reads an .oni file image by image, each exactly once, and pairs depth with colour.
// OpenNiFileSource adds the first frame to play and the step between frames.
#include "drivers/openni2/openni_file_player.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "drivers/openni2/frames/pixels.h"
#include "drivers/openni2/frames/video_modes.h"
#include "drivers/openni2/library.h"
#include "drivers/openni2/openni_file_source.h"

namespace barehand {
namespace {

constexpr std::chrono::milliseconds kPatience{10'000};  // longest wait for an image from a slow disk
constexpr std::string_view kMagic = "NI10";
constexpr const char* kRemedyIncomplete =
    "give a complete .oni recording: if the recorder was killed, the table of frames is missing";

/// Another path of the file, which OpenNI2 does not know yet: it identifies a file by its path, and a second reader of
/// the same path would continue where the first one stopped. The descriptor stays open, like the player's handles.
std::string name_of_its_own(const std::string& path) {
  return "/proc/self/fd/" + std::to_string(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
}

}  // namespace

Result<std::unique_ptr<OpenNiFilePlayer>> OpenNiFilePlayer::open(const std::string& path, const OpenNiParams& params) {
  // Check that the file is readable.
  if (eaccess(path.c_str(), R_OK) != 0 && errno == EACCES)
    return fail("this user may not read it", path, "give the user the permission");
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    return fail("no such file", path, "give the path of an .oni file");

  // Refuse files that are not recordings, which OpenNI2's player cannot handle.
  std::array<char, 4> head{};
  std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  if (std::string_view(head.data(), head.size()) != kMagic)
    return fail("is not an OpenNI recording", path, kRemedyIncomplete);

  // Open the file. OpenNI2 is never unloaded: that would destroy the player's streams, which may crash (see
  // OpenNiSensor).
  auto library = OpenNiLibrary::load();
  if (!library) return tl::unexpected(library.error());
  static_cast<void>(library->release());
  auto sensor = OpenNiSensor::open(name_of_its_own(path), params);
  if (!sensor)
    return fail(sensor.error().what, path, sensor.error().remedy.empty() ? kRemedyIncomplete : sensor.error().remedy);

  // Make the player, and refuse a recording without depth images.
  std::unique_ptr<OpenNiFilePlayer> player(new OpenNiFilePlayer(path, std::move(*sensor)));
  if (player->frames() <= 0) return fail("the recording holds no depth images", path, "record it again");
  return player;
}

OpenNiFilePlayer::OpenNiFilePlayer(std::string path, std::unique_ptr<OpenNiSensor> sensor)
    : path_(std::move(path)),
      sensor_(std::move(sensor)),
      pairing_(1'000'000 / std::max(1, sensor_->depth_mode().getFps())),
      depth_total_(sensor_->depth_pictures()),
      colour_total_(sensor_->colour_pictures()) {}

Error OpenNiFilePlayer::error(std::string what, std::string remedy) const {
  return {std::move(what), "openni2:" + path_, std::move(remedy)};
}

SourceEvent OpenNiFilePlayer::next() {
  if (position_ == depth_total_) return EndOfStream{};
  const auto pair = next_pair();
  if (!pair)
    return SourceFailed{
        error("ends after " + std::to_string(depth_read_) + " of " + std::to_string(depth_total_) + " depth images",
              "the file is damaged or truncated; the frames before are intact")};
  ++position_;
  return frame_of(*pair);
}

std::optional<OpenNiFilePlayer::Pairing::Pair> OpenNiFilePlayer::next_pair() {
  if (auto pair = pairing_.matched()) return pair;
  while (depth_read_ < depth_total_ || colour_read_ < colour_total_) {
    auto picture = sensor_->read(kPatience);
    if (!picture) break;
    Pairing::Stamped stamped{static_cast<std::int64_t>(picture->frame.getTimestamp()), 0, picture->frame};
    ++(picture->colour ? colour_read_ : depth_read_);
    auto pair = picture->colour ? pairing_.add_colour(std::move(stamped)) : pairing_.add_depth(std::move(stamped));
    if (pair) return pair;
    if (colour_total_ == 0) break;
  }
  return pairing_.flush();
}

SourceEvent OpenNiFilePlayer::frame_of(const Pairing::Pair& pair) {
  // Count the time from the first depth image.
  const openni::VideoFrameRef& depth = pair.depth.picture;
  if (!first_us_) first_us_ = pair.depth.device_us;
  const std::string name = "picture " + std::to_string(position_ - 1);
  if (!complete(depth, sensor_->depth_mode(), 2)) return SkippedFrame{error(name + " is incomplete", "")};

  // Fill in the frame and its depth.
  auto frame = std::make_shared<RgbdFrame>();
  frame->number = position_ - 1;
  frame->utime = OpenNiFileSource::kFirstUtime + pair.depth.device_us - *first_us_;
  frame->camera = sensor_->camera();
  frame->depth_unit = depth_unit(sensor_->depth_mode().getPixelFormat());
  copy_depth(depth, sensor_->mirrored(false), frame->depth);

  // Add colour if it is complete.
  const openni::VideoMode& mode = sensor_->colour_mode();
  if (pair.colour && complete(*pair.colour, mode, colour_bytes_per_pixel(mode.getPixelFormat())))
    copy_colour(*pair.colour, sensor_->mirrored(true), frame->colour);
  else if (sensor_->has_colour())
    frame->colour_fault = pair.colour ? "it is incomplete" : "the recording has none at this time";
  return FramePtr(std::move(frame));
}

}  // namespace barehand
