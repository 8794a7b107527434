// Converts what is known about a grasp to an LCM message.
#include "stages/publish/grasp_messages.h"

#include <algorithm>
#include <utility>

#include "barehand/hand_state_t.hpp"

namespace barehand {
namespace {

/// A property of a grasp and its probability.
template <class Property>
struct Probable {
  Property property;
  double probability;
};

/// The most probable value of a property, by the sum over the classes that have it; `none` if no grasp is stated.
template <class Property, class PropertyOf>
Probable<Property> most_probable(const HandGrasp& grasp, Property none, PropertyOf&& property_of) {
  const GraspProbabilities& probabilities = grasp.probabilities;
  if (grasp.grasp == 0) return {none, probabilities[0]};
  Probable<Property> best{none, -1};
  for (const GraspType& type : grasp_types()) {
    const Property property = property_of(type);
    double sum = 0;
    for (std::size_t k = 0; k < kGraspTypeCount; ++k)
      if (property_of(grasp_types()[k]) == property) sum += probabilities[k + 1];
    if (sum > best.probability) best = {property, sum};
  }
  return best;
}

void fill_unknown(grasp_state_t& out) {
  for (std::int8_t* state : {&out.grasp, &out.kind, &out.opposition, &out.thumb, &out.first_finger, &out.last_finger})
    *state = grasp_state_t::UNKNOWN;
  for (double* number : {&out.probability, &out.kind_probability, &out.opposition_probability, &out.thumb_probability,
                         &out.finger_probability, &out.aperture, &out.closure})
    *number = HandGrasp::kUnknown;
  for (double& number : out.probabilities) number = HandGrasp::kUnknown;
}

void fill_known(grasp_state_t& out, const HandGrasp& grasp) {
  out.grasp = static_cast<std::int8_t>(grasp.grasp);
  out.probability = grasp.probabilities[static_cast<std::size_t>(grasp.grasp)];
  out.since = grasp.since;
  std::copy(grasp.probabilities.begin(), grasp.probabilities.end(), out.probabilities);
  out.aperture = grasp.aperture;
  out.closure = grasp.closure;

  // Properties of several classes.
  const auto kind = most_probable(grasp, GraspKind::none, [](const GraspType& type) { return type.kind; });
  const auto opposition = most_probable(grasp, Opposition::none, [](const GraspType& type) { return type.opposition; });
  const auto thumb = most_probable(grasp, ThumbPosition::none, [](const GraspType& type) { return type.thumb; });
  const auto fingers = most_probable(
      grasp, std::pair(0, 0), [](const GraspType& type) { return std::pair(type.first_finger, type.last_finger); });

  // State each with its probability.
  out.kind = static_cast<std::int8_t>(kind.property);
  out.kind_probability = kind.probability;
  out.opposition = static_cast<std::int8_t>(opposition.property);
  out.opposition_probability = opposition.probability;
  out.thumb = static_cast<std::int8_t>(thumb.property);
  out.thumb_probability = thumb.probability;
  out.first_finger = static_cast<std::int8_t>(fingers.property.first);
  out.last_finger = static_cast<std::int8_t>(fingers.property.second);
  out.finger_probability = fingers.probability;
}

}  // namespace

grasp_state_t grasp_message(const HandEstimate& estimate, TrackStatus published, const HandGrasp& grasp) {
  grasp_state_t out{};
  out.utime = estimate.utime;
  out.frame_number = estimate.number;
  out.sensor = estimate.sensor;
  out.hand_id = estimate.hand_id;
  out.handedness = estimate.handedness == Handedness::left ? hand_state_t::LEFT : hand_state_t::RIGHT;
  out.status = static_cast<std::int8_t>(published);
  if (grasp.known)
    fill_known(out, grasp);
  else
    fill_unknown(out);
  return out;
}

}  // namespace barehand
