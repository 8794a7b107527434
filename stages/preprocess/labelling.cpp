#include "stages/preprocess/labelling.h"

#include <algorithm>
#include <cmath>

#include "stages/preprocess/standing_depth.h"

namespace barehand {
namespace {

// Decides by depth, colour and detection which pixels of the region of interest show the hand.

constexpr float kInFront = 0.005f;  // data in front of the nearest hand pixel by more than this is an object [m]

bool joined(float a, float b, float fx) { return std::abs(a - b) < same_surface_step(std::min(a, b), fx); }

}  // namespace

void HandMask::tabulate(const Intrinsics& camera, const CoarseGrid& grid, const Region& region) {
  rays_.reset(camera, region.u0, region.v0, region.width, region.height);
  column_.resize(region.width);
  row_.resize(region.height);
  for (int u = 0; u < region.width; ++u) column_[u] = std::min((u + region.u0) / grid.step, grid.z.width() - 1);
  for (int v = 0; v < region.height; ++v) row_[v] = std::min((v + region.v0) / grid.step, grid.z.height() - 1);
}

void HandMask::support(const CoarseGrid& grid, const CoarseHand& hand, std::span<const CoarseHand> hands) {
  const int width = grid.z.width(), height = grid.z.height();
  const float fx = static_cast<float>(grid.camera.fx);
  lowest_.reset(width, height, INFINITY);
  highest_.reset(width, height, -INFINITY);

  // Around each cell of the hand, allow the depths of the same surface.
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      if (!hand.cells.at(u, v)) continue;

      const float z = grid.z.at(u, v), step = same_surface_step(z, fx);
      for (int y = std::max(0, v - 1); y <= std::min(height - 1, v + 1); ++y)
        for (int x = std::max(0, u - 1); x <= std::min(width - 1, u + 1); ++x) {
          lowest_.at(x, y) = std::min(lowest_.at(x, y), z - step);
          highest_.at(x, y) = std::max(highest_.at(x, y), z + step);
        }
    }

  // In the cells of another hand, allow no depth.
  for (const CoarseHand& other : hands) {
    if (&other == &hand || !other.found) continue;
    for (std::size_t i = 0; i < other.cells.size(); ++i)
      if (other.cells[i]) lowest_[i] = INFINITY, highest_[i] = -INFINITY;
  }
}

void HandMask::colour_evidence(const RgbdFrame& frame, const SkinModel& skin, const Region& region) {
  skin_log_odds_.reset(region.width, region.height);
  coloured_.reset(region.width, region.height);
  non_skin_.reset(region.width, region.height);
  colours_.reset(region.width, region.height);

  // Visit the pixels row by row.
  for (int v = 0; v < region.height; ++v) {
    const Rgb* colour = frame.colour.row(v + region.v0) + region.u0;
    std::copy_n(colour, region.width, colours_.row(v));
    const float* nearest = lowest_.row(row_[v]);
    float* odds = skin_log_odds_.row(v);
    std::uint8_t *coloured = coloured_.row(v), *non_skin = non_skin_.row(v);

    // Look up the log odds near the hand; elsewhere they are 0, which means no evidence.
    for (int u = 0; u < region.width; ++u) {
      const bool beside_hand = nearest[column_[u]] < INFINITY;
      odds[u] = beside_hand ? skin.log_odds(colour[u]) : 0.f;
      coloured[u] = odds[u] != 0.f;
      non_skin[u] = odds[u] < 0.f;
    }
  }

  // Sum up over the window in which a colour may belong to a neighbouring surface.
  sum_odds_.compute(skin_log_odds_, params_.skew_px, summed_log_odds_);
  count_.compute(coloured_, params_.skew_px, coloured_count_);
  count_.compute(non_skin_, params_.skew_px, non_skin_count_);
}

