#include "io/web/view_status.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace barehand {
namespace {

using nlohmann::json;

TEST(ViewStatus, TellsTheRoomRowByRow) {
  ViewState state;
  EXPECT_TRUE(json::parse(status_json(state))["T_world_camera"].is_null()) << "not known";
  state.T_world_camera = SE3{exp_so3({-M_PI / 2, 0, 0}), {1, 2, 3}};
  const auto numbers = json::parse(status_json(state))["T_world_camera"].get<std::vector<double>>();
  const std::vector<double> expected = {1, 0, 0, 1, 0, 0, 1, 2, 0, -1, 0, 3, 0, 0, 0, 1};
  ASSERT_EQ(numbers.size(), 16u);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(numbers[i], expected[i], 1e-12) << i;
}

}  // namespace
}  // namespace barehand
