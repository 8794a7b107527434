#include "sensor/camera_placement.h"

#include <gmock/gmock.h>

#include <limits>

namespace barehand {
namespace {

using ::testing::HasSubstr;

const double kRoot = std::sqrt(0.5);

/// Position and orientation of a camera 1.2 m above the floor that looks along the world's y axis: its x axis is the
/// world's x axis, its y axis (down) is -z.
const std::vector<double> kLevel = {0.5, -2, 1.2, -kRoot, 0, 0, kRoot};
const std::vector<double> kLevelMatrix = {1, 0, 0, 0.5, 0, 0, 1, -2, 0, -1, 0, 1.2, 0, 0, 0, 1};

TEST(CameraPlacement, IsNotKnownByDefault) {
  const auto world = world_from({});
  ASSERT_TRUE(world) << world.error().message();
  EXPECT_FALSE(*world);
  EXPECT_FALSE(world_from({{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}).value());
}

TEST(CameraPlacement, IsAPositionAndAQuaternionOrAMatrix) {
  for (const auto& numbers : {kLevel, kLevelMatrix}) {
    const auto world = world_from({numbers});
    ASSERT_TRUE(world) << world.error().message();
    ASSERT_TRUE(*world);
    const Eigen::Vector3d ahead = **world * Eigen::Vector3d(0.1, 0.2, 3);
    EXPECT_LT((ahead - Eigen::Vector3d(0.6, 1, 1)).norm(), 1e-12) << ahead.transpose();
  }
}

TEST(CameraPlacement, TheExamplesOfTheDocumentationAgree) {
  const auto a = world_from({{0, -0.6, 0.35, -0.8192, 0, 0, 0.5736}});
  const auto b = world_from({{1, 0, 0, 0, 0, -0.3420, 0.9397, -0.6, 0, -0.9397, -0.3420, 0.35, 0, 0, 0, 1}});
  ASSERT_TRUE(a && *a && b && *b);
  EXPECT_LT(((*a)->matrix() - (*b)->matrix()).norm(), 1e-3);
}

TEST(CameraPlacement, RoundedNumbersMakeAnExactRotation) {
  const auto world = world_from({{0, 0, 0, -0.7071, 0, 0, 0.7071}});
  ASSERT_TRUE(world && *world);
  EXPECT_TRUE(((*world)->R * (*world)->R.transpose()).isIdentity(1e-14));
}

/// `numbers` with the one at `position` replaced.
std::vector<double> with(std::vector<double> numbers, std::size_t position, double value) {
  numbers.at(position) = value;
  return numbers;
}

TEST(CameraPlacement, RefusesWhatIsNoPose) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> mirror = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};
  for (const auto& [numbers, reason] : {std::pair(std::vector<double>{}, "0 numbers are given"),
                                        {{1, 2, 3}, "3 numbers are given"},
                                        {std::vector<double>(12, 0.0), "12 numbers are given"},
                                        {with(kLevel, 0, nan), "not finite"},
                                        {with(kLevel, 6, infinity), "not finite"},
                                        {with(kLevelMatrix, 5, nan), "not finite"},
                                        {with(kLevel, 6, 0), "norm 0.7071 instead of 1"},
                                        {std::vector<double>(7, 0.0), "norm 0 instead of 1"},
                                        {with(kLevelMatrix, 0, 1.01), "length 1"},
                                        {with(kLevelMatrix, 1, 0.01), "right angles"},
                                        {with(kLevelMatrix, 12, 0.5), "last row"},
                                        {with(kLevelMatrix, 15, 2), "last row"},
                                        {mirror, "left-handed"}}) {
    const auto world = world_from({numbers}, "room.yaml: world.T_world_camera");
    ASSERT_FALSE(world) << reason;
    EXPECT_THAT(world.error().message(), HasSubstr(reason));
    EXPECT_THAT(world.error().where, HasSubstr("room.yaml"));
  }
}

}  // namespace
}  // namespace barehand
