#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hand/hand_pose.h"
#include "observe/detection.h"
#include "stages/preprocess/coarse_grid.h"
#include "stages/preprocess/coarse_hand.h"

namespace barehand {

/// Decides whether colour shows where hands are. It does not if a hand wears a glove, is overexposed or is lit by
/// coloured light: then the networks see a hand in depth of which hardly anything has the colour of skin.
class ColourTrust {
 public:
  /// Whether colour is used in frame `number`. A tracked hand is followed as in the frame in which it was found;
  /// without one, the most probable detected hand decides. `grid` must be coloured, and `detection` may be null.
  bool trusts(std::int64_t number, const CoarseGrid& grid, std::span<const HandEstimatePtr> feedback,
              const Detection* detection);
  /// Takes note of the colour of the hands that were followed in this frame: trusts colour again if it is that of skin,
  /// also because the skin model has learned the colour of a glove.
  void learn(const CoarseGrid& grid, std::span<const CoarseHand> hands);
  /// The last decision.
  bool trusted() const { return decided(number_); }

 private:
  struct Decision {
    std::int64_t number = 0;
    bool trusted = true;
  };
  bool decide(const CoarseGrid& grid, std::span<const HandEstimatePtr> feedback, const Detection* detection);
  bool decided(std::int64_t number) const;

  static std::size_t slot(std::int64_t number) { return static_cast<std::uint64_t>(number) % kKept; }

  static constexpr std::size_t kKept = 64;
  std::array<Decision, kKept> decisions_;  // of the last frames, at the slots of their numbers
  std::int64_t number_ = 0;                // of the last frame
  bool followed_ = false;                  // whether the last frame's feedback had a hand
};

}  // namespace barehand
