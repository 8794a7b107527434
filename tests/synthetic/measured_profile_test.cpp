#include "drivers/synthetic/hand/measured_profile.h"

#include "drivers/synthetic/hand/hand_mirror.h"
#include "tests/synthetic/test_hand.h"

namespace barehand::synthetic {
namespace {

/// An independent measurement of cross-sections on the same mesh [mm]: length, and half width and half thickness at
/// both ends.
struct Measured {
  const char* segment;
  double length, width[2], thickness[2];
};
constexpr Measured kMeasured[] = {
    {"palm", 91.7, {31.8, 44.3}, {26.4, 18.6}},           {"thumb_proximal", 33.8, {12.8, 9.1}, {12.1, 7.0}},
    {"thumb_distal", 16.9, {10.6, 8.8}, {8.1, 6.7}},      {"index_proximal", 45.3, {13.0, 7.5}, {13.9, 7.6}},
    {"index_intermediate", 24.3, {8.1, 7.1}, {7.9, 6.7}}, {"index_distal", 15.8, {7.1, 6.4}, {6.5, 5.4}},
    {"middle_proximal", 46.9, {12.7, 7.3}, {13.8, 7.8}},  {"middle_intermediate", 27.6, {8.2, 7.3}, {8.3, 6.8}},
    {"middle_distal", 17.7, {7.5, 6.8}, {6.6, 5.8}},      {"ring_intermediate", 26.6, {7.9, 6.7}, {7.7, 6.4}},
    {"little_proximal", 34.6, {11.3, 6.6}, {11.8, 5.5}},  {"little_distal", 15.7, {6.2, 5.5}, {5.7, 4.9}},
};

class MeasuredProfile : public HandTest {};

TEST_F(MeasuredProfile, AgreesWithAnIndependentMeasurement) {
  const HandProfile profile = measure_profile(right_);
  for (const Measured& expected : kMeasured) {
    const SegmentProfile& s = profile.segments[*segment_from_name(expected.segment)];
    EXPECT_NEAR(1e3 * s.length, expected.length, 1.0) << expected.segment;
    for (int end = 0; end < 2; ++end) {
      EXPECT_NEAR(1e3 * s.half_width[end], expected.width[end], std::max(1.2, 0.08 * expected.width[end]))
          << expected.segment << " width at end " << end;
      EXPECT_NEAR(1e3 * s.half_thickness[end], expected.thickness[end], std::max(1.3, 0.08 * expected.thickness[end]))
          << expected.segment << " thickness at end " << end;
    }
  }
}

TEST_F(MeasuredProfile, EllipsesLieOnTheSkin) {
  const HandProfile profile = measure_profile(right_);
  for (int s = 1; s < kSegmentCount; ++s) {
    const SegmentProfile& p = profile.segments[s];
    double sum = 0;
    int n = 0;
    // Distance of the skin beside the bone from the ellipse there.
    for (std::size_t v = 0; v < right_.vertices.size(); ++v) {
      if (right_.segment_weight(v, s) < 0.9f) continue;
      const Eigen::Vector3d q = p.T_hand_segment.inverse() * right_.vertices[v].cast<double>();
      const double t = -q.z() / p.length;
      if (t < 0 || t > 1) continue;

      const auto at = [&](const std::array<double, 2>& ends) { return (1 - t) * ends[0] + t * ends[1]; };
      const Eigen::Vector2d d(q.x() - at(p.flesh_offset_x), q.y() - at(p.flesh_offset_y));
      const double rho = std::hypot(d.x() / at(p.half_width), d.y() / at(p.half_thickness));
      sum += std::abs(d.norm() * (1 - 1 / rho));
      ++n;
    }
    if (n < 8) continue;
    EXPECT_LT(sum / n, 0.0012) << kSegmentNames[s];
  }
}

TEST_F(MeasuredProfile, TipsEndOneRadiusBeyondTheDistalEnd) {
  const HandProfile profile = measure_profile(right_);
  float farthest = 0;
  for (const auto& v : right_.vertices) farthest = std::max(farthest, v.norm());
  EXPECT_NEAR(profile.hand_length(), farthest, 0.003);
}

TEST_F(MeasuredProfile, IsMirroredForTheMirroredHand) {
  const HandProfile right = measure_profile(right_), left = measure_profile(mirrored(right_));
  EXPECT_EQ(left.handedness, Handedness::left);
  for (int s = 0; s < kSegmentCount; ++s) {
    const SegmentProfile &a = right.segments[s], &b = left.segments[s];
    EXPECT_NEAR(a.length, b.length, 1e-6);
    EXPECT_NEAR(a.half_width[0], b.half_width[0], 1e-6);
    EXPECT_NEAR(a.flesh_offset_x[1], -b.flesh_offset_x[1], 1e-6);
    ASSERT_EQ(a.dofs.size(), b.dofs.size());
    for (std::size_t d = 0; d < a.dofs.size(); ++d) {
      EXPECT_NEAR(a.dofs[d].axis.x(), b.dofs[d].axis.x(), 1e-12);
      EXPECT_NEAR(a.dofs[d].axis.y(), -b.dofs[d].axis.y(), 1e-12);
    }
  }
}

}  // namespace
}  // namespace barehand::synthetic
