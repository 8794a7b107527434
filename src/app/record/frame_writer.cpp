// Opens the destination of recorded frames: an LCM log, an MCAP file or a recording folder.
#include "app/record/frame_writer.h"

#include <filesystem>
#include <functional>

#include "drivers/lcm/wire.h"
#include "io/lcm/lcm_log_writer.h"
#include "io/lcm/log_names.h"
#include "io/mcap/mcap_scene.h"
#include "io/recording/recording_writer.h"

namespace barehand {
namespace {

class LogFrameWriter : public FrameWriter {
 public:
  /// `path`: gives the path of the file or of the set of files that `log` writes.
  LogFrameWriter(std::function<std::string()> path, const FrameWriterOptions& options, std::unique_ptr<MessageSink> log)
      : path_(std::move(path)), options_(options), log_(std::move(log)) {}

  Result<void> write(const RgbdFrame& frame) override {
    const auto message = encode_frame(frame, options_.encoding);
    if (!message) return tl::unexpected(message.error());
    return log_->send(options_.channel, encode_message(*message), frame.utime).map([&] { ++written_; });
  }
  Result<void> finish() override { return written_ > 0 ? log_->finish() : Result<void>(); }
  std::string name() const override { return "LCM log " + path_(); }

 private:
  std::function<std::string()> path_;
  FrameWriterOptions options_;
  std::unique_ptr<MessageSink> log_;
  std::int64_t written_ = 0;
};

class McapFrameWriter : public FrameWriter {
 public:
  McapFrameWriter(const FrameWriterOptions& options, std::unique_ptr<mcap::McapWriter> file)
      : options_(options), file_(std::move(file)) {}

  Result<void> write(const RgbdFrame& frame) override {
    ros::Scene scene;
    scene.utime = frame.utime;
    scene.number = frame.number;
    scene.fps = options_.fps;
    scene.cloud = false;  // the point cloud can be computed from the depth image

    // Write the colour as the user wishes, or leave it out.
    if (options_.encoding.colour == ColourEncoding::jpeg) scene.jpeg_quality = options_.encoding.jpeg_quality;
    if (options_.encoding.colour != ColourEncoding::none) {
      scene.frame = FramePtr(FramePtr(), &frame);  // does not own the frame, which outlives this call
    } else {
      auto depth_only = std::make_shared<RgbdFrame>(frame);
      depth_only->colour = {};
      scene.frame = std::move(depth_only);
    }

    return mcap::write_scene(*file_, scene).map([&] { ++written_; });
  }
  Result<void> finish() override { return written_ > 0 ? file_->finish() : Result<void>(); }
  std::string name() const override { return "MCAP file " + file_->path(); }

 private:
  FrameWriterOptions options_;
  std::unique_ptr<mcap::McapWriter> file_;
  std::int64_t written_ = 0;
};

class FolderFrameWriter : public FrameWriter {
 public:
  FolderFrameWriter(std::string path, bool colour, RecordingWriter writer)
      : path_(std::move(path)), colour_(colour), writer_(std::move(writer)) {}

  Result<void> write(const RgbdFrame& frame) override {
    if (colour_) return written(writer_.write(frame));
    RgbdFrame depth_only = frame;
    depth_only.colour = {};
    return written(writer_.write(depth_only));
  }
  Result<void> finish() override { return writer_.finish(); }
  std::string name() const override { return "folder " + path_; }

 private:
  static Result<void> written(const Result<std::int64_t>& number) {
    if (!number) return tl::unexpected(number.error());
    return {};
  }
  std::string path_;
  bool colour_;
  RecordingWriter writer_;
};

}  // namespace

bool is_log_path(const std::string& path) { return is_log_name(path); }
bool is_mcap_path(const std::string& path) { return mcap::is_mcap_name(path); }
bool is_file_path(const std::string& path) { return is_log_path(path) || is_mcap_path(path); }

Result<std::unique_ptr<FrameWriter>> open_frame_writer(const std::string& path, const FrameWriterOptions& options) {
  if (options.rotation && !is_log_path(path))
    return fail("only an LCM log can continue in new files", path, "give a name that ends in .lcmlog");

  // Choose a log or an MCAP file by the ending of the name.
  if (options.rotation) {
    auto log = RotatingLog::create(path, *options.rotation, *options.clock);
    if (!log) return tl::unexpected(log.error());
    const auto place = [path, &set = **log] {
      const std::int64_t removed = set.removed_events();
      return pattern_of_set(path) +
             (removed > 0 ? ", of which the oldest " + std::to_string(removed) + " gave way to newer ones" : "");
    };
    return std::make_unique<LogFrameWriter>(place, options, std::move(*log));
  }
  if (is_log_path(path)) {
    auto log = LcmLogWriter::create(path, options.overwrite);
    if (!log) return tl::unexpected(log.error());
    const LcmLogWriter& file = **log;
    return std::make_unique<LogFrameWriter>([&file] { return file.path(); }, options, std::move(*log));
  }

  if (is_mcap_path(path)) {
    auto file = mcap::McapWriter::create(path, options.overwrite);
    if (!file) return tl::unexpected(file.error());
    return std::make_unique<McapFrameWriter>(options, std::move(*file));
  }

  // Any other name is a folder for a recording.
  std::error_code ignored;
  if (const auto there = std::filesystem::status(path, ignored); exists(there) && !is_directory(there))
    return fail("is no folder", path,
                "a file, also a pipe that a program reads, has a name that ends in " + std::string(kFileEndings));

  // Create the folder; colour is stored as JPEG only if the user asked for it.
  RecordingWriter::Options folder;
  folder.fps = options.fps;
  folder.colour_ending = options.encoding.colour == ColourEncoding::jpeg ? "jpg" : "png";
  auto writer = RecordingWriter::create(path, folder);
  if (!writer) return tl::unexpected(writer.error());
  const bool colour = options.encoding.colour != ColourEncoding::none;
  return std::make_unique<FolderFrameWriter>(path, colour, std::move(*writer));
}

}  // namespace barehand
