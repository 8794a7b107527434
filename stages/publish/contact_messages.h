#pragma once

#include <vector>

#include "barehand/contact_state_t.hpp"
#include "barehand/object_state_t.hpp"
#include "hand/contacts.h"
#include "hand/hand_pose.h"

namespace barehand {

/// The message about what one hand of a frame touches. `published`: the status in its hand_state_t; `objects`: those of
/// the frame, in whose frames contacts are expressed as well.
contact_state_t contact_message(const HandEstimate& estimate, TrackStatus published, const HandContacts& contacts,
                                const FrameVector<ObjectEstimate>& objects);

/// The message about an object in the frame of `estimate`.
object_state_t object_message(const HandEstimate& estimate, const ObjectEstimate& object);

}  // namespace barehand
