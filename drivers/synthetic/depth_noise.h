#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drivers/synthetic/shading.h"
#include "math/camera.h"

namespace barehand::synthetic {

/// Structured-light camera (Kinect class).
struct KinectNoise {
  double axial = 0.0012;         ///< sigma at 0.4 m [m]
  double axial_growth = 0.0019;  ///< grows by this times (z - 0.4 m)^2 / m^2 [m] (Nguyen et al., 3DIMPVT 2012)
  double lateral = 0.8;          ///< sigma across the line of sight [px], growing at grazing angles (same source)
  double baseline = 0.075;       ///< projector to camera [m]: what it does not light has no depth
};
/// Time-of-flight camera.
struct TofNoise {
  double axial = 0.0012;  ///< sigma at 0.5 m on a white surface that faces the camera [m]
  double flying = 0.6;    ///< share of the pixels on a depth edge that lie between both surfaces
};

/// Spoils an ideal depth image as a sensor would. Pixels lost are 0. A pure function of view, seed and frame.
class DepthNoise {
 public:
  DepthNoise();
  Image<float> kinect(const Intrinsics& camera, const RenderedView& view, std::span<const Material> materials,
                      const KinectNoise& noise, std::uint64_t seed, std::uint32_t frame) const;
  Image<float> tof(const RenderedView& view, const TofNoise& noise, std::uint64_t seed, std::uint32_t frame) const;

 private:
  /// Standard normal number from 12 random bits.
  float normal(std::uint32_t bits) const { return quantiles_[bits & 0xfffu]; }

  std::array<float, 4096> quantiles_;
};

/// Axial 1-sigma of the Kinect model at distance z [m].
double kinect_axial_sigma(const KinectNoise& noise, double z);

}  // namespace barehand::synthetic
