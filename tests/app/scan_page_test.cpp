#include "app/calibrate/scan_page.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "support/adult_hand.h"
#include "web/web_client.h"

namespace barehand {
namespace {

using ::testing::SizeIs;

TEST(ScanPage, SaysWhatIsStillToBeShownAndHowTheLengthsChange) {
  // A scan in which the palm side of the palm was seen in some frames.
  const auto start = test::adult_hand();
  HandEstimate estimate;
  estimate.status = TrackStatus::tracking;
  estimate.profile = start;
  const HandPose pose = test::facing_pose(*start, 0.5, 0.1);
  for (int s = 0; s < kSegmentCount; ++s) estimate.segments[s].T_camera_segment = pose[s];
  estimate.segments[kPalm].seen = true;
  ScanReport report;
  for (int i = 0; i < 4; ++i) report.add(estimate);
  HandProfile longer = *start;
  longer.segments[kPalm].length += 0.01;

  const ViewScan scan = view_scan("Open the hand.", report, *start, longer);
  EXPECT_EQ(scan.phase, ViewScan::Phase::showing);
  EXPECT_EQ(scan.how_to, "Open the hand.");
  EXPECT_THAT(scan.missing, SizeIs(3));
  EXPECT_EQ(scan.frames, 4);
  EXPECT_EQ(scan.enough_frames, ScanReport::kEnoughFrames);
  ASSERT_THAT(scan.segments, SizeIs(kSegmentCount));
  EXPECT_EQ(scan.segments[kPalm].name, "palm");
  EXPECT_EQ(scan.segments[kPalm].palm_side, 4);
  EXPECT_EQ(scan.segments[kPalm].back_side, 0);
  EXPECT_FALSE(scan.segments[kPalm].to_bend);
  EXPECT_TRUE(scan.segments[segment_of(1, 0)].to_bend);
  EXPECT_NEAR(scan.segments[kPalm].after - scan.segments[kPalm].before, 0.01, 1e-12);
}

TEST(ScanPage, TellsTheEndToWhoeverLooks) {
  const SystemClock clock;
  auto server = ViewServer::start({{"127.0.0.1", 0}, {}, {}, nullptr}, clock);
  ASSERT_TRUE(server) << server.error().message();
  const std::string url = (*server)->url();
  test::SocketClient client(std::stoi(url.substr(url.rfind(':') + 1)));
  client.send("?");
  ASSERT_TRUE(client.text());

  const auto start = test::adult_hand();
  HandProfile longer = *start;
  longer.segments[kPalm].length += 0.01;
  ViewState state;
  state.T_world_camera = SE3{};
  state.scan = view_scan("", {}, *start, *start);
  ScanPage(server->get(), state).done("Saved.", &longer);
  server->reset();
  const auto status = nlohmann::json::parse(client.text().value());
  EXPECT_EQ(status["scan"]["phase"], "done");
  EXPECT_EQ(status["scan"]["progress"], "Saved.");
  EXPECT_NEAR(status["scan"]["segments"][0]["after"].get<double>(), longer.segments[kPalm].length, 1e-9);
  EXPECT_FALSE(status["T_world_camera"].is_null()) << "the room stays";
}

TEST(ScanPage, GoesOnSayingTheStateWhileNothingNewHappens) {
  const SystemClock clock;
  auto server = ViewServer::start({{"127.0.0.1", 0}, {}, {}, nullptr}, clock);
  ASSERT_TRUE(server) << server.error().message();
  const std::string url = (*server)->url();
  test::SocketClient client(std::stoi(url.substr(url.rfind(':') + 1)));
  client.send("?");
  ASSERT_TRUE(client.text());

  const auto start = test::adult_hand();
  ViewState state;
  state.scan = view_scan("", {}, *start, *start);
  ScanPage page(server->get(), state);
  page.measuring("Measuring.");
  for (int i = 0; i < 3; ++i) {
    const auto text = client.text();
    ASSERT_TRUE(text) << i;
    EXPECT_EQ(nlohmann::json::parse(*text)["scan"]["progress"], "Measuring.");
  }
}

}  // namespace
}  // namespace barehand
