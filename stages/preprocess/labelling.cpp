#include "stages/preprocess/labelling.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace barehand {
namespace {

constexpr double kSpeckArea = 3e-5;  // m^2: less than half a fingertip
constexpr float kInFront = 0.005f;   // m before the nearest hand pixel

bool joined(float a, float b, float fx) { return std::abs(a - b) < same_surface_step(std::min(a, b), fx); }

}  // namespace

void HandMask::tabulate(const Intrinsics& camera, const CoarseGrid& grid, const Region& region) {
  rays_.reset(camera, region.u0, region.v0, region.width, region.height);
  column_.resize(region.width);
  row_.resize(region.height);
  for (int u = 0; u < region.width; ++u) column_[u] = std::min((u + region.u0) / grid.step, grid.z.width() - 1);
  for (int v = 0; v < region.height; ++v) row_[v] = std::min((v + region.v0) / grid.step, grid.z.height() - 1);
}

void HandMask::support(const CoarseGrid& grid, const CoarseHand& hand) {
  const int width = grid.z.width(), height = grid.z.height();
  const float fx = static_cast<float>(grid.camera.fx);
  lowest_.reset(width, height, INFINITY);
  highest_.reset(width, height, -INFINITY);
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
}

void HandMask::colour_evidence(const RgbdFrame& frame, const SkinModel& skin, const Region& region) {
  own_odds_.create(region.height, region.width, CV_32F);
  present_.create(region.height, region.width, CV_32F);
  colours_.reset(region.width, region.height);
  for (int v = 0; v < region.height; ++v) {
    const Rgb* colour = frame.colour.row(v + region.v0) + region.u0;
    std::copy_n(colour, region.width, colours_.row(v));
    const float* nearest = lowest_.row(row_[v]);
    float* odds = own_odds_.ptr<float>(v);
    float* present = present_.ptr<float>(v);
    for (int u = 0; u < region.width; ++u) {
      const bool beside_hand = nearest[column_[u]] < INFINITY;
      odds[u] = beside_hand ? skin.log_odds(colour[u]) : 0.f;
      present[u] = odds[u] != 0.f ? 1.f : 0.f;
    }
  }
  const cv::Size window(2 * params_.skew_px + 1, 2 * params_.skew_px + 1);
  cv::boxFilter(own_odds_, odds_, -1, window, {-1, -1}, false, cv::BORDER_CONSTANT);
  cv::boxFilter(present_, present_, -1, window, {-1, -1}, false, cv::BORDER_CONSTANT);
}

void HandMask::remove_specks(const RgbdFrame& frame, const Image<float>& depth, Image<std::uint8_t>& mask) {
  const cv::Mat view(mask.height(), mask.width(), CV_8U, mask.data());
  const int parts = cv::connectedComponentsWithStats(view, labels_, stats_, centroids_, 8, CV_32S);
  if (parts <= 1) return;
  const double per_metre_sq = frame.camera.fx * frame.camera.fy;
  keep_.assign(parts, 1);
  for (int k = 1; k < parts; ++k) {
    const double x = centroids_.at<double>(k, 0), y = centroids_.at<double>(k, 1);
    const float z = depth.at(static_cast<int>(x), static_cast<int>(y));
    const double pixels = kSpeckArea * per_metre_sq / (z > 0 ? z * z : 0.25);
    keep_[k] = stats_.at<int>(k, cv::CC_STAT_AREA) >= pixels;
  }
  for (int v = 0; v < mask.height(); ++v) {
    const int* label = labels_.ptr<int>(v);
    std::uint8_t* own = mask.row(v);
    for (int u = 0; u < mask.width(); ++u) own[u] &= keep_[label[u]];
  }
}

void HandMask::find_supported(const Image<float>& depth) {
  const int width = depth.width(), height = depth.height();
  supported_.reset(width, height);
  low_.resize(width);
  high_.resize(width);
  for (int v = 0; v < height; ++v) {
    if (v == 0 || row_[v] != row_[v - 1])
      for (int u = 0; u < width; ++u) {
        low_[u] = lowest_.at(column_[u], row_[v]);
        high_[u] = highest_.at(column_[u], row_[v]);
      }
    const float *z = depth.row(v), *low = low_.data(), *high = high_.data();
    std::uint8_t* supported = supported_.row(v);
    for (int u = 0; u < width; ++u) supported[u] = (z[u] > low[u]) & (z[u] < high[u]);
  }
}

void HandMask::judge_depth(const Image<float>& depth) {
  for (std::size_t i = 0; i < depth.size(); ++i)
    evidence_[i] = depth[i] <= 0 ? Evidence::none : (supported_[i] ? Evidence::hand : Evidence::other);
}

