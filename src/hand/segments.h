#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace barehand {

/// The 16 rigid segments of the hand (paper Sec. 3), always in this order: the palm, then five chains of three. Frame
/// of a segment: origin at the proximal end, -z along the bone towards the distal end, +y out of the back of the hand,
/// x along the flexion axis.
inline constexpr int kSegmentCount = 16;
inline constexpr int kPalm = 0;
inline constexpr int kFingerCount = 5;  ///< thumb, index, middle, ring, little
inline constexpr std::array<std::string_view, kSegmentCount> kSegmentNames = {
    "palm",         "thumb_metacarpal", "thumb_proximal",      "thumb_distal",  "index_proximal", "index_intermediate",
    "index_distal", "middle_proximal",  "middle_intermediate", "middle_distal", "ring_proximal",  "ring_intermediate",
    "ring_distal",  "little_proximal",  "little_intermediate", "little_distal"};

/// Index of the k-th segment (0 = nearest to the palm, 2 = fingertip) of a finger (0 = thumb).
constexpr int segment_of(int finger, int k) { return 1 + 3 * finger + k; }
/// The finger (0 = thumb) of a segment that is not the palm.
constexpr int finger_of(int segment) { return (segment - 1) / 3; }
constexpr bool is_tip(int segment) { return segment != kPalm && (segment - 1) % 3 == 2; }
/// The next segment towards the palm; -1 for the palm itself.
constexpr int parent_of(int segment) { return segment == kPalm ? -1 : ((segment - 1) % 3 == 0 ? kPalm : segment - 1); }

/// The index of a segment by its name in kSegmentNames; none if there is no such name.
std::optional<int> segment_from_name(std::string_view name);

enum class Handedness { left, right };
/// "left" or "right".
std::string_view to_string(Handedness side);
/// 1 for a right hand, -1 for a left one. Mirroring a hand in x changes the sign of offsets along x and of rotations
/// about y and z.
constexpr double side_sign(Handedness side) { return side == Handedness::right ? 1.0 : -1.0; }
constexpr Handedness opposite(Handedness side) {
  return side == Handedness::right ? Handedness::left : Handedness::right;
}

}  // namespace barehand
