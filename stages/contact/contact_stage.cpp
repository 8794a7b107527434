#include "stages/contact/contact_stage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hand/skin.h"

namespace barehand {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kSkinPoints = 80;            // per segment
constexpr double kSkinChange = 0.0005;     // change of a bone or a section that is worth a new skin [m]
constexpr double kSkinDeviation = 0.0015;  // of the skin model [m]
constexpr float kWrist = 0.02f;            // skin of the palm nearer to the wrist than this lies on the sleeve [m]
constexpr double kVisible = 0.5;           // visible fraction of a segment that shows whether something is near it
// How much the odds of a touch rise if it is a hidden fingertip and its hand holds the object: tips that are not seen
// rest on what the hand holds.
constexpr double kHolds = 3;
constexpr float kOwnSkin = 0.004f;  // points this near to skin that faces the same way are the hand's own [m]

bool tracked(const HandEstimate& estimate) { return estimate.status == TrackStatus::tracking && estimate.profile; }

/// Whether two profiles have the same skin, but for fractions of a millimetre.
bool alike(const HandProfile& a, const HandProfile& b) {
  if (a.handedness != b.handedness || a.scanned_skin != b.scanned_skin) return false;
  for (int s = 0; s < kSegmentCount; ++s) {
    const SegmentProfile &x = a.segments[s], &y = b.segments[s];
    double change = std::max((x.distal - y.distal).norm(), (x.T_hand_segment.t - y.T_hand_segment.t).norm());
    for (int end = 0; end < 2; ++end)
      change = std::max({change, std::abs(x.half_width[end] - y.half_width[end]),
                         std::abs(x.half_thickness[end] - y.half_thickness[end]),
                         std::abs(x.flesh_offset_x[end] - y.flesh_offset_x[end]),
                         std::abs(x.flesh_offset_y[end] - y.flesh_offset_y[end])});
    if (change > kSkinChange) return false;
  }
  return true;
}

/// Variance of a point of a body along a direction, by the body's pose and the covariance of that [m^2].
double variance(const SE3& T_camera_body, const Matrix6d& covariance, const Vector3d& point,
                const Vector3d& direction) {
  const Vector6d row = point_jacobian(point - T_camera_body.t).transpose() * direction;
  return row.dot(covariance * row);
}
double variance(const SegmentState& segment, const Vector3d& point, const Vector3d& direction) {
  return variance(segment.T_camera_segment, segment.covariance, point, direction);
}

/// States that no segment is near anything; what is not seen is inferred.
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

  // Collect the surfaces around the tracked hands, and tell the objects apart.
  points_.clear();
  open_.clear();
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    if (!tracked(*estimates[k])) continue;
    prepare(hands_[k], *estimates[k]);
    if (observations[k]->hand_present) cells_.collect(observations, estimates, k, points_, open_);
  }
  drop_skin(estimates);
  objects_.process(estimates.empty() ? 0 : estimates[0]->utime, estimates, open_, points_, out->objects);
  find_known(observations, estimates, out->objects);

  // Measure the distances of each hand's segments.
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    if (!tracked(*estimates[k])) continue;
    HandContacts& contacts = out->hands[k];
    touch_objects(hands_[k], *estimates[k], observations[k]->noise, contacts.object);
    for (int s = 0; s < kSegmentCount; ++s) touch_known(hands_[k], *estimates[k], s, contacts.object[s]);
    touch_itself(hands_[k], *estimates[k], contacts.own);
    for (std::size_t other = 0; other < estimates.size(); ++other)
      if (other != k && tracked(*estimates[other])) touch_hand(k, other, estimates, contacts.other_hand);
  }
  return out;
}

