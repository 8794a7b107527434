#include "app/view/frame_messages.h"

#include <gtest/gtest.h>

#include <cstring>

#include "app/view/log_index.h"
#include "drivers/lcm/wire.h"
#include "io/lcm/lcm_log_writer.h"
#include "io/mcap/mcap_scene.h"
#include "mcap/mcap_bytes.h"
#include "publish/published_hand.h"
#include "stages/publish/hand_messages.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

ShownHands mean_hands() {
  return ShownHands({test::adult_hand(Handedness::left), test::adult_hand(Handedness::right)});
}

HandMessages messages_at(std::int64_t utime, TrackStatus status = TrackStatus::tracking, double size = 1) {
  const HandProfile hand = scaled(*test::adult_hand(), size);
  return HandMessageMaker({}).process(estimate_of(hand, {}, utime, status));
}

TEST(FrameMessages, BecomeAFrame) {
  const HandMessages made = messages_at(4'000'000);
  const std::vector<ReceivedMessage> messages = {{"A", encode_message(made.state)}, {"B", encode_message(made.glove)}};
  ShownHands hands = mean_hands();
  const auto content = frame_content(messages, hands, {});
  EXPECT_EQ(content.utime, 4'000'000);
  ASSERT_EQ(content.messages.size(), 2u);
  EXPECT_STREQ(content.messages[0].channel, "HAND_STATE");
  EXPECT_FALSE(content.skins[0]);
  ASSERT_TRUE(content.skins[1]);
  EXPECT_EQ(frame_content(messages, hands, {}).skins[1], content.skins[1]) << "the same hand has the same skin";
}

TEST(FrameMessages, GiveViewersOfRosTheHandsThatAreWhole) {
  const HandMessages made = messages_at(4'000'000);
  std::vector<ReceivedMessage> messages = {{"A", encode_message(made.state)}, {"B", encode_message(made.glove)}};
  ShownHands hands = mean_hands();
  EXPECT_TRUE(frame_content(messages, hands, {}).hands.empty()) << "its joints are missing";
  messages.push_back({"C", encode_message(made.joints)});
  const auto content = frame_content(messages, hands, {});
  ASSERT_EQ(content.hands.size(), 1u);
  EXPECT_EQ(content.hands[0].joints.radius[3], made.joints.radius[3]);
  ASSERT_EQ(content.messages.size(), 3u) << "clients get them, too";
  EXPECT_STREQ(content.messages[2].channel, "HAND_JOINTS");
}

TEST(FrameMessages, PassOnWhatTheHandTouchesAndHowItGrasps) {
  const HandMessages made = messages_at(4'000'000);
  contact_state_t contact = {};
  contact.hand_id = made.state.hand_id;
  contact.own[6].state = contact_state_t::TOUCHING;
  grasp_state_t grasp = {};
  grasp.hand_id = made.state.hand_id;
  grasp.grasp = grasp_state_t::TRIPOD;
  object_state_t object = {};
  object.object_id = 7;
  ShownHands hands = mean_hands();
  const auto content = frame_content(std::vector<ReceivedMessage>{{"A", encode_message(made.state)},
                                                                  {"B", encode_message(made.glove)},
                                                                  {"C", encode_message(made.joints)},
                                                                  {"D", encode_message(contact)},
                                                                  {"E", encode_message(object)},
                                                                  {"F", encode_message(grasp)}},
                                     hands, {});
  ASSERT_EQ(content.messages.size(), 6u);
  EXPECT_STREQ(content.messages[3].channel, "CONTACT_STATE");
  EXPECT_STREQ(content.messages[4].channel, "OBJECT_STATE");
  EXPECT_STREQ(content.messages[5].channel, "GRASP_STATE");
  ASSERT_EQ(content.hands.size(), 1u);
  ASSERT_TRUE(content.hands[0].contact);
  EXPECT_EQ(content.hands[0].contact->own[6].state, contact_state_t::TOUCHING);
  ASSERT_TRUE(content.hands[0].grasp);
  EXPECT_EQ(content.hands[0].grasp->grasp, grasp_state_t::TRIPOD);
  ASSERT_EQ(content.objects.size(), 1u);
  EXPECT_EQ(content.objects[0].object_id, 7);
}

