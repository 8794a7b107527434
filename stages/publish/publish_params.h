#pragma once

#include "stages/publish/one_euro.h"

namespace barehand {

/// Parameters of the published messages: smoothing, and how uncertainty grows while a pose is held.
struct PublishParams {
  OneEuroParams smoothing;
  double hold_time = 0.5;  ///< how long the last pose of a lost hand is held [s]; the key is tracker.loss.hold_time
  double hold_growth = 0.1;
  double hold_growth_rotation = 1.0;
  bool operator==(const PublishParams&) const = default;
};
template <class V>
void visit(V& v, PublishParams& p) {
  v("smoothing", p.smoothing, "output filter; the raw pose is published as well as the smoothed one");
  v.retired("hold_time", "tracker.loss.hold_time");
  v("hold_growth", p.hold_growth, 0.0, 10.0,
    "m/s, growth of the standard deviation of the position while a pose is held");
  v("hold_growth_rotation", p.hold_growth_rotation, 0.0, 100.0,
    "rad/s, growth of the standard deviation of the orientation while a pose is held");
}

}  // namespace barehand
