#pragma once

#include <string>

namespace barehand {

/// Parameters of the soft constraints, the message passing and the hierarchy of levels (paper Sec. 4.3, 4.4). "start"
/// and "end" are the values at the first and the last level, with a geometric progression in between; the paper keeps
/// its sigmas constant.
struct FusionParams {
  int levels = 4;
  int kernels = 5;
  double kernel_separation = 0.5;
  std::string marginals = "sum";
  double sigma_prox_start = 0.005;
  double sigma_prox_end = 0.002;
  double sigma_flexion_deg = 10;
  double sigma_abduction_deg = 10;
  double sigma_twist_deg = 10;
  double limit_widening_deg = 10;
  double range_translation = 0.008;
  double range_flexion_deg = 25;
  double range_abduction_deg = 8;
  double range_twist_deg = 6;
  double range_palm_deg = 10;
  double range_end = 0.08;
  std::string read_out = "mean";
  double mode_radius = 0.005;
  double mode_angle_deg = 15;
  bool operator==(const FusionParams&) const = default;
};

template <class V>
void visit(V& v, FusionParams& p) {
  // Declare the keys for the levels and the messages.
  v.user("levels", p.levels, 1, 100, "number of levels per frame (Sec. 4.4; the paper uses 10)");
  v("kernels", p.kernels, 1, 100, "S': number of best samples that seed the next level (Sec. 4.4)");
  v("kernel_separation", p.kernel_separation, 0.0, 10.0,
    "minimum distance between two kernels, in half widths of the next level; 0: the best samples at any distance "
    "(paper)");
  v("marginals", p.marginals, {"sum", "max"}, "sum-product (Eq. 7) or max-product messages");

  // Declare the keys for the gap at a joint.
  v("sigma_prox_start", p.sigma_prox_start, 1e-4, 0.1,
    "m, standard deviation of the gap between adjacent ends at the first level (Eq. 5)");
  v("sigma_prox_end", p.sigma_prox_end, 1e-4, 0.1,
    "m, standard deviation of the gap between adjacent ends at the last level; if it is too small, hardly any pair of "
    "samples is compatible");

  // Declare the keys for the angles of a joint.
  v("sigma_flexion_deg", p.sigma_flexion_deg, 0.1, 180.0,
    "degrees, standard deviation beyond the flexion limits (Eq. 6)");
  v("sigma_abduction_deg", p.sigma_abduction_deg, 0.1, 180.0,
    "degrees, standard deviation beyond the abduction limits (Eq. 6)");
  v("sigma_twist_deg", p.sigma_twist_deg, 0.1, 180.0, "degrees, standard deviation of the twist (Eq. 6)");
  v("limit_widening_deg", p.limit_widening_deg, 0.0, 90.0,
    "degrees by which every joint range of the hand profile is widened at both ends (Sec. 3.2)");

  // Declare the keys for the boxes from which samples are drawn.
  v("range_translation", p.range_translation, 1e-4, 0.2, "m, half width of the first level's box along every axis");
  v("range_flexion_deg", p.range_flexion_deg, 0.1, 180.0,
    "degrees, half width of a phalanx's box about the flexion axis");
  v("range_abduction_deg", p.range_abduction_deg, 0.1, 180.0,
    "degrees, half width of a phalanx's box about the dorsal axis");
  v("range_twist_deg", p.range_twist_deg, 0.1, 180.0, "degrees, half width of a phalanx's box about the bone");
  v("range_palm_deg", p.range_palm_deg, 0.1, 180.0, "degrees, half width of the palm's box about every axis");
  v("range_end", p.range_end, 0.001, 1.0, "half widths of the last level as a fraction of the first level's");

  // Declare the keys for the final pose.
  v("read_out", p.read_out, {"mean", "max"}, "final pose: mean of the best mode, or the best sample");
  v("mode_radius", p.mode_radius, 1e-4, 0.1, "m, samples within this distance of the best one belong to its mode");
  v("mode_angle_deg", p.mode_angle_deg, 0.1, 180.0,
    "degrees, samples of the mode are rotated by at most this relative to the best one");
}

}  // namespace barehand
