#pragma once

#include <array>
#include <vector>

#include "hand/gaussian_tree.h"
#include "hand/hand_pose.h"

namespace barehand {

/// What keeps fingers and palm from passing through one another: a round rod within the skin of every phalanx and of
/// every finger's part of the palm. Rods of different fingers may touch, not overlap; what the web joins is left out.
class HandContact {
 public:
  explicit HandContact(const HandProfile& profile);

  /// Overlaps as least squares with the standard deviation `sigma` [m]; returns the energy. Two segments of different
  /// fingers have no block in the tree: each is moved as if the other stayed, with twice the information, which bounds
  /// the energy from above (|a - b|^2 <= 2 |a|^2 + 2 |b|^2), so that both together do not overshoot.
  double add_terms(const HandPose& pose, double sigma, GaussianTree& tree) const;
  /// The deepest overlap [m]; 0 if there is none.
  double deepest(const HandPose& pose) const;

 private:
  struct Rod {
    int segment = 0;
    std::array<Eigen::Vector3d, 2> ends;  // of its axis, in the segment frame [m]
    double radius = 0;                    // [m]
  };
  /// Calls `use(a, b, p_a, p_b, overlap)` for every two rods that overlap: the closest points of their axes in the
  /// camera frame.
  template <class Use>
  void for_each_overlap(const HandPose& pose, const Use& use) const;

  std::vector<Rod> rods_;
  std::vector<std::array<int, 2>> pairs_;  // of rods_
};

}  // namespace barehand
