#include "object/known_object.h"

#include <gtest/gtest.h>

#include "math/angles.h"
#include "support/solid_meshes.h"

namespace barehand {
namespace {

bool is_half(const SE3& turn) { return log_so3(turn.R).norm() > 179.9 * kDegree; }

TEST(KnownObjects, TurnsAreThoseAboutAnAxisThatIsRoundButForAPart) {
  // A ball with a knob is round about the axis through both, and but for the knob about the two others.
  ObjectMesh knobbed = test::ball_mesh(0.04f);
  test::add(knobbed, test::ball_mesh(0.012f), {0.05f, 0, 0});
  const KnownObjectPtr object = make_known_object(knobbed, 1);
  ASSERT_EQ(object->turns.size(), 2u * 11u + 1u);
  for (const SE3& turn : object->turns) {
    const Eigen::Vector3d turned = log_so3(turn.R);
    if (std::abs(turned.normalized().x()) > 0.9)
      EXPECT_TRUE(is_half(turn));
    else
      EXPECT_LT(std::abs(turned.normalized().x()), 1e-3);
    EXPECT_NEAR(std::fmod(turned.norm() + 1e-6, 30 * kDegree), 0, 1e-3);
  }

  // Nothing changes about a round axis, and too much about one that is not: half turns are enough.
  for (const ObjectMesh& mesh : {test::ball_mesh(0.04f), test::box_mesh({0.12f, 0.05f, 0.02f})}) {
    const std::vector<SE3> turns = make_known_object(mesh, 1)->turns;
    EXPECT_EQ(turns.size(), 3u);
    EXPECT_TRUE(std::ranges::all_of(turns, is_half));
  }
}

}  // namespace
}  // namespace barehand
