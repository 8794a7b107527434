#pragma once

#include <array>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "hand/hand_pose.h"
#include "hand/surface.h"

namespace barehand {

/// A skin vertex, bound to a segment `a` and, near a joint, also to its neighbour `b` in the tree. Linear blend
/// skinning uses only two adjacent segments, so that the normal equations of a fit keep the sparsity of the tree.
struct SkinVertex {
  std::int16_t a = 0, b = 0;    ///< indices of the segments; a != b only if weight_b > 0
  float weight_b = 0;           ///< skinning weight of segment b; that of segment a is 1 - weight_b
  Eigen::Vector3f in_a, in_b;   ///< position in the frames of a and b [m]
  Eigen::Vector3f normal_in_a;  ///< outward unit normal in the frame of a
};

/// A smooth triangle mesh of the hand's skin, posed by the 16 segment poses.
struct Skin {
  std::vector<SkinVertex> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< counter-clockwise seen from outside
};

/// Builds the skin from a profile's lengths and elliptic sections: the level set of ImplicitHand, meshed with the cell
/// size `cell` [m]. It is open at the wrist, where triangles on the forearm's side are left out. A skin whose making
/// was stopped is empty.
Skin make_blended_skin(const HandProfile& profile, double cell = 0.003, const std::stop_token& stop = {});

/// The profile's scanned skin if it has one; otherwise make_blended_skin(profile, cell, stop).
Skin make_skin(const HandProfile& profile, double cell, const std::stop_token& stop = {});

/// Recomputes the normals of all vertices that belong to triangles, from the triangles in the profile's rest pose.
void compute_normals(const HandProfile& profile, Skin& skin);
/// The skin of the other hand: mirrored in the plane x = 0 of every segment.
Skin mirrored(const Skin& skin);
/// The skin with all lengths multiplied by `size`.
Skin scaled(const Skin& skin, double size);

/// Positions of all vertices in the camera frame [m] at `pose`; `posed` keeps its allocation.
void pose_skin(const Skin& skin, const HandPose& pose, std::vector<Eigen::Vector3f>& posed);

/// A skin with fewer triangles: space is divided into cubes of the side `cell` [m] in each segment's frame, and of the
/// vertices in a cube only the one nearest to their mean is kept.
Skin coarsened(const Skin& skin, double cell);

/// Points on the skin of each segment for the local trackers, which treat segments as rigid: every vertex belongs to
/// the segment with the larger weight. At most `points_per_segment` vertices are kept, spread evenly.
HandSurface surface_points(const Skin& skin, const HandProfile& profile, int points_per_segment);

}  // namespace barehand
