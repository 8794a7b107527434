#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "barehand/hand_state_t.hpp"
#include "hand/profile.h"
#include "io/web/view_frame.h"
#include "sensor/given_intrinsics.h"

namespace barehand {

/// What the page may show of the messages on LCM.
enum class MessageKind { hand_state, glove_state, hand_joints, health, frame, other };
/// By the fingerprint of a message's type.
MessageKind kind_of(std::int64_t hash);

/// One message as it came.
struct LcmMessage {
  std::string channel;
  std::vector<std::uint8_t> bytes;
};

/// The skins of the hands that the states tell of. States carry no skin, so that one is shown whose profile the user
/// gave, or the mean adult hand's, made as large as the tracked one.
class ShownHands {
 public:
  /// `profiles`: by Handedness, both there.
  explicit ShownHands(std::array<std::shared_ptr<const HandProfile>, 2> profiles) : profiles_(std::move(profiles)) {}
  ViewSkinPtr skin_of(const hand_state_t& state);

 private:
  std::array<std::shared_ptr<const HandProfile>, 2> profiles_;
  std::array<ViewSkinPtr, 2> skins_;
  std::array<double, 2> sizes_{};  // of the skins, against the profiles
};

/// All that `messages`, which are of one frame, say of it; what is damaged is left out. `foreign`: intrinsics of frames
/// that come without.
ViewFrame::Content frame_content(std::span<const LcmMessage> messages, ShownHands& hands,
                                 const GivenIntrinsics& foreign);

}  // namespace barehand
