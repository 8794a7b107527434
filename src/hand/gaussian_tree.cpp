// Solves the normal equations of a kinematic tree by elimination from the leaves to the root.
#include "hand/gaussian_tree.h"

#include <Eigen/Cholesky>

namespace barehand {
namespace {

// Result of eliminate(): the equations of each segment after its children were eliminated, and the linear dependence of
// each segment on its parent.
struct Elimination {
  std::array<Matrix6d, kSegmentCount> H;
  std::array<Vector6d, kSegmentCount> g;
  std::array<Eigen::LLT<Matrix6d>, kSegmentCount> factor;
  std::array<Matrix6d, kSegmentCount> gain;  // x_s = factor^-1 g - gain x_parent
};

/// Eliminates the segments from the fingertips to the palm. Returns false if H is not positive definite.
bool eliminate(const GaussianTree& tree, Elimination& e) {
  e.H = tree.H_self;
  e.g = tree.g;
  for (int s = kSegmentCount - 1; s >= 0; --s) {  // children have larger indices than their parent
    e.factor[s].compute(e.H[s]);
    if (e.factor[s].info() != Eigen::Success) return false;
    if (s == kPalm) break;
    const int parent = parent_of(s);
    e.gain[s] = e.factor[s].solve(tree.H_parent[s]);
    e.H[parent] -= tree.H_parent[s].transpose() * e.gain[s];
    e.g[parent] -= e.gain[s].transpose() * e.g[s];
  }
  return true;
}

}  // namespace

void GaussianTree::set_zero() {
  for (int s = 0; s < kSegmentCount; ++s) {
    H_self[s].setZero();
    H_parent[s].setZero();
    g[s].setZero();
  }
}

bool GaussianTree::solve(std::array<Vector6d, kSegmentCount>& x) const {
  Elimination e;
  if (!eliminate(*this, e)) return false;
  // Substitute back from the palm to the fingertips.
  std::array<Vector6d, kSegmentCount> result;
  for (int s = 0; s < kSegmentCount; ++s) {
    result[s] = e.factor[s].solve(e.g[s]);
    if (s != kPalm) result[s] -= e.gain[s] * result[parent_of(s)];
    if (!result[s].allFinite()) return false;
  }
  x = result;
  return true;
}

bool GaussianTree::marginals(std::array<Matrix6d, kSegmentCount>& covariance) const {
  Elimination e;
  if (!eliminate(*this, e)) return false;
  // The covariance of a segment is its covariance given its parent plus the covariance that its parent passes on.
  std::array<Matrix6d, kSegmentCount> result;
  for (int s = 0; s < kSegmentCount; ++s) {
    result[s] = e.factor[s].solve(Matrix6d::Identity());
    if (s != kPalm) result[s] += e.gain[s] * result[parent_of(s)] * e.gain[s].transpose();
    result[s] = 0.5 * (result[s] + result[s].transpose()).eval();
    if (!result[s].allFinite()) return false;
  }
  covariance = result;
  return true;
}

}  // namespace barehand
