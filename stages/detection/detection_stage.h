#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/log.h"
#include "hand/hand_pose.h"
#include "sensor/rgbd_frame.h"
#include "stages/detection/hand_detector.h"

namespace barehand {

/// Decides, frame by frame, where detection is worth its time, and runs it: in the whole frame while a hand is searched
/// for, around each tracked hand where no colour tells it from the arm, and else not at all. Decisions depend on the
/// frames and the feedback alone, never on time, so that the same recording gives the same results everywhere.
/// Synchronous; frames come in order. Without usable networks it says so once in the log, and nothing is detected.
class DetectionStage {
 public:
  /// `folder`: of the networks. `use_colour`: whether preprocessing uses colour where there is some.
  DetectionStage(const DetectionParams& params, const std::string& folder, bool use_colour,
                 std::shared_ptr<spdlog::logger> log);

  /// `feedback`: estimates of an earlier frame, one per hand, as preprocessing gets them; empty while nothing is
  /// tracked. Null: detection is off, or not worth its time in this frame, and says nothing.
  DetectionPtr process(const RgbdFrame& frame, std::span<const HandEstimatePtr> feedback);

 private:
  Result<Detection> detect_tracked(const RgbdFrame& frame, std::span<const HandEstimatePtr> feedback);

  DetectionParams params_;
  bool use_colour_;
  std::shared_ptr<spdlog::logger> log_;
  std::optional<HandDetector> detector_;  // none: off
  std::int64_t frame_ = 0;
  std::vector<HandDetector::Expected> places_;  // scratch
};

}  // namespace barehand
