#pragma once

#include <cstdint>
#include <span>

#include "drivers/synthetic/rendering/rasteriser.h"
#include "drivers/synthetic/rendering/scene_geometry.h"

namespace barehand::synthetic {

inline constexpr std::uint8_t kNoSurface = 255;

/// The image of an ideal camera.
struct RenderedView {
  Image<float> depth;           ///< z of the front-most surface [m]; 0: there is none
  Image<float> cosine;          ///< cosine of the angle between line of sight and normal, in (0, 1]; 0: no surface
  Image<std::uint8_t> surface;  ///< SceneGeometry::surface of the visible triangle; kNoSurface: there is none
  Image<Rgb> colour;            ///< never pure black, which would mean "no colour"
};

/// Computes depth, viewing angle, surface and colour of every pixel of a visibility buffer. The colour consists of
/// ambient light and the diffuse light of a lamp near the camera, interpolated between vertices, and a little noise
/// that depends on (seed, frame).
RenderedView shade(const Intrinsics& camera, const VisibilityBuffer& visible, const SceneGeometry& scene,
                   std::span<const Material> materials, std::uint64_t seed, std::uint32_t frame);

}  // namespace barehand::synthetic
