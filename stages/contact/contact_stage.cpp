#include "stages/contact/contact_stage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/square.h"

namespace barehand {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kSkinDeviation = 0.0015;  // standard deviation of the skin model [m]
constexpr double kVisible = 0.5;           // visible fraction of a segment that shows whether something is near it
// Fitted to simulated grasps: the distance of a fingertip that is seen errs less than its deviation says, since skin
// does not enter objects; distances of what is seen are a little too small; and some objects are too thin or too dark
// to be seen, or taken for others.
constexpr double kSharper = 2, kNearer = 0.15, kOverlooked = 0.03;
// Factor on the odds of a touch for a fingertip that is hidden: it usually rests on what is near it.
constexpr double kHiddenTip = 2;

bool tracked(const HandEstimate& estimate) { return estimate.status == TrackStatus::tracking && estimate.profile; }

/// Variance of a point of a body along a direction, from the covariance of the body's pose [m^2].
double variance(const SE3& T_camera_body, const Matrix6d& covariance, const Vector3d& point,
                const Vector3d& direction) {
  const Vector6d row = point_jacobian(point - T_camera_body.t).transpose() * direction;
  return row.dot(covariance * row);
}
double variance(const SegmentState& segment, const Vector3d& point, const Vector3d& direction) {
  return variance(segment.T_camera_segment, segment.covariance, point, direction);
}

/// States that no segment is near anything; for segments that are not seen, this is inferred.
void all_apart(const HandEstimate& estimate, SegmentContacts& contacts) {
  for (int s = 0; s < kSegmentCount; ++s) {
    contacts[s].state = ContactState::none;
    contacts[s].probability = 0;
    contacts[s].inferred = !estimate.segments[s].seen;
  }
}

/// Gives `contact` to a segment if it is the nearest one so far.
void offer(Contact& best, const Contact& contact) {
  if (!(contact.distance >= best.distance)) best = contact;
}

}  // namespace

Result<FrameContactsPtr> ContactStage::process(const HandObservations& observations, const HandEstimates& estimates) {
  const auto out = std::allocate_shared<FrameContacts>(FrameAllocator<FrameContacts>());
  out->hands.resize(estimates.size());
  hands_.resize(estimates.size());

  // Collect the surfaces around the tracked hands.
  space_.observe(observations);
  points_.clear();
  open_.clear();
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    if (!tracked(*estimates[k])) continue;
    hands_[k].pose(*estimates[k]);
    if (observations[k]->hand_present) {
      const auto on_skin = [&](const Vector3f& p) { return hands_[k].contains(p); };
      cells_.collect(observations, estimates, k, on_skin, points_, open_);
    }
  }

  // Leave out the points that belong to a tracked hand.
  std::erase_if(points_, [&](const SurfacePoint& point) {
    for (std::size_t k = 0; k < estimates.size(); ++k)
      if (tracked(*estimates[k]) && hands_[k].owns(point)) return true;
    return false;
  });

  // Track the objects, and the known and the round ones among them.
  objects_.process(estimates.empty() ? 0 : estimates[0]->utime, estimates, space_, open_, points_, out->objects);
  find_known(observations, estimates, out->objects);
  add_round(out->objects);

  // Measure the distances of each hand's segments.
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    if (!tracked(*estimates[k])) continue;
    HandContacts& contacts = out->hands[k];
    touch_objects(hands_[k], *estimates[k], observations[k]->noise, contacts.object);
    for (int s = 0; s < kSegmentCount; ++s) touch_shaped(hands_[k], *estimates[k], s, contacts.object[s]);
    touch_itself(hands_[k], *estimates[k], contacts.own);
    for (std::size_t other = 0; other < estimates.size(); ++other)
      if (other != k && tracked(*estimates[other])) touch_hand(k, other, estimates, contacts.other_hand);
  }

  // Let the objects remember which of them the hands touch.
  objects_.note_touches(out->hands);
  return out;
}

/// Finds the known objects, the first of those that have a shape. Their meshes replace the points that were seen of
/// them.
void ContactStage::find_known(const HandObservations& observations, const HandEstimates& estimates,
                              FrameVector<ObjectEstimate>& objects) {
  shaped_.clear();
  if (!find_known_) return;
  shaped_ = find_known_(observations, estimates, points_, objects);
  std::erase_if(points_, [&](const SurfacePoint& point) {
    return std::ranges::any_of(shaped_, [&](const PosedObject& known) { return known.object->id == point.object; });
  });
}

