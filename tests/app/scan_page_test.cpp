#include "app/calibrate/scan_page.h"

#include <gmock/gmock.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

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

/// A page of a scan that has just begun, and a client that looks at it.
class ShownScanPage : public testing::Test {
 protected:
  void SetUp() override {
    auto server = ViewServer::start({{"127.0.0.1", 0}, {}, {}, nullptr}, clock_);
    ASSERT_TRUE(server) << server.error().message();
    server_ = std::move(*server);
    client_.emplace(test::port_of(server_->url()));
    client_->send("?");
    ASSERT_TRUE(client_->text());
    state_.scan = view_scan("", {}, *start_, *start_);
  }

  const std::shared_ptr<const HandProfile> start_ = test::adult_hand();
  const SystemClock clock_;
  std::unique_ptr<ViewServer> server_;
  std::optional<test::SocketClient> client_;
  ViewState state_;
};

TEST_F(ShownScanPage, TellsTheEndToWhoeverLooks) {
  HandProfile longer = *start_;
  longer.segments[kPalm].length += 0.01;
  state_.T_world_camera = SE3{};
  ScanPage(server_.get(), state_).done("Saved.", &longer);
  server_.reset();
  const auto status = nlohmann::json::parse(client_->text().value());
  EXPECT_EQ(status["scan"]["phase"], "done");
  EXPECT_EQ(status["scan"]["progress"], "Saved.");
  EXPECT_NEAR(status["scan"]["segments"][0]["after"].get<double>(), longer.segments[kPalm].length, 1e-9);
  EXPECT_FALSE(status["T_world_camera"].is_null()) << "the room stays";
}

TEST_F(ShownScanPage, GoesOnSayingTheStateWhileNothingNewHappens) {
  ScanPage page(server_.get(), state_);
  page.measuring("Measuring.");
  for (int i = 0; i < 3; ++i) {
    const auto text = client_->text();
    ASSERT_TRUE(text) << i;
    EXPECT_EQ(nlohmann::json::parse(*text)["scan"]["progress"], "Measuring.");
  }
}

}  // namespace
}  // namespace barehand
