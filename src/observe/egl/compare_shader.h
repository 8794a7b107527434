#pragma once

#include <string>

namespace barehand {

// The compute shader that compares samples with the data, and its interface.

/// Bindings of the shader's storage buffers.
enum ShaderBuffer {
  kSkinBuffer,    ///< per skin point: (x, y, z, area), (nx, ny, nz, 0) in the segment frame
  kCellBuffer,    ///< PixelMap::cells
  kHiddenBuffer,  ///< PixelMap::hidden
  kPoseBuffer,    ///< per sample: the three rows of its pose (R | t), segment by segment
  kResultBuffer,  ///< per sample: the members distance, counted and total of its PatchDistance
  kShaderBufferCount
};

inline constexpr int kFloatsPerPoint = 8, kFloatsPerPose = 12, kFloatsPerResult = 3;

/// Locations of the shader's uniforms.
enum ShaderUniform {
  kCameraUniform,        ///< vec4: fx, fy, cx, cy of the map [pixel]
  kMapSizeUniform,       ///< ivec2: columns and rows of the map
  kCapUniform,           ///< float: largest distance of one pixel [m]
  kFirstSegmentUniform,  ///< int: first segment that is compared
  kPointsUniform,        ///< ivec2[16]: for each segment, index of its first skin point and number of its points
};

/// Source of the compute shader that compares samples with the data: one work group per sample (x) and segment (y, from
/// the first segment that is compared). `lanes` is the number of invocations in a group, a power of two; they divide
/// the sample's skin points among themselves.
std::string compare_shader(int lanes);

}  // namespace barehand
