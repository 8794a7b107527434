#include "hand/profile_warnings.h"

#include <gmock/gmock.h>

#include "math/angles.h"
#include "support/adult_hand.h"

namespace barehand {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ProfileWarnings, PeoplesHandsRaiseNone) {
  for (const double size : {0.6, 0.8, 1.0, 1.2})
    EXPECT_THAT(profile_warnings(scaled(*test::adult_hand(), size)), IsEmpty()) << size;
}

TEST(ProfileWarnings, AHandOfNobodysSizeIsNamedWithItsLength) {
  EXPECT_THAT(profile_warnings(scaled(*test::adult_hand(), 2)), ElementsAre(HasSubstr("the hand is 39")));
  EXPECT_THAT(profile_warnings(scaled(*test::adult_hand(), 0.5)), ElementsAre(HasSubstr("the hand is 9")));
  EXPECT_THAT(profile_warnings(scaled(*test::adult_hand(), 0.0254)), ElementsAre(HasSubstr("in metres?")));
}

TEST(ProfileWarnings, JointsBesideTheirBonesAreNamed) {
  HandProfile profile = *test::adult_hand();
  profile.segments[segment_of(2, 1)].T_hand_segment.t.y() += 0.003;
  EXPECT_THAT(profile_warnings(profile),
              ElementsAre(AllOf(HasSubstr("middle_"), HasSubstr("3.0 mm"), HasSubstr("rounded"))));
}

TEST(ProfileWarnings, LimitsInRadiansLookLikeRadians) {
  HandProfile profile = *test::adult_hand();
  EXPECT_FALSE(limits_look_like_radians(profile));
  for (SegmentProfile& segment : profile.segments)
    for (JointDof& dof : segment.dofs) {
      dof.lower *= kDegree;
      dof.upper *= kDegree;
    }
  EXPECT_TRUE(limits_look_like_radians(profile));
}

}  // namespace
}  // namespace barehand
