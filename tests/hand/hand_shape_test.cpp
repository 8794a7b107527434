#include "hand/hand_shape.h"

#include "hand/implicit_hand.h"
#include "support/adult_hand.h"

namespace barehand {
namespace {

using Eigen::Vector3d;

int index_of(const std::string& name) {
  for (int k = 0; k < kShapeCount; ++k)
    if (shape_parameters()[k].name == name) return k;
  ADD_FAILURE() << name;
  return 0;
}

class HandShapeTest : public ::testing::Test {
 protected:
  // Mean distance of a skin that moves with its bones from the surface of a hand.
  static double mean_distance(const Skin& skin, const ImplicitHand& hand) {
    double sum = 0;
    for (const SkinVertex& v : skin.vertices) {
      const Vector3d a = hand.pose()[v.a] * v.in_a.cast<double>(), b = hand.pose()[v.b] * v.in_b.cast<double>();
      sum += std::abs(hand.distance(a + v.weight_b * (b - a)));
    }
    return sum / static_cast<double>(skin.vertices.size());
  }

  const std::shared_ptr<const HandProfile> mean_ = test::adult_hand();
  const Skin skin_ = make_blended_skin(*mean_, 0.006);
};

TEST_F(HandShapeTest, ZeroIsTheMeanHand) {
  const HandProfile same = reshaped(*mean_, HandShape::Zero());
  for (int s = 0; s < kSegmentCount; ++s) {
    EXPECT_EQ(same.segments[s].half_width, mean_->segments[s].half_width) << s;
    EXPECT_LT((same.segments[s].T_hand_segment.t - mean_->segments[s].T_hand_segment.t).norm(), 1e-12) << s;
  }
  EXPECT_EQ(mean_->origin, ProfileOrigin::mean);
  EXPECT_EQ(same.origin, ProfileOrigin::fitted);
}

TEST_F(HandShapeTest, SizeEnlargesEverythingAlike) {
  HandShape shape = HandShape::Zero();
  shape[index_of("size")] = std::log(1.1);
  const HandProfile large = reshaped(*mean_, shape);
  EXPECT_NEAR(large.hand_length(), 1.1 * mean_->hand_length(), 1e-9);
  for (int s = 0; s < kSegmentCount; ++s) {
    EXPECT_NEAR(large.segments[s].half_thickness[1], 1.1 * mean_->segments[s].half_thickness[1], 1e-9);
    EXPECT_LT((large.rest_relative(s).t - 1.1 * mean_->rest_relative(s).t).norm(), 1e-9) << s;
  }
}

TEST_F(HandShapeTest, ALongerBoneMovesOnlyWhatHangsOnIt) {
  HandShape shape = HandShape::Zero();
  shape[index_of("index_proximal_length")] = 0.1;
  const HandProfile hand = reshaped(*mean_, shape);
  for (int s = 0; s < kSegmentCount; ++s) {
    const double moved = (hand.segments[s].T_hand_segment.t - mean_->segments[s].T_hand_segment.t).norm();
    const bool beyond = s == segment_of(1, 1) || s == segment_of(1, 2);
    EXPECT_NEAR(moved, beyond ? mean_->segments[segment_of(1, 0)].length * (std::exp(0.1) - 1) : 0.0, 1e-6) << s;
  }
}

TEST_F(HandShapeTest, MorphedSkinLiesOnTheSurfaceOfTheReshapedHand) {
  const ShapeBasis basis = shape_basis(*mean_, HandShape::Zero(), skin_);
  for (const char* name : {"size", "palm_width", "palm_thickness", "middle_length", "ring_distal_length",
                           "fingers_thickness", "knuckle_thickness", "thumb_knuckle_x", "palm_flesh"}) {
    HandShape shape = HandShape::Zero();
    const int k = index_of(name);
    shape[k] = 0.5 * shape_parameters()[k].deviation;
    const ImplicitHand other(reshaped(*mean_, shape));
    const double before = mean_distance(skin_, other), after = mean_distance(morphed(skin_, basis, shape), other);
    EXPECT_LT(after, 0.25 * before) << name;
  }
}

TEST_F(HandShapeTest, JointsOfTheBasisMatchCentralDifferences) {
  const ShapeBasis basis = shape_basis(*mean_, HandShape::Zero(), skin_);
  for (int k = 0; k < kShapeCount; ++k)
    for (int s = 1; s < kSegmentCount; ++s) {
      constexpr double kStep = 1e-4;
      HandShape more = HandShape::Zero(), less = HandShape::Zero();
      more[k] = kStep;
      less[k] = -kStep;
      const Vector3d numeric =
          (reshaped(*mean_, more).rest_relative(s).t - reshaped(*mean_, less).rest_relative(s).t) / (2 * kStep);
      EXPECT_LT((basis.joint[s].col(k) - numeric).norm(), 2e-3 * numeric.norm() + 1e-6)
          << shape_parameters()[k].name << " " << kSegmentNames[s];
    }
}

}  // namespace
}  // namespace barehand
