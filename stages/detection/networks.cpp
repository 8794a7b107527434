// Makes the inputs of the two detection networks from depth, and converts their outputs to joints and labels.
#include "stages/detection/networks.h"

#include <algorithm>
#include <cmath>

#include "stages/detection/heat_map.h"

namespace barehand {
namespace {

// Longest and shortest focal length of a window (DepthView) that is resampled for the network `full` [px of the
// window].
constexpr double kFullFocal = 131.25, kShortestFocal = 105;
// Most columns and rows of such windows. Four are enough for 120 degrees; more are wanted only with a wrong focal
// length, and would take seconds a frame.
constexpr double kMostInARow = 6;
// The input of `full` is the difference from the depth kMiddleDepth, clipped to the range from kFullNear to kFullFar
// [m].
constexpr float kMiddleDepth = 1, kFullNear = -1, kFullFar = 1.5;
constexpr double kWindow = 0.34;      // width of the window of `crop` at the palm's depth [m]
constexpr float kWindowDepth = 0.15;  // depth range of that window, in front of the palm and behind it [m]
// Factor from the standard deviation of a heat map to that of its joint. The map is wider than the joint is uncertain,
// since its tails cover the whole hand.
constexpr double kSpreadShare = 0.4;
constexpr double kLeastDeviation = 0.004;  // minimum standard deviation of a joint [m]

double square(double x) { return x * x; }

}  // namespace

std::vector<DepthView> frame_views(const Intrinsics& camera) {
  // Choose the focal length with which one window covers the frame, within the limits; then count the windows that are
  // needed.
  const double wide =
      std::max(camera.width / (camera.fx * kFullShape.width), camera.height / (camera.fy * kFullShape.height));
  const double focal = std::clamp(1 / wide, kShortestFocal, kFullFocal);
  const auto count = [&](int pixels, double f, int width) {
    return static_cast<int>(std::clamp(std::ceil(pixels * focal / (f * width) - 1e-6), 1.0, kMostInARow));
  };

  // Count the columns and rows of windows.
  const int columns = count(camera.width, camera.fx, kFullShape.width),
            rows = count(camera.height, camera.fy, kFullShape.height);

  // Space the windows evenly; several windows overlap.
  const auto middle = [](int i, int n, int pixels, double covered) {
    return n == 1 ? 0.5 * (pixels - 1) : 0.5 * (covered - 1) + i * (pixels - covered) / (n - 1);
  };

  std::vector<DepthView> views;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      views.emplace_back(kFullShape.width, kFullShape.height, focal,
                         middle(c, columns, camera.width, kFullShape.width * camera.fx / focal),
                         middle(r, rows, camera.height, kFullShape.height * camera.fy / focal), camera);
  return views;
}

DepthView window_around(const Eigen::Vector3d& centre, const Intrinsics& camera) {
  const Eigen::Vector2d pixel = camera.project(centre);
  const double focal = kCropShape.width * centre.z() / kWindow;
  return DepthView(kCropShape.width, kCropShape.height, focal, pixel.x(), pixel.y(), camera);
}

void fill_full(const Image<float>& depth, NetworkInput& input) {
  input.depth.reset(depth.width(), depth.height(), kFullFar);
  input.valid.reset(depth.width(), depth.height(), 0.f);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (depth[i] <= 0) continue;
    input.depth[i] = std::clamp(depth[i] - kMiddleDepth, kFullNear, kFullFar);
    input.valid[i] = 1;
  }
}

void fill_crop(const Image<float>& depth, double middle, bool mirrored, NetworkInput& input) {
  const int width = depth.width();
  input.depth.reset(width, depth.height(), 1.f);
  input.valid.reset(width, depth.height(), 0.f);
  for (int v = 0; v < depth.height(); ++v)
    for (int u = 0; u < width; ++u) {
      const float z = depth.at(u, v);
      if (z <= 0) continue;
      const int column = mirrored ? width - 1 - u : u;
      input.depth.at(column, v) = std::clamp((z - static_cast<float>(middle)) / kWindowDepth, -1.f, 1.f);
      input.valid.at(column, v) = 1;
    }
}

// Cell (c, r) of the label planes lies at input pixel (2c, 2r).
void read_labels(const NetworkOutput& output, const DepthView& view, bool mirrored, LabelMap& out) {
  const int width = output.label_width, height = output.label_height;
  out.label.reset(width, height);
  out.hand_log_odds.reset(width, height);

  // Choose the most probable label of every cell.
  for (int r = 0; r < height; ++r)
    for (int c = 0; c < width; ++c) {
      std::array<float, kSurfaceLabelCount> logit;
      for (int k = 0; k < kSurfaceLabelCount; ++k) logit[k] = output.label_plane(k)[r * width + c];
      const auto best = std::max_element(logit.begin(), logit.end());
      constexpr int kHand = static_cast<int>(SurfaceLabel::hand);

      // Compute the log odds of the hand against all other labels.
      float rest = 0;
      for (int k = 0; k < kSurfaceLabelCount; ++k)
        if (k != kHand) rest += std::exp(logit[k] - logit[kHand]);
      const int column = mirrored ? width - 1 - c : c;
      out.label.at(column, r) = static_cast<SurfaceLabel>(best - logit.begin());
      out.hand_log_odds.at(column, r) = -std::log(rest);
    }

  // State where the cells lie in the frame.
  const Eigen::Vector2d corner = view.frame_pixel(mirrored ? 1 : 0, 0);
  out.u0 = corner.x();
  out.v0 = corner.y();
  out.step_u = 2 * view.step_u;
  out.step_v = 2 * view.step_v;
}

DetectedJoint read_joint(const NetworkOutput& output, int joint, const DepthView& view, double middle, bool mirrored,
                         const Intrinsics& camera) {
  const HeatMap map{output.map_plane(joint), output.map_width, output.map_height};
  const HeatMoments heat = heat_moments(map, output.map_plane(kLandmarkCount + joint));

  // Map the mean of the heat map to a pixel and a depth.
  double u = kMapStep * heat.mean.x() + kMapOffset;
  if (mirrored) u = view.width - 1 - u;
  const Eigen::Vector2d pixel = view.frame_pixel(u, kMapStep * heat.mean.y() + kMapOffset);
  const double z = middle + kWindowDepth * heat.value_mean;

  // The covariance across the ray follows from the width of the heat map. The variance along the ray follows from the
  // variance of the depths under the map, and is at least the mean variance across.
  DetectedJoint result;
  result.position = camera.unproject(pixel.x(), pixel.y(), z);
  const double metres = kMapStep * z / view.focal;  // size of a cell at the joint's depth
  Eigen::Matrix2d across = square(kSpreadShare * metres) * heat.covariance;
  if (mirrored) across(0, 1) = across(1, 0) = -across(0, 1);
  const double depth_variance = square(kSpreadShare * kWindowDepth) * heat.value_variance + 0.5 * across.trace();

  // Add the variances along the ray and across it.
  const Eigen::Vector3d ray = result.position / z;
  result.covariance = depth_variance * ray * ray.transpose();
  result.covariance.topLeftCorner<2, 2>() += across;
  result.covariance.diagonal().array() += square(kLeastDeviation);
  return result;
}

}  // namespace barehand
