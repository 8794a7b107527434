#include "stages/segment_tracker/self_occlusion.h"

#include <gtest/gtest.h>

#include "support/scene.h"

namespace barehand {
namespace {

constexpr int kTip = segment_of(1, 2), kOther = segment_of(2, 2);

/// The upright segment at 0.4 m; all others are far outside the image.
HandPose one_segment() {
  HandPose pose;
  for (SE3& T : pose) T = {upright_pose().R, {5, 0, 0.4}};
  pose[kTip] = upright_pose();
  return pose;
}

PixelMap labelled(float data_z, PixelLabel label, const HandPose& pose, const std::string& rule) {
  Workers workers(1);
  const HandObservation o = make_observation(small_camera(), [&](int u, int v) {
    return u + v ? ScenePixel{data_z, label} : ScenePixel{data_z, PixelLabel::hand};
  });
  PixelMap map = make_pixel_map(o, false, workers);
  SegmentTrackerParams params;
  params.self_occlusion = rule;
  SelfOcclusion().label(make_cylinder_surface(capsule_profile(), 150), pose, params, map, workers);
  return map;
}

bool hidden_at(const PixelMap& map, int segment, int u, int v) {
  return map.hidden[map.index(u + 1, v + 1)] >> segment & 1;
}

TEST(PredictedPatch, HoldsTheDepthOfTheSkinAndContinuesBeyondIt) {
  Workers workers(1);
  const PixelMap map = make_pixel_map(make_observation(small_camera(),
                                                       [](int, int) {
                                                         return ScenePixel{0.4f, PixelLabel::hand};
                                                       }),
                                      false, workers);

  // The predicted depth at a pixel of the observation.
  PredictedPatch patch;
  patch.predict(make_cylinder_surface(capsule_profile(), 150)[kTip], upright_pose(), map, 0.010);
  const auto depth_at = [&](int u, int v) {
    return patch
        .z[static_cast<std::size_t>((v + 1 - patch.v0) / patch.cell) * patch.columns + (u + 1 - patch.u0) / patch.cell];
  };
  EXPECT_NEAR(depth_at(48, 48), 0.392, 0.0007);       // the front of the skin
  EXPECT_NEAR(depth_at(48 + 18, 48), 0.399, 0.0025);  // 3 mm outside the outline
}

TEST(SelfOcclusion, SkinInFrontByMoreThanTheThresholdHides) {
  // The front of the predicted skin is at 0.392 m.
  EXPECT_TRUE(hidden_at(labelled(0.380f, PixelLabel::hand, one_segment(), "data"), kTip, 48, 48));
  EXPECT_FALSE(hidden_at(labelled(0.384f, PixelLabel::hand, one_segment(), "data"), kTip, 48, 48));
}

TEST(SelfOcclusion, LabelsThePatchAroundTheSegmentOnly) {
  const PixelMap map = labelled(0.370f, PixelLabel::hand, one_segment(), "data");
  EXPECT_TRUE(hidden_at(map, kTip, 48 + 18, 48));   // within the margin
  EXPECT_FALSE(hidden_at(map, kTip, 48 + 40, 48));  // far outside the margin
  EXPECT_FALSE(hidden_at(map, kOther, 48, 48));
}

TEST(SelfOcclusion, ObjectsAndOffAreLeftToTheSamples) {
  EXPECT_FALSE(hidden_at(labelled(0.370f, PixelLabel::object, one_segment(), "data"), kTip, 48, 48));
  EXPECT_FALSE(hidden_at(labelled(0.370f, PixelLabel::hand, one_segment(), "off"), kTip, 48, 48));
}

TEST(SelfOcclusion, ByTheModelFollowsTheOtherSegmentsWhateverTheData) {
  HandPose pose = one_segment();
  pose[kOther] = upright_pose(0.36);
  pose[kOther].t.x() += 0.008;  // covers the right half
  const PixelMap map = labelled(0.392f, PixelLabel::hand, pose, "model");
  EXPECT_TRUE(hidden_at(map, kTip, 48 + 8, 48));
  EXPECT_FALSE(hidden_at(map, kTip, 48 - 8, 48));
  EXPECT_FALSE(hidden_at(map, kOther, 48 + 8, 48));
  EXPECT_FALSE(hidden_at(labelled(0.392f, PixelLabel::hand, pose, "data"), kTip, 48 + 8, 48));
  EXPECT_TRUE(hidden_at(labelled(0.392f, PixelLabel::hand, pose, "both"), kTip, 48 + 8, 48));
}

}  // namespace
}  // namespace barehand
