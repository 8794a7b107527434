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

namespace barehand {

struct McapOptions {
  std::string channel = {};  ///< topic of the depth images, or a glob of such (matches_glob); "": the only one
  std::optional<std::int64_t> start = {};  ///< position of the first frame, from 0; not given: first, backwards last
  std::int64_t step = 1;                   ///< every step-th frame; negative plays backwards
  GivenIntrinsics foreign = {};            ///< where there is no camera info
};

/// Replays the depth images of an MCAP file of ROS 2 messages: one that this program wrote, or a bag with depth in
/// 16UC1 (sensor_msgs/Image, or CompressedImage in compressedDepth). The intrinsics are those of the topic camera_info
/// beside it; colour is taken from a topic of the same frame and size, whose pixels are then the same rays. Never drops
/// a frame; frames that are damaged or that FrameOrder does not use come as SkippedFrame. Own frames keep their numbers
/// as far as these rise, foreign ones get their position.
class McapSource : public FrameSource {
 public:
  /// Errors: no MCAP file; no depth images (names the topics), or on several topics and none chosen; no intrinsics; a
  /// start outside the file, a step of 0.
  static Result<std::unique_ptr<McapSource>> open(const std::string& path, const McapOptions& options = {});

  SourceEvent next(std::chrono::milliseconds patience) override;
  bool live() const override { return false; }
  std::string name() const override { return "log:" + path_; }

  /// Number of events `next` will deliver before the end: for progress.
  std::int64_t remaining() const;
  /// Nominal rate noted in the file [frames/s]; 0: none is.
  double fps() const { return fps_; }
  /// What is to be said of the file, in sentences.
  const std::vector<std::string>& doubts() const { return doubts_; }

 private:
  /// What the messages of one topic are, told by the first one.
  enum class Kind { depth, packed_depth, colour, packed_colour, camera, other };
  struct Stream {
    Kind kind = Kind::other;
    std::string type, frame_id;
    int width = 0, height = 0;
    std::vector<mcap::Message> messages;
    std::vector<std::int64_t> utimes;
    std::map<std::int64_t, Intrinsics> cameras;  ///< by time, of Kind::camera
    bool lens = false;                           ///< some camera info has coefficients of distortion
  };
  using Streams = std::map<std::string, Stream>;  ///< by topic
  struct Frame {
    const std::string* topic = nullptr;
    mcap::Message depth;
    std::optional<mcap::Message> colour;
    std::int64_t utime = 0, number = 0;
    std::string fault;  ///< why it is not used (FrameOrder); "": it is
  };

  McapSource(std::string path, const McapOptions& options) : path_(std::move(path)), options_(options) {}
  void look(const mcap::Message& message, const mcap::Channel& channel, std::span<const std::uint8_t> bytes);
  static Stream begin_stream(const mcap::Channel& channel, std::span<const std::uint8_t> bytes);
  Result<void> choose();
  Result<void> add_frames(const std::string& topic);
  const Stream* camera_of(const std::string& topic) const;
  const Stream* colour_of(const std::string& topic);
  std::string topics() const;
  SourceEvent read(std::int64_t position);
  Result<FramePtr> read_frame(const Frame& frame);
  Result<Image<std::uint16_t>> read_depth(const Frame& frame);
  Result<Image<Rgb>> read_colour(const Frame& frame, const Intrinsics& camera);

  std::string path_;
  McapOptions options_;
  std::optional<mcap::McapReader> reader_;
  Streams streams_;
  std::vector<Frame> frames_;
  std::vector<std::string> doubts_;
  double fps_ = 0;
  std::int64_t next_ = 0;
};

}  // namespace barehand
