#pragma once

#include <string>

namespace barehand {

/// Parameters of the local trackers: how many samples are drawn, how they are compared with the data, and what counts
/// as hidden (paper Sec. 4.1, 4.2).
struct SegmentTrackerParams {
  int samples = 40;
  int samples_on_device = 0;
  double level_budget_ms = 0.5;
  double sigma_obs_start = 0.004;
  double sigma_obs_end = 0.001;
  double pixel_distance_cap = 0.008;
  std::string missing_depth = "unknown";
  std::string self_occlusion = "data";
  double self_occlusion_threshold = 0.010;
  double patch_margin = 0.010;
  double min_counted = 0.05;
  bool observe_palm = true;
  std::string observer = "auto";
  bool operator==(const SegmentTrackerParams&) const = default;
};

template <class V>
void visit(V& v, SegmentTrackerParams& p) {
  // Declare the keys for the number of samples.
  v.user("samples", p.samples, 1, 10000, "S: number of samples per segment and level (Sec. 4)");
  v("samples_on_device", p.samples_on_device, 0, 10000,
    "maximum S where a GPU compares the samples, as far as level_budget_ms allows; S never falls below samples");
  v("level_budget_ms", p.level_budget_ms, 0.0, 1000.0,
    "ms, time limit of a level with more samples than on the CPU: drawing, comparing and fusing them");

  // Declare the keys for the likelihood of a sample.
  v("sigma_obs_start", p.sigma_obs_start, 1e-5, 0.1, "m, standard deviation of the depth at the first level (Eq. 2)");
  v("sigma_obs_end", p.sigma_obs_end, 1e-5, 0.1,
    "m, standard deviation of the depth at the last level, with a geometric progression in between; the paper keeps it "
    "constant");
  v("pixel_distance_cap", p.pixel_distance_cap, 0.0, 1.0,
    "m, upper limit of one pixel's distance (Eq. 1); 0: no limit (paper)");
  v("missing_depth", p.missing_depth, {"unknown", "background"},
    "a pixel without depth is ignored (unknown), or counts as not hand (background, paper)");

  // Declare the keys for what the hand hides of itself.
  v("self_occlusion", p.self_occlusion, {"data", "model", "both", "off"},
    "which pixels are hidden by the hand itself: those with data in front of the predicted segment (data, paper Sec. "
    "4.2), those with another segment's predicted skin in front of it (model), either, or none");
  v("self_occlusion_threshold", p.self_occlusion_threshold, 0.0, 0.1,
    "m, minimum distance in front of the segment (Sec. 4.2)");
  v("patch_margin", p.patch_margin, 0.0, 0.1,
    "m, margin around the predicted segment within which self-occlusion is computed");

  // Declare the keys for which samples and segments count.
  v("min_counted", p.min_counted, 0.0, 1.0,
    "a sample with a smaller visible fraction than this has no evidence and gets the mean distance of its segment's "
    "other samples");
  v("observe_palm", p.observe_palm, "also compare the palm with the data, which the paper does not (Sec. 4.1)");

  // Declare the key for where the samples are compared.
  v.user("observer", p.observer, {"auto", "cpu", "egl"},
         "where samples are compared with the data: on the CPU or a GPU, whichever is measured to be faster (auto), on "
         "the CPU (cpu), or on whatever runs OpenGL ES, including software (egl)");
}

}  // namespace barehand
