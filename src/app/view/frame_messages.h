#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "barehand/hand_joints_t.hpp"
#include "barehand/hand_state_t.hpp"
#include "hand/profile.h"
#include "io/web/view_frame.h"
#include "sensor/given_intrinsics.h"

namespace barehand {

// The LCM messages of one frame, combined for the live page.

/// The kinds of LCM messages that the page can show.
enum class MessageKind {
  hand_state,
  glove_state,
  hand_joints,
  contact_state,
  grasp_state,
  object_state,
  health,
  frame,
  other
};
/// The kind of a message, by the fingerprint of its type.
MessageKind kind_of(std::int64_t hash);

/// A message as it was received.
struct ReceivedMessage {
  std::string channel;
  std::vector<std::uint8_t> bytes;
};

/// Skins to draw the hands in states with. States carry no skin; the skin of a profile that the user gave is scaled to
/// the size of the tracked hand, and that of the mean adult hand gets the lengths and the thickness in its messages.
class ShownHands {
 public:
  /// `profiles` are indexed by Handedness; none may be null. `names`: as in ViewState::drawn.
  explicit ShownHands(const std::array<std::shared_ptr<const HandProfile>, 2>& profiles,
                      std::array<std::string, 2> names = {})
      : bases_{std::make_shared<const ViewSkin>(profiles[0]), std::make_shared<const ViewSkin>(profiles[1])},
        names_(std::move(names)) {
    sizes_.fill(SegmentSizes::Zero());
  }
  /// Makes the skins of the profiles, which takes tens of milliseconds, so that no frame waits for that later.
  void prepare() const;
  /// `joints`: of the same hand and frame; null: the hand is as thick as its bones are long.
  ViewSkinPtr skin_of(const hand_state_t& state, const hand_joints_t* joints);
  const std::array<std::string, 2>& names() const { return names_; }

 private:
  std::array<ViewSkinPtr, 2> bases_;  // of the profiles
  std::array<std::string, 2> names_;
  std::array<ViewSkinPtr, 2> skins_;
  std::array<SegmentSizes, 2> sizes_;  // of the skins
};

/// Collects what the messages of one frame contain; damaged messages are left out. `foreign`: intrinsics of frames
/// whose type carries none. `image`: the frame's images if they are in no message; null: they may be.
ViewFrame::Content frame_content(std::span<const ReceivedMessage> messages, ShownHands& hands,
                                 const GivenIntrinsics& foreign, FramePtr image = nullptr);

}  // namespace barehand
