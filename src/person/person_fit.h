#pragma once

#include <future>
#include <memory>
#include <optional>
#include <stop_token>

#include "core/parallel/parallel.h"
#include "observe/observation.h"
#include "person/shape_fit.h"
#include "stages/refinement/refinement.h"

namespace barehand {

/// Adapts a mean hand (the average of many people) to the tracked person. It evaluates frames that the tracked hand
/// fits well, and returns how the tracked hand should change. The skin changes with the shape to first order; at
/// doubling intervals it is built anew in the background (Workers::run_in_background), while frames go on with the old
/// one.
class PersonFit {
 public:
  /// `mean`: the mean hand that is to be adapted; `skin`: its skin. `skin_cell`: for new skins [m]. `workers` must
  /// outlive the object. `stop` ends what is done in the background; the fit is then useless. Until that has ended, the
  /// destructor waits.
  PersonFit(const ShapeFitParams& params, std::shared_ptr<const HandProfile> mean, std::shared_ptr<const Skin> skin,
            double skin_cell, Workers& workers, std::stop_token stop = {});

  /// How profile() and skin() changed. none: not at all; small: to first order; large: the skin was built anew.
  enum class Change { none, small, large };
  /// Evaluates one frame at its refined pose. `refinement`: of the tracked hand, with skin().
  Change add_frame(const HandObservation& observation, const HandPose& pose, const Refinement& refinement);

  /// Call when the tracked hand gets another skin that was built for profile().
  void use_skin(std::shared_ptr<const Skin> skin, double skin_cell);

  std::shared_ptr<const HandProfile> profile() const { return profile_; }
  std::shared_ptr<const Skin> skin() const { return skin_; }
  const ShapeFit& fit() const { return fit_; }

 private:
  /// A skin that was built for a shape, and how it changes with the shape.
  struct BuiltSkin {
    HandShape shape;
    std::shared_ptr<const Skin> skin;
    ShapeBasis basis;
  };

  // Counts a frame, and returns whether it should contribute to the shape.
  bool due();
  // Begins to compute the basis of a skin for the present shape; null: the skin is built, too.
  void build(std::shared_ptr<const Skin> skin);
  // Takes what build() began if it has ended; returns whether that changed skin().
  bool take_built();
  // Changes the built skin to the present shape.
  std::shared_ptr<const Skin> skin_of_shape() const;

  ShapeFitParams params_;
  double skin_cell_;
  Workers& workers_;
  std::stop_token stop_;
  std::shared_ptr<const HandProfile> mean_, profile_;
  std::shared_ptr<const Skin> skin_;
  ShapeFit fit_;
  HandShape shape_ = HandShape::Zero();
  std::optional<BuiltSkin> built_;  // none before the first frame, and while the first is built
  std::future<BuiltSkin> building_;
  ShapeEquations equations_;
  int frames_ = 0, next_skin_;  // frames so far, and number of contributing frames at which the skin is built anew
};

}  // namespace barehand
