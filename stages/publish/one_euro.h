#pragma once

#include "math/se3.h"

namespace barehand {

/// Parameters of the One-Euro filter (Casiez, Roussel & Vogel, CHI 2012): a low pass whose cut-off frequency rises with
/// speed, so that a resting hand does not jitter and a fast one does not lag.
struct OneEuroParams {
  bool enabled = true;
  double min_cutoff = 3.0;
  double beta = 30.0;
  double beta_rotation = 3.0;
  double speed_cutoff = 2.0;
  bool operator==(const OneEuroParams&) const = default;
};
template <class V>
void visit(V& v, OneEuroParams& p) {
  v.user("enabled", p.enabled, "smooth the published pose; false: the smoothed pose is the raw one");
  v.user("min_cutoff", p.min_cutoff, 0.01, 1000.0, "Hz, cut-off frequency at rest (lower: smoother, more lag)");
  v.user("beta", p.beta, 0.0, 10000.0, "Hz per m/s, increase of the cut-off frequency with speed (higher: less lag)");
  v("beta_rotation", p.beta_rotation, 0.0, 10000.0,
    "Hz per rad/s, increase of the rotation's cut-off frequency with angular speed (higher: less lag)");
  v("speed_cutoff", p.speed_cutoff, 0.01, 1000.0, "Hz, cut-off frequency of the low pass on the speed");
}

/// Filters one rigid transform; translation and rotation have separate cut-off frequencies.
class OneEuroPose {
 public:
  /// Filters the next value. `dt`: seconds since the last call, > 0. The first call after a reset returns `raw`.
  SE3 filter(const SE3& raw, double dt, const OneEuroParams& params);
  void reset() { started_ = false; }

 private:
  bool started_ = false;
  SE3 raw_, smoothed_;
  Vector6d speed_ = Vector6d::Zero();
};

}  // namespace barehand