void HandMask::find_supported(const CoarseHand& hand, const Image<float>& depth) {
  const int width = depth.width(), height = depth.height();
  supported_.reset(width, height);
  low_.resize(width);
  high_.resize(width);
  standing_.resize(width);
  tolerance_.resize(width);
  for (int v = 0; v < height; ++v) {
    // Look up the limits of the cells where a new row of cells begins.
    if (v == 0 || row_[v] != row_[v - 1])
      for (int u = 0; u < width; ++u) {
        low_[u] = lowest_.at(column_[u], row_[v]);
        high_[u] = highest_.at(column_[u], row_[v]);
        standing_[u] = hand.standing ? hand.standing->depth(column_[u], row_[v]) : 0.f;
        tolerance_[u] = StandingDepth::tolerance(standing_[u]);
      }

    // Compare the depth with the limits, and with what has stood there.
    const float *z = depth.row(v), *low = low_.data(), *high = high_.data(), *standing = standing_.data(),
                *tolerance = tolerance_.data();
    std::uint8_t* supported = supported_.row(v);
    for (int u = 0; u < width; ++u)
      supported[u] = (z[u] > low[u]) & (z[u] < high[u]) & (std::abs(z[u] - standing[u]) >= tolerance[u]);
  }
}

void HandMask::classify_by_depth(const Image<float>& depth) {
  for (std::size_t i = 0; i < depth.size(); ++i)
    evidence_[i] = depth[i] <= 0 ? Evidence::none : (supported_[i] ? Evidence::hand : Evidence::other);
}

void HandMask::apply_labels(const LabelMap& labels, const Region& region) {
  for (int v = 0; v < evidence_.height(); ++v)
    for (int u = 0; u < evidence_.width(); ++u) {
      Evidence& evidence = evidence_.at(u, v);
      const int frame_u = u + region.u0, frame_v = v + region.v0;
      if ((evidence != Evidence::hand && evidence != Evidence::open) || !labels.covers(frame_u, frame_v)) continue;
      if (labels.hand_odds_at(frame_u, frame_v) < 0) evidence = Evidence::other;
    }
}

void HandMask::classify_by_colour(const Image<float>& depth) {
  constexpr auto kNone = static_cast<std::int32_t>(Evidence::none), kHand = static_cast<std::int32_t>(Evidence::hand),
                 kOther = static_cast<std::int32_t>(Evidence::other), kOpen = static_cast<std::int32_t>(Evidence::open);
  const float least_skin = static_cast<float>(params_.skin_odds), most_other = -static_cast<float>(params_.other_odds);
  const int window = 2 * params_.skew_px + 1, most_coloured = window * window;
  const int width = depth.width();
  row_evidence_.resize(width);

  // Visit the pixels row by row.
  for (int v = 0; v < depth.height(); ++v) {
    const float *z = depth.row(v), *sum = summed_log_odds_.row(v), *own = skin_log_odds_.row(v);
    const std::uint16_t *coloured_count = coloured_count_.row(v), *edges = edges_.row(v),
                        *non_skin_count = non_skin_count_.row(v);
    const std::uint8_t* supported = supported_.row(v);
    std::int32_t* row_evidence = row_evidence_.data();
    for (int u = 0; u < width; ++u) {  // computes all cases before it selects one, so that the compiler vectorises it
      const float mean = sum[u] / static_cast<float>(coloured_count[u]);
      // Require the pixel's own colour, too: near a colour border, the mean alone would assign a strip of one side to
      // the other side.
      const bool skin = (mean > least_skin) & (own[u] > 0), other = (mean < most_other) & (own[u] < most_other);
      std::int32_t e = other ? kOther : kOpen;
      e = skin ? kHand : e;
      e = supported[u] ? e : kOther;
      // Near a depth edge, a colour may belong to the neighbouring surface, so leave the decision to the neighbours,
      // unless the whole window is skin. Without this exception, a fingertip behind an object, which is near edges
      // everywhere, would be assigned to the object.
      const bool sure = skin & (non_skin_count[u] == 0) & (2 * coloured_count[u] > most_coloured);
      e = (edges[u] > 0) & !sure ? kOpen : e;
      row_evidence[u] = z[u] > 0 ? e : kNone;
    }

    // Store the classes of the row.
    Evidence* evidence = evidence_.row(v);
    for (int u = 0; u < width; ++u) evidence[u] = static_cast<Evidence>(row_evidence[u]);
  }
}

