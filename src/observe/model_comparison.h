#pragma once

#include <array>
#include <vector>

#include "observe/hand_renderer.h"
#include "observe/nearest_cell.h"
#include "observe/observation.h"
#include "observe/pixel_rays.h"

namespace barehand {

/// Skin that a correspondence of weight 1 stands for [m^2]: 2 pixels at 0.6 m and 525 px.
inline constexpr float kReferenceArea = 5e-6f;

struct ComparisonParams {
  int stride = 2;                      ///< compare every n-th pixel of the region of interest
  double distance_cap = 0.02;          ///< m, no cell costs more than this in the score
  double occlusion_tolerance = 0.004;  ///< m, an object this far behind the model may still hide it
  double self_occlusion = 0.010;  ///< m, hand data this far in front of the model belongs to another part (Sec. 4.2)
  bool operator==(const ComparisonParams&) const = default;
};

template <class V>
void visit(V& v, ComparisonParams& p) {
  v.user("stride", p.stride, 1, 16, "compare every n-th pixel of the region of interest");
  v("distance_cap", p.distance_cap, 1e-3, 0.2, "m, no pixel costs more than this in the global score");
  v("occlusion_tolerance", p.occlusion_tolerance, 0.0, 0.05,
    "m, an object this far behind the model may still hide it");
  v("self_occlusion", p.self_occlusion, 1e-3, 0.1,
    "m, hand data this far in front of the model is another part (Sec. 4.2)");
}

/// One piece of evidence: where the model's skin should move to.
struct Correspondence {
  /// surface: both are hand; outside: skin that shows no data would be nearest beside where it is; behind: nearest
  /// just behind what is seen there; unexplained: hand data that no model pixel covers.
  enum class Kind { surface, outside, behind, unexplained };
  Kind kind;
  int vertex;                           ///< skin vertex that carries the model point
  Eigen::Vector3f model, normal, data;  ///< camera frame [m]; the normal is zero where it was left out
  float weight;                         ///< skin area of the cell relative to kReferenceArea
};

/// Evidence of a whole rendered hand against an observation, in both directions: model explained by data (surface,
/// outside, behind) and data explained by model (unexplained). Missing depth is no evidence.
struct ModelComparison {
  std::vector<Correspondence> correspondences;
  double score = 0;  ///< mean capped distance over all evidence [m]; lower is better; the cap if there is none
  std::array<int, kSegmentCount> visible{};  ///< cells in which a segment is front-most and not behind an object
  std::array<int, kSegmentCount> matched{};  ///< of these, cells with hand data near the model
  NearestCell nearest_model;                 ///< scratch: where the rendered hand is
  PixelRays rays;                            ///< scratch
};

/// Cells of the whole region of interest.
CellGrid grid_of(const HandObservation& observation, int stride);

/// Cell by cell of `rendered`, whose grid says how finely; the parameters' stride does not count here.
void compare(const HandObservation& observation, const Skin& skin, const HandPose& pose, const RenderedHand& rendered,
             const ComparisonParams& params, ModelComparison& out);

}  // namespace barehand
