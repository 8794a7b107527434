#pragma once

#include <span>
#include <vector>

#include "barehand/object_state_t.hpp"
#include "core/slot.h"
#include "pipeline/sink.h"
#include "stages/publish/hand_messages.h"

namespace barehand {

/// The messages of one frame: of the hands in the order of the estimates, and of the objects.
struct FrameMessages {
  std::span<const HandMessages> hands;
  std::span<const object_state_t> objects;
};

/// Makes the messages of all hands and objects of every frame.
class HandMessageMakers {
 public:
  /// `pending`: changed parameters, taken before every frame; may be null; must outlive this object.
  HandMessageMakers(const PublishParams& params, Slot<PublishParams>* pending) : params_(params), pending_(pending) {}
  // Messages are valid until the next frame.

  /// The messages of the hands, without what was found about them. Smoothing begins anew if parameters changed.
  std::span<const HandMessages> make_hands(const TrackedFrame& tracked);
  /// Completes the messages of make_hands(), which must have been called for the same frame.
  FrameMessages add_findings(const TrackedFrame& tracked);
  /// Both in one.
  FrameMessages process(const TrackedFrame& tracked) { return make_hands(tracked), add_findings(tracked); }

 private:
  PublishParams params_;
  Slot<PublishParams>* pending_;
  std::vector<HandMessageMaker> makers_;  // one per hand
  std::vector<HandMessages> messages_;
  std::vector<object_state_t> objects_;
};

}  // namespace barehand
