#pragma once

#include <array>
#include <vector>

#include "hand/hand_pose.h"
#include "hand/skin.h"

namespace barehand {

/// A hand while it is scanned: a skin that may take any shape, on segments whose joints may lie anywhere within them.
/// A segment's frame is fixed to its skin, so where a joint lies is two points, one on either bone, and the axes that
/// it bends about are how these stand to each other at rest.
struct ScanModel {
  HandProfile profile;  ///< what the scan started from: frames and limits
  Skin skin;            ///< every vertex is bound to two segments, with a share of 0 to 1 for the second
  std::vector<Eigen::Vector3f> normal_in_b;                            ///< of every vertex, as normal_in_a
  std::array<Eigen::Vector3d, kSegmentCount> in_parent{}, in_segment;  ///< joint of every segment but the palm [m]
  std::array<Eigen::Matrix3d, kSegmentCount> rest;                     ///< R_parent_segment, likewise
  bool joints_are_known() const { return profile.origin == ProfileOrigin::measured; }
};
/// `cell` [m]: size of the skin's triangles.
ScanModel make_scan_model(const HandProfile& profile, double cell);

/// Unknowns that all frames of a scan share, in this order: of every joint both points and a turn of its rest rotation,
/// how far each vertex stands out along its normal, and each vertex's share of the second segment.
class ScanVariables {
 public:
  static constexpr int kJoint = 9;  ///< in_parent, in_segment, and w of rest exp(w)
  static constexpr int kJoints = kJoint * (kSegmentCount - 1);

  explicit ScanVariables(const ScanModel& model) : vertices_(static_cast<int>(model.skin.vertices.size())) {}
  int count() const { return kJoints + 2 * vertices_; }
  static int joint(int segment) { return kJoint * (segment - 1); }
  int offset(int vertex) const { return kJoints + vertex; }
  int share(int vertex) const { return kJoints + vertices_ + vertex; }
  /// Adds a step to the model.
  void apply(const Eigen::VectorXd& step, ScanModel& model) const;

 private:
  int vertices_;
};

/// The scanned hand, which began as `start`, as a profile that carries its skin: segment frames moved to the joints,
/// the ends of fingertips to one radius before the end of their skin.
HandProfile scanned_profile(const ScanModel& start, const ScanModel& model);

}  // namespace barehand
