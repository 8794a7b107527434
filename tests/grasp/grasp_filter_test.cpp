#include "stages/grasp/grasp_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace barehand {
namespace {

constexpr double kMemory = 0.3, kFrame = 1.0 / 30;
constexpr int kWrap = 1, kPinch = 12;

/// What a frame says: this class with probability 0.8, the others share the rest.
std::array<double, kGraspCount> frame_of(int grasp) {
  std::array<double, kGraspCount> out;
  out.fill(std::log(0.2 / (kGraspCount - 1)));
  out[static_cast<std::size_t>(grasp)] = std::log(0.8);
  return out;
}

/// Frames until the filter states this class.
int frames_until(GraspFilter& filter, int grasp) {
  for (int n = 1; n < 1000; ++n) {
    filter.add(frame_of(grasp), kFrame);
    if (filter.grasp() == grasp) return n;
  }
  return 1000;
}

/// A filter that has seen this class for two seconds.
GraspFilter filter_after(int grasp) {
  GraspFilter filter(kMemory);
  for (int n = 0; n < 60; ++n) filter.add(frame_of(grasp), kFrame);
  return filter;
}

TEST(GraspFilter, ProbabilitiesSumToOne) {
  GraspFilter filter(kMemory);
  for (const int grasp : {kWrap, kPinch, 0, kWrap}) {
    const GraspProbabilities& p = filter.add(frame_of(grasp), kFrame);
    EXPECT_NEAR(std::accumulate(p.begin(), p.end(), 0.0), 1, 1e-9);
  }
}

TEST(GraspFilter, AGraspThatLastsIsAsSureAsItsFrames) {
  GraspFilter filter = filter_after(kPinch);
  EXPECT_NEAR(filter.add(frame_of(kPinch), kFrame)[kPinch], 0.8, 1e-6);
}

TEST(GraspFilter, StatesAGraspSoonAndItsEnd) {
  GraspFilter filter = filter_after(0);
  EXPECT_EQ(filter.grasp(), 0);
  EXPECT_LE(frames_until(filter, kPinch), 10);
  EXPECT_LE(frames_until(filter, 0), 10);
}

TEST(GraspFilter, FewFramesOfAnotherClassChangeNothing) {
  GraspFilter filter = filter_after(kPinch);
  for (int n = 0; n < 30; ++n) {
    filter.add(frame_of(n % 5 == 0 ? kWrap : kPinch), kFrame);
    EXPECT_EQ(filter.grasp(), kPinch) << n;
  }
  EXPECT_LE(frames_until(filter, kWrap), 10) << "it is not stuck";
}

TEST(GraspFilter, EquallyProbableClassesDoNotTakeTurns) {
  GraspFilter filter = filter_after(kPinch);
  int changes = 0;
  for (int n = 0, last = filter.grasp(); n < 100; ++n) {
    filter.add(frame_of(n % 2 == 0 ? kWrap : kPinch), kFrame);
    changes += filter.grasp() != last;
    last = filter.grasp();
  }
  EXPECT_LE(changes, 1);
}

TEST(GraspFilter, SimilarGraspsTogetherAreAGrasp) {
  std::array<double, kGraspCount> either;
  either.fill(std::log(0.1 / 15));
  either[0] = std::log(0.32);
  either[kWrap] = std::log(0.3);
  either[kPinch] = std::log(0.28);
  GraspFilter filter = filter_after(0);
  for (int n = 0; n < 60; ++n) filter.add(either, kFrame);
  EXPECT_EQ(filter.grasp(), kWrap);
}

TEST(GraspFilter, AGraspBeginsEarlierThanItEnds) {
  const auto none_with = [](double probability) {
    std::array<double, kGraspCount> out;
    out.fill(std::log(0.01 / 16));
    out[0] = std::log(probability);
    out[kPinch] = std::log(0.99 - probability);
    return out;
  };
  GraspFilter filter = filter_after(0);
  for (int n = 0; n < 60; ++n) filter.add(none_with(0.52), kFrame);
  EXPECT_EQ(filter.grasp(), 0);
  for (int n = 0; n < 60; ++n) filter.add(none_with(0.47), kFrame);
  EXPECT_EQ(filter.grasp(), kPinch);
  for (int n = 0; n < 60; ++n) filter.add(none_with(0.55), kFrame);
  EXPECT_EQ(filter.grasp(), kPinch);
  for (int n = 0; n < 60; ++n) filter.add(none_with(0.65), kFrame);
  EXPECT_EQ(filter.grasp(), 0);
}

TEST(GraspFilter, FramesThatComeTwiceAsOftenCountHalfAsMuch) {
  GraspFilter slow = filter_after(0), fast = filter_after(0);
  double of_slow = 0, of_fast = 0;
  for (int n = 0; n < 5; ++n) {
    of_slow = slow.add(frame_of(kPinch), kFrame)[kPinch];
    for (int k = 0; k < 2; ++k) of_fast = fast.add(frame_of(kPinch), kFrame / 2)[kPinch];
  }
  EXPECT_NEAR(of_slow, of_fast, 1e-9);
}

TEST(GraspFilter, ForgetsWhatWas) {
  GraspFilter filter = filter_after(kPinch);
  filter.reset();
  EXPECT_EQ(filter.grasp(), 0);
  EXPECT_NEAR(filter.add(frame_of(kWrap), kFrame)[kPinch], 0.2 / 17, 1e-9);
}

}  // namespace
}  // namespace barehand
