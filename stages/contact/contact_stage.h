#pragma once

#include <vector>

#include "core/error.h"
#include "hand/contacts.h"
#include "hand/hand_pose.h"
#include "observe/observation.h"
#include "stages/contact/contact_params.h"
#include "stages/contact/object_tracker.h"
#include "stages/contact/posed_hand.h"
#include "stages/contact/seen_space.h"
#include "stages/contact/surface_cells.h"
#include "stages/contact/surface_distance.h"

namespace barehand {

/// The contact stage: says what the tracked hands of a frame touch, from their estimates and observations, frame after
/// frame in order. It changes no estimate. Contacts are stated for hands that are tracked; those of the others are
/// unknown.
class ContactStage {
 public:
  explicit ContactStage(const ContactParams& params) : params_(params) {}
  Result<FrameContactsPtr> process(const HandObservations& observations, const HandEstimates& estimates);

 private:
  void touch_objects(const PosedHand& hand, const HandEstimate& estimate, double noise, SegmentContacts& contacts);
  void touch_itself(const PosedHand& hand, const HandEstimate& estimate, SegmentContacts& contacts) const;
  void touch_hand(std::size_t own, std::size_t other, const HandEstimates& estimates, SegmentContacts& contacts) const;
  Contact touch_of_skins(double distance, double variance, const SegmentState& first, const SegmentState& second) const;
  void judge(Contact& contact, double deviations) const;

  ContactParams params_;
  SurfaceCells cells_;
  ObjectTracker objects_;
  SeenSpace space_;
  SurfaceDistance distance_;
  std::vector<PosedHand> hands_;  // one per configured hand
  std::vector<SurfacePoint> points_;
  std::vector<bool> open_;
};

}  // namespace barehand
