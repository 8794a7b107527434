#include "stages/refinement/residual_moments.h"

namespace barehand {

void ResidualMoments::add_to(GaussianTree& tree) const {
  for (int s = 0; s < kSegmentCount; ++s) {
    tree.H_self[s] += self_[s].topRows<6>().cast<double>();
    tree.H_parent[s] += parent_[s].topRows<6>().cast<double>();
    tree.g[s] -= gradient_[s].head<6>().cast<double>();
  }
}

}  // namespace barehand
