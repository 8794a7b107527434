// Decides in which frames the networks look for hands.
#include "stages/detection/detection_stage.h"

#include <algorithm>

#include "sensor/tint.h"
#include "stages/detection/probable_hands.h"

namespace barehand {
namespace {

// While one hand is tracked, the networks look for the other one only in every n-th frame, like TwoHandTracker
// (kSearchEvery).
constexpr int kBesideTracked = 3;

bool is_tracked(const HandEstimatePtr& earlier) { return earlier && earlier->status == TrackStatus::tracking; }

}  // namespace

DetectionStage::DetectionStage(const DetectionParams& params, const std::string& folder, Workers& workers,
                               std::shared_ptr<spdlog::logger> log, std::optional<Handedness> only)
    : params_(params), workers_(workers), log_(std::move(log)), only_(only), second_look_(params.second_look_every) {
  if (!params.enabled) return;
  auto detector = HandDetector::load(folder, params);
  if (!detector) {
    log_->warn("hands are found without networks: {}", detector.error().message());
    return;
  }
  detector_.emplace(std::move(*detector));
  log_->info("hands are found by networks of version {}", detector_->version());
}

DetectionPtr DetectionStage::process(const FramePtr& shared, std::span<const HandEstimatePtr> feedback,
                                     bool needs_labels, const SkinModel* skin) {
  const RgbdFrame& frame = *shared;
  const bool valid =
      frame.camera.valid() && frame.depth.width() == frame.camera.width && frame.depth.height() == frame.camera.height;
  if (!detector_ || !valid) return nullptr;  // preprocessing reports what is wrong with the frame

  // Decide whether this frame is searched as a whole, around the tracked hands, or not at all.
  const std::int64_t turn = frame_++;
  const auto tracked = std::ranges::count_if(feedback, is_tracked);
  const bool all_tracked = !feedback.empty() && tracked == static_cast<std::ptrdiff_t>(feedback.size());
  const bool whole = !all_tracked && turn % (tracked ? std::max(kBesideTracked, params_.every) : params_.every) == 0;
  const bool colour = has_colour(frame);
  const bool windows = tracked && turn % params_.every_tracked == 0 && (!colour || needs_labels);
  const auto look = second_look_.next(shared, feedback, *detector_, workers_);
  if (look && !*look && all_tracked && !windows) return nullptr;

  // Search the frame, or the windows around the tracked hands.
  Result<Detection> detection = Detection{};
  const std::optional<Handedness> side = wanted(feedback);
  expect_tracked(frame, feedback);
  if (!look)
    detection = tl::unexpected(look.error());
  else if (whole)
    detection = detector_->detect(frame, workers_, places_, side, skin_of_search(colour ? skin : nullptr));
  if (windows && detection) detection = detector_->detect_at(frame, places_, workers_, std::move(*detection));

  // After an error, continue without the networks.
  if (!detection) {
    log_->warn("hands are found without networks from now on: {}", detection.error().message());
    second_look_ = SecondLook(0);  // a look that is under way uses the detector, and is waited for
    detector_.reset();
    return nullptr;
  }
  if (whole) sort_by_probability(detection->hands, side);
  // While a hand is missing, set whole_frame even if this frame was not searched as a whole: preprocessing then starts
  // the missing hand only where the networks find it, not at any other surface.
  detection->whole_frame = !all_tracked;
  detection->second_look = *look;
  return std::make_shared<const Detection>(std::move(*detection));
}

/// Where objects and arms hide a hand's shape, its colour shows it, and where colour misleads, depth does.
const SkinModel* DetectionStage::skin_of_search(const SkinModel* skin) {
  const bool skin_only = skin && skin_next_;
  skin_next_ = skin && !skin_next_;
  return skin_only ? skin : nullptr;
}

std::optional<Handedness> DetectionStage::wanted(std::span<const HandEstimatePtr> feedback) const {
  // Prefer the side in the feedback to the one in the configuration, since a command may have changed the profile.
  return only_ && feedback.size() == 1 && feedback[0] ? feedback[0]->handedness : only_;
}

void DetectionStage::expect_tracked(const RgbdFrame& frame, std::span<const HandEstimatePtr> feedback) {
  places_.clear();
  for (const HandEstimatePtr& earlier : feedback)
    if (const auto place = expected_hand(earlier.get(), frame)) places_.push_back(*place);
}

}  // namespace barehand
