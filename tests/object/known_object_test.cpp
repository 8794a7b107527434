#include "object/known_object.h"

#include <gtest/gtest.h>

#include "math/angles.h"
#include "support/solid_meshes.h"

namespace barehand {
namespace {

TEST(KnownObjects, TurnsAreThoseAboutAnAxisThatIsRoundButForAPart) {
  // A ball with a knob is round about the axis through both, and but for the knob about the two others.
  ObjectMesh knobbed = test::ball_mesh(0.04f);
  test::add(knobbed, test::ball_mesh(0.012f), {0.05f, 0, 0});
  const KnownObjectPtr object = make_known_object(knobbed, 1);
  ASSERT_EQ(object->turns.size(), 2u * 11u);
  for (const SE3& turn : object->turns) {
    const Eigen::Vector3d turned = log_so3(turn.R);
    EXPECT_LT(std::abs(turned.normalized().x()), 1e-3);
    EXPECT_NEAR(std::fmod(turned.norm() + 1e-6, 30 * kDegree), 0, 1e-3);
  }

  // Nothing changes about a round axis, and too much about one that is not.
  EXPECT_TRUE(make_known_object(test::ball_mesh(0.04f), 1)->turns.empty());
  EXPECT_TRUE(make_known_object(test::box_mesh({0.12f, 0.05f, 0.02f}), 1)->turns.empty());
}

}  // namespace
}  // namespace barehand
