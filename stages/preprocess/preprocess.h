#pragma once

#include "core/error.h"
#include "hand/hand_pose.h"
#include "observe/observation.h"
#include "stages/preprocess/distance_transform.h"
#include "stages/preprocess/hand_search.h"
#include "stages/preprocess/labelling.h"
#include "stages/preprocess/normals.h"
#include "stages/preprocess/observation_pool.h"
#include "stages/preprocess/params.h"

namespace barehand {

/// First stage: finds the hand in a frame and makes the maps the trackers look at (paper Sec. 4.1). Synchronous; frames
/// must come in order because the skin model learns from each (the only state that outlives a frame).
class Preprocessor {
 public:
  explicit Preprocessor(const PreprocessParams& params);

  /// `hint`: the tracker's estimate of an earlier frame, typically two before; null while nothing is tracked. It may be
  /// stale: it is moved to where its hand is now, and not used if that fails. With status `tracking` the skin model
  /// learns from it. Without a hint the nearest hand-like thing in the image is the hand.
  /// Errors: frame without valid intrinsics, or depth or colour of another size than they say.
  /// A frame without hand is no error: hand_present is false and the maps are empty.
  Result<HandObservationPtr> process(const FramePtr& frame, const HandEstimate* hint);

 private:
  Region region_of_interest(const RgbdFrame& frame) const;
  void describe_hand(HandObservation& out);
  void learn_skin();

  PreprocessParams params_;
  SkinModel skin_;
  HandSearch search_;
  HandMask masker_;
  DepthCleaner cleaner_;
  NearestPixelTransform transform_;
  NormalFitter normals_;
  ObservationPool pool_;
  CoarseGrid grid_;
  const CoarseHand* hand_ = nullptr;  // of the current frame, owned by search_
  Image<std::uint8_t> edge_, mask_, object_;
  std::vector<Rgb> skin_colours_, other_colours_;
};

}  // namespace barehand
