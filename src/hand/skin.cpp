#include "hand/skin.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "hand/implicit_hand.h"
#include "hand/joint_angles.h"
#include "hand/surface_nets.h"

namespace barehand {
namespace {

// Builds the skin as a mesh of the implicit hand, binds its vertices to segments, and poses, thins and samples it.

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kWristCut = 0.012;  // the skin ends this far behind the wrist joint [m]

HandPose rest_pose(const HandProfile& profile) {
  HandPose rest;
  for (int s = 0; s < kSegmentCount; ++s) rest[s] = profile.segments[s].T_hand_segment;
  return rest;
}

double smoothstep(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

/// The segments `a` and `b` that a vertex is bound to, and the weight of `b`.
struct Binding {
  int a, b;
  double weight_b;
};

// Weight of the distal segment `distal` for a skin point near its joint, from the position along the distal bone. The
// blend is wider at a knuckle, and there the palm's skin reaches farther along the palm side of the finger than along
// its back.
double weight_across_joint(const HandProfile& profile, const HandPose& pose, int distal, const Vector3d& p) {
  // Half widths of the blend at a joint and at a knuckle, relative to the joint's size.
  constexpr double kReach = 0.82, kKnuckleReach = 1.79;

  // Shift of the blend at a knuckle towards the fingertip, and how much smaller the shift is on the back of the hand
  // and larger on the palm side; both relative to the joint's size.
  constexpr double kKnuckleShift = 0.173, kKnuckleSlant = 0.226;
  const Vector3d q = pose[distal].inverse() * p;
  const SegmentProfile& s = profile.segments[distal];
  const double size = std::min({s.half_width[0], s.half_thickness[0], 0.7 * s.length});

  // The blend is centred on the joint; at the knuckles of fingers it is wider and shifted.
  double along = -q.z(), reach = kReach * size;
  if (parent_of(distal) == kPalm && finger_of(distal) != 0) {
    const double towards_back = std::clamp((q.y() - s.flesh_offset_y[0]) / s.half_thickness[0], -1.2, 1.2);
    along -= (kKnuckleShift - kKnuckleSlant * towards_back) * size;
    reach = kKnuckleReach * size;
  }
  return smoothstep(0.5 + along / (2 * reach));
}

/// Binds a vertex to both segments, the one with the larger weight first. `child_weight`: weight of `child`.
Binding blended(int parent, int child, double child_weight) {
  if (child_weight <= 0) return {parent, parent, 0};
  if (child_weight >= 1) return {child, child, 0};
  return child_weight < 0.5 ? Binding{parent, child, child_weight} : Binding{child, parent, 1 - child_weight};
}

// Binds a point near the wide fold of skin between thumb and palm, by the difference of its distances to their
// surfaces.
Binding bind_thenar(const ImplicitHand& hand, const Vector3d& p) {
  constexpr double kRange = 0.0104;  // half width of the blend [m]
  const int thumb = segment_of(0, 0);
  const double difference = hand.segment_distance(kPalm, p) - hand.segment_distance(thumb, p);
  return blended(kPalm, thumb, smoothstep(0.5 + difference / (2 * kRange)));
}

/// Chooses the segments and the weight of a skin point in the hand frame, in the pose of the implicit hand.
Binding bind(const ImplicitHand& hand, const HandProfile& profile, const Vector3d& p) {
  // Find the segment whose surface is nearest.
  int nearest = kPalm;
  double best = hand.segment_distance(kPalm, p);
  for (int s = 1; s < kSegmentCount; ++s) {
    const double d = hand.segment_distance(s, p);
    if (d < best) best = d, nearest = s;
  }

  // Skin of the palm blends into the nearest finger, but the palm keeps at least half of the weight.
  if (nearest == kPalm) {
    // Find the nearest finger.
    int finger = 0;
    double nearest_finger = hand.segment_distance(segment_of(0, 0), p);
    for (int f = 1; f < kFingerCount; ++f) {
      const double d = hand.segment_distance(segment_of(f, 0), p);
      if (d < nearest_finger) nearest_finger = d, finger = f;
    }
    if (finger == 0) return bind_thenar(hand, p);
    const int child = segment_of(finger, 0);
    return blended(kPalm, child, std::min(0.5, weight_across_joint(profile, hand.pose(), child, p)));
  }

  // Skin of the thumb's metacarpal blends into the next phalanx near their joint, and otherwise into the palm.
  if (nearest == segment_of(0, 0)) {
    const double next_weight = weight_across_joint(profile, hand.pose(), nearest + 1, p);
    return next_weight > 0 ? blended(nearest, nearest + 1, next_weight) : bind_thenar(hand, p);
  }

  // Skin of any other segment blends into its child near their joint, and otherwise into its parent.
  if (!is_tip(nearest)) {
    const double next_weight = weight_across_joint(profile, hand.pose(), nearest + 1, p);
    if (next_weight > 0) return blended(nearest, nearest + 1, next_weight);
  }
  return blended(parent_of(nearest), nearest, weight_across_joint(profile, hand.pose(), nearest, p));
}

}  // namespace

Skin make_blended_skin(const HandProfile& profile, double cell, const std::stop_token& stop) {
  const ImplicitHand hand(profile);
  const auto distance = [&](const Vector3d& p) { return hand.distance(p); };

  // Extract the surface in a box around all bones, with a margin for the flesh.
  Vector3d lower = hand.pose()[kPalm].t, upper = lower;
  for (int s = 0; s < kSegmentCount; ++s) {
    for (const Vector3d& end : {proximal_end(hand.pose(), s), distal_end(profile, hand.pose(), s)}) {
      lower = lower.cwiseMin(end);
      upper = upper.cwiseMax(end);
    }
  }
  const Vector3d margin = Vector3d::Constant(0.045);
  const TriangleMesh mesh = extract_surface(distance, lower - margin, upper + margin, cell, stop);

  // Bind every vertex to its segments.
  Skin skin;
  skin.vertices.reserve(mesh.vertices.size());
  std::vector<bool> beyond_wrist;
  const SE3 T_palm_hand = hand.pose()[kPalm].inverse();
  for (const Vector3d& p : mesh.vertices) {
    if (stop.stop_requested()) return {};

    // Find the two segments and the skinning weight.
    const Binding binding = bind(hand, profile, p);
    SkinVertex v;
    v.a = static_cast<std::int16_t>(binding.a);
    v.b = static_cast<std::int16_t>(binding.b);
    v.weight_b = static_cast<float>(binding.weight_b);
    // Express the vertex in the frames of its segments.
    v.in_a = (hand.pose()[binding.a].inverse() * p).cast<float>();
    v.in_b = (hand.pose()[binding.b].inverse() * p).cast<float>();
    v.normal_in_a = (hand.pose()[binding.a].R.transpose() * surface_normal(distance, p)).cast<float>();
    skin.vertices.push_back(v);

    beyond_wrist.push_back((T_palm_hand * p).z() > kWristCut);
  }

  if (stop.stop_requested()) return {};

  // Leave out the triangles beyond the wrist, on the forearm.
  for (const auto& t : mesh.triangles)
    if (!(beyond_wrist[t[0]] && beyond_wrist[t[1]] && beyond_wrist[t[2]])) skin.triangles.push_back({t[0], t[1], t[2]});
  return skin;
}

Skin make_skin(const HandProfile& profile, double cell, const std::stop_token& stop) {
  return profile.scanned_skin ? *profile.scanned_skin : make_blended_skin(profile, cell, stop);
}

void compute_normals(const HandProfile& profile, Skin& skin) {
  std::vector<Vector3f> posed;
  pose_skin(skin, rest_pose(profile), posed);

  // Average the normals of the triangles around each vertex.
  std::vector<Vector3f> normals(posed.size(), Vector3f::Zero());
  for (const auto& t : skin.triangles) {
    // The cross product is as long as twice the triangle's area, which is its weight in the average.
    const Vector3f normal = (posed[t[1]] - posed[t[0]]).cross(posed[t[2]] - posed[t[0]]);
    for (int corner : t) normals[corner] += normal;
  }

  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Eigen::Matrix3f R = profile.segments[skin.vertices[i].a].T_hand_segment.R.cast<float>();
    if (normals[i] != Vector3f::Zero()) skin.vertices[i].normal_in_a = R.transpose() * normals[i].stableNormalized();
  }
}

Skin mirrored(const Skin& skin) {
  Skin other = skin;
  for (SkinVertex& v : other.vertices)
    for (Vector3f* x : {&v.in_a, &v.in_b, &v.normal_in_a}) x->x() = -x->x();
  for (auto& t : other.triangles) std::swap(t[1], t[2]);
  return other;
}

Skin scaled(const Skin& skin, double size) {
  Skin other = skin;
  for (SkinVertex& v : other.vertices) {
    v.in_a *= static_cast<float>(size);
    v.in_b *= static_cast<float>(size);
  }
  return other;
}

void pose_skin(const Skin& skin, const HandPose& pose, std::vector<Vector3f>& posed) {
  // Convert the pose to single precision.
  std::array<Eigen::Matrix3f, kSegmentCount> R;
  std::array<Vector3f, kSegmentCount> t;
  for (int s = 0; s < kSegmentCount; ++s) {
    R[s] = pose[s].R.cast<float>();
    t[s] = pose[s].t.cast<float>();
  }

  posed.resize(skin.vertices.size());
  for (std::size_t i = 0; i < skin.vertices.size(); ++i) {
    const SkinVertex& v = skin.vertices[i];
    posed[i] = R[v.a] * v.in_a + t[v.a];
    if (v.weight_b > 0) posed[i] += v.weight_b * (R[v.b] * v.in_b + t[v.b] - posed[i]);
  }
}

Skin coarsened(const Skin& skin, double cell) {
  using Cell = std::array<int, 4>;  // segment, and cube in its frame
  const float per_metre = static_cast<float>(1 / cell);
  struct Cluster {
    Vector3f sum = Vector3f::Zero();
    int count = 0, vertex = -1;
    float distance = 0;  // distance of `vertex` from the mean [m]
  };

  // Assign every vertex to the cluster of its cube.
  std::map<Cell, int> numbers;
  std::vector<Cluster> clusters;
  std::vector<int> cluster_of;
  cluster_of.reserve(skin.vertices.size());

  // A cluster is a cube in the frame of a segment.
  for (const SkinVertex& v : skin.vertices) {
    const Eigen::Array3i cube = (v.in_a.array() * per_metre).floor().cast<int>();
    const auto [known, fresh] =
        numbers.try_emplace({v.a, cube.x(), cube.y(), cube.z()}, static_cast<int>(clusters.size()));
    if (fresh) clusters.emplace_back();
    cluster_of.push_back(known->second);
    clusters[known->second].sum += v.in_a;
    ++clusters[known->second].count;
  }

  // Represent each cluster by its vertex nearest to the mean.
  for (std::size_t i = 0; i < skin.vertices.size(); ++i) {
    Cluster& cluster = clusters[cluster_of[i]];
    const float distance = (skin.vertices[i].in_a - cluster.sum / static_cast<float>(cluster.count)).norm();
    if (cluster.vertex >= 0 && distance >= cluster.distance) continue;
    cluster.vertex = static_cast<int>(i);
    cluster.distance = distance;
  }

  // Build the coarse skin; only triangles with their corners in three different clusters remain.
  Skin coarse;
  coarse.vertices.reserve(clusters.size());
  for (const Cluster& cluster : clusters) coarse.vertices.push_back(skin.vertices[cluster.vertex]);
  for (const auto& t : skin.triangles) {
    const std::array<std::int32_t, 3> corners = {cluster_of[t[0]], cluster_of[t[1]], cluster_of[t[2]]};
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
      coarse.triangles.push_back(corners);
  }
  return coarse;
}

HandSurface surface_points(const Skin& skin, const HandProfile& profile, int points_per_segment) {
  // A vertex's area is a third of the summed area of the triangles around it.
  std::vector<Vector3f> posed;
  pose_skin(skin, rest_pose(profile), posed);
  std::vector<float> area(skin.vertices.size(), 0);
  for (const auto& t : skin.triangles) {
    const float third = (posed[t[1]] - posed[t[0]]).cross(posed[t[2]] - posed[t[0]]).norm() / 6;
    for (int corner : t) area[corner] += third;
  }

  std::array<std::vector<int>, kSegmentCount> members;
  for (std::size_t i = 0; i < skin.vertices.size(); ++i)
    if (area[i] > 0) members[skin.vertices[i].a].push_back(static_cast<int>(i));

  HandSurface surface;
  for (int s = 0; s < kSegmentCount; ++s) {
    const int count = static_cast<int>(members[s].size());
    const int kept = std::min(count, points_per_segment);
    float total = 0, kept_area = 0;
    for (int i : members[s]) total += area[i];
    SegmentSurface& out = surface[s];
    for (int k = 0; k < kept; ++k) {
      // Vertices are in grid order, so equal steps through them are spread evenly over the surface.
      const int i = members[s][static_cast<std::size_t>(k) * count / kept];
      const SkinVertex& v = skin.vertices[i];
      out.x.push_back(v.in_a.x()), out.y.push_back(v.in_a.y()), out.z.push_back(v.in_a.z());
      out.nx.push_back(v.normal_in_a.x()), out.ny.push_back(v.normal_in_a.y()), out.nz.push_back(v.normal_in_a.z());
      out.area.push_back(area[i]);
      kept_area += area[i];
    }

    // Scale the areas so that the kept points represent the whole surface.
    for (float& a : out.area) a *= total / kept_area;
  }
  return surface;
}

}  // namespace barehand
