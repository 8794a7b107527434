#pragma once

#include <span>
#include <vector>

#include "core/slot.h"
#include "hand/hand_pose.h"
#include "stages/publish/hand_messages.h"

namespace barehand {

/// Makes the messages of all hands of every frame.
class HandMessageMakers {
 public:
  /// `pending`: changed parameters, taken before every frame; may be null; must outlive this object.
  HandMessageMakers(const PublishParams& params, Slot<PublishParams>* pending) : params_(params), pending_(pending) {}
  /// The messages in the order of the estimates, valid until the next call. Smoothing begins anew if parameters
  /// changed.
  std::span<const HandMessages> process(const HandEstimates& estimates);

 private:
  PublishParams params_;
  Slot<PublishParams>* pending_;
  std::vector<HandMessageMaker> makers_;  // one per hand
  std::vector<HandMessages> messages_;
};

}  // namespace barehand
