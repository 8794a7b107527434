#include "math/se3.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace barehand {
namespace {

std::vector<Eigen::Vector3d> hard_rotations() {
  using Eigen::Vector3d;
  const double pi = std::numbers::pi;
  return {Vector3d::Zero(),
          {1e-12, 0, 0},
          {1e-7, -1e-7, 1e-8},
          {0.3, -0.2, 0.7},
          {pi - 1e-7, 0, 0},
          {0, pi * 0.99999, 0},
          Vector3d(1, 1, 1).normalized() * 3.0};
}

TEST(SE3, LogInvertsExp) {
  for (const auto& w : hard_rotations()) EXPECT_LT((log_so3(exp_so3(w)) - w).norm(), 1e-7) << w.transpose();
}

TEST(SE3, ExpIsRotation) {
  for (const auto& w : hard_rotations()) {
    const Eigen::Matrix3d R = exp_so3(w);
    EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(R.determinant(), 1, 1e-12);
  }
}

TEST(SE3, BoxminusInvertsBoxplus) {
  for (const auto& w : hard_rotations()) {
    const SE3 T{exp_so3({0.4, 0.1, -2}), {0.1, -0.2, 0.5}};
    Vector6d twist;
    twist << 0.01, -0.02, 0.03, w;
    EXPECT_LT((boxminus(boxplus(T, twist), T) - twist).norm(), 1e-7);
  }
}

TEST(SE3, ComposesLikeMatrices) {
  const SE3 a{exp_so3({0.4, 0.1, -2}), {0.1, -0.2, 0.5}}, b{exp_so3({-1, 0.6, 0.3}), {1, 2, 3}};
  EXPECT_LT(((a * b).matrix() - a.matrix() * b.matrix()).norm(), 1e-12);
  EXPECT_LT(((a * a.inverse()).matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-12);
}

}  // namespace
}  // namespace barehand
