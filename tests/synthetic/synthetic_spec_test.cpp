#include "drivers/synthetic/synthetic_spec.h"

#include <gmock/gmock.h>

namespace barehand::synthetic {
namespace {

std::string error_of(const std::string& text) {
  const auto spec = parse_synthetic_spec(text);
  return spec ? "no error" : spec.error().message();
}

TEST(SyntheticSpec, ReadsNameAndKeys) {
  const auto spec = parse_synthetic_spec("grasp_ball,noise=kinect,seed=3,fps=60,hand=left,scale=1.1,live=true");
  ASSERT_TRUE(spec.has_value()) << spec.error().message();
  EXPECT_EQ(spec->simulator.sequence, "grasp_ball");
  EXPECT_EQ(spec->simulator.noise, "kinect");
  EXPECT_EQ(spec->simulator.seed, 3);
  EXPECT_EQ(spec->simulator.fps, 60);
  EXPECT_EQ(spec->simulator.hand, "left");
  EXPECT_EQ(spec->simulator.shape.scale, 1.1);
  EXPECT_TRUE(spec->live);
}

TEST(SyntheticSpec, NameAloneKeepsTheDefaults) {
  const auto spec = parse_synthetic_spec("fist");
  ASSERT_TRUE(spec.has_value());
  EXPECT_EQ(spec->simulator.noise, "none");
  EXPECT_FALSE(spec->live);
}

TEST(SyntheticSpec, WrongInputNamesWhatIsWrong) {
  EXPECT_THAT(error_of("dance"), testing::AllOf(testing::HasSubstr("dance"), testing::HasSubstr("occlusion_3")));
  EXPECT_THAT(error_of(""), testing::HasSubstr("choose one of"));
  EXPECT_THAT(error_of("fist,nose=kinect"), testing::AllOf(testing::HasSubstr("nose"), testing::HasSubstr("noise")));
  EXPECT_THAT(error_of("fist,noise=snow"), testing::HasSubstr("none, kinect, tof"));
  EXPECT_THAT(error_of("fist,seed=3x"), testing::HasSubstr("seed=3x"));
  EXPECT_THAT(error_of("fist,fps=nan"), testing::HasSubstr("fps=nan"));
  EXPECT_THAT(error_of("fist,scale=9"), testing::HasSubstr("0.6 to 1.5"));
  EXPECT_THAT(error_of("fist,live"), testing::HasSubstr("key=value"));
  EXPECT_THAT(error_of("fist,live=yes"), testing::HasSubstr("true or false"));
  EXPECT_THAT(error_of("fist,seed=1,seed=2"), testing::HasSubstr("twice"));
}

TEST(SyntheticSpec, HelpNamesEveryKeyThatIsUnderstood) {
  for (const char* key : {"noise=", "seed=", "frames=", "thickness=", "loop=", "sleeve="})
    EXPECT_THAT(synthetic_spec_help(), testing::HasSubstr(key));
}

}  // namespace
}  // namespace barehand::synthetic
