#pragma once

#include <optional>

#include "stages/preprocess/components.h"
#include "stages/preprocess/predicted_hand.h"
#include "stages/preprocess/wrist.h"

namespace barehand {

/// The hand in the coarse grid.
struct CoarseHand {
  bool found = false;
  Image<std::uint8_t> cells;                ///< 1 = hand
  std::optional<PredictedHand> prediction;  ///< the hint, moved to where the hand is now; none if it did not help
  Image<float> distance;                    ///< [m] from candidates to the prediction's skin; infinite far away
  std::optional<WristPlane> wrist;          ///< what lies behind is forearm
};

/// Looks for the hand, first where the hint says, moved by up to max_speed * age of the hint; else in the whole image.
class HandSearch {
 public:
  explicit HandSearch(const PreprocessParams& params) : params_(params) {}
  /// `hint_age`: seconds between the hint's frame and this one. The result lives until the next call.
  const CoarseHand& find(const CoarseGrid& grid, const HandEstimate* hint, double hint_age);

 private:
  std::optional<Eigen::Vector3f> motion(const CoarseGrid& grid, const PredictedHand& hand, double reach);
  bool follow(const CoarseGrid& grid, const HandEstimate& hint, double hint_age);
  bool start(const CoarseGrid& grid);
  int choose_part(const CoarseGrid& grid) const;
  float hand_area(const CoarseGrid& grid) const;

  PreprocessParams params_;
  Image<std::uint8_t> candidates_, movable_;
  CandidateFinder finder_;
  Components surfaces_;
  CoarseHand hand_;
};

}  // namespace barehand
