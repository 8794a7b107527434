#pragma once

#include <span>

#include "observe/dense/pixel_rays.h"
#include "observe/observation.h"
#include "stages/preprocess/depth_cleaner.h"
#include "stages/preprocess/hand_locator.h"
#include "stages/preprocess/image/specks.h"
#include "stages/preprocess/image/window_sum.h"

namespace barehand {

// Labels of the pixels in the region of interest.

/// Decides for each pixel whether it belongs to the hand that was found in the coarse grid.
class HandMask {
 public:
  explicit HandMask(const PreprocessParams& params) : params_(params) {}
  /// Computes `mask` (1 = hand) for a region whose cleaned depth and depth edges are given. A hand pixel is at the
  /// depth of a neighbouring hand cell and on the hand's side of the wrist, and its colour, averaged over `skew_px`, is
  /// skin. Pixels near depth edges or without colour are decided by their depth-connected neighbours. If the whole
  /// frame has no colour, or colour misleads, the labels of the detected hand decide, if there are any. Cells of the
  /// other `hands` are left out.
  void compute(const RgbdFrame& frame, const SkinModel& skin, const CoarseGrid& grid, const CoarseHand& hand,
               std::span<const CoarseHand> hands, const Region& region, const Image<float>& depth,
               const Image<std::uint8_t>& edge, Image<std::uint8_t>& mask);

 private:
  void tabulate(const Intrinsics& camera, const CoarseGrid& grid, const Region& region);
  void support(const CoarseGrid& grid, const CoarseHand& hand, std::span<const CoarseHand> hands);
  void colour_evidence(const RgbdFrame& frame, const SkinModel& skin, const Region& region);
  void find_supported(const CoarseHand& hand, const Image<float>& depth);
  void classify_by_depth(const Image<float>& depth);
  void apply_labels(const LabelMap& labels, const Region& region);
  void classify_by_colour(const Image<float>& depth);

  PreprocessParams params_;
  PixelRays rays_;
  std::vector<int> column_, row_;  // grid column of every column of the region, and grid row of every row
  Image<float> lowest_, highest_;  // range of depths at which the pixels of each grid cell may be hand [m]
  // Data of every pixel of the current row: range of depths of hand pixels; depth of what stands there, and how far it
  // reaches [m].
  std::vector<float> low_, high_, standing_, tolerance_;
  std::vector<std::int32_t> row_evidence_;
  // Data of every pixel; the window around a pixel reaches `skew_px` to every side.
  Image<std::uint8_t> supported_;                 // 1 = the pixel may be hand according to its depth
  Image<float> skin_log_odds_, summed_log_odds_;  // log odds of skin, and their sum over the window
  Image<std::uint8_t> coloured_;                  // 1 = the pixel's colour is evidence for or against skin
  Image<std::uint16_t> coloured_count_;           // number of pixels with such a colour in the window
  Image<std::uint8_t> non_skin_;                  // 1 = the pixel's colour is evidence against skin
  Image<std::uint16_t> non_skin_count_;           // number of pixels with evidence against skin in the window
  Image<std::uint16_t> edges_;                    // number of depth edges in the window
  WindowSum<float> sum_odds_;
  WindowSum<std::uint16_t> count_;
  Image<Rgb> colours_;  // colours of the region
  Image<Evidence> evidence_;
  Flood flood_;
  SpeckRemover specks_;
};

/// Labels all pixels: hand = set in `mask`; object = not hand, but within `reach` [m] of the nearest hand pixel or in
/// front of it; background = other data; unknown = no data. `rays` is scratch memory.
void label_pixels(const Intrinsics& camera, const Image<std::uint8_t>& mask, double reach, PixelRays& rays,
                  HandObservation& out);

}  // namespace barehand
