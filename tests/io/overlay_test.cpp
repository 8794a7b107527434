#include "io/overlay/overlay.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "hand/joint_angles.h"
#include "io/overlay/overlay_drawing.h"
#include "io/recording/image_file.h"
#include "read_video.h"
#include "support/resource_limit.h"
#include "support/small_hand.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

RgbdFrame grey_frame(int width = 320, std::int64_t number = 7) {
  RgbdFrame frame;
  frame.number = number;
  const double f = width * 0.75;
  frame.camera = {width, width * 3 / 4, f, f, width * 0.5, width * 0.375};
  frame.depth.reset(width, width * 3 / 4, 400);
  frame.colour.reset(width, width * 3 / 4, Rgb{100, 100, 100});
  return frame;
}

/// Open hand upright in front of the camera, its back towards it.
HandEstimate open_hand(double confidence = 1) {
  HandEstimate estimate;
  estimate.status = TrackStatus::tracking;
  estimate.profile = std::make_shared<HandProfile>(test::small_hand());
  SE3 palm{exp_so3({-M_PI / 2, 0, 0}), {0, 0.08, 0.4}};  // fingers along -y of the camera, its back along -z
  const HandPose pose = forward_kinematics(*estimate.profile, palm, {});
  for (int s = 0; s < kSegmentCount; ++s) {
    SegmentState& state = estimate.segments[s];
    state.T_camera_segment = pose[s];
    state.confidence = confidence;
    state.seen = true;
  }
  return estimate;
}

HandEstimates shared(const HandEstimate& estimate) { return {std::make_shared<HandEstimate>(estimate)}; }

const Skin& skin() {
  static const Skin kSkin = make_skin(test::small_hand(), 0.004);
  return kSkin;
}

Image<Rgb> draw(const HandEstimate& estimate, const RgbdFrame& frame = grey_frame(),
                SegmentNames names = SegmentNames::left_out) {
  const DrawnHand hand{estimate, skin()};
  return draw_overlay(frame, 0, {&hand, 1}, {}, names);
}

/// A frame whose depth is `counts` [mm] everywhere.
RgbdFrame frame_with_depth(std::uint16_t counts) {
  RgbdFrame frame = grey_frame();
  frame.depth.reset(frame.depth.width(), frame.depth.height(), counts);
  return frame;
}

/// The pixel of the left image at the projection of a point in the camera frame [m].
Rgb pixel_at(const Image<Rgb>& sheet, const Eigen::Vector3d& p) {
  const Eigen::Vector2d pixel = grey_frame().camera.project(p) * 2;
  return sheet.at(static_cast<int>(pixel.x() + 0.5), static_cast<int>(pixel.y() + 0.5));
}

Eigen::Vector3d middle_tip(const HandEstimate& e) {
  const int s = segment_of(2, 2);
  return e.segments[s].T_camera_segment * e.profile->segments[s].distal;
}

TEST(Overlay, SmallFramesAreEnlargedAndPicturesStandSideBySide) {
  const Image<Rgb> sheet = draw(open_hand());
  EXPECT_EQ(sheet.width(), 2 * 640);
  EXPECT_EQ(sheet.height(), 480 + kCaptionHeight);
  EXPECT_EQ(overlay_scale(grey_frame(640).camera), 1);
}

TEST(Overlay, DistalEndsAreBlueDotsAndHollowWhereInferred) {
  HandEstimate estimate = open_hand();
  const Rgb seen = pixel_at(draw(estimate), middle_tip(estimate));
  EXPECT_GT(seen.b, 200);
  EXPECT_LT(seen.r, 90);
  estimate.segments[segment_of(2, 2)].seen = false;
  const Rgb inferred = pixel_at(draw(estimate), middle_tip(estimate));
  EXPECT_LT(inferred.b, 200);
}

/// A point within the skin of the middle finger (green), beside its bone.
Eigen::Vector3d beside_middle_bone(const HandEstimate& estimate) {
  return estimate.segments[segment_of(2, 0)].T_camera_segment * Eigen::Vector3d(0.004, 0, -0.015);
}

int greenness(const Rgb& p) { return p.g - p.r; }

