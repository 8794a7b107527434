#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/clock.h"
#include "core/statistics.h"
#include "io/mcap/mcap_writer.h"
#include "pipeline/sink.h"
#include "pipeline/sinks/hand_message_makers.h"

namespace barehand {

/// --mcap: writes every frame with its images and hands, all with the same time stamp, for viewers of ROS 2 messages.
/// The file can also be replayed by this program. Equal replays write equal files: the health of the pipeline, which
/// differs, is only written in a live run.
class McapSink : public Sink {
 public:
  struct Input {
    double fps = 0;     ///< nominal frame rate of the source; 0: unknown
    bool live = false;  ///< FrameSource::live()
    std::function<PipelineHealth()> health;
    std::string source;                      ///< FrameSource::name()
    std::optional<SE3> T_world_camera = {};  ///< none: the pose of the camera in the room is unknown
  };
  /// `clock` and `pending` (changed parameters, taken before every frame; may be null) must outlive the sink.
  static Result<std::unique_ptr<Sink>> create(const PublishParams& params, const std::string& path, bool overwrite,
                                              Input input, const Clock& clock, Slot<PublishParams>* pending = nullptr);
  std::string name() const override { return "MCAP file"; }
  Result<void> consume(const TrackedFrame& tracked) override;
  /// Leaves no file if there was no frame.
  Result<void> finish() override { return frames_ > 0 ? file_->finish() : Result<void>(); }

 private:
  McapSink(const PublishParams& params, std::unique_ptr<mcap::McapWriter> file, Input input, const Clock& clock,
           Slot<PublishParams>* pending);

  HandMessageMakers makers_;
  std::unique_ptr<mcap::McapWriter> file_;
  const Input input_;
  const Clock& clock_;
  std::int64_t frames_ = 0,  // number of frames written
      health_us_ = 0;        // time at which the health was written last; steady clock [us]
};

}  // namespace barehand
