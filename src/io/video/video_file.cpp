// Writes images to a video file, by a module that is loaded for the first video.
#include "io/video/video_file.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "io/file_ending.h"

namespace barehand {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<const char*, const char*>, 4> kFormats = {
    {{".mp4", "mp4"}, {".mkv", "matroska"}, {".webm", "webm"}, {".avi", "avi"}}};

/// The path of the module: in the folder of the installed program's libraries, or where the build put it.
std::string module_file() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path().parent_path() / BAREHAND_LIBRARIES / BAREHAND_VIDEO_MODULE;
  return fs::exists(installed, error) ? installed : fs::path(BAREHAND_BUILT_LIBRARIES) / BAREHAND_VIDEO_MODULE;
}

}  // namespace

const char* video_format(const std::string& path) {
  const std::string ending = lower_case_ending(path);
  const auto* format = std::find_if(kFormats.begin(), kFormats.end(), [&](const auto& f) { return ending == f.first; });
  return format == kFormats.end() ? nullptr : format->second;
}

Result<const VideoModule*> load_video_module(const std::string& library) {
  const std::string file = library.empty() ? module_file() : library;
  const auto failure = [&] {
    return fail(std::string("videos cannot be written: ") + dlerror(), file,
                "install the package barehand-video, or give a folder for single images");
  };
  void* loaded = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);  // never closed, because libav cannot be unloaded
  if (!loaded) return failure();
  void* symbol = dlsym(loaded, kVideoModuleSymbol);
  if (!symbol) return failure();
  return reinterpret_cast<decltype(&barehand_video_module)>(symbol)();
}

Result<VideoFile> VideoFile::create(const std::string& path, double fps) {
  const auto module = load_video_module();
  if (!module) return tl::unexpected(module.error());
  auto file = AtomicFile::create(path, true);
  if (!file) return tl::unexpected(file.error());
  VideoFile video(*module, path, fps, std::move(*file));

  // The size of the images is not known yet, so a small video is written to nowhere to find out whether there is an
  // encoder.
  VideoModule::Message message{};
  void* trial = (*module)->open("/dev/null", video_format(path), 64, 64, fps, message);
  if (trial && (*module)->close(trial, message)) return video;
  return fail(std::string("no video can be written: ") + message.data(), path,
              "the other formats are .mp4, .mkv, .webm and .avi; or give a folder for images");
}

VideoFile::VideoFile(const VideoModule* module, std::string path, double fps, AtomicFile file)
    : module_(module), path_(std::move(path)), fps_(fps), file_(std::move(file)) {}

VideoFile::VideoFile(VideoFile&& other) noexcept
    : module_(other.module_),
      path_(std::move(other.path_)),
      fps_(other.fps_),
      file_(std::move(other.file_)),
      video_(std::exchange(other.video_, nullptr)),
      width_(other.width_),
      height_(other.height_),
      broken_(std::move(other.broken_)) {}

VideoFile::~VideoFile() { (void)finish(); }

Result<void> VideoFile::write(const Image<Rgb>& picture) {
  if (broken_) return tl::unexpected(*broken_);
  VideoModule::Message message{};

  // Open the file with the size of the first picture.
  if (!video_) {
    width_ = picture.width();
    height_ = picture.height();
    video_ = module_->open(file_.draft().c_str(), video_format(path_), width_, height_, fps_, message);
    if (!video_) return broken(message);
  }
  if (picture.width() != width_ || picture.height() != height_)
    return fail("differs in size from the first image", path_, "give a folder for single images");

  static_assert(sizeof(Rgb) == 3, "pixels are read as they lie in memory");
  if (module_->write(video_, reinterpret_cast<const std::uint8_t*>(picture.data()), message)) return {};

  // After an error, close the file and refuse all further pictures.
  VideoModule::Message ignored{};
  (void)module_->close(std::exchange(video_, nullptr), ignored);
  return broken(message);
}

Result<void> VideoFile::finish() {
  if (broken_) return tl::unexpected(*broken_);
  if (!video_) return file_.discard(), Result<void>();
  VideoModule::Message message{};
  if (!module_->close(std::exchange(video_, nullptr), message)) return broken(message);
  if (std::string(video_format(path_)) == "mp4") defragment();
  return file_.finish();
}

void VideoFile::defragment() {
  if (file_.direct()) return;
  auto ordinary = AtomicFile::create(path_, true);
  VideoModule::Message ignored{};
  if (ordinary && module_->defragment(file_.draft().c_str(), ordinary->draft().c_str(), ignored))
    file_ = std::move(*ordinary);
}

tl::unexpected<Error> VideoFile::broken(const VideoModule::Message& message) {
  broken_ = Error{std::string("cannot be written: ") + message.data(), path_,
                  "check the free space; what was written is in " + file_.keep()};
  return tl::unexpected(*broken_);
}

}  // namespace barehand