void ContactStage::prepare(Hand& hand, const HandEstimate& estimate) {
  // Make the skin if this is another hand than before.
  if (!hand.profile || (hand.profile != estimate.profile && !alike(*hand.profile, *estimate.profile))) {
    const HandProfile& profile = *estimate.profile;
    hand.surface = profile.scanned_skin ? surface_points(*profile.scanned_skin, profile, kSkinPoints)
                                        : make_cylinder_surface(profile, kSkinPoints);
    hand.rods.emplace(*estimate.profile);
    hand.profile = estimate.profile;
  }

  // Pose it.
  hand.pose = pose_of(estimate.segments);
  for (int s = 0; s < kSegmentCount; ++s) {
    const SegmentSurface& surface = hand.surface[s];
    const Eigen::Matrix3f R = hand.pose[s].R.cast<float>();
    const Vector3f t = hand.pose[s].t.cast<float>();
    PosedSkin& skin = hand.skin[s];

    // Move its points, and enclose them in a sphere.
    skin.points.clear();
    skin.normals.clear();
    skin.centre.setZero();
    for (std::size_t i = 0; i < surface.size(); ++i) {
      if (s == kPalm && surface.z[i] > -kWrist) continue;
      skin.points.push_back(R * Vector3f(surface.x[i], surface.y[i], surface.z[i]) + t);
      skin.normals.push_back(R * Vector3f(surface.nx[i], surface.ny[i], surface.nz[i]));
      skin.centre += skin.points.back();
    }
    skin.centre /= static_cast<float>(skin.points.size());
    skin.radius = 0;
    for (const Vector3f& p : skin.points) skin.radius = std::max(skin.radius, (p - skin.centre).norm());
  }
}

/// Removes points of the hands' own skin that preprocessing took for an object's: near to the skin, and facing the same
/// way. What touches the skin faces it.
void ContactStage::drop_skin(const HandEstimates& estimates) {
  std::erase_if(points_, [&](const SurfacePoint& point) {
    for (std::size_t k = 0; k < estimates.size(); ++k) {
      if (!tracked(*estimates[k])) continue;
      for (const PosedSkin& skin : hands_[k].skin) {
        const float reach = skin.radius + kOwnSkin;
        if ((point.p - skin.centre).squaredNorm() > reach * reach) continue;
        for (std::size_t i = 0; i < skin.points.size(); ++i)
          if ((point.p - skin.points[i]).squaredNorm() < kOwnSkin * kOwnSkin && point.n.dot(skin.normals[i]) > 0.5f)
            return true;
      }
    }
    return false;
  });
}

/// Finds the known objects. Their meshes take the place of the points that are seen of them.
void ContactStage::find_known(const HandObservations& observations, const HandEstimates& estimates,
                              FrameVector<SeenObject>& objects) {
  if (!find_known_) return;
  known_ = find_known_(observations, estimates, points_, objects);
  std::erase_if(points_, [&](const SurfacePoint& point) {
    return std::ranges::any_of(known_, [&](const PosedObject& known) { return known.object->id == point.object; });
  });
}

/// The distance of a segment from the known objects, all of whose surface is known. Nothing changes if none is near.
void ContactStage::touch_known(const Hand& hand, const HandEstimate& estimate, int s, Contact& contact) const {
  const PosedSkin& skin = hand.skin[s];
  const SegmentState& segment = estimate.segments[s];
  for (const PosedObject& known : known_) {
    // Find the place of the skin that is nearest, or deepest inside.
    const SE3 T_object_camera = known.T_camera_object.inverse();
    const Eigen::Matrix3f R = T_object_camera.R.cast<float>();
    const Vector3f t = T_object_camera.t.cast<float>();
    DistanceGrid::Sample least{SurfaceDistance::kReach, Vector3f::Zero()};
    if (known.object->grid.distance(R * skin.centre + t) > skin.radius + SurfaceDistance::kReach) continue;
    const Vector3f* nearest = nullptr;
    for (const Vector3f& p : skin.points) {
      const DistanceGrid::Sample sample = known.object->grid.sample(R * p + t);
      if (sample.distance >= least.distance) continue;
      least = sample;
      nearest = &p;
    }
    if (!nearest || (contact.state != ContactState::unknown && contact.distance <= least.distance)) continue;

    // State the distance.
    contact.normal = known.T_camera_object.R * least.gradient.cast<double>().normalized();
    contact.distance = least.distance;
    contact.point = nearest->cast<double>() - contact.distance * contact.normal;
    contact.deviation = std::sqrt(variance(segment, contact.point, contact.normal) +
                                  variance(known.T_camera_object, known.covariance, contact.point, contact.normal) +
                                  kSkinDeviation * kSkinDeviation);
    contact.inferred = !segment.seen;
    contact.partner = known.object->id;
    const bool holds = is_tip(s) && contact.inferred && known.hand_id == estimate.hand_id;
    judge(contact, holds ? kHolds : 1);
  }
}