/// Adds the round objects to those that have a shape, without those that turned out to be known ones and so are not
/// among the `objects`. How badly the far side is known counts as an uncertainty of the place.
void ContactStage::add_round(const FrameVector<ObjectEstimate>& objects) {
  for (const ObjectTrack& track : objects_.tracks()) {
    const ObjectEstimate& state = track.state;
    if (!track.round || std::ranges::find(objects, state.id, &ObjectEstimate::id) == objects.end()) continue;
    PosedObject& posed = shaped_.emplace_back();
    posed = {track.round_object, state.T_camera_object, state.covariance, state.hand_id};
    posed.covariance.topLeftCorner<3, 3>().diagonal().array() += square(track.round->deviation) / 3;
  }
}

/// Measures how far a segment is from the objects whose whole surface is known, or from a guessed surface if nothing is
/// seen of the segment. Nothing changes if none is near.
void ContactStage::touch_shaped(const PosedHand& hand, const HandEstimate& estimate, int s, Contact& contact) const {
  const PosedSkin& skin = hand.skin(s);
  const SegmentState& segment = estimate.segments[s];
  for (const PosedObject& shaped : shaped_) {
    const bool guessed = shaped.object->id >= kFirstUnknownObject;
    if (guessed && segment.seen) continue;

    // Find the place of the skin that is nearest, or deepest inside.
    const SE3 T_object_camera = shaped.T_camera_object.inverse();
    const Eigen::Matrix3f R = T_object_camera.R.cast<float>();
    const Vector3f t = T_object_camera.t.cast<float>();
    DistanceGrid::Sample least{SurfaceDistance::kReach, Vector3f::Zero()};
    if (shaped.object->grid.distance(R * skin.centre + t) > skin.radius + SurfaceDistance::kReach) continue;

    // Sample the distance grid of the object at every point of the skin.
    const Vector3f* nearest = nullptr;
    for (const Vector3f& p : skin.points) {
      const DistanceGrid::Sample sample = shaped.object->grid.sample(R * p + t);
      if (sample.distance >= least.distance) continue;
      least = sample;
      nearest = &p;
    }
    if (!nearest || (contact.state != ContactState::unknown && contact.distance <= least.distance)) continue;

    // State the distance.
    Contact found = contact;
    found.normal = shaped.T_camera_object.R * least.gradient.cast<double>().normalized();
    found.distance = least.distance;
    found.point = nearest->cast<double>() - found.distance * found.normal;
    found.deviation = std::sqrt(variance(segment, found.point, found.normal) +
                                variance(shaped.T_camera_object, shaped.covariance, found.point, found.normal) +
                                kSkinDeviation * kSkinDeviation);

    // Only what the hand holds is likely to be touched by a hidden fingertip.
    found.inferred = !segment.seen;
    found.partner = shaped.object->id;
    const bool holds = is_tip(s) && found.inferred && shaped.hand_id == estimate.hand_id;
    set_object_state(found, (params_.touch_distance - found.distance) / found.deviation, holds ? kHiddenTip : 1);

    // A guessed shape need not be all of the object: what is apart from it may touch the rest.
    if (!guessed || found.state == ContactState::touching) contact = found;
  }
}

void ContactStage::touch_objects(const PosedHand& hand, const HandEstimate& estimate, double noise,
                                 SegmentContacts& contacts) {
  for (int s = 0; s < kSegmentCount; ++s) {
    const SegmentState& segment = estimate.segments[s];
    Contact& contact = contacts[s];

    // Find the surface that is nearest to this segment.
    const auto nearest = distance_.measure(hand.skin(s), points_, [this](std::int32_t object, const Vector3f& p) {
      return space_.empty(p) || objects_.seen_empty(object, p);
    });
    if (!nearest) {
      // If nothing is near a visible segment, the state is none; of a hidden segment it is unknown.
      if (segment.seen && segment.visible >= kVisible) {
        contact.state = ContactState::none;
        contact.probability = kOverlooked;
      }
      continue;
    }

    // State the distance and its deviation.
    contact.point = nearest->point.cast<double>();
    contact.normal = nearest->normal.cast<double>();
    contact.distance = nearest->distance;
    contact.deviation = std::sqrt(variance(segment, contact.point, contact.normal) + noise * noise +
                                  kSkinDeviation * kSkinDeviation + nearest->deviation * nearest->deviation);
    contact.inferred = !segment.seen;
    contact.partner = nearest->object;

    // If little of the segment is seen, something unseen may be nearer than the surface that was found.
    const double below = (params_.touch_distance - contact.distance) / contact.deviation;
    const bool visible = segment.seen && segment.visible >= kVisible;
    if (visible)
      set_object_state(contact, (is_tip(s) ? kSharper : 1) * below - kNearer);
    else
      set_object_state(contact, below, is_tip(s) ? kHiddenTip : 1);
    if (contact.state != ContactState::touching && !visible) contact = Contact();
  }
}

