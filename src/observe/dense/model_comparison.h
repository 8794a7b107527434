#pragma once

#include <array>
#include <vector>

#include "hand/rendering/hand_renderer.h"
#include "observe/dense/nearest_cell.h"
#include "observe/dense/pixel_rays.h"
#include "observe/observation.h"

namespace barehand {

// Comparison of a rendered hand with an observation, pixel by pixel.

/// The area of skin that a correspondence of weight 1 represents [m^2]: a cell of 2 x 2 pixels at 0.6 m with a focal
/// length of 525 px.
inline constexpr float kReferenceArea = 5e-6f;

/// Settings of the comparison of model and data.
struct ComparisonParams {
  int stride = 2;
  double distance_cap = 0.02;
  double occlusion_tolerance = 0.004;
  double self_occlusion = 0.010;
  double missing_depth = 0.5;
  bool operator==(const ComparisonParams&) const = default;
};

template <class V>
void visit(V& v, ComparisonParams& p) {
  v.user("stride", p.stride, 1, 16, "compare every n-th pixel of the region of interest");
  v("distance_cap", p.distance_cap, 1e-3, 0.2, "m, upper limit of one pixel's distance in the global score");
  v("occlusion_tolerance", p.occlusion_tolerance, 0.0, 0.05,
    "m, an object up to this far behind the model may still occlude it");
  v("self_occlusion", p.self_occlusion, 1e-3, 0.1,
    "m, hand data this far in front of the model belongs to another segment (Sec. 4.2)");
  v("missing_depth", p.missing_depth, 0.0, 1.0,
    "weight of skin that reaches beyond the measured end of its finger to where nothing was measured, relative to skin "
    "before measured background; 0: missing depth is no evidence");
}

/// One piece of evidence: a point of the model and the point of the data that it should move to.
struct Correspondence {
  /// surface: the cell shows the model and hand data. outside: it shows the model but no hand data, and the model
  /// should move sideways in the image. behind: it shows the model but no hand data, and the model should move just
  /// behind the surface that is measured there. unexplained: it shows hand data but not the model.
  enum class Kind { surface, outside, behind, unexplained };
  Kind kind;
  int vertex;                           ///< skin vertex that carries the model point
  Eigen::Vector3f model, normal, data;  ///< camera frame [m]; the normal is zero if the rendering has none
  float weight;  ///< skin area of the cell relative to kReferenceArea, times `missing_depth` in a hole
};

/// All correspondences of a rendered hand and an observation, in both directions: model explained by data (surface,
/// outside, behind) and data explained by the model (unexplained). Missing depth is evidence only beside the measured
/// part of the same finger.
struct ModelComparison {
  std::vector<Correspondence> correspondences;
  double score = 0;  ///< mean capped distance over all evidence [m], lower is better; the cap if there is no evidence
  std::array<int, kSegmentCount> visible{};      ///< cells where a segment is front-most and not hidden by an object
  std::array<int, kSegmentCount> matched{};      ///< `visible` cells with hand data near the model
  std::array<int, kSegmentCount> unexplained{};  ///< cells with hand data that no skin explains, nearest to a segment
  NearestCell nearest_model;                     ///< scratch: look-up of the nearest cell of the rendered hand
  PixelRays rays;                                ///< scratch: points of the observed pixels
};

/// The grid of every `stride`-th pixel that covers the whole region of interest.
CellGrid grid_of(const HandObservation& observation, int stride);

/// Compares the observation with the rendered `skin` cell by cell. The grid of `rendered` sets the spacing; the stride
/// of `params` is not used here.
void compare(const HandObservation& observation, const Skin& skin, const HandPose& pose, const RenderedHand& rendered,
             const ComparisonParams& params, ModelComparison& out);

}  // namespace barehand
