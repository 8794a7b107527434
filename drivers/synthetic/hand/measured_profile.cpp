// Measures a hand profile on a simulated hand's mesh.
#include "drivers/synthetic/hand/measured_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/synthetic/hand/joint_ranges.h"
#include "drivers/synthetic/hand/skinning.h"

namespace barehand::synthetic {
namespace {

/// A sample of the skin.
struct SkinSample {
  Eigen::Vector3d point;  ///< point on the skin in the segment's frame [m]
  double area;            ///< weight of the sample [m^2]
};

/// Samples the skin of a segment: ten evenly spread points on each triangle that belongs to it.
std::vector<SkinSample> skin_of(const HandMesh& mesh, int segment) {
  std::vector<SkinSample> samples;
  const SE3 T_segment_hand = mesh.T_hand_joint[joint_of_segment(segment)].inverse();
  for (const Triangle& t : mesh.triangles) {
    if (mesh.segment_of_triangle(t) != segment) continue;
    const Eigen::Vector3d a = mesh.vertices[t[0]].cast<double>(), b = mesh.vertices[t[1]].cast<double>(),
                          c = mesh.vertices[t[2]].cast<double>();
    const double area = 0.5 * (b - a).cross(c - a).norm();
    // Only relative weights matter, so every sample carries the area of its whole triangle.
    constexpr int n = 4;
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        const double u = (i + 1.0 / 3) / n, v = (j + 1.0 / 3) / n;
        samples.push_back({T_segment_hand * Eigen::Vector3d(a + u * (b - a) + v * (c - a)), area});
      }
  }
  return samples;
}

/// Elliptic cross-sections along a bone, interpolated linearly between its ends: centre x, centre y, half width and
/// half thickness at end 0, then at end 1 [m].
using EllipticTaper = Eigen::Matrix<double, 8, 1>;

/// Fits elliptic sections to the skin by Gauss-Newton on the Sampson distance, the first-order distance of a point from
/// an ellipse: ((x / a)^2 + (y / b)^2 - 1) / |gradient|.
EllipticTaper fit_ellipses(const std::vector<SkinSample>& skin, double length, double radius) {
  EllipticTaper fit;
  fit << 0, 0, radius, radius, 0, 0, radius, radius;
  for (int iteration = 0; iteration < 30; ++iteration) {
    Eigen::Matrix<double, 8, 8> A = Eigen::Matrix<double, 8, 8>::Identity() * 1e-12;
    Eigen::Matrix<double, 8, 1> b = Eigen::Matrix<double, 8, 1>::Zero();
    // Add one residual for each sample next to the bone.
    for (const SkinSample& s : skin) {
      const double t = -s.point.z() / length;
      if (t < 0 || t > 1) continue;

      // Compute the section at the sample's position along the bone, and the sample's distance from it.
      const Eigen::Vector4d e = (1 - t) * fit.head<4>() + t * fit.tail<4>();
      const double x = (s.point.x() - e[0]) / e[2], y = (s.point.y() - e[1]) / e[3];
      const double slope = std::max(2 * std::hypot(x / e[2], y / e[3]), 1e-6);
      const double residual = (x * x + y * y - 1) / slope;

      // Compute the derivatives of this distance.
      Eigen::Vector4d g(-x / e[2], -y / e[3], -x * x / e[2], -y * y / e[3]);
      g *= 2 / slope;
      Eigen::Matrix<double, 8, 1> J;
      J << (1 - t) * g, t * g;
      A += s.area * J * J.transpose();
      b -= s.area * residual * J;
    }

    // Take one Gauss-Newton step.
    const Eigen::Matrix<double, 8, 1> step = A.ldlt().solve(b);
    fit += step;
    if (step.norm() < 1e-8) break;
  }
  return fit;
}

/// Fits the palm's sections to the extents of its skin across the bone, measured in slices. The skin has gaps at the
/// thumb and the fingers, through which an ellipse fitted to points would grow.
EllipticTaper fit_extents(const std::vector<SkinSample>& skin, double length) {
  // Measure the slices.
  constexpr int kSlices = 8;
  std::array<Eigen::AlignedBox2d, kSlices> slices;
  for (const SkinSample& s : skin) {
    const double t = -s.point.z() / length;
    if (t >= 0 && t < 1) slices[static_cast<int>(t * kSlices)].extend(s.point.head<2>());
  }

  // Fit lines through their centres and half extents.
  Eigen::Matrix2d A = Eigen::Matrix2d::Identity() * 1e-12;
  Eigen::Matrix<double, 2, 4> b = Eigen::Matrix<double, 2, 4>::Zero();
  for (int i = 0; i < kSlices; ++i) {
    if (slices[i].isEmpty()) continue;
    const double t = (i + 0.5) / kSlices;
    const Eigen::Vector2d w(1 - t, t), half = 0.5 * slices[i].sizes(), centre = slices[i].center();
    A += w * w.transpose();
    b += w * Eigen::RowVector4d(centre.x(), centre.y(), half.x(), half.y());
  }

  const Eigen::Matrix<double, 2, 4> ends = A.ldlt().solve(b);
  EllipticTaper fit;
  fit << ends.row(0).transpose(), ends.row(1).transpose();
  return fit;
}

/// Fits a circular cone frustum around the bone: its radii at both ends, by least squares on the samples' distances
/// from the bone.
std::array<double, 2> fit_round(const std::vector<SkinSample>& skin, double length) {
  Eigen::Matrix2d A = Eigen::Matrix2d::Identity() * 1e-15;
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  for (const SkinSample& s : skin) {
    const double t = -s.point.z() / length;
    if (t < 0 || t > 1) continue;
    const Eigen::Vector2d w(1 - t, t);
    A += s.area * w * w.transpose();
    b += s.area * std::hypot(s.point.x(), s.point.y()) * w;
  }
  const Eigen::Vector2d r = A.ldlt().solve(b);
  return {r[0], r[1]};
}

/// Distance along the bone from its proximal end to the farthest point of the skin [m].
double skin_end(const std::vector<SkinSample>& skin) {
  double end = 0;
  for (const SkinSample& s : skin) end = std::max(end, -s.point.z());
  return end;
}

/// Distal end of a fingertip: on the line to the tip joint, one distal radius before the end of the skin. Radius and
/// length depend on each other, so they are found by iteration.
Eigen::Vector3d tip_centre(const std::vector<SkinSample>& skin, const Eigen::Vector3d& tip_joint) {
  const Eigen::Vector3d along = tip_joint.normalized();
  double length = tip_joint.norm();
  for (int i = 0; i < 20; ++i) length = skin_end(skin) - fit_round(skin, length)[1];
  return length * along;
}

void measure_skin(const HandMesh& mesh, int segment, SegmentProfile& profile) {
  const std::vector<SkinSample> skin = skin_of(mesh, segment);
  if (is_tip(segment)) profile.distal = tip_centre(skin, profile.distal);
  profile.length = profile.distal.norm();
  profile.radius = fit_round(skin, profile.length);
  const EllipticTaper q =
      segment == kPalm ? fit_extents(skin, profile.length) : fit_ellipses(skin, profile.length, profile.radius[1]);
  profile.flesh_offset_x = {q[0], q[4]};
  profile.flesh_offset_y = {q[1], q[5]};
  profile.half_width = {std::abs(q[2]), std::abs(q[6])};
  profile.half_thickness = {std::abs(q[3]), std::abs(q[7])};
}

}  // namespace

HandProfile measure_profile(const HandMesh& mesh) {
  HandProfile profile;
  profile.handedness = mesh.handedness;
  for (int s = 0; s < kSegmentCount; ++s) {
    SegmentProfile& segment = profile.segments[s];
    const int joint = joint_of_segment(s);
    const int next = s == kPalm ? joint_of(2, 1) : joint + 1;
    segment.T_hand_segment = mesh.T_hand_joint[joint];
    segment.distal = segment.T_hand_segment.inverse() * mesh.T_hand_joint[next].t;
    measure_skin(mesh, s, segment);
    segment.dofs = joint_dofs(s, mesh.handedness);
  }
  return profile;
}

}  // namespace barehand::synthetic
