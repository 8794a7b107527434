#pragma once

#include <functional>
#include <vector>

#include "core/error.h"
#include "hand/contacts.h"
#include "hand/hand_pose.h"
#include "object/known_object.h"
#include "observe/observation.h"
#include "stages/contact/contact_params.h"
#include "stages/contact/object_tracker.h"
#include "stages/contact/observed_space.h"
#include "stages/contact/posed_hand.h"
#include "stages/contact/surface_cells.h"
#include "stages/contact/surface_distance.h"

namespace barehand {

// The contact stage, which finds what the tracked hands touch: objects, each other or themselves.

/// Finds the known objects (those for which a mesh was given) among the objects near the hands. Sets their ids in
/// `points`, and replaces their entries in `objects`.
using KnownObjectFinder =
    std::function<std::vector<PosedObject>(const HandObservations& observations, const HandEstimates& estimates,
                                           std::vector<SurfacePoint>& points, FrameVector<ObjectEstimate>& objects)>;

/// Finds the contacts of the hands from their estimates and observations. The frames must come in order. No estimate is
/// changed. The contacts of a hand that is not tracked are unknown.
class ContactStage {
 public:
  explicit ContactStage(const ContactParams& params) : params_(params) {}
  /// `find_known`: finds known objects, whose ids are below kFirstUnknownObject.
  ContactStage(const ContactParams& params, KnownObjectFinder find_known)
      : params_(params), find_known_(std::move(find_known)) {}
  Result<FrameContactsPtr> process(const HandObservations& observations, const HandEstimates& estimates);
  /// The unknown objects (those for which no mesh was given), as they were in the last frame.
  std::span<const ObjectTrack> objects() const { return objects_.tracks(); }
  /// Objects whose whole surface is known or guessed, as they were in the last frame: the known ones that were seen,
  /// and the unknown ones that are round, with the shapes that were fitted to them.
  std::span<const PosedObject> shaped_objects() const { return shaped_; }

 private:
  void touch_objects(const PosedHand& hand, const HandEstimate& estimate, double noise, SegmentContacts& contacts);
  void find_known(const HandObservations& observations, const HandEstimates& estimates,
                  FrameVector<ObjectEstimate>& objects);
  void add_round(const FrameVector<ObjectEstimate>& objects);
  void touch_shaped(const PosedHand& hand, const HandEstimate& estimate, int s, Contact& contact) const;
  void touch_itself(const PosedHand& hand, const HandEstimate& estimate, SegmentContacts& contacts) const;
  void touch_hand(std::size_t own, std::size_t other, const HandEstimates& estimates, SegmentContacts& contacts) const;
  Contact touch_of_skins(double distance, double variance, const SegmentState& first, const SegmentState& second) const;
  void set_state(Contact& contact, double deviations, double odds = 1) const;
  void set_object_state(Contact& contact, double deviations, double odds = 1) const;

  ContactParams params_;
  KnownObjectFinder find_known_;  // empty: there are none
  SurfaceCells cells_;
  ObjectTracker objects_;
  ObservedSpace space_;
  SurfaceDistance distance_;
  std::vector<PosedHand> hands_;  // one per configured hand
  std::vector<SurfacePoint> points_;
  std::vector<PosedObject> shaped_;
  std::vector<bool> open_;
};

}  // namespace barehand
