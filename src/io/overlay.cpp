#include "io/overlay.h"

#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "core/format.h"
#include "io/image_file.h"
#include "io/overlay_drawing.h"

namespace barehand {
namespace fs = std::filesystem;

class OverlayWriter::Output {
 public:
  virtual ~Output() = default;
  virtual Result<void> write(const Image<Rgb>& picture, std::int64_t number) = 0;
  virtual Result<void> finish() { return {}; }
};

class OverlayWriter::Folder : public OverlayWriter::Output {
 public:
  explicit Folder(std::string path) : path_(std::move(path)) {}
  Result<void> write(const Image<Rgb>& picture, std::int64_t number) override {
    return write_colour(path_ + formatted("/%06lld.jpg", static_cast<long long>(number)), picture);
  }

 private:
  std::string path_;
};

class OverlayWriter::Video : public OverlayWriter::Output {
 public:
  Video(std::string path, double fps) : path_(std::move(path)), fps_(fps) {}
  ~Video() override { (void)finish(); }

  Result<void> open(cv::Size size) {
    const int codec = backend_ == cv::CAP_FFMPEG ? cv::VideoWriter::fourcc('m', 'p', '4', 'v')
                                                 : cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
    if (!writer_.open(path_, backend_, codec, fps_, size))
      return fail("cannot be opened for video", path_,
                  "check the folder; where OpenCV has no MPEG-4 codec, let the name end in .avi or give a folder");
    size_ = size;
    return {};
  }
  Result<void> write(const Image<Rgb>& picture, std::int64_t number) override {
    const cv::Size size(picture.width(), picture.height());
    if (!writer_.isOpened())
      if (const auto opened = open(size); !opened) return opened;
    if (size != size_)
      return fail("frame " + std::to_string(number) + " has another size than the first", path_,
                  "give a folder for single pictures");
    cv::Mat bgr;
    cv::cvtColor(cv::Mat(size, CV_8UC3, const_cast<Rgb*>(picture.data())), bgr, cv::COLOR_RGB2BGR);
    writer_.write(bgr);
    ++written_;
    return {};
  }
  /// cv::VideoWriter keeps errors to itself, so the file is asked how many frames arrived.
  Result<void> finish() override {
    if (!writer_.isOpened()) return {};
    writer_.release();
    if (written_ == 0) return {};
    const cv::VideoCapture video(path_, backend_);
    const int held = video.isOpened() ? static_cast<int>(video.get(cv::CAP_PROP_FRAME_COUNT)) : 0;
    if (held == written_) return {};
    return fail("holds " + std::to_string(held) + " of " + std::to_string(written_) + " frames after it was closed",
                path_, "check the free space");
  }

 private:
  std::string path_;
  double fps_;
  // By name: OpenCV would try, and complain about, every one it knows.
  const int backend_ = fs::path(path_).extension() == ".avi" ? cv::CAP_OPENCV_MJPEG : cv::CAP_FFMPEG;
  cv::VideoWriter writer_;
  cv::Size size_;
  int written_ = 0;
};

Result<OverlayWriter> OverlayWriter::open(const std::string& path, double fps) {
  const std::string ending = fs::path(path).extension().string();
  if (ending == ".mp4" || ending == ".avi") {
    // The size is known with the first frame only; a small video tells now whether there is a codec.
    if (const auto probe = Video(path, fps).open({64, 64}); !probe) return tl::unexpected(probe.error());
    std::error_code ignored;
    fs::remove(path, ignored);
    return OverlayWriter(std::make_unique<Video>(path, fps));
  }
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return fail("cannot be made: " + error.message(), path, "check the path and its permissions");
  return OverlayWriter(std::make_unique<Folder>(path));
}

OverlayWriter::OverlayWriter(std::unique_ptr<Output> output) : output_(std::move(output)) {}
OverlayWriter::OverlayWriter(OverlayWriter&&) noexcept = default;
OverlayWriter& OverlayWriter::operator=(OverlayWriter&&) noexcept = default;
OverlayWriter::~OverlayWriter() = default;

void OverlayWriter::Outline::follow(const HandEstimate& estimate) {
  constexpr int kPoints = 240;  // a segment; enough for a smooth outline
  if (!estimate.profile || estimate.profile == profile) return;
  profile = estimate.profile;
  surface = make_cylinder_surface(*profile, kPoints);
}

Result<void> OverlayWriter::write(const RgbdFrame& frame, const HandEstimates& estimates) {
  outlines_.resize(estimates.size());
  std::vector<DrawnHand> hands;
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    outlines_[k].follow(*estimates[k]);
    hands.push_back({*estimates[k], outlines_[k].surface});
  }
  return output_->write(draw_overlay(frame, hands), frame.number);
}

Result<void> OverlayWriter::finish() { return output_->finish(); }

}  // namespace barehand
