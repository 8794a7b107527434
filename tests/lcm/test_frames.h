#pragma once

#include <gtest/gtest.h>

#include "math/random.h"
#include "sensor/rgbd_frame.h"

namespace barehand {

/// A small frame with measured and unmeasured pixels, large steps of depth, and colours including black.
inline RgbdFrame test_frame(std::int64_t number, int width = 40, int height = 30) {
  RgbdFrame frame;
  frame.number = number;
  frame.utime = 1'700'000'000'000'000 + number * 33'333;
  frame.sensor = "test";
  frame.camera = {width, height, 50.5, 51.25, 19.5, 14.5};
  frame.depth_unit = 0.0001;

  // Fill the images at random; some pixels have no depth or no colour.
  frame.depth = Image<std::uint16_t>(width, height);
  frame.colour = Image<Rgb>(width, height);
  KeyedRandom random(1, static_cast<std::uint32_t>(number));
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const std::uint32_t bits = random.bits();
    if (bits % 4 != 0) frame.depth[i] = static_cast<std::uint16_t>(bits % 16 == 1 ? 65535 : 7000 + bits % 100);
    if (bits % 5 != 0) frame.colour[i] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i / 2), 90};
  }
  return frame;
}

inline void expect_same_frame(const RgbdFrame& a, const RgbdFrame& b) {
  EXPECT_EQ(a.utime, b.utime);
  EXPECT_EQ(a.number, b.number);
  EXPECT_EQ(a.sensor, b.sensor);
  EXPECT_EQ(a.camera, b.camera);
  EXPECT_EQ(a.depth_unit, b.depth_unit);
  ASSERT_EQ(a.depth.size(), b.depth.size());
  for (std::size_t i = 0; i < a.depth.size(); ++i) ASSERT_EQ(a.depth[i], b.depth[i]) << "depth pixel " << i;
  ASSERT_EQ(a.colour.size(), b.colour.size());
  for (std::size_t i = 0; i < a.colour.size(); ++i) ASSERT_EQ(a.colour[i], b.colour[i]) << "colour pixel " << i;
}

}  // namespace barehand
