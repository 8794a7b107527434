// Says how the tracked hands of a frame grasp.
#include "stages/grasp/grasp_stage.h"

namespace barehand {
namespace {

constexpr std::int64_t kMemoryUs = 1'000'000;  // longest gap between frames over which the past counts

}  // namespace

Result<FrameGraspsPtr> GraspStage::process(const HandEstimates& estimates, const FrameContactsPtr& contacts) {
  const auto out = std::allocate_shared<FrameGrasps>(FrameAllocator<FrameGrasps>());
  out->resize(estimates.size());
  while (hands_.size() < estimates.size()) hands_.emplace_back(classifier_.memory());
  for (std::size_t k = 0; k < estimates.size(); ++k)
    if (estimates[k]->status == TrackStatus::tracking && estimates[k]->profile)
      (*out)[k] = estimate_grasp(hands_[k], *estimates[k], contacts ? &contacts->hands[k].object : nullptr);
  return out;
}

HandGrasp GraspStage::estimate_grasp(Hand& hand, const HandEstimate& estimate, const SegmentContacts* objects) const {
  // Start again with another hand, and after a gap.
  const std::int64_t passed = estimate.utime - hand.utime;
  if (hand.id != estimate.hand_id || passed <= 0 || passed > kMemoryUs) {
    hand.filter.reset();
    hand.since.reset();
  }
  const double seconds = hand.since ? 1e-6 * static_cast<double>(passed) : 1.0;
  hand.id = estimate.hand_id;
  hand.utime = estimate.utime;

  // Classify the pose and the touches.
  HandGrasp out;
  out.known = true;
  out.probabilities = hand.filter.add(classifier_.classify(grasp_features(estimate, objects)), seconds);
  out.grasp = hand.filter.grasp();
  if (!hand.since || out.grasp != hand.grasp) hand.since = estimate.utime;
  hand.grasp = out.grasp;
  out.since = *hand.since;

  // Measure how far the hand is open; without a grasp, between thumb and index finger.
  const auto& fingers = grasp_types()[static_cast<std::size_t>(std::max(0, out.grasp - 1))];
  const GraspOpening opening = out.grasp == 0 ? grasp_opening(estimate, 2, 2)
                                              : grasp_opening(estimate, fingers.first_finger, fingers.last_finger);
  out.aperture = opening.aperture;
  out.closure = opening.closure;
  return out;
}

}  // namespace barehand