TEST(Overlay, SkinIsTheGreenerTheHigherTheConfidence) {
  const auto green_at = [](double confidence) {
    const HandEstimate estimate = open_hand(confidence);
    return greenness(pixel_at(draw(estimate), beside_middle_bone(estimate)));
  };
  EXPECT_GT(green_at(1.0), green_at(0.5) + 10);
  EXPECT_GT(green_at(0.5), green_at(0.0) + 10);
}

TEST(Overlay, SkinBehindTheMeasuredSurfaceIsFainter) {
  const HandEstimate estimate = open_hand();
  const auto green_at = [&](std::uint16_t depth) {
    return greenness(pixel_at(draw(estimate, frame_with_depth(depth)), beside_middle_bone(estimate)));
  };
  const int on_the_skin = green_at(400), unknown = green_at(0), hidden = green_at(300);
  EXPECT_EQ(unknown, on_the_skin);
  EXPECT_LT(hidden, on_the_skin / 2);
  EXPECT_GT(hidden, 5);
}

TEST(Overlay, TheSkinOfTheNearerFingerHidesThatOfTheOther) {
  // Move the ring finger (blue) in front of the middle finger (green) or behind it.
  const auto colour_with_ring_at = [](double dz) {
    HandEstimate estimate = open_hand();
    const Eigen::Vector3d point = beside_middle_bone(estimate);
    for (int k = 0; k < 3; ++k) {
      SE3& ring = estimate.segments[segment_of(3, k)].T_camera_segment;
      ring = estimate.segments[segment_of(2, k)].T_camera_segment;
      ring.t.z() += dz;
    }
    return pixel_at(draw(estimate), point);
  };
  const Rgb in_front = colour_with_ring_at(-0.03), behind = colour_with_ring_at(0.03);
  EXPECT_GT(in_front.b, in_front.g);
  EXPECT_GT(behind.g, behind.b);
}

TEST(Overlay, InferredSegmentsAreHatched) {
  // The mean difference of neighbouring pixels in a part of the skin of one segment.
  const auto contrast = [](bool seen) {
    HandEstimate estimate = open_hand();
    estimate.segments[segment_of(2, 0)].seen = seen;
    const Image<Rgb> sheet = draw(estimate);
    const Eigen::Vector2d pixel = grey_frame().camera.project(beside_middle_bone(estimate)) * 2;
    int lowest = 255, highest = -255;
    for (int dv = -6; dv <= 6; ++dv) {
      const int green = greenness(sheet.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()) + dv));
      lowest = std::min(lowest, green);
      highest = std::max(highest, green);
    }
    return highest - lowest;
  };
  EXPECT_GT(contrast(false), contrast(true) + 30);
}

TEST(Overlay, NamesAppearOnlyOnRequestAndOverTheColourImage) {
  const HandEstimate estimate = open_hand();
  const Image<Rgb> without = draw(estimate), with = draw(estimate, grey_frame(), SegmentNames::drawn);
  int on_colour = 0, on_depth = 0;
  for (int v = 0; v < with.height(); ++v)
    for (int u = 0; u < with.width(); ++u)
      if (with.at(u, v) != without.at(u, v)) ++(u < with.width() / 2 ? on_colour : on_depth);
  EXPECT_GT(on_colour, 16 * 100);  // each name takes some hundred pixels
  EXPECT_EQ(on_depth, 0);
}

TEST(Overlay, NothingIsDrawnWithoutAPoseAndAHandBehindTheCameraDoesNoHarm) {
  HandEstimate estimate = open_hand();
  estimate.status = TrackStatus::lost;
  EXPECT_EQ(pixel_at(draw(estimate), middle_tip(estimate)), (Rgb{100, 100, 100}));
  estimate = open_hand();
  for (SegmentState& state : estimate.segments) state.T_camera_segment.t.z() -= 0.4;
  const Image<Rgb> sheet = draw(estimate);
  EXPECT_EQ(sheet.at(5, 5), (Rgb{100, 100, 100}));
}

TEST(Overlay, DepthOnlyFramesHaveAPictureOfTheirDepth) {
  RgbdFrame frame = grey_frame();
  frame.colour = {};
  frame.depth.at(10, 10) = 0;
  const Image<Rgb> sheet = draw_overlay(frame, 0, {}, {});
  EXPECT_EQ(sheet.at(20, 20), (Rgb{0, 0, 0}));
  EXPECT_GT(sheet.at(100, 100).r, 30);
}

