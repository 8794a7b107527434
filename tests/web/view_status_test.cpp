#include "io/web/view_status.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace barehand {
namespace {

using nlohmann::json;

TEST(ViewStatus, TellsHowFarAScanIs) {
  ViewState state;
  EXPECT_TRUE(json::parse(status_json(state))["scan"].is_null()) << "no hand is being scanned";
  state.scan =
      ViewScan{ViewScan::Phase::measuring, "Open the hand.", {"show the back of: palm"}, "round 2", 7, 15, 0.5, {}};
  state.scan->segments.push_back({"palm", 3, 4, 0.25, true, 0.09, 0.1});
  const json scan = json::parse(status_json(state))["scan"];
  EXPECT_EQ(scan,
            json::parse(R"({"phase": "measuring", "how_to": "Open the hand.", "missing": ["show the back of: palm"],
    "progress": "round 2", "frames": 7, "enough_frames": 15, "enough_bending": 0.5, "segments": [{"name": "palm",
    "palm_side": 3, "back_side": 4, "bent": 0.25, "to_bend": true, "before": 0.09, "after": 0.1}]})"));
}

TEST(ViewStatus, TellsWhoseSkinIsDrawn) {
  ViewState state;
  EXPECT_TRUE(json::parse(status_json(state))["drawn"].is_null()) << "that of the tracked hand";
  state.drawn = {"", "anna.json"};
  EXPECT_EQ(json::parse(status_json(state))["drawn"], json({"", "anna.json"}));
}

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
