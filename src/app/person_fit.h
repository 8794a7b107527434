#pragma once

#include <memory>
#include <optional>

#include "observe/observation.h"
#include "stages/refinement/refinement.h"
#include "stages/refinement/shape_fit.h"

namespace barehand {

/// Fits a mean hand to the person in view: looks at frames that are explained well, and after each look says how the
/// hand that is tracked with should change.
class PersonFit {
 public:
  PersonFit(const ShapeFitParams& params, std::shared_ptr<const HandProfile> mean);

  /// none: go on; small: go on with `profile` and `skin`; large: `profile` is worth a skin of its own.
  enum class Change { none, small, large };
  /// One look at a frame at its refined pose; `refinement` and `skin` are those of the hand that is tracked with.
  Change look(const HandObservation& observation, const HandPose& pose, const Refinement& refinement,
              const std::shared_ptr<const Skin>& skin);

  /// The hand that is tracked with gets a new skin, made for `profile`.
  void expect_new_skin() { basis_.reset(); }

  std::shared_ptr<const HandProfile> profile() const { return profile_; }
  std::shared_ptr<const Skin> skin() const { return skin_; }
  const ShapeFit& fit() const { return fit_; }

 private:
  bool due();

  ShapeFitParams params_;
  std::shared_ptr<const HandProfile> mean_, profile_;
  std::shared_ptr<const Skin> skin_, made_skin_;  // the current one, and the last one that was made for a profile
  ShapeFit fit_;
  HandShape shape_ = HandShape::Zero(), made_shape_ = HandShape::Zero();
  std::optional<ShapeBasis> basis_;  // of made_skin_
  ShapeEquations equations_;
  int frames_ = 0, next_skin_;
};

}  // namespace barehand
