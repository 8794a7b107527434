#pragma once

#include <array>
#include <stop_token>
#include <vector>

#include "hand/hand_pose.h"
#include "hand/skin.h"

namespace barehand {

/// A hand while it is scanned: a skin that may take any shape, and segments whose joints may lie anywhere within them.
/// Since a segment's frame is fixed to its skin, a joint is described by two points, one in each of its two segments,
/// and by the rotation between them at rest, which sets the axes about which the joint bends.
struct ScanModel {
  HandProfile profile;  ///< the hand that the scan started from: its frames and limits
  Skin skin;            ///< every vertex is bound to two segments with a weight of 0 to 1 for the second
  std::vector<Eigen::Vector3f> normal_in_b;  ///< outward unit normal of every vertex in the frame of its second segment
  /// Position of the joint of every segment but the palm, in its parent's frame and in its own [m].
  std::array<Eigen::Vector3d, kSegmentCount> in_parent{}, in_segment;
  std::array<Eigen::Matrix3d, kSegmentCount> rest;  ///< R_parent_segment at rest, of every segment but the palm
  /// A measured profile states where the joints lie, so a scan must not move them.
  bool joints_are_known() const { return profile.origin == ProfileOrigin::measured; }
};
/// The model that a scan of the hand `profile` begins with. `cell`: size of the skin's triangles [m]. Its skin is empty
/// if `stop` was requested.
ScanModel make_scan_model(const HandProfile& profile, double cell, const std::stop_token& stop = {});

/// Numbering of the unknowns that all frames of a scan share. First come the joints (both points and a rotation of the
/// rest rotation), then the offset of each vertex along its normal, then each vertex's weight of its second
/// segment.
class ScanVariables {
 public:
  static constexpr int kJoint = 9;  ///< in_parent, in_segment, and the rotation vector w in rest * exp(w)
  static constexpr int kJoints = kJoint * (kSegmentCount - 1);

  explicit ScanVariables(const ScanModel& model) : vertices_(static_cast<int>(model.skin.vertices.size())) {}
  int count() const { return kJoints + 2 * vertices_; }
  /// Index of the first unknown of the joint between `segment` and its parent.
  static int joint(int segment) { return kJoint * (segment - 1); }
  int offset(int vertex) const { return kJoints + vertex; }
  int skin_weight(int vertex) const { return kJoints + vertices_ + vertex; }
  /// Adds a step of all unknowns to the model; changes of the skin are clamped to the range in which the equations
  /// hold.
  void apply(const Eigen::VectorXd& step, ScanModel& model) const;

 private:
  int vertices_;
};

/// Turns a finished scan, which began as `start`, into a profile with a scanned skin. Segment frames move to the
/// joints, and the bone of each fingertip ends one radius before the end of its skin.
HandProfile scanned_profile(const ScanModel& start, const ScanModel& model);

}  // namespace barehand
