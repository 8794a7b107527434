#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/clock.h"
#include "core/slot.h"
#include "core/statistics.h"
#include "io/mcap/mcap_writer.h"
#include "pipeline/sink.h"
#include "stages/publish/hand_messages.h"

namespace barehand {

/// --mcap: every frame with its images and its hands under one stamp, for viewers of ROS 2 messages. It may be played
/// again. A replay that is equal writes equal bytes; the health, which differs, is only in the file of a live run.
class McapSink : public Sink {
 public:
  struct Input {
    double fps = 0;     ///< nominal rate of the source; 0: not known
    bool live = false;  ///< FrameSource::live()
    std::function<PipelineHealth()> health;
    std::string source;  ///< FrameSource::name()
  };
  /// `clock` and `pending` (changed parameters, taken before every frame; may be null) must outlive the sink.
  static Result<std::unique_ptr<Sink>> create(const PublishParams& params, const std::string& path, bool overwrite,
                                              Input input, const Clock& clock, Slot<PublishParams>* pending = nullptr);
  std::string name() const override { return "MCAP file"; }
  Result<void> consume(const TrackedFrame& tracked) override;
  /// Without a frame there is no file.
  Result<void> finish() override { return frames_ > 0 ? file_->finish() : Result<void>(); }

 private:
  McapSink(const PublishParams& params, std::unique_ptr<mcap::McapWriter> file, Input input, const Clock& clock,
           Slot<PublishParams>* pending);

  PublishParams params_;
  std::unique_ptr<mcap::McapWriter> file_;
  const Input input_;
  const Clock& clock_;
  Slot<PublishParams>* pending_;
  std::vector<HandMessageMaker> makers_;     // one a hand
  std::int64_t frames_ = 0, health_us_ = 0;  // written; when the health was told, steady clock
};

}  // namespace barehand