TEST(SteadyRange, FollowsTheFramesWithinSeconds) {
  SteadyRange steady;
  EXPECT_EQ(steady.follow({0.4, 0.6}, 5'000'000).near, 0.4);
  const ColouredDepths next = steady.follow({1.4, 2.6}, 5'033'000);
  EXPECT_LT(next.near, 0.5) << "no jump";
  EXPECT_GT(next.far, 0.6);
  ColouredDepths range;
  for (int i = 2; i < 200; ++i) range = steady.follow({1.4, 2.6}, 5'000'000 + 33'000 * i);
  EXPECT_NEAR(range.near, 1.4, 0.01);
  EXPECT_NEAR(range.far, 2.6, 0.01);
  EXPECT_EQ(steady.follow({0.4, 0.6}, 4'000'000).near, 0.4) << "after a jump back in time";
}

class OverlayFiles : public testing::Test {
 protected:
  test::TempFolder folder_;
  const HandEstimates hand_ = shared(open_hand());  // share a profile, so that every writer makes its skin once
};

TEST_F(OverlayFiles, FolderHoldsOnePicturePerFrameNumber) {
  auto writer = OverlayWriter::open(folder_ / "overlay", 30);
  ASSERT_TRUE(writer) << writer.error().message();
  for (std::int64_t number : {12, 11}) ASSERT_TRUE(writer->write(grey_frame(320, number), hand_));
  ASSERT_TRUE(writer->finish());
  const auto picture = read_colour(folder_ / "overlay/000011.jpg");
  ASSERT_TRUE(picture) << picture.error().message();
  EXPECT_EQ(picture->width(), 1280);
  EXPECT_TRUE(fs::exists(folder_ / "overlay/000012.jpg"));
}

TEST_F(OverlayFiles, TimeCountsFromTheFirstPictureAsAPlayerDoes) {
  for (const std::int64_t begin_us : {0, 77'000'000}) {
    auto writer = OverlayWriter::open(folder_ / std::to_string(begin_us), 30).value();
    RgbdFrame frame = grey_frame();
    frame.utime = begin_us;
    ASSERT_TRUE(writer.write(frame, hand_));
  }
  EXPECT_EQ(test::read_text(folder_ / "77000000/000007.jpg"), test::read_text(folder_ / "0/000007.jpg"));
}

TEST_F(OverlayFiles, ColoursOfDepthDoNotJumpWhereTheHandIsLost) {
  // Without a hand, the depths of the scene reach to the wall at the left.
  RgbdFrame frame = grey_frame();
  for (int v = 0; v < frame.depth.height(); ++v)
    for (int u = 0; u < frame.depth.width() / 4; ++u) frame.depth.at(u, v) = 2000;
  auto writer = OverlayWriter::open(folder_ / "overlay", 30).value();
  HandEstimate lost = open_hand();
  lost.status = TrackStatus::lost;
  for (const auto& hands : {hand_, shared(lost)}) {
    ASSERT_TRUE(writer.write(frame, hands));
    ++frame.number;
    frame.utime += 33'000;
  }
  const Rgb tracked = read_colour(folder_ / "overlay/000007.jpg").value().at(640 + 600, 20);
  const Rgb next = read_colour(folder_ / "overlay/000008.jpg").value().at(640 + 600, 20);
  EXPECT_EQ(next, tracked);
}

TEST_F(OverlayFiles, NewPicturesTakeThePlaceOfThoseOfAnEarlierRunAndOfNothingElse) {
  fs::create_directories(folder_ / "000003.jpg");
  test::write_text(folder_ / "000003.jpg/000004.jpg", "x");
  fs::create_symlink("nowhere", folder_ / "000005.jpg");
  std::set<std::string> kept = {"000003.jpg", "000005.jpg"};
  for (const char* name : {"1.jpg", "12345.jpg", "0000012.jpg", "000012.png", "000012.JPG", "000012.jpg.txt",
                           "a00012.jpg", "00012a.jpg", "000012", "notes.txt"})
    test::write_text(folder_ / *kept.insert(name).first, "somebody's");
  for (const char* name : {"000001.jpg", "000012.jpg", "1234567.jpg"}) test::write_text(folder_ / name, "of a run");
  const auto names = [&] {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path())) names.insert(entry.path().filename());
    return names;
  };

  auto writer = OverlayWriter::open(folder_.path(), 30, true).value();
  EXPECT_EQ(names().size(), kept.size() + 3) << "before there is a new one";
  for (std::int64_t number : {11, 12}) ASSERT_TRUE(writer.write(grey_frame(320, number), hand_));
  kept.insert({"000011.jpg", "000012.jpg"});
  EXPECT_EQ(names(), kept);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "000003.jpg"), {}), 1);

  auto without = OverlayWriter::open(folder_.path(), 30).value();
  ASSERT_TRUE(without.write(grey_frame(320, 13), hand_));
  kept.insert("000013.jpg");
  EXPECT_EQ(names(), kept);
}

