#include "hand/implicit_hand.h"

#include "math/random.h"
#include "support/adult_hand.h"

namespace barehand {
namespace {

TEST(ImplicitHand, LeftHandMirrorsTheRightOne) {
  const std::shared_ptr<const HandProfile> profile = test::adult_hand();
  const ImplicitHand right(*profile), left(mirrored(*profile));
  KeyedRandom random(1, 1);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p(random.uniform(-0.06, 0.06), random.uniform(-0.04, 0.03), random.uniform(-0.18, 0.01));
    EXPECT_NEAR(left.distance({-p.x(), p.y(), p.z()}), right.distance(p), 1e-9) << p.transpose();
  }
}

TEST(ImplicitHand, FleshFillsTheSpaceBetweenThumbAndIndexFinger) {
  const std::shared_ptr<const HandProfile> profile = test::adult_hand();
  const ImplicitHand hand(*profile);
  const SE3 &thumb = hand.pose()[segment_of(0, 0)], &index = hand.pose()[segment_of(1, 0)];
  const Eigen::Vector3d on_thumb = thumb * (0.6 * profile->segments[segment_of(0, 0)].distal);
  const Eigen::Vector3d on_palm = hand.pose()[kPalm].t + 0.6 * (index.t - hand.pose()[kPalm].t);
  EXPECT_LT(hand.distance(0.5 * (on_thumb + on_palm)), -0.003);
}

}  // namespace
}  // namespace barehand
