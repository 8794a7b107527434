#pragma once

#include <string>

namespace barehand {

/// What the shader's buffers are bound to. All are storage buffers.
enum ShaderBuffer {
  kSkinBuffer,    ///< per point: (x, y, z, area), (nx, ny, nz, 0), segment frame
  kCellBuffer,    ///< PixelMap::cells
  kHiddenBuffer,  ///< PixelMap::hidden
  kPoseBuffer,    ///< per sample: the three rows of (R | t), segment by segment
  kResultBuffer,  ///< per sample: distance, counted, total of its PatchDistance
  kShaderBufferCount
};

inline constexpr int kFloatsPerPoint = 8, kFloatsPerPose = 12, kFloatsPerResult = 3;

/// Where its uniforms are.
enum ShaderUniform {
  kCameraUniform,        ///< vec4: fx, fy, cx, cy of the map [pixel]
  kMapSizeUniform,       ///< ivec2: columns, rows
  kCapUniform,           ///< float: largest distance of one pixel [m]
  kFirstSegmentUniform,  ///< int: of the segments that are looked at
  kPointsUniform,        ///< ivec2[16]: a segment's first skin point and their number
};

/// Source of the compute shader that compares samples with the data: one work group per sample and, in y, segment from
/// the first that is looked at. `lanes`, a power of two: invocations in a group, which share the sample's skin points.
std::string compare_shader(int lanes);

}  // namespace barehand
