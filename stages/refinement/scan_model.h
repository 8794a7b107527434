#pragma once

#include <array>
#include <vector>

#include "hand/hand_pose.h"
#include "hand/skin.h"

namespace barehand {

/// A hand while it is scanned: a skin that may take any shape, on segments whose joints may lie anywhere within them.
/// A segment's frame is fixed to its skin, so where a joint lies is two points, one on either bone.
struct ScanModel {
  HandProfile profile;  ///< what the scan started from: frames, rest rotations and limits
  Skin skin;            ///< every vertex is bound to two segments, with a share of 0 to 1 for the second
  std::vector<Eigen::Vector3f> normal_in_b;                            ///< of every vertex, as normal_in_a
  std::array<Eigen::Vector3d, kSegmentCount> in_parent{}, in_segment;  ///< joint of every segment but the palm [m]
};
/// `cell` [m]: size of the skin's triangles.
ScanModel make_scan_model(const HandProfile& profile, double cell);

/// Unknowns that all frames of a scan share, in this order: both points of every joint, how far each vertex stands out
/// along its normal, and the second segment's share of each vertex that may change it.
class ScanVariables {
 public:
  static constexpr int kJoints = 6 * (kSegmentCount - 1);

  explicit ScanVariables(const ScanModel& model);
  int count() const { return kJoints + vertices_ + shares_; }
  int joint(int segment) const { return 6 * (segment - 1); }  ///< in_parent, then in_segment
  int offset(int vertex) const { return kJoints + vertex; }
  /// -1: a vertex in the middle of a bone follows this bone alone.
  int share(int vertex) const { return share_[vertex]; }
  /// Adds a step to the model.
  void apply(const Eigen::VectorXd& step, ScanModel& model) const;

 private:
  int vertices_, shares_ = 0;
  std::vector<int> share_;
};

/// The scanned hand, which began as `start`, as a profile that carries its skin: segment frames moved to the joints,
/// the ends of fingertips to one radius before the end of their skin.
HandProfile scanned_profile(const ScanModel& start, const ScanModel& model);

}  // namespace barehand