TEST(FrameMessages, AreLeftOutWhereDamaged) {
  auto bytes = encode_message(messages_at(4'000'000).state);
  bytes.resize(bytes.size() / 2);
  ShownHands hands = mean_hands();
  EXPECT_TRUE(frame_content(std::vector<ReceivedMessage>{{"A", bytes}}, hands, {}).messages.empty());
}

TEST(ShownHands, AreAsLargeAsTheTrackedHand) {
  ShownHands hands = mean_hands();
  const ViewSkinPtr skin = hands.skin_of(messages_at(1, TrackStatus::tracking, 1.2).state, nullptr);
  ASSERT_TRUE(skin);
  EXPECT_NEAR(skin->profile()->hand_length(), 1.2 * test::adult_hand()->hand_length(), 1e-3);

  // What is drawn has that size, too; behind the head and the counts come the positions, then the normals.
  const std::vector<std::uint8_t> mean = ViewSkin(test::adult_hand()).bytes(), large = skin->bytes();
  ASSERT_EQ(large.size(), mean.size());
  const auto number = [](const std::vector<std::uint8_t>& bytes, std::size_t index) {
    float value = 0;
    std::memcpy(&value, bytes.data() + 16 + 4 * index, sizeof value);
    return value;
  };
  std::uint32_t vertices = 0;
  std::memcpy(&vertices, mean.data() + 8, sizeof vertices);
  for (std::size_t i = 0; i < 6 * vertices; ++i) ASSERT_NEAR(number(large, i), 1.2 * number(mean, i), 1e-3) << i;
  for (std::size_t i = 6 * vertices; i < 9 * vertices; ++i) ASSERT_EQ(number(large, i), number(mean, i)) << i;
}

/// The z coordinates of the skin's vertices reach as far as its bone, and the y coordinates as far as it is thick.
TEST(ShownHands, HaveTheLengthsAndTheThicknessOfTheTrackedHand) {
  HandProfile longer = *test::adult_hand();
  const int bone = segment_of(2, 2);
  longer.segments[bone].distal *= 1.3;
  for (double& radius : longer.segments[bone].radius) radius *= 1.1;  // which is also the end of the bone before
  const HandMessages made = HandMessageMaker({}).process(estimate_of(longer, {}, 1, TrackStatus::tracking));
  ShownHands hands = mean_hands();
  const Skin mean = ViewSkin(test::adult_hand()).mesh(), shown = hands.skin_of(made.state, &made.joints)->mesh();
  ASSERT_EQ(shown.vertices.size(), mean.vertices.size());
  for (std::size_t i = 0; i < mean.vertices.size(); ++i) {
    const SkinVertex &v = mean.vertices[i], &w = shown.vertices[i];
    ASSERT_NEAR(w.in_a.z(), (v.a == bone ? 1.3f : 1) * v.in_a.z(), 1e-5);
    if (v.a == bone - 1) continue;
    ASSERT_NEAR(w.in_a.y(), (v.a == bone ? 1.1f : 1) * v.in_a.y(), 1e-5);
  }
}

TEST(ShownHands, KeepTheFormOfAPersonsOwnSkin) {
  HandProfile own = *test::adult_hand(), thicker = own;
  own.origin = ProfileOrigin::measured;
  for (SegmentProfile& segment : thicker.segments) segment.radius[0] *= 1.3;
  const HandMessages made = HandMessageMaker({}).process(estimate_of(thicker, {}, 1, TrackStatus::tracking));
  const auto profile = std::make_shared<const HandProfile>(own);
  const Skin skin = ViewSkin(profile).mesh(),
             shown = ShownHands({profile, profile}).skin_of(made.state, &made.joints)->mesh();
  for (std::size_t i = 0; i < skin.vertices.size(); ++i)
    ASSERT_TRUE(shown.vertices[i].in_a.isApprox(skin.vertices[i].in_a, 1e-4f)) << i;
}

