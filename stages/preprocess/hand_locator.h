#pragma once

#include <optional>
#include <span>
#include <vector>

#include "observe/detection.h"
#include "stages/preprocess/alignment.h"
#include "stages/preprocess/coarse_hand.h"
#include "stages/preprocess/standing_depth.h"

namespace barehand {

// Finds the hands in the coarse grid of a frame.

/// Finds which cells of the coarse grid belong to which hand (a segmentation; the search for poses is in
/// stages/search). A hand with feedback is expected near its pose there, within max_speed times the feedback's age;
/// tracked hands come first. Hands that are not found there, or have no feedback, are searched for in the rest of the
/// image. A cell belongs to at most one hand.
class HandLocator {
 public:
  HandLocator(const PreprocessParams& params, int hands) : params_(params), hands_(hands) {}
  /// `standing`: what stood there before; it is no part of a tracked hand. `feedback`: one estimate per hand or none at
  /// all; each may be null. `feedback_age`: seconds since its frame.
  /// `detection`: result for this frame; null: surfaces and colours alone decide. Within its windows, its labels
  /// distinguish the hand from arm, object and background; if its `whole_frame` is set, nothing else starts a hand. If
  /// it looked around the tracked hands and there is no colour, a hand that it did not see there is not found there
  /// either. Returns one result per hand, in the order of the feedback, valid until the next call and as long as
  /// `detection`.
  std::span<const CoarseHand> find(const CoarseGrid& grid, const StandingDepth& standing,
                                   std::span<const HandEstimatePtr> feedback, double feedback_age,
                                   const Detection* detection = nullptr);
  /// Whether something of the colour of skin touches a followed hand of the last frame, so that labels are needed to
  /// tell it apart.
  bool colour_misleads() const { return colour_misleads_; }

 private:
  std::optional<Eigen::Vector3f> motion(const CoarseGrid& grid, const PredictedHand& hand, double reach);
  void remove_nearer_to(const CoarseGrid& grid, const PredictedHand& other, const PredictedHand& own);
  bool follow(const CoarseGrid& grid, PredictedHand body, bool tracked, double feedback_age, const Detection* detection,
              CoarseHand& hand);
  bool start(const CoarseGrid& grid, CoarseHand& hand);
  void locate(const CoarseGrid& grid, const StandingDepth& standing, std::span<const HandEstimatePtr> feedback,
              double feedback_age, const Detection* detection);
  void remove_labelled(const CoarseGrid& grid, const Detection& detection);
  bool touches_labelled(const CoarseGrid& grid, const PredictedHand& body) const;
  const DetectedHand* detected_near(std::span<const DetectedHand> hands, const Eigen::Vector3f& centre,
                                    double reach) const;
  const DetectedHand* choose_detected(const Detection& detection) const;
  bool start_at(const CoarseGrid& grid, const DetectedHand& detected, CoarseHand& hand);
  void remove_hand(const CoarseGrid& grid, const CoarseHand& hand);
  int choose_part(const CoarseGrid& grid) const;
  float hand_area(const CoarseGrid& grid, const CoarseHand& hand) const;

  /// Numbers of a surface's cells that match the prediction of a hand (on_model) and that are farther away (off_model).
  struct MatchCounts {
    int on_model = 0, off_model = 0;
  };

  PreprocessParams params_;
  Image<std::uint8_t> all_candidates_, candidates_, movable_;
  Image<std::uint8_t> labelled_;  // 1 = no candidate because of its label, and not an arm
  CandidateFinder finder_;
  TranslationSearch translation_;
  Components surfaces_;
  std::vector<MatchCounts> match_counts_;  // numbers of matching cells for every surface
  bool colour_misleads_ = false;
  bool use_labels_ = false;  // whether labels tell in this frame what is not hand
  std::vector<CoarseHand> hands_;
  std::vector<std::optional<PredictedHand>> predictions_;
};

}  // namespace barehand