void ContactStage::touch_objects(const Hand& hand, const HandEstimate& estimate, double noise,
                                 SegmentContacts& contacts) {
  for (int s = 0; s < kSegmentCount; ++s) {
    const SegmentState& segment = estimate.segments[s];
    Contact& contact = contacts[s];
    const auto nearest = distance_.measure(hand.skin[s], points_);
    if (!nearest) {
      // Nothing is near what is seen; whether something is near what is not seen is unknown.
      if (segment.seen && segment.visible >= kVisible) {
        contact.state = ContactState::none;
        contact.probability = 0;
      }
      continue;
    }
    contact.point = nearest->point.cast<double>();
    contact.normal = nearest->normal.cast<double>();
    contact.distance = nearest->distance;
    contact.deviation = std::sqrt(variance(segment, contact.point, contact.normal) + noise * noise +
                                  kSkinDeviation * kSkinDeviation + nearest->deviation * nearest->deviation);
    contact.inferred = !segment.seen;
    contact.partner = nearest->object;
    judge(contact);

    // Where little of the segment is seen, there may be something nearer than what was found.
    if (contact.state != ContactState::touching && (!segment.seen || segment.visible < kVisible)) contact = Contact();
  }
}

void ContactStage::touch_itself(const Hand& hand, const HandEstimate& estimate, SegmentContacts& contacts) const {
  all_apart(estimate, contacts);
  const auto& rods = hand.rods->rods();
  const SegmentState& palm = estimate.segments[kPalm];
  for (const auto& [a, b] : hand.rods->apart()) {
    const RodDistance measured = HandRods::distance(rods[a], hand.pose, rods[b], hand.pose);
    if (measured.distance > params_.near_distance) continue;

    // Both segments hang on the palm, whose own error moves them together.
    const SegmentState &first = estimate.segments[rods[a].segment], &second = estimate.segments[rods[b].segment];
    const double common = variance(palm, measured.on_a, measured.normal);
    const double apart =
        variance(first, measured.on_a, measured.normal) + variance(second, measured.on_b, measured.normal) - 2 * common;
    Contact contact = touch_of_skins(measured.distance, std::max(0.0, apart), first, second);
    contact.partner = estimate.hand_id;

    // It is a contact of both segments.
    for (const bool from_a : {true, false}) {
      contact.point = from_a ? measured.on_b : measured.on_a;
      contact.normal = from_a ? measured.normal : Vector3d(-measured.normal);
      contact.segment = static_cast<std::int8_t>(from_a ? rods[b].segment : rods[a].segment);
      offer(contacts[from_a ? rods[a].segment : rods[b].segment], contact);
    }
  }
}

void ContactStage::touch_hand(std::size_t own, std::size_t other, const HandEstimates& estimates,
                              SegmentContacts& contacts) const {
  all_apart(*estimates[own], contacts);
  const Hand &hand = hands_[own], &partner = hands_[other];
  for (const HandRods::Rod& a : hand.rods->rods())
    for (const HandRods::Rod& b : partner.rods->rods()) {
      const RodDistance measured = HandRods::distance(a, hand.pose, b, partner.pose);
      if (measured.distance > params_.near_distance) continue;

      // The poses of two hands err independently.
      const SegmentState &first = estimates[own]->segments[a.segment], &second = estimates[other]->segments[b.segment];
      const double apart =
          variance(first, measured.on_a, measured.normal) + variance(second, measured.on_b, measured.normal);
      Contact contact = touch_of_skins(measured.distance, apart, first, second);
      contact.point = measured.on_b;
      contact.normal = measured.normal;
      contact.partner = estimates[other]->hand_id;
      contact.segment = static_cast<std::int8_t>(b.segment);
      offer(contacts[a.segment], contact);
    }
}

/// A contact of the skins of two segments, whose distance has this variance by the poses of the segments [m^2].
Contact ContactStage::touch_of_skins(double distance, double variance, const SegmentState& first,
                                     const SegmentState& second) const {
  Contact contact;
  contact.distance = distance;
  contact.deviation = std::sqrt(variance + 2 * kSkinDeviation * kSkinDeviation);
  contact.inferred = !first.seen || !second.seen;
  judge(contact);
  return contact;
}

/// Sets the probability of a touch, and the state, from the distance and its deviation. `odds`: how much more likely a
/// touch is for other reasons.
void ContactStage::judge(Contact& contact, double odds) const {
  const double p =
      0.5 * std::erfc((contact.distance - params_.touch_distance) / (contact.deviation * std::numbers::sqrt2));
  contact.probability = odds * p / (odds * p + 1 - p);
  contact.state = contact.probability >= 0.5                 ? ContactState::touching
                  : contact.distance < params_.near_distance ? ContactState::near
                                                             : ContactState::none;
}

}  // namespace barehand
