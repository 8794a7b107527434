#pragma once

#include <memory>

#include "stages/refinement/shape_moments.h"

namespace barehand {

/// When and how strongly frames contribute to the shape of a person's hand while it is tracked. A "look" is one frame
/// that contributes.
struct ShapeFitParams {
  bool enabled = true;
  int every = 1, every_later = 8;  ///< frames between two looks: at first, and after `eager_looks`
  int eager_looks = 100;
  double weight = 0.01;       ///< of a look against the prior: its errors are the model's, not independent noise
  double memory = 1.5;        ///< how far back, of all looks so far: old ones were taken with a worse hand
  double memory_looks = 200;  ///< but never further back than so many
  int first_rebuild = 8;      ///< looks before a skin is made anew; then after twice, four times ... as many
  int scan_after = 60;  ///< frames before the skin is scanned (scan_hand); then after twice, four times ... as many
  int scans = 3;        ///< so often; 0: never
  bool operator==(const ShapeFitParams&) const = default;
};

template <class V>
void visit(V& v, ShapeFitParams& p) {
  v.user("enabled", p.enabled,
         "learn the person's hand while tracking: the bones if the profile is a mean hand, and the skin");
  v("every", p.every, 1, 1000, "frames between two looks at the shape, at first");
  v("every_later", p.every_later, 1, 100000, "frames between two looks after `eager_looks`");
  v("eager_looks", p.eager_looks, 0, 100000, "looks in quick succession at the start");
  v("weight", p.weight, 1e-6, 1.0, "of one look against what is known of people: its errors are not independent noise");
  v("memory", p.memory, 0.01, 10.0, "part of all looks so far that counts: old ones were taken with a worse hand");
  v("memory_looks", p.memory_looks, 1.0, 1e6, "looks, never more count");
  v("first_rebuild", p.first_rebuild, 1, 100000, "looks before a new skin is made, then twice as many each time");
  v.user("scan_after", p.scan_after, 32, 100000,
         "tracked frames before the skin is scanned, then twice as many each time");
  v.user("scans", p.scans, 0, 10, "how often the skin is scanned, if the profile has none of its own; 0: never");
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
  int looks() const { return looks_; }

 private:
  using Matrix = Eigen::Matrix<double, kShapeCount, kShapeCount>;
  Matrix posterior() const;

  ShapeFitParams params_;
  Matrix information_ = Matrix::Zero();
  HandShape weighted_ = HandShape::Zero();  // information times shape
  int looks_ = 0;
};

}  // namespace barehand
