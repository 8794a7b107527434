#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drivers/synthetic/rendering/shading.h"
#include "math/camera.h"

namespace barehand::synthetic {

// The noise of depth sensors, which the simulator adds to its images.

/// Noise of a structured-light camera (Kinect class).
struct KinectNoise {
  double axial = 0.0012;         ///< m, sigma along the line of sight at 0.4 m (Nguyen et al., 3DIMPVT 2012)
  double axial_growth = 0.0019;  ///< 1/m, sigma = axial + axial_growth (z - 0.4 m)^2 (same source)
  double lateral = 0.8;          ///< px, sigma across the line of sight, larger at grazing angles (same source)
  double baseline = 0.075;  ///< m, distance of the projector from the camera; pixels that are not lit have no depth
};
/// Noise of a time-of-flight camera.
struct TofNoise {
  double axial = 0.0012;  ///< m, sigma at 0.5 m on a white surface that faces the camera
  double flying = 0.6;    ///< fraction of the pixels at a depth edge that lie between both surfaces ("flying pixels")
};

/// Adds a sensor's noise to an ideal depth image [m]. Lost pixels become 0. The result depends on the arguments only.
class DepthNoise {
 public:
  DepthNoise();
  /// Adds the noise of a structured-light camera. `materials`: indexed by RenderedView::surface.
  Image<float> kinect(const Intrinsics& camera, const RenderedView& view, std::span<const Material> materials,
                      const KinectNoise& noise, std::uint64_t seed, std::uint32_t frame) const;
  /// Adds the noise of a time-of-flight camera.
  Image<float> tof(const RenderedView& view, const TofNoise& noise, std::uint64_t seed, std::uint32_t frame) const;

 private:
  /// A standard normal number from 12 random bits.
  float normal(std::uint32_t bits) const { return quantiles_[bits & 0xfffu]; }

  std::array<float, 4096> quantiles_;  // quantiles of the standard normal distribution, equally spaced in probability
};

/// Standard deviation of the Kinect model along the line of sight at the distance z [m].
double kinect_axial_sigma(const KinectNoise& noise, double z);

}  // namespace barehand::synthetic
