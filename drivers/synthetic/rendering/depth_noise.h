#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drivers/synthetic/rendering/shading.h"
#include "math/camera.h"

namespace barehand::synthetic {

/// Noise of a structured-light camera (Kinect class).
struct KinectNoise {
  double axial = 0.0012;         ///< m, sigma at 0.4 m
  double axial_growth = 0.0019;  ///< m, growth of sigma: times (z - 0.4 m)^2 / m^2 (Nguyen et al., 3DIMPVT 2012)
  double lateral = 0.8;          ///< px, sigma across the line of sight, larger at grazing angles (same source)
  double baseline = 0.075;       ///< m, from projector to camera: what the projector does not light has no depth
};
/// Noise of a time-of-flight camera.
struct TofNoise {
  double axial = 0.0012;  ///< m, sigma at 0.5 m on a white surface that faces the camera
  double flying = 0.6;    ///< share of the pixels on a depth edge that float between both surfaces
};

/// Degrades an ideal depth image [m] as a sensor does. Lost pixels become 0. The result is a pure function of view,
/// seed and frame.
class DepthNoise {
 public:
  DepthNoise();
  /// With the noise of a structured-light camera; `materials`: by RenderedView::surface.
  Image<float> kinect(const Intrinsics& camera, const RenderedView& view, std::span<const Material> materials,
                      const KinectNoise& noise, std::uint64_t seed, std::uint32_t frame) const;
  /// With the noise of a time-of-flight camera.
  Image<float> tof(const RenderedView& view, const TofNoise& noise, std::uint64_t seed, std::uint32_t frame) const;

 private:
  /// A standard normal number from 12 random bits.
  float normal(std::uint32_t bits) const { return quantiles_[bits & 0xfffu]; }

  std::array<float, 4096> quantiles_;
};

/// Standard deviation along the line of sight in the Kinect model at the distance z [m].
double kinect_axial_sigma(const KinectNoise& noise, double z);

}  // namespace barehand::synthetic
