#include "observe/dense/pixel_rays.h"

#include <gtest/gtest.h>

#include "observe/observation.h"

namespace barehand {
namespace {

TEST(PixelRays, GiveTheObservationsOwnPoints) {
  // A region of interest within a larger image.
  auto frame = std::make_shared<RgbdFrame>();
  frame->camera = {640, 480, 525.3, 524.1, 319.7, 238.9};
  HandObservation observation;
  observation.frame = frame;
  observation.u0 = 101;
  observation.v0 = 37;
  observation.depth.reset(213, 97);
  for (std::size_t i = 0; i < observation.depth.size(); ++i)
    observation.depth[i] = 0.3f + 1e-5f * static_cast<float>(i);

  // The tables give exactly the same points as HandObservation::point().
  PixelRays rays;
  rays.reset(frame->camera, observation.u0, observation.v0, 213, 97);
  for (int v = 0; v < 97; ++v)
    for (int u = 0; u < 213; ++u) {
      const auto pixel = static_cast<std::int32_t>(observation.depth.index(u, v));
      ASSERT_EQ(rays.row_of(pixel), v) << pixel;
      ASSERT_EQ(rays.point(u, v, observation.depth.at(u, v)), observation.point(u, v)) << u << "," << v;
      ASSERT_EQ(rays.point(pixel, observation.depth), observation.point(pixel)) << pixel;
    }
}

}  // namespace
}  // namespace barehand
