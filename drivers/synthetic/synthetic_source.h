#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "drivers/synthetic/synthetic_spec.h"
#include "sensor/frame_source.h"

namespace barehand::synthetic {

/// A simulated hand and its truth in the frame that was delivered last.
struct SimulatedHand {
  HandProfile profile;              ///< measured on the hand
  std::optional<TableFrame> truth;  ///< none if the hand is not in view
  HandPose pose;                    ///< T_camera_segment
};

/// The simulator as a source of frames. Replay: every frame once, with times from 1 s on. Live: a frame becomes due at
/// its time by the clock and carries this time; frames that nobody took in time are dropped, as a sensor would drop
/// them.
class SyntheticSource : public FrameSource {
 public:
  /// `text`: the part after "sim:", see parse_synthetic_spec(). `clock` must outlive the source; it is used for live
  /// frames only.
  static Result<std::unique_ptr<SyntheticSource>> open(const std::string& text, const Clock& clock);

  SourceEvent next(std::chrono::milliseconds patience) override;
  bool live() const override { return spec_.live; }
  std::string name() const override { return name_; }

  /// No hand, one, or a right and a left one.
  const std::vector<SimulatedHand>& hands() const { return hands_; }
  const Intrinsics& camera() const { return simulator_.camera(); }
  double fps() const { return simulator_.fps(); }
  /// Number of frames still to come; -1 if the sequence is repeated endlessly.
  std::int64_t remaining() const;

 private:
  SyntheticSource(SyntheticSpec spec, Simulator simulator, std::string name, const Clock& clock);
  bool at_end() const { return !spec_.loop && next_ >= simulator_.frame_count(); }
  /// Waits until the next frame is due; false if that takes longer than `patience`.
  bool wait_until_due(std::chrono::milliseconds patience);
  FramePtr deliver();

  SyntheticSpec spec_;
  Simulator simulator_;
  std::string name_;
  const Clock& clock_;
  std::int64_t next_ = 0;
  std::int64_t start_us_ = -1;    // clock time of frame 0 once live frames were requested; before: -1
  std::int64_t start_utime_ = 0;  // the same since the epoch
  std::vector<SimulatedHand> hands_;
};

}  // namespace barehand::synthetic
