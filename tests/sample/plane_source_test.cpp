#include "drivers/sample/plane_source.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace barehand {
namespace {

using std::chrono::milliseconds;

TEST(PlaneSource, DeliversEveryFrameInOrderAndThenEnds) {
  PlaneSource::Options options;
  options.frames = 3;
  const auto source = PlaneSource::open(options);
  ASSERT_TRUE(source.has_value());

  // Frames come in order and are complete.
  std::int64_t last_utime = 0;
  for (std::int64_t i = 0; i < 3; ++i) {
    const SourceEvent event = (*source)->next(milliseconds(0));
    const auto* frame = std::get_if<FramePtr>(&event);
    ASSERT_TRUE(frame);

    EXPECT_EQ((*frame)->number, i);
    EXPECT_GT((*frame)->utime, last_utime);
    EXPECT_TRUE((*frame)->camera.valid());
    EXPECT_EQ((*frame)->depth.width(), (*frame)->camera.width);
    last_utime = (*frame)->utime;
  }
  EXPECT_TRUE(std::holds_alternative<EndOfStream>((*source)->next(milliseconds(0))));
}

TEST(PlaneSource, WallSwingsBetweenItsDistances) {
  PlaneSource::Options options;
  options.frames = 60;
  const auto source = PlaneSource::open(options);
  ASSERT_TRUE(source.has_value());

  // The extreme distances over a whole swing.
  double nearest = 10, farthest = 0;
  for (int i = 0; i < options.frames; ++i) {
    const SourceEvent event = (*source)->next(milliseconds(0));
    const RgbdFrame& frame = **std::get_if<FramePtr>(&event);
    const double z = frame.depth_unit * frame.depth.at(10, 20);
    nearest = std::min(nearest, z);
    farthest = std::max(farthest, z);
  }
  EXPECT_NEAR(nearest, 0.5, 1e-4);
  EXPECT_NEAR(farthest, 1.0, 1e-4);
}

TEST(PlaneSource, RefusesWhatCannotBe) {
  PlaneSource::Options options;
  options.far = 7;
  const auto too_far = PlaneSource::open(options);
  ASSERT_FALSE(too_far.has_value());
  EXPECT_THAT(too_far.error().message(), testing::HasSubstr("6.55"));
  options = {};
  options.frames = 0;
  EXPECT_FALSE(PlaneSource::open(options).has_value());
}

}  // namespace
}  // namespace barehand