TEST_F(OverlayFiles, VideosHoldEveryFrame) {
  for (const char* name : {"overlay.avi", "overlay.mp4", "overlay.MKV"}) {
    const std::string path = folder_ / name;
    auto writer = OverlayWriter::open(path, 30);
    ASSERT_TRUE(writer) << writer.error().message();
    for (int i = 0; i < 5; ++i) ASSERT_TRUE(writer->write(grey_frame(320, i), hand_));
    ASSERT_TRUE(writer->finish());
    const test::ReadVideo video = test::read_video(path);
    ASSERT_EQ(video.pictures.size(), 5) << name;
    EXPECT_EQ(video.pictures[0].width(), 1280);
    EXPECT_NEAR(video.pictures[0].at(5, 5).g, 100, 6);
  }
}

TEST_F(OverlayFiles, AVideoThatIsCutByAFullDiskIsAnError) {
  for (const char* name : {"overlay.avi", "overlay.mp4"}) {
    auto writer = OverlayWriter::open(folder_ / name, 30);
    const test::FileSizeLimit full(20'000);
    for (int i = 0; i < 20; ++i) (void)writer->write(grey_frame(320, i), hand_);
    const auto finished = writer->finish();
    ASSERT_FALSE(finished) << name;
    EXPECT_THAT(finished.error().message(), HasSubstr("free space"));
  }
}

TEST_F(OverlayFiles, OtherKindsOfVideoAreRefusedAndNotMadeFolders) {
  for (const char* name : {"a.mov", "A.MPG", "b.gif"}) {
    const auto writer = OverlayWriter::open(folder_ / name, 30);
    ASSERT_FALSE(writer) << name;
    EXPECT_THAT(writer.error().message(), AllOf(HasSubstr(name), HasSubstr(".webm")));
    EXPECT_FALSE(fs::exists(folder_ / name));
  }
  fs::create_directory(folder_ / "c.mov");
  EXPECT_TRUE(OverlayWriter::open(folder_ / "c.mov", 30));
}

TEST_F(OverlayFiles, OutsideConditionsAreReported) {
  EXPECT_THAT(OverlayWriter::open(folder_ / "none/overlay.avi", 30).error().message(),
              AllOf(HasSubstr("none/overlay.avi"), HasSubstr("cannot be written")));
  EXPECT_FALSE(OverlayWriter::open(folder_ / "none/overlay.mp4", 30));
  EXPECT_THAT(OverlayWriter::open("/proc/overlay", 30).error().message(),
              HasSubstr("/proc/overlay: cannot be created"));

  auto video = OverlayWriter::open(folder_ / "overlay.avi", 30);
  ASSERT_TRUE(video->write(grey_frame(320), hand_));
  EXPECT_THAT(video->write(grey_frame(800, 8), hand_).error().message(), HasSubstr("differs in size"));

  auto pictures = OverlayWriter::open(folder_ / "overlay", 30);
  fs::create_symlink("/dev/full", folder_ / "overlay/000007.jpg");
  EXPECT_THAT(pictures->write(grey_frame(), hand_).error().message(),
              AllOf(HasSubstr("000007.jpg"), HasSubstr("free space")));
}

}  // namespace
}  // namespace barehand
