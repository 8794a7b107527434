#pragma once

#include <array>
#include <vector>

#include "hand/gaussian_tree.h"
#include "hand/hand_pose.h"

namespace barehand {

/// Keeps fingers and palm from passing through one another. Every phalanx, and the part of the palm that leads to each
/// finger, carries a capsule within its skin. Capsules of different fingers may touch but
/// not overlap; pairs that overlap in every real hand, such as neighbouring proximal phalanges joined by the web, are
/// left out.
class HandContact {
 public:
  explicit HandContact(const HandProfile& profile);

  /// Adds every overlap as a least-squares residual with the standard deviation `sigma` [m] to `tree`; returns the
  /// energy. The tree has no block for two segments of different fingers, so each of the two is moved as if the other
  /// stayed. The doubled information bounds the energy from above (|a - b|^2 <= 2 |a|^2 + 2 |b|^2) and keeps the two
  /// moves together from overshooting.
  double add_terms(const HandPose& pose, double sigma, GaussianTree& tree) const;
  /// The deepest overlap of two capsules [m]; 0 if none overlap.
  double deepest(const HandPose& pose) const;

 private:
  struct Capsule {
    int segment = 0;
    std::array<Eigen::Vector3d, 2> ends;  // ends of the capsule's axis, in the segment frame [m]
    double radius = 0;                    // radius of the capsule [m]
  };
  /// Calls `use(capsule_a, capsule_b, p_a, p_b, overlap)` for every pair of capsules that overlap. p_a and p_b are the
  /// closest points of the two axes in the camera frame [m]; `overlap` is the depth of the overlap [m].
  template <class Use>
  void for_each_overlap(const HandPose& pose, const Use& use) const;

  std::vector<Capsule> capsules_;
  std::vector<std::array<int, 2>> pairs_;  // indices into capsules_ of the pairs that are tested
};

}  // namespace barehand
