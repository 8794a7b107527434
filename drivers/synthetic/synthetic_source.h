#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "drivers/synthetic/synthetic_spec.h"
#include "math/source.h"

namespace barehand::synthetic {

/// A hand of the simulator.
struct SimulatedHand {
  HandProfile profile;              ///< as measured on it
  std::optional<TableFrame> truth;  ///< of the frame delivered last; none if the hand is not in view there
  HandPose pose;                    ///< in that frame
};

/// The simulator as a camera. Replayed: every frame once, stamped from 1 s on. Live: a frame becomes due at its time by
/// the clock and is stamped with that; frames that nobody fetched in time are left out, as a sensor would.
class SyntheticSource : public FrameSource {
 public:
  /// `text`: what stands after "sim:", see parse_synthetic_spec. `clock` outlives the source and is used when live.
  static Result<std::unique_ptr<SyntheticSource>> open(const std::string& text, const Clock& clock);

  SourceEvent next(std::chrono::milliseconds patience) override;
  bool live() const override { return spec_.live; }
  std::string name() const override { return name_; }

  /// One, or a right and a left one.
  const std::vector<SimulatedHand>& hands() const { return hands_; }
  const Intrinsics& camera() const { return simulator_.camera(); }
  double fps() const { return simulator_.fps(); }
  /// Frames still to come; -1 if it goes on for ever.
  std::int64_t remaining() const;

 private:
  SyntheticSource(SyntheticSpec spec, Simulator simulator, std::string name, const Clock& clock);
  bool at_end() const { return !spec_.loop && next_ >= simulator_.frame_count(); }
  /// Waits for the next frame; false if it is not due within `patience`.
  bool wait_until_due(std::chrono::milliseconds patience);
  FramePtr deliver();

  SyntheticSpec spec_;
  Simulator simulator_;
  std::string name_;
  const Clock& clock_;
  std::int64_t next_ = 0;
  std::int64_t start_us_ = -1;    // clock time of frame 0, once live frames were asked for
  std::int64_t start_utime_ = 0;  // the same since the epoch
  std::vector<SimulatedHand> hands_;
};

}  // namespace barehand::synthetic
