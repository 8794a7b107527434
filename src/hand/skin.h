#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hand/hand_pose.h"
#include "hand/surface.h"

namespace barehand {

/// One skin vertex bound to a segment `a` and, near a joint, to its tree neighbour `b` (linear blend skinning over two
/// adjacent segments only, so that the normal equations of a fit keep the sparsity of the hand's tree).
struct SkinVertex {
  std::int16_t a = 0, b = 0;    ///< a != b only where weight_b > 0
  float weight_b = 0;           ///< weight of a is 1 - weight_b
  Eigen::Vector3f in_a, in_b;   ///< position in the frames of a and b [m]
  Eigen::Vector3f normal_in_a;  ///< outward unit normal in the frame of a
};

/// Smooth closed skin of a hand, posed by the 16 segment poses.
struct Skin {
  std::vector<SkinVertex> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< counter-clockwise seen from outside
};

/// Skin derived from a profile's lengths and elliptic sections: level set of ImplicitHand meshed with `cell` [m].
/// The cut at the wrist stays open to the forearm side: triangles there are left out.
Skin make_blended_skin(const HandProfile& profile, double cell = 0.003);

/// The skin that a profile carries from a scan, or else the one derived from its sections with `cell` [m].
Skin make_skin(const HandProfile& profile, double cell);

/// Normals of all vertices with triangles around them, from these in the profile's rest pose.
void compute_normals(const HandProfile& profile, Skin& skin);
/// The skin of the other hand: reflected in the plane x = 0 of every segment.
Skin mirrored(const Skin& skin);
/// The skin of a hand that is `size` times as large.
Skin scaled(const Skin& skin, double size);

/// Vertex positions in the camera frame for a pose; `posed` keeps its allocation.
void pose_skin(const Skin& skin, const HandPose& pose, std::vector<Eigen::Vector3f>& posed);

/// The same skin with fewer triangles: of the vertices of a segment in a cube of `cell` [m] at rest, the one nearest to
/// their mean stands for all.
Skin coarsened(const Skin& skin, double cell);

/// The skin as rigid surface points per segment (every vertex goes to the segment with the larger weight), for the
/// local trackers. Thinned to at most `points_per_segment`, evenly by area.
HandSurface surface_points(const Skin& skin, const HandProfile& profile, int points_per_segment);

}  // namespace barehand
