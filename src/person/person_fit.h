#pragma once

#include <memory>
#include <optional>

#include "observe/observation.h"
#include "person/shape_fit.h"
#include "stages/refinement/refinement.h"

namespace barehand {

/// Adapts a mean hand (the average of many people) to the tracked person. It evaluates frames that the tracked hand
/// fits well, and returns how the tracked hand should change.
class PersonFit {
 public:
  /// `mean`: the mean hand that is to be adapted.
  PersonFit(const ShapeFitParams& params, std::shared_ptr<const HandProfile> mean);

  /// What the caller must do. none: nothing; small: use profile() and skin() from now on; large: use profile() and
  /// build a new skin for it, since skin() is out of date.
  enum class Change { none, small, large };
  /// Evaluates one frame at its refined pose. `refinement` and `skin` are those of the tracked hand.
  Change add_frame(const HandObservation& observation, const HandPose& pose, const Refinement& refinement,
                   const std::shared_ptr<const Skin>& skin);

  /// Call when the tracked hand gets a new skin that was built for `profile`.
  void expect_new_skin() { basis_.reset(); }

  std::shared_ptr<const HandProfile> profile() const { return profile_; }
  std::shared_ptr<const Skin> skin() const { return skin_; }
  const ShapeFit& fit() const { return fit_; }

 private:
  // Counts a frame, and returns whether it should contribute to the shape.
  bool due();

  ShapeFitParams params_;
  std::shared_ptr<const HandProfile> mean_, profile_;
  std::shared_ptr<const Skin> skin_, made_skin_;  // the current skin, and the last one that was built for a profile
  ShapeFit fit_;
  HandShape shape_ = HandShape::Zero(), made_shape_ = HandShape::Zero();  // the current shape, and that of made_skin_
  std::optional<ShapeBasis> basis_;                                       // how made_skin_ changes with the shape
  ShapeEquations equations_;
  int frames_ = 0, next_skin_;  // frames so far, and number of contributing frames at which the skin is rebuilt next
};

}  // namespace barehand
