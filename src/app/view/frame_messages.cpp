// Combines the LCM messages of one frame for the live page.
#include "app/view/frame_messages.h"

#include <algorithm>
#include <map>
#include <optional>

#include "drivers/lcm/frame_message.h"
#include "drivers/lcm/layouts.h"
#include "stages/publish/openxr_joints.h"

namespace barehand {
namespace {

/// Sizes of the tracked hand relative to the profile: the lengths of the bones, the distance of the knuckles, and the
/// radii of the joints.
SegmentSizes sizes_of(const hand_state_t& state, const hand_joints_t* joints, const HandProfile& profile) {
  const auto begin = [&](int s) { return Eigen::Vector3d(state.segments[s].position); };
  Eigen::Array<double, 1, kSegmentCount> length;
  for (int s = 0; s < kSegmentCount; ++s)
    length[s] = (Eigen::Vector3d(state.segments[s].distal) - begin(s)).norm() / profile.segments[s].distal.norm();

  // A person's own skin keeps its form: the tracked hand may be another profile's.
  if (profile.origin != ProfileOrigin::mean) return SegmentSizes::Constant(static_cast<float>(length.mean()));

  // Compare the radii of the joints; the first is in the middle of the palm.
  Eigen::Array<double, 1, kOpenXrJointCount> radius;
  radius = length.mean();
  const auto own = openxr_joints(profile, {});
  for (int j = 0; joints && j < kOpenXrJointCount; ++j) radius[j] = joints->radius[j] / own[j].radius;

  // Segments are as wide as thick, but for the palm, which is as wide as its knuckles are far apart.
  SegmentSizes sizes;
  for (int s = 0; s < kSegmentCount; ++s) {
    const auto joint = std::ranges::find(own, s, &OpenXrJoint::segment) - own.begin(),
               next = s == kPalm ? joint : joint + 1;
    const Eigen::Vector3d at_begin(radius[joint], radius[joint], length[s]),
        at_end(radius[next], radius[next], length[s]);
    sizes.col(s) << at_begin.cast<float>(), at_end.cast<float>();
  }
  constexpr int kFirst = segment_of(1, 0), kLast = segment_of(4, 0);
  const SegmentProfile &first = profile.segments[kFirst], &last = profile.segments[kLast];
  sizes(0, kPalm) = sizes(3, kPalm) = static_cast<float>((begin(kFirst) - begin(kLast)).norm() /
                                                         (first.T_hand_segment.t - last.T_hand_segment.t).norm());
  return sizes;
}

/// The messages of one hand received so far.
struct HandParts {
  std::optional<hand_state_t> state;
  std::optional<glove_state_t> glove;
  std::optional<hand_joints_t> joints;
  std::optional<contact_state_t> contact;
  std::optional<grasp_state_t> grasp;
};

void add(ViewFrame::Content& content, const char* channel, const ReceivedMessage& message) {
  ViewMessage& added = content.messages.emplace_back();
  added.channel = channel;
  added.bytes.assign(message.bytes.begin(), message.bytes.end());
}

}  // namespace

MessageKind kind_of(std::int64_t hash) {
  if (hash == hand_state_t::getHash()) return MessageKind::hand_state;
  if (hash == glove_state_t::getHash()) return MessageKind::glove_state;
  if (hash == hand_joints_t::getHash()) return MessageKind::hand_joints;
  if (hash == contact_state_t::getHash()) return MessageKind::contact_state;
  if (hash == grasp_state_t::getHash()) return MessageKind::grasp_state;
  if (hash == object_state_t::getHash()) return MessageKind::object_state;
  if (hash == health_t::getHash()) return MessageKind::health;
  return carries_frames(hash) ? MessageKind::frame : MessageKind::other;
}

void ShownHands::prepare() const {
  for (const ViewSkinPtr& base : bases_) base->mesh();
}

ViewSkinPtr ShownHands::skin_of(const hand_state_t& state, const hand_joints_t* joints) {
  constexpr float kSameSize = 0.02f;
  const std::size_t side = state.handedness == hand_state_t::LEFT ? 0 : 1;
  if (!state.has_pose) return skins_[side];
  const SegmentSizes sizes = sizes_of(state, joints, *bases_[side]->profile());
  if (!((sizes.array() > 0.3f).all() && (sizes.array() < 3).all())) return skins_[side];
  if (((sizes - sizes_[side]).array().abs() > kSameSize * sizes.array()).any()) {
    sizes_[side] = sizes;
    skins_[side] = std::make_shared<const ViewSkin>(bases_[side], sizes);
  }
  return skins_[side];
}

ViewFrame::Content frame_content(std::span<const ReceivedMessage> messages, ShownHands& hands,
                                 const GivenIntrinsics& foreign, FramePtr image) {
  ViewFrame::Content content;
  content.frame = std::move(image);
  FrameVector<Eigen::Vector3d> places;
  std::map<std::int32_t, HandParts> parts;  // by hand_id

  // The messages of hands are passed on as received; an image is decoded.
  for (const ReceivedMessage& message : messages) {
    const MessageKind kind = kind_of(message_hash(message.bytes));
    if (kind == MessageKind::hand_state) {
      const auto state = decode_message<hand_state_t>(message.bytes);
      if (!state) continue;
      content.utime = state->utime;
      content.number = state->frame_number;
      for (const segment_state_t& segment : state->segments) places.push_back(Eigen::Vector3d(segment.position));
      add(content, "HAND_STATE", message);
      parts[state->hand_id].state = *state;
    } else if (kind == MessageKind::glove_state) {
      const auto glove = decode_message<glove_state_t>(message.bytes);
      if (!glove) continue;
      add(content, "GLOVE_STATE", message);
      parts[glove->hand_id].glove = *glove;
    } else if (kind == MessageKind::hand_joints) {
      const auto joints = decode_message<hand_joints_t>(message.bytes);
      if (!joints) continue;
      add(content, "HAND_JOINTS", message);
      parts[joints->hand_id].joints = *joints;
    } else if (kind == MessageKind::contact_state) {
      const auto contact = decode_message<contact_state_t>(message.bytes);
      if (!contact) continue;
      add(content, "CONTACT_STATE", message);
      parts[contact->hand_id].contact = *contact;
    } else if (kind == MessageKind::grasp_state) {
      const auto grasp = decode_message<grasp_state_t>(message.bytes);
      if (!grasp) continue;
      add(content, "GRASP_STATE", message);
      parts[grasp->hand_id].grasp = *grasp;
    } else if (kind == MessageKind::object_state) {
      const auto object = decode_message<object_state_t>(message.bytes);
      if (!object) continue;
      add(content, "OBJECT_STATE", message);
      content.objects.push_back(*object);
    } else if (kind == MessageKind::frame && !content.frame) {
      if (const auto frame = decode_frame_message(message.bytes, foreign, content.number)) content.frame = *frame;
    }
  }

  for (const auto& [id, hand] : parts) {
    if (hand.state)
      content.skins[hand.state->handedness == hand_state_t::LEFT ? 0 : 1] =
          hands.skin_of(*hand.state, hand.joints ? &*hand.joints : nullptr);
    if (hand.state && hand.glove && hand.joints)
      content.hands.push_back({*hand.state, *hand.glove, *hand.joints, hand.contact, hand.grasp});
  }

  // Without states, the time and the number of the frame are those of the image.
  if (content.frame && content.utime == 0) {
    content.utime = content.frame->utime;
    content.number = content.frame->number;
  }
  if (content.frame) content.focus = focus_on(places, content.frame->camera);
  return content;
}

}  // namespace barehand