void ContactStage::touch_itself(const PosedHand& hand, const HandEstimate& estimate, SegmentContacts& contacts) const {
  all_apart(estimate, contacts);
  const auto& capsules = hand.capsules().capsules();
  const SegmentState& palm = estimate.segments[kPalm];
  for (const auto& [a, b] : hand.capsules().apart()) {
    const CapsuleDistance measured = HandCapsules::distance(capsules[a], hand.segments(), capsules[b], hand.segments());
    if (measured.distance > params_.near_distance) continue;

    // Both segments are attached to the palm, whose own error moves them together.
    const SegmentState &first = estimate.segments[capsules[a].segment],
                       &second = estimate.segments[capsules[b].segment];
    const double common = variance(palm, measured.on_a, measured.normal);
    const double apart =
        variance(first, measured.on_a, measured.normal) + variance(second, measured.on_b, measured.normal) - 2 * common;
    Contact contact = touch_of_skins(measured.distance, std::max(0.0, apart), first, second);
    contact.partner = estimate.hand_id;

    // It is a contact of both segments.
    for (const bool from_a : {true, false}) {
      contact.point = from_a ? measured.on_b : measured.on_a;
      contact.normal = from_a ? measured.normal : Vector3d(-measured.normal);
      contact.segment = static_cast<std::int8_t>(from_a ? capsules[b].segment : capsules[a].segment);
      offer(contacts[from_a ? capsules[a].segment : capsules[b].segment], contact);
    }
  }
}

void ContactStage::touch_hand(std::size_t own, std::size_t other, const HandEstimates& estimates,
                              SegmentContacts& contacts) const {
  all_apart(*estimates[own], contacts);
  const PosedHand &hand = hands_[own], &partner = hands_[other];
  for (const HandCapsules::Capsule& a : hand.capsules().capsules())
    for (const HandCapsules::Capsule& b : partner.capsules().capsules()) {
      const CapsuleDistance measured = HandCapsules::distance(a, hand.segments(), b, partner.segments());
      if (measured.distance > params_.near_distance) continue;

      // The poses of two hands err independently.
      const SegmentState &first = estimates[own]->segments[a.segment], &second = estimates[other]->segments[b.segment];
      const double apart =
          variance(first, measured.on_a, measured.normal) + variance(second, measured.on_b, measured.normal);

      // Offer the contact to the segment, which keeps the nearest one.
      Contact contact = touch_of_skins(measured.distance, apart, first, second);
      contact.point = measured.on_b;
      contact.normal = measured.normal;
      contact.partner = estimates[other]->hand_id;
      contact.segment = static_cast<std::int8_t>(b.segment);
      offer(contacts[a.segment], contact);
    }
}

/// A contact of the skins of two segments. `variance`: of their distance, from the covariances of the segments [m^2].
Contact ContactStage::touch_of_skins(double distance, double variance, const SegmentState& first,
                                     const SegmentState& second) const {
  Contact contact;
  contact.distance = distance;
  contact.deviation = std::sqrt(variance + 2 * kSkinDeviation * kSkinDeviation);
  contact.inferred = !first.seen || !second.seen;
  set_state(contact, (params_.touch_distance - distance) / contact.deviation);
  return contact;
}

/// Sets the probability of a touch, and the state. `deviations`: how far the distance is below the touch distance, in
/// standard deviations; `odds`: how much more likely a touch is for other reasons.
void ContactStage::set_state(Contact& contact, double deviations, double odds) const {
  const double p = 0.5 * std::erfc(-deviations / std::numbers::sqrt2);
  contact.probability = odds * p / (odds * p + 1 - p);
  contact.state = contact.probability >= 0.5                 ? ContactState::touching
                  : contact.distance < params_.near_distance ? ContactState::near
                                                             : ContactState::none;
}

/// Likewise for a touch of an object. The probability shrinks towards one half, so that the state stays.
void ContactStage::set_object_state(Contact& contact, double deviations, double odds) const {
  set_state(contact, deviations, odds);
  contact.probability = kOverlooked + (1 - 2 * kOverlooked) * contact.probability;
}

}  // namespace barehand
