#pragma once

#include <memory>

#include "stages/refinement/shape_moments.h"

namespace barehand {

// ShapeFit: a running Gaussian estimate of the person's hand shape. ShapeFitParams also holds the settings of PersonFit
// and PersonScan, which rebuild and scan the skin.

/// When and how strongly frames contribute to the shape of a person's hand while it is tracked. Each contribution of a
/// frame is called a "look".
struct ShapeFitParams {
  bool enabled = true;
  int every = 1, every_later = 8;
  int initial_frames = 100;
  double weight = 0.01;
  double memory = 1.5;
  double memory_frames = 200;
  int first_rebuild = 8;
  int scan_after = 60;
  int scans = 3;
  bool operator==(const ShapeFitParams&) const = default;
};

template <class V>
void visit(V& v, ShapeFitParams& p) {
  v.user("enabled", p.enabled,
         "learn the person's hand while tracking: the bones if the profile is a mean hand, and the skin");

  // These set which frames contribute to the shape, and how much.
  v("every", p.every, 1, 1000,
    "every n-th frame contributes to the shape, until there are `initial_frames` contributions");
  v("every_later", p.every_later, 1, 100000,
    "every n-th frame contributes to the shape after the first `initial_frames` contributions");
  v.formerly("eager_looks");
  v("initial_frames", p.initial_frames, 0, 100000, "number of contributions at the interval `every`");
  v("weight", p.weight, 1e-6, 1.0,
    "weight of one frame relative to the prior, which is how people differ; it is small, as errors of the model repeat "
    "in all frames");

  // These limit the memory of earlier contributions.
  v("memory", p.memory, 0.01, 10.0,
    "length of the memory relative to the number of contributions so far; old ones were made with a less accurate "
    "hand");
  v.formerly("memory_looks");
  v("memory_frames", p.memory_frames, 1.0, 1e6, "longest memory, in contributions");

  // These set when the skin is rebuilt and when it is scanned.
  v("first_rebuild", p.first_rebuild, 1, 100000,
    "contributions before the skin is first rebuilt; each later rebuild waits for twice as many");
  v.user("scan_after", p.scan_after, 32, 100000,
         "tracked frames before the skin is first scanned; each later scan waits for twice as many");
  v.user("scans", p.scans, 0, 10, "number of skin scans, for a profile without a skin of its own; 0: none");
}

/// Estimates the shape of a person's hand from many frames as one Gaussian. Each frame contributes at its own optimal
/// pose, with the uncertainty of that pose marginalised. The prior is how people differ (ShapeParameter::deviation).
class ShapeFit {
 public:
  explicit ShapeFit(const ShapeFitParams& params);

  /// Adds one frame's equations, linearised at the shape `at`. Returns false, and changes nothing, if they are not
  /// positive definite.
  bool add(const ShapeEquations& equations, const HandShape& at);
  /// The most likely shape; see HandShape for the units.
  HandShape estimate() const;
  /// Standard deviation of each number of the shape, same units.
  HandShape deviation() const;
  int frames() const { return frames_; }

 private:
  using Matrix = Eigen::Matrix<double, kShapeCount, kShapeCount>;
  Matrix posterior() const;

  ShapeFitParams params_;
  Matrix information_ = Matrix::Zero();
  HandShape weighted_ = HandShape::Zero();  // information times shape
  int frames_ = 0;
};

}  // namespace barehand
