#include "hand/gaussian_tree.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "math/random.h"

namespace barehand {
namespace {

constexpr int kUnknowns = 6 * kSegmentCount;
using Dense = Eigen::Matrix<double, kUnknowns, kUnknowns>;

/// A positive definite tree of random residuals.
GaussianTree random_tree(std::uint32_t key) {
  KeyedRandom random(1, key);
  const auto block = [&] { return Matrix6d::NullaryExpr([&] { return random.uniform(-1, 1); }); };
  GaussianTree tree;
  tree.set_zero();
  for (int s = 0; s < kSegmentCount; ++s) {
    tree.H_self[s] += Matrix6d::Identity() * 0.1;
    tree.g[s] = Vector6d::NullaryExpr([&] { return random.uniform(-1, 1); });
    if (s == kPalm) continue;

    const Matrix6d a = block(), b = block();  // a random residual between segment and parent
    tree.H_self[s] += a.transpose() * a;
    tree.H_self[parent_of(s)] += b.transpose() * b;
    tree.H_parent[s] += a.transpose() * b;
  }
  return tree;
}

Dense dense(const GaussianTree& tree) {
  Dense H = Dense::Zero();
  for (int s = 0; s < kSegmentCount; ++s) {
    H.block<6, 6>(6 * s, 6 * s) = tree.H_self[s];
    if (s == kPalm) continue;
    H.block<6, 6>(6 * s, 6 * parent_of(s)) = tree.H_parent[s];
    H.block<6, 6>(6 * parent_of(s), 6 * s) = tree.H_parent[s].transpose();
  }
  return H;
}

TEST(GaussianTree, SolvesLikeADenseFactorisation) {
  for (std::uint32_t key = 0; key < 5; ++key) {
    const GaussianTree tree = random_tree(key);
    Eigen::Matrix<double, kUnknowns, 1> g;
    for (int s = 0; s < kSegmentCount; ++s) g.segment<6>(6 * s) = tree.g[s];
    const Eigen::Matrix<double, kUnknowns, 1> expected = dense(tree).ldlt().solve(g);
    std::array<Vector6d, kSegmentCount> x;
    ASSERT_TRUE(tree.solve(x));
    for (int s = 0; s < kSegmentCount; ++s) EXPECT_LT((x[s] - expected.segment<6>(6 * s)).norm(), 1e-9) << s;
  }
}

TEST(GaussianTree, MarginalsAreTheDiagonalBlocksOfTheInverse) {
  const GaussianTree tree = random_tree(7);
  const Dense inverse = dense(tree).inverse();
  std::array<Matrix6d, kSegmentCount> covariance;
  ASSERT_TRUE(tree.marginals(covariance));
  for (int s = 0; s < kSegmentCount; ++s)
    EXPECT_LT((covariance[s] - inverse.block<6, 6>(6 * s, 6 * s)).norm(), 1e-9 * inverse.norm()) << s;
}

TEST(GaussianTree, RefusesAnIndefiniteSystemAndLeavesTheResultAlone) {
  GaussianTree tree = random_tree(3);
  tree.H_self[5].diagonal().array() -= 100;
  std::array<Vector6d, kSegmentCount> x;
  x.fill(Vector6d::Constant(42));
  EXPECT_FALSE(tree.solve(x));
  EXPECT_EQ(x[5], Vector6d::Constant(42));
}

}  // namespace
}  // namespace barehand
