#include "io/web/view_frame.h"

#include <gtest/gtest.h>

#include "hand/skin.h"
#include "io/recording/jpeg_codec.h"
#include "support/adult_hand.h"
#include "web/web_client.h"

namespace barehand {
namespace {

using test::Chunk;
using test::chunks_of;

std::string text_of(std::span<const std::uint8_t> bytes) { return {bytes.begin(), bytes.end()}; }

/// Depth 1000 + 10 u + v millimetres, colour by position.
std::shared_ptr<RgbdFrame> frame(int width, int height) {
  auto out = std::make_shared<RgbdFrame>();
  out->utime = 5'000'000;
  out->number = 7;
  out->camera = {width, height, 500, 501, width / 2.0, height / 2.0};
  out->depth.reset(width, height);
  out->colour.reset(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      out->depth.at(u, v) = static_cast<std::uint16_t>(1000 + 10 * u + v);
      out->colour.at(u, v) = {static_cast<std::uint8_t>(u), static_cast<std::uint8_t>(v), 248};
    }
  return out;
}

ViewFrame::Content content(FramePtr image) {
  ViewFrame::Content out;
  out.utime = image->utime;
  out.number = image->number;
  out.frame = std::move(image);
  return out;
}

TEST(ViewFrame, SendsTimesAndCamera) {
  const ViewFrame view(content(frame(64, 48)));
  std::vector<std::uint8_t> bytes;
  view.write_states(5'020'000, bytes);
  const std::vector<Chunk> chunks = chunks_of(text_of(bytes));
  ASSERT_EQ(test::kinds_of(chunks), "F");
  EXPECT_EQ(chunks[0].at<std::int64_t>(0), 5'000'000);
  EXPECT_EQ(chunks[0].at<std::int64_t>(8), 7);
  EXPECT_EQ(chunks[0].at<std::int64_t>(16), 5'020'000);
  EXPECT_EQ(chunks[0].at<double>(24), 500);
  EXPECT_EQ(chunks[0].at<double>(48), 24);
  EXPECT_EQ(chunks[0].at<std::int32_t>(56), 64);
}

TEST(ViewFrame, SaysWhereInALogItLies) {
  ViewFrame::Content some;
  some.place = {12, 0.4};
  const ViewFrame view(std::move(some));
  std::vector<std::uint8_t> bytes;
  view.write_states(0, bytes);
  const std::vector<Chunk> chunks = chunks_of(text_of(bytes));
  ASSERT_EQ(test::kinds_of(chunks), "FT");
  EXPECT_EQ(chunks[1].at<std::int64_t>(0), 12);
  EXPECT_EQ(chunks[1].at<double>(8), 0.4);
}

TEST(ViewFrame, SendsMessagesAsTheyAre) {
  ViewFrame::Content some;
  some.messages.push_back({"HAND_STATE", {1, 2, 3, 4, 5}});
  some.messages.push_back({"GLOVE_STATE", {6}});
  const ViewFrame view(std::move(some));
  std::vector<std::uint8_t> bytes;
  view.write_states(0, bytes);
  const std::vector<Chunk> chunks = chunks_of(text_of(bytes));
  ASSERT_EQ(test::kinds_of(chunks), "FLL");
  EXPECT_EQ(chunks[1].payload, "\x0aHAND_STATE\x01\x02\x03\x04\x05");
  EXPECT_EQ(chunks[2].payload, "\x0bGLOVE_STATE\x06");
  EXPECT_EQ(bytes.size() % 4, 0u);
}

TEST(ViewFrame, SendsTheSceneOnAGrid) {
  const ViewFrame view(content(frame(640, 480)));
  const std::vector<Chunk> chunks = chunks_of(text_of(view.cloud(ViewCloud::scene)));
  ASSERT_EQ(test::kinds_of(chunks), "D");
  const Chunk& d = chunks[0];
  const int columns = d.at<std::uint16_t>(0), rows = d.at<std::uint16_t>(2), step = d.at<std::uint16_t>(4);
  EXPECT_EQ(columns, 160);
  EXPECT_EQ(rows, 120);
  EXPECT_EQ(step, 4);
  EXPECT_FLOAT_EQ(d.at<float>(12), 0.001f);
  const int u = d.at<std::uint16_t>(6) + 5 * step, v = d.at<std::uint16_t>(8) + 9 * step;
  const std::size_t cell = 9 * 160 + 5;
  EXPECT_EQ(d.at<std::uint16_t>(16 + 2 * cell), 1000 + 10 * u + v);
  EXPECT_EQ(d.index, 1) << "with colour";
  const std::uint16_t colour = d.at<std::uint16_t>(16 + 2 * (160 * 120 + cell));
  EXPECT_EQ(colour >> 11, (u & 0xff) >> 3);
  EXPECT_EQ(colour & 31, 31);
  EXPECT_EQ(d.payload.size(), 16u + 4 * 160 * 120);
}

TEST(ViewFrame, SendsTheHandsSurroundingsFinely) {
  auto some = content(frame(640, 480));
  some.focus = ViewFocus{100, 50, 80, 60, 2.1, 2.5};
  const ViewFrame view(std::move(some));
  const Chunk d = chunks_of(text_of(view.cloud(ViewCloud::hand))).at(0);
  EXPECT_EQ(d.at<std::uint16_t>(0), 80);
  EXPECT_EQ(d.at<std::uint16_t>(4), 1);
  EXPECT_EQ(d.at<std::uint16_t>(6), 100);
  EXPECT_EQ(d.at<std::uint16_t>(16), 0) << "2.05 m: before the hand";
  EXPECT_EQ(d.at<std::uint16_t>(16 + 2 * 20), 1000 + 10 * 120 + 50);
  EXPECT_EQ(d.at<std::uint16_t>(16 + 2 * 60), 0) << "2.65 m: behind it";
}

TEST(ViewFrame, SendsPicturesThatAreNotTooLarge) {
  const ViewFrame view(content(frame(1280, 96)));
  for (const bool large : {false, true})
    for (const ViewPicture kind : {ViewPicture::colour, ViewPicture::depth}) {
      const Chunk p = chunks_of(text_of(view.picture(kind, large))).at(0);
      EXPECT_EQ(p.kind, 'P');
      EXPECT_EQ(p.index, static_cast<int>(kind));
      const std::vector<std::uint8_t> jpeg(p.payload.begin(), p.payload.end());
      EXPECT_TRUE(decode_jpeg(jpeg, large ? 640 : 320, large ? 48 : 24));
    }
}

TEST(ViewFrame, GivesADepthTheSameColourWhateverElseIsInView) {
  const auto colour_beside = [](std::uint16_t depth) {
    auto image = frame(64, 48);
    image->depth.reset(64, 48, depth);
    for (int v = 0; v < 16; ++v)
      for (int u = 0; u < 16; ++u) image->depth.at(u, v) = 1000;
    auto some = content(image);
    some.depths = {0.5, 1.5};
    const Chunk p = chunks_of(text_of(ViewFrame(std::move(some)).picture(ViewPicture::depth, false))).at(0);
    return decode_jpeg(std::vector<std::uint8_t>(p.payload.begin(), p.payload.end()), 64, 48).value().at(4, 4);
  };
  EXPECT_EQ(colour_beside(700), colour_beside(2000));
}

TEST(ViewFrame, HasNeitherCloudNorPictureWithoutImages) {
  const ViewFrame view{ViewFrame::Content{}};
  EXPECT_TRUE(view.cloud(ViewCloud::scene).empty());
  EXPECT_TRUE(view.picture(ViewPicture::colour, false).empty());
  auto grey = frame(64, 48);
  grey->colour = {};
  const ViewFrame without_colour(content(grey));
  EXPECT_TRUE(without_colour.picture(ViewPicture::colour, false).empty());
  EXPECT_EQ(chunks_of(text_of(without_colour.cloud(ViewCloud::scene))).at(0).payload.size(), 16u + 2 * 64 * 48);
}

TEST(Focus, LiesAroundWhatIsInView) {
  const Intrinsics camera{640, 480, 500, 500, 320, 240};
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0.5}, {0.05, 0, 0.6}, {0, 0, -1}};
  const auto focus = focus_on(points, camera);
  ASSERT_TRUE(focus);
  EXPECT_EQ(focus->u, 260);
  EXPECT_NEAR(focus->u + focus->width, 320 + 500 * 0.11 / 0.6, 1);
  EXPECT_LT(focus->near, 0.5);
  EXPECT_GT(focus->far, 0.6);
  EXPECT_FALSE(focus_on({}, camera));
  EXPECT_FALSE(focus_on(std::vector<Eigen::Vector3d>{{5, 0, 0.5}}, camera)) << "beside the picture";
}

TEST(ViewSkin, HasTheVerticesOfTheProfilesSkin) {
  const auto profile = test::adult_hand(Handedness::left);
  const ViewSkin skin(profile);
  const Chunk s = chunks_of(text_of(skin.bytes())).at(0);
  EXPECT_EQ(s.kind, 'S');
  EXPECT_EQ(s.index, static_cast<int>(Handedness::left));
  const Skin whole = make_skin(*profile, 0.004);
  const auto vertices = s.at<std::uint32_t>(0), triangles = s.at<std::uint32_t>(4);
  EXPECT_EQ(vertices, whole.vertices.size());
  EXPECT_EQ(triangles, whole.triangles.size());
  EXPECT_EQ(s.at<float>(8), whole.vertices[0].in_a.x());
  EXPECT_EQ(s.payload.size(), 8 + 42 * vertices + 12 * triangles);
}

}  // namespace
}  // namespace barehand
