#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "drivers/synthetic/synthetic_spec.h"
#include "sensor/frame_source.h"

namespace barehand::synthetic {

// A source that delivers the frames of the simulator.

/// A simulated hand, and the truth about it in the frame that was delivered last.
struct SimulatedHand {
  HandProfile profile;              ///< profile measured on the simulated hand
  std::optional<TableFrame> truth;  ///< none if the hand is not in view
  HandPose pose;                    ///< T_camera_segment
};

/// The simulator as a source of frames. A replay delivers every frame once, with time stamps from 1 s on. A live source
/// delivers each frame when it is due by the clock, with that time as its time stamp; like a sensor, it drops frames
/// that were not taken in time.
class SyntheticSource : public FrameSource {
 public:
  /// `text`: the part after "sim:", see parse_synthetic_spec(). `clock` must outlive the source; it is used for live
  /// frames only.
  static Result<std::unique_ptr<SyntheticSource>> open(const std::string& text, const Clock& clock);

  SourceEvent next(std::chrono::milliseconds patience) override;
  bool live() const override { return spec_.live; }
  std::string name() const override { return name_; }

  /// The simulated hands: none, one, or a right and a left one.
  const std::vector<SimulatedHand>& hands() const { return hands_; }
  /// The object that a hand grasps; null: there is none.
  const GraspedObject* grasped() const { return simulator_.grasped(); }
  /// The state of the grasped object in the frame that was delivered last; none if nothing is grasped.
  const std::optional<ObjectTruth>& object() const { return last_.object; }
  /// The contacts of a hand with the grasped object in that frame, see Simulator::contacts().
  std::optional<HandContacts> contacts(std::size_t hand) const { return simulator_.contacts(last_, hand); }
  std::string_view grasp_type() const { return simulator_.grasp_type(); }
  const Intrinsics& camera() const { return simulator_.camera(); }
  double fps() const { return simulator_.fps(); }
  /// Number of frames still to come; -1 if the sequence is repeated endlessly.
  std::int64_t remaining() const;

 private:
  SyntheticSource(SyntheticSpec spec, Simulator simulator, std::string name, const Clock& clock);
  bool at_end() const { return !spec_.loop && next_ >= simulator_.frame_count(); }
  /// Waits until the next frame is due. Returns false if that takes longer than `patience`.
  bool wait_until_due(std::chrono::milliseconds patience);
  FramePtr deliver();

  SyntheticSpec spec_;
  Simulator simulator_;
  std::string name_;
  const Clock& clock_;
  std::int64_t next_ = 0;
  std::int64_t start_us_ = -1;    // time of live frame 0, steady clock; -1 before the first request
  std::int64_t start_utime_ = 0;  // time stamp of live frame 0 [us since the epoch]
  std::vector<SimulatedHand> hands_;
  SimulatedFrame last_;  // the frame that was delivered last
};

}  // namespace barehand::synthetic