TEST(LogIndex, PutsStatesInOrderAndFindsLostOnes) {
  const test::TempFolder folder;
  const std::string path = folder / "states.lcmlog";
  auto log = LcmLogWriter::create(path, false);
  ASSERT_TRUE(log);
  for (int i = 0; i < 6; ++i) {
    const auto status = i == 2 || i == 3 ? TrackStatus::lost : TrackStatus::tracking;
    const HandMessages made = messages_at(1'000'000 + 100'000 * i, status);
    ASSERT_TRUE((*log)->send("HAND_STATE", encode_message(made.state), made.state.utime));
    ASSERT_TRUE((*log)->send("GLOVE_STATE", encode_message(made.glove), made.state.utime));
  }
  ASSERT_TRUE((*log)->finish());
  auto index = LogIndex::open({path});
  ASSERT_TRUE(index) << index.error().message();
  EXPECT_EQ(index->frames(), 6);
  EXPECT_NEAR(index->seconds(5), 0.5, 1e-9);
  ASSERT_EQ(index->lost().size(), 1u);
  EXPECT_EQ(index->lost()[0].first, 2);
  EXPECT_EQ(index->lost()[0].last, 3);
  EXPECT_EQ(index->messages(4).size(), 2u);
}

/// The depth is 500 + `number` everywhere.
ros::Scene scene_with_image(std::int64_t utime, int number) {
  auto frame = std::make_shared<RgbdFrame>();
  frame->utime = utime;
  frame->number = number;
  frame->camera = {64, 48, 50, 50, 32, 24};
  frame->depth.reset(64, 48, static_cast<std::uint16_t>(500 + number));
  ros::Scene scene;
  scene.utime = utime;
  scene.number = number;
  scene.frame = frame;
  return scene;
}

/// A file as `track --mcap` writes it: five frames with images, without a pose in the third.
std::string mcap_file(const test::TempFolder& folder) {
  const std::string path = folder / "hands.mcap";
  auto file = mcap::McapWriter::create(path, false);
  EXPECT_TRUE(file);
  for (int i = 0; i < 5; ++i) {
    const HandMessages made = messages_at(1'000'000 + 100'000 * i, i == 2 ? TrackStatus::lost : TrackStatus::tracking);
    ros::Scene scene = scene_with_image(made.state.utime, i);
    scene.hands = {{made.state, made.glove, made.joints}};
    EXPECT_TRUE(mcap::write_scene(**file, scene));
  }
  EXPECT_TRUE((*file)->finish());
  return path;
}

TEST(LogIndex, ReadsMcapFilesWithTheirImages) {
  const test::TempFolder folder;
  auto index = LogIndex::open({mcap_file(folder)});
  ASSERT_TRUE(index) << index.error().message();
  EXPECT_EQ(index->frames(), 5);
  ASSERT_EQ(index->lost().size(), 1u);
  EXPECT_EQ(index->lost()[0].first, 2);
  EXPECT_TRUE(index->warnings().empty());

  // A frame has the messages of the bus and its own image.
  const std::vector<ReceivedMessage> messages = index->messages(3);
  ASSERT_EQ(messages.size(), 3u);
  EXPECT_EQ(messages[0].bytes, encode_message(messages_at(1'300'000).state));
  ShownHands hands = mean_hands();
  const auto content = frame_content(messages, hands, {}, index->image(3));
  EXPECT_EQ(content.hands.size(), 1u);
  ASSERT_TRUE(content.frame);
  EXPECT_EQ(content.frame->depth.at(5, 5), 503);
  EXPECT_TRUE(content.focus);
}

TEST(LogIndex, ShowsTheImagesOfAnMcapFileWithoutHands) {
  const test::TempFolder folder;
  const std::string path = folder / "take.mcap";
  auto file = mcap::McapWriter::create(path, false);
  ASSERT_TRUE(file);
  ASSERT_TRUE(mcap::write_scene(**file, scene_with_image(7, 0)));
  ASSERT_TRUE((*file)->finish());
  auto index = LogIndex::open({path});
  ASSERT_TRUE(index) << index.error().message();
  EXPECT_EQ(index->frames(), 1);
  EXPECT_TRUE(index->lost().empty());
  ShownHands hands = mean_hands();
  EXPECT_EQ(frame_content(index->messages(0), hands, {}, index->image(0)).utime, 7);
}

TEST(LogIndex, SaysWhyThereAreNoImages) {
  const test::TempFolder folder;
  const std::string path = folder / "hands.mcap";
  auto file = mcap::McapWriter::create(path, false);
  ASSERT_TRUE(file);
  const HandMessages made = messages_at(1'000'000);
  ros::Scene scene;
  scene.utime = made.state.utime;
  scene.hands = {{made.state, made.glove, made.joints}};
  ASSERT_TRUE(mcap::write_scene(**file, scene));
  ASSERT_TRUE((*file)->finish());
  auto index = LogIndex::open({path});
  ASSERT_TRUE(index) << index.error().message();
  EXPECT_EQ(index->frames(), 1);
  EXPECT_EQ(index->image(0), nullptr);
  ASSERT_EQ(index->warnings().size(), 1u);
  EXPECT_NE(index->warnings()[0].find("holds no depth images"), std::string::npos);
}

TEST(LogIndex, SaysThatStatesAndImagesAreOfDifferentRecordings) {
  const test::TempFolder folder;
  const std::string states = folder / "states.lcmlog";
  auto log = LcmLogWriter::create(states, false);
  ASSERT_TRUE(log);
  const hand_state_t state = messages_at(9'000'000).state;
  ASSERT_TRUE((*log)->send("HAND_STATE", encode_message(state), state.utime));
  ASSERT_TRUE((*log)->finish());
  const std::string images = folder / "take.mcap";
  auto file = mcap::McapWriter::create(images, false);
  ASSERT_TRUE(file);
  ASSERT_TRUE(mcap::write_scene(**file, scene_with_image(7, 0)));
  ASSERT_TRUE((*file)->finish());
  const auto index = LogIndex::open({states, images});
  ASSERT_TRUE(index) << index.error().message();
  EXPECT_EQ(index->frames(), 1);
  ASSERT_EQ(index->warnings().size(), 1u);
  EXPECT_NE(index->warnings()[0].find("same recording"), std::string::npos);
}

TEST(LogIndex, SaysWhatIsCutOff) {
  const test::TempFolder folder;
  const std::string path = mcap_file(folder);
  test::cut_off_end(path);
  const auto index = LogIndex::open({path});
  ASSERT_TRUE(index) << index.error().message();
  EXPECT_EQ(index->frames(), 5);
  ASSERT_EQ(index->warnings().size(), 1u);
  EXPECT_NE(index->warnings()[0].find(path), std::string::npos);
}

TEST(LogIndex, RefusesALogWithNothingToShow) {
  const test::TempFolder folder;
  const std::string path = folder / "other.lcmlog";
  auto log = LcmLogWriter::create(path, false);
  ASSERT_TRUE(log);
  ASSERT_TRUE((*log)->send("X", std::vector<std::uint8_t>(40, 7), 1));
  ASSERT_TRUE((*log)->finish());
  const auto index = LogIndex::open({path});
  ASSERT_FALSE(index);
  EXPECT_NE(index.error().message().find("--states-log"), std::string::npos);
}

}  // namespace
}  // namespace barehand
