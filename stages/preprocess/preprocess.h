#pragma once

#include <span>

#include "core/error.h"
#include "hand/hand_pose.h"
#include "observe/observation.h"
#include "stages/preprocess/colour_trust.h"
#include "stages/preprocess/hand_locator.h"
#include "stages/preprocess/image/distance_transform.h"
#include "stages/preprocess/labelling.h"
#include "stages/preprocess/normals.h"
#include "stages/preprocess/observation_pool.h"
#include "stages/preprocess/params.h"

namespace barehand {

/// First stage: finds the hands in a frame and computes the maps that the trackers use (paper Sec. 4.1). Synchronous;
/// frames must come in order, because the skin model and what stands in the scene, the only states that outlive a
/// frame, learn from each.
class Preprocessor {
 public:
  explicit Preprocessor(const PreprocessParams& params, int hands = 1);

  /// `feedback`: the tracker's estimates of an earlier frame, typically two before, one per hand; empty while nothing
  /// is tracked. They may be old: they are moved to where their hands are now, and not used if that fails. The skin
  /// model learns from those with the status `tracking`. Without feedback, the nearest skin-like surfaces in the image
  /// are taken; which hand each of them is remains undecided. `detection`: result of the networks for this frame; null:
  /// none. Returns one observation per hand, in the order of the feedback; no pixel belongs to two hands. Errors: frame
  /// without valid intrinsics, or depth or colour of another size than they state. A frame without a hand is not an
  /// error: hand_present is false and the maps are empty.
  Result<HandObservations> process(const FramePtr& frame, std::span<const HandEstimatePtr> feedback,
                                   const DetectionPtr& detection = nullptr);

  /// Whether colour, if there is any, does not tell a followed hand from what touches it, so that the next frame's
  /// detection should.
  bool needs_labels() const { return !params_.use_colour || locator_.colour_misleads() || !colour_.trusted(); }
  /// Whether colour shows where the hands of the last frame are (ColourTrust); if not, depth alone was used.
  bool colour_is_trusted() const { return colour_.trusted(); }
  /// The colour of skin as it was learned so far; null if colour is not used.
  const SkinModel* skin() const { return params_.use_colour ? &skin_ : nullptr; }

 private:
  HandObservationPtr observe(const FramePtr& frame, const CoarseHand& hand, std::span<const CoarseHand> hands,
                             const DetectionPtr& detection);
  void remove_taken(const HandObservation& out);
  Region region_of_interest(const RgbdFrame& frame, const CoarseHand& hand) const;
  void describe_hand(HandObservation& out);
  void learn_skin(std::span<const CoarseHand> hands, std::span<const HandEstimatePtr> feedback,
                  const HandObservations& seen);

  PreprocessParams params_;
  SkinModel skin_;
  StandingDepth standing_;
  ColourTrust colour_;
  HandLocator locator_;
  HandMask masker_;
  DepthCleaner cleaner_;
  NearestPixelTransform transform_;
  NormalFitter normals_;
  NoiseMeter noise_;
  PixelRays rays_;  // scratch memory
  ObservationPool pool_;
  CoarseGrid grid_;
  Image<std::uint8_t> edge_, mask_, object_;
  Image<std::uint8_t> taken_;  // 1 at pixels of the frame that belong to a hand processed before in this frame
  std::vector<const CoarseHand*> training_hands_;  // tracked hands from which the skin model learns in this frame
  std::vector<Rgb> skin_colours_, other_colours_;
};

}  // namespace barehand
