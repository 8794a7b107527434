#pragma once

#include <span>

#include "observe/dense/pixel_rays.h"
#include "observe/observation.h"
#include "stages/preprocess/depth_cleaner.h"
#include "stages/preprocess/hand_search.h"
#include "stages/preprocess/image/specks.h"
#include "stages/preprocess/image/window_sum.h"

namespace barehand {

/// Decides pixel by pixel what belongs to the hand that was found in the coarse grid.
class HandMask {
 public:
  explicit HandMask(const PreprocessParams& params) : params_(params) {}
  /// `mask` (1 = hand) for a region whose cleaned depth and depth edges are given. A hand pixel lies at the depth of a
  /// neighbouring hand cell, on the hand's side of the wrist; its colour, averaged over `skew_px`, is skin. Beside
  /// depth edges and without colour, the depth-connected neighbours decide; without colour in the whole frame, the
  /// labels of the detected hand where there are some. Cells of the other `hands` are theirs.
  void compute(const RgbdFrame& frame, const SkinModel& skin, const CoarseGrid& grid, const CoarseHand& hand,
               std::span<const CoarseHand> hands, const Region& region, const Image<float>& depth,
               const Image<std::uint8_t>& edge, Image<std::uint8_t>& mask);

 private:
  void tabulate(const Intrinsics& camera, const CoarseGrid& grid, const Region& region);
  void support(const CoarseGrid& grid, const CoarseHand& hand, std::span<const CoarseHand> hands);
  void colour_evidence(const RgbdFrame& frame, const SkinModel& skin, const Region& region);
  void find_supported(const Image<float>& depth);
  void classify_by_depth(const Image<float>& depth, const Region& region, const DetectedHand* detected);
  void classify_by_colour(const Image<float>& depth);

  PreprocessParams params_;
  PixelRays rays_;
  std::vector<int> column_, row_;  // of the grid's cell in which a pixel of the region lies
  Image<float> lowest_, highest_;  // per cell: depths at which its pixels may be hand
  std::vector<float> low_, high_;  // the same along a row of pixels
  std::vector<std::int32_t> judged_;
  Image<std::uint8_t> supported_;                 // 1 = may be hand as far as depth says
  Image<float> skin_log_odds_, summed_log_odds_;  // of a pixel, and summed over the `skew_px` around it
  Image<std::uint8_t> coloured_;                  // 1 = its colour is evidence for or against skin
  Image<std::uint16_t> coloured_count_;           // the same, counted in its surroundings
  Image<std::uint8_t> non_skin_;                  // 1 = its colour is evidence against skin
  Image<std::uint16_t> non_skin_count_;           // the same, counted in its surroundings
  Image<std::uint16_t> edges_;                    // depth edges in its surroundings
  WindowSum<float> sum_odds_;
  WindowSum<std::uint16_t> count_;
  Image<Rgb> colours_;  // of the region
  Image<Evidence> evidence_;
  Flood flood_;
  SpeckRemover specks_;
};

/// Names the remaining pixels: object = no hand but within `reach` [m] of the nearest hand pixel, or in front of it;
/// background = other data; unknown = no data. `rays` is scratch.
void label_pixels(const Intrinsics& camera, const Image<std::uint8_t>& mask, double reach, PixelRays& rays,
                  HandObservation& out);

}  // namespace barehand
