// The source of the compute shader that compares samples with the depth image.
#include "observe/egl/compare_shader.h"

namespace barehand {
namespace {

// Body of the compute shader, with the same steps as stages/segment_tracker/patch_distance.cpp. Each of the LANES
// invocations of a work group compares every LANES-th skin point.
constexpr const char* kBody = R"(
precision highp float;
precision highp int;
layout(local_size_x = LANES) in;

layout(std430, binding = 0) readonly buffer Skin { vec4 skin[]; };
layout(std430, binding = 1) readonly buffer Cells { vec4 cells[]; };
layout(std430, binding = 2) readonly buffer Hidden { int hidden[]; };
layout(std430, binding = 3) readonly buffer Poses { vec4 pose_rows[]; };
layout(std430, binding = 4) writeonly buffer Results { float results[]; };

layout(location = 0) uniform vec4 camera;
layout(location = 1) uniform ivec2 map_size;
layout(location = 2) uniform float cap;
layout(location = 3) uniform int first_segment;
layout(location = 4) uniform ivec2 points[16];

shared vec3 partial[LANES];

const float kNearest = 0.01;  // skin nearer to the camera than this [m] is not seen by any depth sensor

// Returns weight times distance, the weight if the point is seen (else 0), and the weight of one skin point. T: rows of
// (R | t); origin: R^T t.
vec3 compare_point(int i, mat3x4 T, vec3 origin, int segment) {
  vec4 point = skin[2 * i];
  vec3 p = vec4(point.xyz, 1.0) * T;
  float away = dot(skin[2 * i + 1].xyz, point.xyz + origin);
  float inv = 1.0 / max(p.z, kNearest);
  // Number of pixels that the point's patch of skin covers: f^2 area (-n.p) / z^3.
  bool front = away < 0.0 && p.z > kNearest;
  float weight = front ? -away * point.w * camera.x * camera.y * inv * inv * inv : 0.0;

  vec2 pixel = camera.xy * p.xy * inv + camera.zw + 0.5;  // with + 0.5, truncation rounds to the nearest pixel
  ivec2 at = ivec2(clamp(pixel, vec2(0.0), vec2(map_size - 1)));
  int k = at.y * map_size.x + at.x;
  vec4 cell = cells[k];

  // Distance of the paper's Eq. 1; on hand pixels only the difference of depth counts.
  vec3 gap = vec3(cell.z < 0.0 ? p.xy - cell.xy : vec2(0.0), p.z - abs(cell.z));
  float d = min(length(gap), cap);
  bool seen = p.z <= cell.w && (hidden[k] & (1 << segment)) == 0;
  return seen ? vec3(weight * d, weight, weight) : vec3(0.0, 0.0, weight);
}

void main() {
  int segment = first_segment + int(gl_WorkGroupID.y);
  int sample_index = segment * int(gl_NumWorkGroups.x) + int(gl_WorkGroupID.x);
  int lane = int(gl_LocalInvocationID.x);
  mat3x4 T = mat3x4(pose_rows[3 * sample_index], pose_rows[3 * sample_index + 1], pose_rows[3 * sample_index + 2]);
  vec3 origin = mat3(T[0].xyz, T[1].xyz, T[2].xyz) * vec3(T[0].w, T[1].w, T[2].w);

  vec3 sum = vec3(0.0);
  int begin = points[segment].x, end = begin + points[segment].y;
  for (int i = begin + lane; i < end; i += LANES) sum += compare_point(i, T, origin, segment);
  partial[lane] = sum;
  for (int half_count = LANES / 2; half_count > 0; half_count /= 2) {
    barrier();
    if (lane < half_count) partial[lane] += partial[lane + half_count];
  }
  if (lane == 0) {
    results[3 * sample_index] = partial[0].x;
    results[3 * sample_index + 1] = partial[0].y;
    results[3 * sample_index + 2] = partial[0].z;
  }
}
)";

}  // namespace

std::string compare_shader(int lanes) {
  return "#version 310 es\n#define LANES " + std::to_string(lanes) + "\n" + kBody;
}

}  // namespace barehand
