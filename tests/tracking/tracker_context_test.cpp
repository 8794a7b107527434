#include "tracking/tracker_context.h"

#include <gtest/gtest.h>

namespace barehand {
namespace {

TEST(TrackerContext, AHandCouplesWithObjectsThatNoOtherHandHolds) {
  Workers workers(1);
  TrackerContext context{.params = {}, .seed = 1, .workers = workers, .log = nullptr, .observer = nullptr};
  context.params.refinement.objects.enabled = true;
  constexpr std::int32_t kMine = 3, kOther = 4;
  const auto couples = [&](std::int32_t moves_with, std::int32_t held_by) {
    NearbyObject object;
    object.hand_id = moves_with;
    object.holder_id = held_by;
    context.couple_with({&object, 1}, kMine);
    return !context.objects.empty();
  };
  EXPECT_TRUE(couples(-1, -1));
  EXPECT_TRUE(couples(-1, kMine));
  EXPECT_TRUE(couples(kMine, kMine));
  EXPECT_FALSE(couples(-1, kOther)) << "held, but at rest";
  EXPECT_FALSE(couples(kOther, kOther));
  EXPECT_FALSE(couples(kOther, -1));

  context.params.refinement.objects.enabled = false;
  EXPECT_FALSE(couples(kMine, kMine));
}

}  // namespace
}  // namespace barehand
