#include "stages/refinement/hand_contact.h"

#include <algorithm>
#include <cmath>

#include "math/closest_points.h"

namespace barehand {
namespace {

using Eigen::Vector3d;
using Axis = LineSegment;

constexpr double kCarpus = 0.3;        // start of a capsule in the palm, as a fraction of the way from wrist to knuckle
constexpr double kTiny = 1e-12;        // squared lengths below this count as zero [m^2]
constexpr double kPalmFraction = 0.9;  // radius of a capsule in the palm, as a fraction of its finger's

double least_radius(const SegmentProfile& s) {
  return std::min({s.half_width[0], s.half_width[1], s.half_thickness[0], s.half_thickness[1]});
}

// Whether the capsules of two segments overlap in every real hand, and so must not be pushed apart: those of one
// finger, and those of neighbouring fingers' roots, which the web joins.
bool may_overlap_by_nature(int a, int b) {
  const bool roots = a == segment_of(finger_of(a), 0) && b == segment_of(finger_of(b), 0);
  return finger_of(a) == finger_of(b) || (roots && std::abs(finger_of(a) - finger_of(b)) == 1);
}

}  // namespace

HandContact::HandContact(const HandProfile& profile) {
  // Make one capsule per phalanx. The thumb's metacarpal has none, because it lies within the flesh of the palm.
  for (int s = segment_of(0, 1); s < kSegmentCount; ++s) {
    const SegmentProfile& phalanx = profile.segments[s];
    Capsule capsule{s, {Vector3d::Zero(), phalanx.distal}, least_radius(phalanx)};
    for (int end = 0; end < 2; ++end)
      capsule.ends[end] += Vector3d(phalanx.flesh_offset_x[end], phalanx.flesh_offset_y[end], 0);
    capsules_.push_back(capsule);
  }

  // Make one capsule in the palm for each finger but the thumb, from the carpus to the knuckle.
  const int phalanges = static_cast<int>(capsules_.size());
  for (int finger = 1; finger < kFingerCount; ++finger) {
    const int root = segment_of(finger, 0);
    const SegmentProfile& s = profile.segments[root];
    const Vector3d knuckle = profile.rest_relative(root).t;
    capsules_.push_back(
        {kPalm, {kCarpus * knuckle, knuckle}, kPalmFraction * std::min(s.half_width[0], s.half_thickness[0])});
  }

  // List the pairs to test: phalanges against phalanges, and against the palm all phalanges that are not jointed to it.
  const int capsules = static_cast<int>(capsules_.size());
  for (int a = 0; a < phalanges; ++a) {
    const int s = capsules_[a].segment;
    for (int b = a + 1; b < phalanges; ++b)
      if (!may_overlap_by_nature(s, capsules_[b].segment)) pairs_.push_back({a, b});
    if (parent_of(s) != kPalm)
      for (int b = phalanges; b < capsules; ++b) pairs_.push_back({a, b});
  }
}

template <class Use>
void HandContact::for_each_overlap(const HandPose& pose, const Use& use) const {
  constexpr int kMaxCapsules = 2 * kSegmentCount;
  // Transform the axes of all capsules to the camera frame.
  std::array<Axis, kMaxCapsules> axes;
  for (std::size_t i = 0; i < capsules_.size(); ++i)
    for (int end = 0; end < 2; ++end) axes[i][end] = pose[capsules_[i].segment] * capsules_[i].ends[end];

  // Report the pairs whose axes come closer than the sum of their radii.
  for (const auto& [a, b] : pairs_) {
    const auto [p_a, p_b] = closest_points(axes[a], axes[b]);
    const double reach = capsules_[a].radius + capsules_[b].radius;
    if ((p_a - p_b).squaredNorm() < reach * reach)
      use(capsules_[a], capsules_[b], p_a, p_b, reach - (p_a - p_b).norm());
  }
}

double HandContact::add_terms(const HandPose& pose, double sigma, GaussianTree& tree) const {
  const double information = 1 / (sigma * sigma);
  double total = 0;
  for_each_overlap(pose, [&](const Capsule& a, const Capsule& b, const auto& p_a, const auto& p_b, double overlap) {
    total += information * overlap * overlap;

    const Vector3d between = p_a - p_b;
    if (between.squaredNorm() < kTiny) return;  // the axes intersect, so the direction of the push is undefined

    // Push both segments apart along the line between the closest points; the declaration of add_terms() explains the
    // factor 2.
    const Vector3d away = between.normalized();
    const auto push = [&](int s, const Vector3d& p, const Vector3d& direction) {
      const Vector6d row = -(point_jacobian(p - pose[s].t).transpose() * direction);
      tree.H_self[s] += 2 * information * row * row.transpose();
      tree.g[s] -= information * overlap * row;
    };

    push(a.segment, p_a, away);
    push(b.segment, p_b, -away);
  });
  return total;
}

double HandContact::deepest(const HandPose& pose) const {
  double deepest = 0;
  for_each_overlap(pose, [&](const Capsule&, const Capsule&, const Vector3d&, const Vector3d&, double overlap) {
    deepest = std::max(deepest, overlap);
  });
  return deepest;
}

}  // namespace barehand
