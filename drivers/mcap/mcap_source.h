#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/mcap/mcap_reader.h"
#include "sensor/frame_source.h"
#include "sensor/given_intrinsics.h"
#include "sensor/replay_position.h"

namespace barehand {

// A source that replays the depth and colour images of an MCAP file.

/// What is replayed of an MCAP file, and how.
struct McapOptions {
  std::string channel = {};  ///< topic of the depth images, or a pattern (matches_glob); "": the only such topic
  std::optional<std::int64_t> start = {};  ///< first frame to play, from 0; none: the first one, or last if backwards
  std::int64_t step = 1;                   ///< every step-th frame; negative plays backwards
  GivenIntrinsics foreign = {};            ///< intrinsics for depth images without camera info
};

/// Replays the depth images of an MCAP file of ROS 2 messages: a file that this program wrote, or a bag with depth in
/// 16UC1 (sensor_msgs/Image, or CompressedImage in compressedDepth). The intrinsics are those of the topic camera_info
/// in the same namespace. Colour is taken from a topic with the same frame_id and image size, which is then registered
/// to depth: equal pixels are equal rays. No frame is dropped; frames that are damaged or that FrameOrder rejects are
/// delivered as SkippedFrame. Frames written by this program keep their numbers as long as these increase; other frames
/// are numbered by their position.
class McapSource : public FrameSource {
 public:
  /// Errors: the file is not MCAP; it has no depth images (the error lists its topics), or has them on several topics
  /// of which none is chosen; there are no intrinsics; `start` lies outside the file, or `step` is 0.
  static Result<std::unique_ptr<McapSource>> open(const std::string& path, const McapOptions& options = {});

  SourceEvent next(std::chrono::milliseconds patience) override;
  bool live() const override { return false; }
  std::string name() const override { return "log:" + path_; }

  /// Number of events that next() will deliver before the end, for a progress display.
  std::int64_t remaining() const { return position_.remaining(); }
  std::int64_t frames() const { return static_cast<std::int64_t>(frames_.size()); }
  /// Time stamp of a frame, from 0 [us since the epoch].
  std::int64_t utime(std::int64_t frame) const { return frames_[static_cast<std::size_t>(frame)].utime; }
  /// Reads a frame, from 0, whatever next() has delivered: FramePtr, or SkippedFrame if it cannot be used.
  SourceEvent read(std::int64_t frame);
  /// Nominal frame rate stored in the file [1/s]; 0: none.
  double fps() const { return fps_; }
  /// Warnings about the file, in sentences.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  /// The kind of the messages of one topic, determined from the first one.
  enum class Kind { depth, packed_depth, colour, packed_colour, camera, other };
  struct Stream {
    Kind kind = Kind::other;
    std::string type, frame_id;
    int width = 0, height = 0;
    std::vector<mcap::Message> messages;
    std::vector<std::int64_t> utimes;
    std::map<std::int64_t, Intrinsics> cameras;  ///< the intrinsics by time, for Kind::camera
    bool lens = false;                           ///< whether any camera info has distortion coefficients
  };
  using Streams = std::map<std::string, Stream>;  ///< by topic
  struct Frame {
    const std::string* topic = nullptr;
    mcap::Message depth;
    std::optional<mcap::Message> colour;
    std::int64_t utime = 0, number = 0;
    std::string fault;  ///< why FrameOrder rejects the frame; "": it is used
  };

  McapSource(std::string path, const McapOptions& options) : path_(std::move(path)), options_(options) {}
  void add_message(const mcap::Message& message, const mcap::Channel& channel, std::span<const std::uint8_t> bytes);
  static Stream begin_stream(const mcap::Channel& channel, std::span<const std::uint8_t> bytes);
  Result<void> choose();
  Result<void> add_frames(const std::string& topic);
  const Stream* camera_of(const std::string& topic) const;
  const Stream* colour_of(const std::string& topic);
  std::string topics() const;
  Result<FramePtr> read_frame(const Frame& frame);
  Result<Image<std::uint16_t>> read_depth(const Frame& frame);
  Result<Image<Rgb>> read_colour(const Frame& frame, const Intrinsics& camera);

  std::string path_;
  McapOptions options_;
  std::optional<mcap::McapReader> reader_;
  Streams streams_;
  std::vector<Frame> frames_;
  std::vector<std::string> warnings_;
  double fps_ = 0;
  ReplayPosition position_;
};

}  // namespace barehand