void HandMask::compute(const RgbdFrame& frame, const SkinModel& skin, const CoarseGrid& grid, const CoarseHand& hand,
                       std::span<const CoarseHand> hands, const Region& region, const Image<float>& depth,
                       const Image<std::uint8_t>& edge, Image<std::uint8_t>& mask) {
  // Find the pixels whose depth agrees with the cells of the hand.
  tabulate(frame.camera, grid, region);
  support(grid, hand, hands);
  find_supported(hand, depth);
  evidence_.reset(region.width, region.height, Evidence::none);

  // Classify them by colour, or by depth if there is no colour.
  if (grid.coloured) {
    colour_evidence(frame, skin, region);
    count_.compute(edge, params_.skew_px, edges_);
    classify_by_colour(depth);
    const float fx = static_cast<float>(frame.camera.fx);
    flood_.run(evidence_, colours_, [&](std::int32_t i, std::int32_t j) { return joined(depth[i], depth[j], fx); });
  } else {
    classify_by_depth(depth);
  }

  // Where colour does not distinguish a hand from what touches it, the detection's labels do.
  if (hand.labelled) apply_labels(hand.detected->labels, region);

  // Take what is classified as hand. Pixels that are still open count, too, unless the colours around them speak
  // against skin.
  mask.reset(region.width, region.height);
  for (int v = 0; v < region.height; ++v) {
    const Evidence* evidence = evidence_.row(v);
    const std::uint8_t* supported = supported_.row(v);
    for (int u = 0; u < region.width; ++u) {
      const bool open = evidence[u] == Evidence::open;
      if (!(supported[u] & (open | (evidence[u] == Evidence::hand)))) continue;
      if (open && summed_log_odds_.at(u, v) < 0) continue;

      // Cut off the forearm.
      mask.at(u, v) = !hand.wrist || hand.wrist->behind(rays_.point(u, v, depth.at(u, v))) <= 0;
    }
  }
  specks_.remove(frame.camera, depth, mask);
}

void label_pixels(const Intrinsics& camera, const Image<std::uint8_t>& mask, double reach, PixelRays& rays,
                  HandObservation& out) {
  out.label.reset(mask.width(), mask.height(), PixelLabel::unknown);
  const float reach_sq = static_cast<float>(reach * reach);
  const float per_pixel_sq = static_cast<float>(1 / (camera.fx * camera.fy));
  rays.reset(camera, out.u0, out.v0, mask.width(), mask.height());

  // Visit the pixels with depth; those of the mask are hand.
  for (int v = 0; v < mask.height(); ++v)
    for (int u = 0; u < mask.width(); ++u) {
      const float z = out.depth.at(u, v);
      if (z <= 0) continue;
      PixelLabel& label = out.label.at(u, v);
      if (mask.at(u, v)) {
        label = PixelLabel::hand;
        continue;
      }

      // Compute the distance to the nearest pixel of the hand.
      const std::int32_t i = out.nearest_hand.at(u, v);
      const float dz = z - out.depth[i];
      const int row = rays.row_of(i);
      const float du = static_cast<float>(i - row * mask.width() - u), dv = static_cast<float>(row - v);
      const float distance_sq = dz * dz + (du * du + dv * dv) * z * z * per_pixel_sq;

      // What is in front of the hand or close to it is an object.
      label = dz < -kInFront || distance_sq < reach_sq ? PixelLabel::object : PixelLabel::background;
    }
}

}  // namespace barehand
