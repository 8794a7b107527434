#include "pipeline/sinks/hand_message_makers.h"

#include "stages/publish/contact_messages.h"
#include "stages/publish/grasp_messages.h"

namespace barehand {

std::span<const HandMessages> HandMessageMakers::make_hands(const TrackedFrame& tracked) {
  const HandEstimates& estimates = tracked.estimates;

  // Start again with new parameters if they have changed.
  if (const auto params = pending_ ? pending_->take() : std::nullopt) {
    params_ = *params;
    makers_.clear();
  }

  // Make the messages of the hands, each with a history of its own.
  while (makers_.size() < estimates.size()) makers_.emplace_back(params_);
  messages_.resize(estimates.size());
  for (std::size_t k = 0; k < estimates.size(); ++k) messages_[k] = makers_[k].process(*estimates[k]);
  return messages_;
}

FrameMessages HandMessageMakers::add_findings(const TrackedFrame& tracked) {
  const HandEstimates& estimates = tracked.estimates;

  // All messages about a hand state the same status.
  const auto published = [&](std::size_t k) { return static_cast<TrackStatus>(messages_[k].state.status); };

  // Add how they grasp and what they touch.
  if (tracked.grasps)
    for (std::size_t k = 0; k < estimates.size(); ++k)
      messages_[k].grasp = grasp_message(*estimates[k], published(k), (*tracked.grasps)[k]);

  // Make the messages of contacts and objects.
  objects_.clear();
  if (const FrameContacts* contacts = tracked.contacts.get()) {
    for (std::size_t k = 0; k < estimates.size(); ++k)
      messages_[k].contact = contact_message(*estimates[k], published(k), contacts->hands[k], contacts->objects);
    for (const ObjectEstimate& object : contacts->objects) objects_.push_back(object_message(*estimates[0], object));
  }
  return {messages_, objects_};
}

}  // namespace barehand
