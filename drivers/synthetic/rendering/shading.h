#pragma once

#include <cstdint>
#include <span>

#include "drivers/synthetic/rendering/rasteriser.h"
#include "drivers/synthetic/rendering/scene_geometry.h"

namespace barehand::synthetic {

inline constexpr std::uint8_t kNoSurface = 255;

/// The image of an ideal camera.
struct RenderedView {
  Image<float> depth;           ///< z of the front-most surface [m]; 0 = nothing
  Image<float> cosine;          ///< of the angle between line of sight and surface normal, (0, 1]; 0 = nothing
  Image<std::uint8_t> surface;  ///< SceneGeometry::surface of the visible triangle; kNoSurface = nothing
  Image<Rgb> colour;            ///< never pure black, which would mean "no colour"
};

/// Colours every pixel of a visibility buffer: ambient and diffuse light of a lamp beside the camera, interpolated
/// between vertices, plus a little colour noise that is keyed by (seed, frame).
RenderedView shade(const Intrinsics& camera, const VisibilityBuffer& visible, const SceneGeometry& scene,
                   std::span<const Material> materials, std::uint64_t seed, std::uint32_t frame);

}  // namespace barehand::synthetic
