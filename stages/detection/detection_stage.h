#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/log.h"
#include "hand/hand_pose.h"
#include "sensor/rgbd_frame.h"
#include "stages/detection/hand_detector.h"
#include "stages/detection/second_look.h"

namespace barehand {

/// Decides for every frame where to run the detection networks, and runs them: on the whole frame while a hand is
/// missing; around each tracked hand if no colour tells it from arm and object; otherwise now and then, beside the
/// tracking (SecondLook).
/// The decision depends on the frames and the feedback only, not on time, so that a recording gives the same results on
/// every machine. Synchronous; frames must come in order. If the networks cannot be used, a warning is logged once and
/// nothing is detected.
class DetectionStage {
 public:
  /// `folder`: contains the networks. `only`: the side of the hand, if a single one is to be tracked; hands of the
  /// other side are then returned last.
  DetectionStage(const DetectionParams& params, const std::string& folder, Workers& workers,
                 std::shared_ptr<spdlog::logger> log, std::optional<Handedness> only = std::nullopt);

  /// `feedback`: the estimates of an earlier frame, one per hand, that preprocessing receives, too; empty while nothing
  /// is tracked. Returns null if the networks are off or not needed in this frame, or if the frame is invalid; null
  /// contains no information about where hands are.
  /// `needs_labels`: whether colour, if there is any, is not enough (Preprocessor::needs_labels). `skin`: if given,
  /// every other search of a whole frame with colour looks at skin only.
  DetectionPtr process(const FramePtr& shared, std::span<const HandEstimatePtr> feedback, bool needs_labels = false,
                       const SkinModel* skin = nullptr);

 private:
  // The side of the hand that is searched for, if it is only one.
  std::optional<Handedness> wanted(std::span<const HandEstimatePtr> feedback) const;
  // The model of skin for this search of a whole frame, which is null in every other search.
  const SkinModel* skin_of_search(const SkinModel* skin);
  // Fills `places_` with the places where the tracked hands are expected.
  void expect_tracked(const RgbdFrame& frame, std::span<const HandEstimatePtr> feedback);

  DetectionParams params_;
  Workers& workers_;
  std::shared_ptr<spdlog::logger> log_;
  std::optional<Handedness> only_;
  std::optional<HandDetector> detector_;  // none: detection is off
  std::int64_t frame_ = 0;                // number of valid frames so far
  bool skin_next_ = false;                // whether the next search of a frame with colour looks at skin only
  SecondLook second_look_;                // after the detector that it uses
  std::vector<ExpectedHand> places_;      // scratch
};

}  // namespace barehand
