#include "stages/segment_tracker/sampling.h"

#include <gtest/gtest.h>

namespace barehand {
namespace {

const Vector6d kHalf = (Vector6d() << 0.008, 0.006, 0.004, 0.4, 0.2, 0.1).finished();

std::vector<Kernel> two_kernels() {
  SE3 a, b;
  a.R = exp_so3({0.3, -0.8, 1.1});
  a.t = {0.1, 0.2, 0.5};
  b.t = {-0.1, 0, 0.4};
  return {{a, kHalf}, {b, kHalf}};
}

TEST(DrawSample, FirstOfEachKernelIsItsCentre) {
  const auto kernels = two_kernels();
  EXPECT_EQ(draw_sample(kernels, 4, 0, {1, 2, 3, 6}).t, kernels[0].T_camera_segment.t);
  EXPECT_EQ(draw_sample(kernels, 4, 1, {1, 2, 3, 6}).t, kernels[1].T_camera_segment.t);
  EXPECT_NE(draw_sample(kernels, 4, 2, {1, 2, 3, 6}).t, kernels[0].T_camera_segment.t);
}

TEST(DrawSample, FillsTheKernelsBoxInTheSegmentsOwnAxes) {
  // The extent of many samples in the kernel's frame.
  const auto kernels = two_kernels();
  Vector6d lo = Vector6d::Zero(), hi = Vector6d::Zero();
  for (int i = 2; i < 2000; i += 2) {  // the even ones belong to the first kernel
    const SE3 sample = draw_sample(kernels, 4, i, {1, 2, 3, 6});
    const SE3 inside = kernels[0].T_camera_segment.inverse() * sample;
    Vector6d offset;
    // R = Ry(y) Rz(z) Rx(-x), decomposed as in joint_angles().
    offset << inside.t, std::atan2(inside.R(1, 2), inside.R(1, 1)), std::atan2(-inside.R(2, 0), inside.R(0, 0)),
        std::asin(inside.R(1, 0));
    lo = lo.cwiseMin(offset);
    hi = hi.cwiseMax(offset);
  }

  // The samples stay within the box and fill it.
  for (int k = 0; k < 6; ++k) {
    EXPECT_LE(hi[k], kHalf[k] + 1e-9);
    EXPECT_GE(lo[k], -kHalf[k] - 1e-9);
    EXPECT_GT(hi[k], 0.97 * kHalf[k]);
    EXPECT_LT(lo[k], -0.97 * kHalf[k]);
  }
}

TEST(DrawSample, EqualKeysReproduceAndAnyDifferenceChangesTheDraw) {
  const auto kernels = two_kernels();
  const SampleKey key{1, 2, 3, 6};
  const auto draw = [&](const SampleKey& k, int segment = 4, int index = 8) {
    return draw_sample(kernels, segment, index, k).t;
  };
  EXPECT_EQ(draw(key), draw(key));
  EXPECT_NE(draw(key), draw({2, 2, 3, 6}));
  EXPECT_NE(draw(key), draw({1, 3, 3, 6}));
  EXPECT_NE(draw(key), draw({1, 2, 4, 6}));
  EXPECT_NE(draw(key), draw(key, 5));
  EXPECT_NE(draw(key), draw(key, 4, 10));
}

}  // namespace
}  // namespace barehand