void HandMask::judge_colour(const Image<float>& depth) {
  constexpr auto kNone = static_cast<std::int32_t>(Evidence::none), kHand = static_cast<std::int32_t>(Evidence::hand),
                 kOther = static_cast<std::int32_t>(Evidence::other), kOpen = static_cast<std::int32_t>(Evidence::open);
  const float least_skin = static_cast<float>(params_.skin_odds), most_other = -static_cast<float>(params_.other_odds);
  const int width = depth.width();
  judged_.resize(width);
  for (int v = 0; v < depth.height(); ++v) {
    const float *z = depth.row(v), *sum = odds_.ptr<float>(v), *present = present_.ptr<float>(v),
                *own = own_odds_.ptr<float>(v);
    const std::uint8_t *edge = edges_.ptr<std::uint8_t>(v), *supported = supported_.row(v);
    std::int32_t* judged = judged_.data();
    for (int u = 0; u < width; ++u) {  // everything is computed before it is chosen from: it vectorises
      const float mean = sum[u] / present[u];
      const bool asked = (present[u] >= 0.5f) & (own[u] != 0.f);
      // Beside a colour border the mean alone would take a strip of one side for the other.
      const bool skin = asked & (mean > least_skin) & (own[u] > 0),
                 other = asked & (mean < most_other) & (own[u] < most_other);
      std::int32_t e = other ? kOther : kOpen;
      e = skin ? kHand : e;
      e = supported[u] ? e : kOther;
      e = edge[u] ? kOpen : e;
      judged[u] = z[u] > 0 ? e : kNone;
    }
    Evidence* evidence = evidence_.row(v);
    for (int u = 0; u < width; ++u) evidence[u] = static_cast<Evidence>(judged[u]);
  }
}

void HandMask::compute(const RgbdFrame& frame, const SkinModel& skin, const CoarseGrid& grid, const CoarseHand& hand,
                       const Region& region, const Image<float>& depth, const Image<std::uint8_t>& edge,
                       Image<std::uint8_t>& mask) {
  tabulate(frame.camera, grid, region);
  support(grid, hand);
  find_supported(depth);
  evidence_.reset(region.width, region.height, Evidence::none);
  if (grid.coloured) {
    colour_evidence(frame, skin, region);
    const cv::Mat edges(region.height, region.width, CV_8U, const_cast<std::uint8_t*>(edge.data()));
    const int side = 2 * params_.skew_px + 1;
    cv::dilate(edges, edges_, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
    judge_colour(depth);
    const float fx = static_cast<float>(frame.camera.fx);
    flood_.run(evidence_, colours_, [&](std::int32_t i, std::int32_t j) { return joined(depth[i], depth[j], fx); });
  } else {
    judge_depth(depth);
  }
  mask.reset(region.width, region.height);
  for (int v = 0; v < region.height; ++v) {
    const Evidence* evidence = evidence_.row(v);
    const std::uint8_t* supported = supported_.row(v);
    for (int u = 0; u < region.width; ++u) {
      const bool open = evidence[u] == Evidence::open;
      if (!(supported[u] & (open | (evidence[u] == Evidence::hand)))) continue;
      if (open && odds_.at<float>(v, u) < 0) continue;
      mask.at(u, v) = !hand.wrist || hand.wrist->behind(rays_.point(u, v, depth.at(u, v))) <= 0;
    }
  }
  remove_specks(frame, depth, mask);
}

void label_pixels(const Intrinsics& camera, const Image<std::uint8_t>& mask, double reach, PixelRays& rays,
                  HandObservation& out) {
  out.label.reset(mask.width(), mask.height(), PixelLabel::unknown);
  const float reach_sq = static_cast<float>(reach * reach);
  const float per_pixel_sq = static_cast<float>(1 / (camera.fx * camera.fy));
  rays.reset(camera, out.u0, out.v0, mask.width(), mask.height());
  for (int v = 0; v < mask.height(); ++v)
    for (int u = 0; u < mask.width(); ++u) {
      const float z = out.depth.at(u, v);
      if (z <= 0) continue;
      PixelLabel& label = out.label.at(u, v);
      if (mask.at(u, v)) {
        label = PixelLabel::hand;
        continue;
      }
      const std::int32_t i = out.nearest_hand.at(u, v);
      const float dz = z - out.depth[i];
      const int row = rays.row_of(i);
      const float du = static_cast<float>(i - row * mask.width() - u), dv = static_cast<float>(row - v);
      const float distance_sq = dz * dz + (du * du + dv * dv) * z * z * per_pixel_sq;
      label = dz < -kInFront || distance_sq < reach_sq ? PixelLabel::object : PixelLabel::background;
    }
}

}  // namespace barehand
