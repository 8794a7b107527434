#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "sensor/frame_source.h"

namespace barehand {

/// Frames that were read beforehand, so that reading or rendering them costs nothing while something is measured.
struct FrameStore {
  std::vector<FramePtr> frames;
  std::int64_t bytes() const;  ///< memory that their images take
};

/// The first `count` frames of a source. Errors: those of the source, and a source without any frame.
Result<FrameStore> read_frames(FrameSource& source, std::int64_t count);

/// Keeps every `factor`-th pixel of every factor-th row, with the intrinsics that belong to it. `factor` must be > 0.
FrameStore decimated(const FrameStore& store, int factor);

/// Plays stored frames alternately forwards and backwards, so that the motion never jumps, until `count` frames were
/// delivered. Without a rate it is a replay and delivers the stored frames themselves. With a rate it is live, like a
/// sensor: it delivers copies at that rate, with the present time as capture time.
class MemorySource : public FrameSource {
 public:
  struct Options {
    std::int64_t count = 0;
    std::optional<double> rate;  ///< frames per second; none: as fast as they are taken
  };
  /// `store` must not be empty; `store` and `clock` must outlive the source.
  MemorySource(const FrameStore& store, Options options, const Clock& clock);

  SourceEvent next(std::chrono::milliseconds patience) override;
  bool live() const override { return options_.rate.has_value(); }
  std::string name() const override { return "memory"; }

 private:
  const FramePtr& stored(std::int64_t index) const;
  SourceEvent when_due(std::chrono::milliseconds patience);

  const FrameStore& store_;
  const Options options_;
  const Clock& clock_;
  std::int64_t delivered_ = 0;
  std::optional<std::int64_t> start_us_;  // time of the first call of next(), steady clock
};

}  // namespace barehand
