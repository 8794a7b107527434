// Writes images of tracked hands over their frames to a folder or a video.
#include "io/overlay/overlay.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "core/format.h"
#include "io/file_ending.h"
#include "io/recording/image_file.h"
#include "io/video/video_file.h"

namespace barehand {
namespace fs = std::filesystem;
namespace {

/// Whether the path ends like a video of another format, so that it cannot be meant as a folder.
bool is_other_video(const std::string& path) {
  constexpr std::array kEndings = {".mov", ".m4v", ".mpg", ".mpeg", ".wmv", ".flv", ".ogv", ".gif"};
  const std::string ending = lower_case_ending(path);
  std::error_code error;
  return !fs::is_directory(path, error) && std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

/// Whether a file has a name that OverlayWriter gives to the image of a frame, such as 000012.jpg.
bool is_picture_name(const fs::path& name) {
  const std::string stem = name.stem().string();
  const bool number = stem.size() >= 6 && stem.find_first_not_of("0123456789") == std::string::npos;
  return number && (stem.size() == 6 || stem[0] != '0') && name.extension() == ".jpg";
}

/// Removes the images of an earlier run, and nothing else. An image that cannot be removed stays.
void remove_pictures(const std::string& folder) {
  std::error_code ignored;
  std::vector<fs::path> pictures;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (is_picture_name(entry.path().filename()) && entry.symlink_status(ignored).type() == fs::file_type::regular)
      pictures.push_back(entry.path());
  for (const fs::path& picture : pictures) fs::remove(picture, ignored);
}

}  // namespace

class OverlayWriter::Output {
 public:
  virtual ~Output() = default;
  virtual Result<void> write(const Image<Rgb>& picture, std::int64_t number) = 0;
  virtual Result<void> finish() { return {}; }
};

class OverlayWriter::Folder : public OverlayWriter::Output {
 public:
  Folder(std::string path, bool overwrite) : path_(std::move(path)), old_pictures_(overwrite) {}
  Result<void> write(const Image<Rgb>& picture, std::int64_t number) override {
    if (std::exchange(old_pictures_, false)) remove_pictures(path_);
    return write_colour(path_ + formatted("/%06lld.jpg", static_cast<long long>(number)), picture);
  }

 private:
  std::string path_;
  bool old_pictures_;  ///< whether images of an earlier run may exist and must be removed
};

class OverlayWriter::Video : public OverlayWriter::Output {
 public:
  explicit Video(VideoFile file) : file_(std::move(file)) {}
  Result<void> write(const Image<Rgb>& picture, std::int64_t) override { return file_.write(picture); }
  Result<void> finish() override { return file_.finish(); }

 private:
  VideoFile file_;
};

Result<OverlayWriter> OverlayWriter::open(const std::string& path, double fps, bool overwrite, SegmentNames names) {
  if (video_format(path)) {
    return VideoFile::create(path, fps).map(
        [&](VideoFile&& file) { return OverlayWriter(std::make_unique<Video>(std::move(file)), names); });
  }
  if (is_other_video(path))
    return fail("is not a supported video format", path, "use a name that ends in .mp4, .mkv, .webm or .avi");
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return fail("cannot be created: " + error.message(), path, "check the path and its permissions");
  return OverlayWriter(std::make_unique<Folder>(path, overwrite), names);
}

OverlayWriter::OverlayWriter(std::unique_ptr<Output> output, SegmentNames names)
    : output_(std::move(output)), names_(names) {}
OverlayWriter::OverlayWriter(OverlayWriter&&) noexcept = default;
OverlayWriter& OverlayWriter::operator=(OverlayWriter&&) noexcept = default;
OverlayWriter::~OverlayWriter() = default;

void OverlayWriter::HandSkin::follow(const HandEstimate& estimate) {
  constexpr double kCell = 0.004;  // size of the skin's triangles [m]; smaller ones make no visible difference
  if (!estimate.has_pose() || estimate.profile == profile) return;
  profile = estimate.profile;
  skin = make_skin(*profile, kCell);
}

Result<void> OverlayWriter::write(const RgbdFrame& frame, const HandEstimates& estimates) {
  skins_.resize(estimates.size());
  std::vector<DrawnHand> hands;
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    skins_[k].follow(*estimates[k]);
    hands.push_back({*estimates[k], skins_[k].skin});
  }
  const ColouredDepths scene = typical_range(frame);
  if (const auto around = depths_around(hands)) around_ = around;
  const OverlayDepths depths{left_.follow(scene, frame.utime), right_.follow(around_.value_or(scene), frame.utime)};

  if (!first_us_) first_us_ = frame.utime;
  const double seconds = static_cast<double>(frame.utime - *first_us_) * 1e-6;
  return output_->write(draw_overlay(frame, seconds, hands, depths, names_), frame.number);
}

Result<void> OverlayWriter::finish() { return output_->finish(); }

}  // namespace barehand
