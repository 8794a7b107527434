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
    // Backends by name: OpenCV would try, and complain about, every one it knows.
    const bool avi = fs::path(path_).extension() == ".avi";
    const bool opened =
        avi ? writer_.open(path_, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), fps_, size)
            : writer_.open(path_, cv::CAP_FFMPEG, cv::VideoWriter::fourcc('m', 'p', '4', 'v'), fps_, size);
    if (!opened)
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
    written_ = true;
    return {};
  }
  Result<void> finish() override {
    if (!writer_.isOpened()) return {};
    writer_.release();
    std::error_code error;
    if (written_ && (fs::file_size(path_, error) == 0 || error))
      return fail("holds nothing after it was closed", path_, "check the free space");
    return {};
  }

 private:
  std::string path_;
  double fps_;
  cv::VideoWriter writer_;
  cv::Size size_;
  bool written_ = false;
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
