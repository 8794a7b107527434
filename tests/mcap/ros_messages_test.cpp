#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/ros/cdr.h"
#include "io/ros/ros_frame.h"
#include "io/ros/ros_hand.h"
#include "io/ros/ros_time.h"
#include "io/ros/ros_topics.h"
#include "tests/lcm/test_frames.h"

namespace barehand::ros {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A hand whose segment s is at (s, 0, 1) cm and is rotated about z.
HandState hand(bool has_pose, std::int8_t side = hand_state_t::RIGHT) {
  HandState hand{};
  hand.state.utime = 1'700'000'000'123'456;
  hand.state.handedness = side;
  hand.state.has_pose = has_pose;
  hand.state.status = has_pose ? hand_state_t::TRACKING : hand_state_t::LOST;
  for (int s = 0; s < 16; ++s) {
    segment_state_t& segment = hand.state.segments[s];
    segment.smoothed_position[0] = has_pose ? 0.01 * s : kNaN;
    segment.smoothed_position[2] = 0.01;
    segment.smoothed_orientation[0] = 0.8;
    segment.smoothed_orientation[3] = 0.6;
    for (int i = 0; i < 3; ++i) segment.covariance[i][i] = 1e-6 * (i + 1);
    segment.confidence = 0.75;
    segment.seen = s != 4;
  }
  for (int i = 0; i < 21; ++i) {
    hand.glove.joint_name[i] = "joint" + std::to_string(i);
    hand.glove.joint_angle[i] = 0.1 * i;
  }
  for (int i = 0; i < 26; ++i) {
    hand.joints.position[i][2] = 0.5 + 0.01 * i;
    hand.joints.radius[i] = 0.008;
  }
  return hand;
}

TEST(RosSchema, IsTheTextOfTheMessageWithThoseInIt) {
  EXPECT_EQ(schema_name<CompressedImage>(), "sensor_msgs/msg/CompressedImage");
  const std::string line = std::string(80, '=') + "\n";
  EXPECT_EQ(SchemaText::of<CompressedImage>(),
            "std_msgs/Header header\nstring format\nuint8[] data\n" + line +
                "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" + line +
                "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
  EXPECT_THAT(SchemaText::of<CameraInfo>(), HasSubstr("float64[] d\nfloat64[9] k\nfloat64[9] r\nfloat64[12] p\n"));
  EXPECT_THAT(SchemaText::of<DiagnosticArray>(), HasSubstr("byte level\n"));
}

TEST(Cdr, NumbersAreAlignedFromTheHeaderOnAndGapsAreZero) {
  JointState message;
  message.header = {{1, 2}, "ab"};
  message.position = {1.0};
  const Bytes expected = {0, 1, 0, 0,                        // little endian
                          1, 0, 0, 0, 2,   0,   0,    0,     // stamp
                          3, 0, 0, 0, 'a', 'b', 0,    0,     // frame, and padding
                          0, 0, 0, 0,                        // no name
                          1, 0, 0, 0,                        // a position, which lies at a multiple of 8
                          0, 0, 0, 0, 0,   0,   0xf0, 0x3f,  //
                          0, 0, 0, 0, 0,   0,   0,    0};    // no velocity, no effort
  for (int again = 0; again < 20; ++again) {
    const Bytes dirt(64 + 16 * static_cast<std::size_t>(again), 0xaa);  // stays in the memory that is allocated next
    EXPECT_EQ(encode(message), expected) << dirt.size();
  }
}

TEST(Cdr, MessagesAreReadAsTheyWereWritten) {
  const RgbdFrame frame = test_frame(7);
  const Image image = depth_image(frame);
  const auto read = decode<Image>(encode(image));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->header.stamp, image.header.stamp);
  EXPECT_EQ(read->encoding, "16UC1");
  EXPECT_EQ(read->data, image.data);
  const auto info = decode<CameraInfo>(encode(camera_info(frame)));
  ASSERT_TRUE(info);
  EXPECT_EQ(camera_of(*info).value(), frame.camera);
}

TEST(Cdr, WhatEndsEarlyOrLiesIsAnError) {
  const Bytes whole = encode(depth_image(test_frame(1)));
  for (std::size_t size = 0; size < whole.size(); size += size < 100 ? 1 : 97)
    EXPECT_FALSE(decode<Image>(std::span(whole).first(size))) << size;
  Bytes lying = whole;
  lying[12] = lying[13] = lying[14] = 0xff;  // the length of the frame's name
  EXPECT_FALSE(decode<Image>(lying));
  lying = whole;
  lying[1] = 9;
  EXPECT_FALSE(decode<Image>(lying)) << "another encoding than plain CDR";
}

TEST(Cdr, BigEndianIsRead) {
  const Bytes header = {0, 0, 0, 0, 0, 0, 0, 5, 0, 0, 0, 6, 0, 0, 0, 2, 'x', 0};
  const auto read = decode<Header>(header);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->stamp, (Time{5, 6}));
  EXPECT_EQ(read->frame_id, "x");
}

TEST(RosTime, HoldsMicrosecondsBeforeAndAfterTheEpoch) {
  for (const std::int64_t utime : {std::int64_t{0}, std::int64_t{1'700'000'000'123'456}, std::int64_t{-1}})
    EXPECT_EQ(utime_of(time_of(utime).value()), utime);
  EXPECT_EQ(nanoseconds(time_of(1'500'000).value()), 1'500'000'000u);
  EXPECT_FALSE(time_of(3'000'000'000'000'000)) << "beyond 2038";
}

TEST(RosFrame, DepthWithGapsBetweenItsRowsAndOfTheOtherEndIsRead) {
  Image image;
  image.encoding = "mono16";
  image.width = 2;
  image.height = 2;
  image.step = 6;
  image.is_bigendian = 1;
  image.data = {0, 1, 0, 2, 9, 9, 1, 0, 2, 0, 9, 9};
  const auto depth = depth_of(image);
  ASSERT_TRUE(depth);
  EXPECT_EQ(depth->at(1, 0), 2);
  EXPECT_EQ(depth->at(0, 1), 256);
  image.data.pop_back();
  EXPECT_FALSE(depth_of(image));
  image.encoding = "32FC1";
  EXPECT_THAT(depth_of(image).error().message(), HasSubstr("32FC1 is not read"));
  image.step = 0xffffffff;
  image.height = 0xffffffff;
  image.encoding = "16UC1";
  EXPECT_FALSE(depth_of(image));
}

TEST(RosFrame, ColourOfEitherOrderIsRead) {
  Image image;
  image.width = image.height = 1;
  image.step = 3;
  image.data = {1, 2, 3};
  image.encoding = "rgb8";
  EXPECT_EQ(colour_of(image).value().at(0, 0), (Rgb{1, 2, 3}));
  image.encoding = "bgr8";
  EXPECT_EQ(colour_of(image).value().at(0, 0), (Rgb{3, 2, 1}));
  image.encoding = "yuv422";
  EXPECT_FALSE(colour_of(image));
}

TEST(RosFrame, PointsLieWhereDepthIs) {
  RgbdFrame frame = test_frame(0);
  frame.depth.reset(40, 30);
  frame.depth.at(10, 20) = 5000;  // 0.5 m
  const PointCloud2 cloud = point_cloud(frame, 40 * 30);
  ASSERT_EQ(cloud.width, 1u);
  ASSERT_EQ(cloud.data.size(), 16u);
  float xyz[3];
  std::memcpy(xyz, cloud.data.data(), sizeof xyz);
  const Eigen::Vector3d expected = frame.camera.unproject(10, 20, 0.5);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(xyz[i], expected[i], 1e-6);
  EXPECT_LE(point_cloud(test_frame(0), 100).width, 100u);
}

TEST(RosHand, JointsAndFramesAreNamedBySide) {
  const JointState joints = joint_state(hand(true, hand_state_t::LEFT));
  ASSERT_EQ(joints.name.size(), 21u);
  EXPECT_EQ(joints.name[3], "left_joint3");
  EXPECT_DOUBLE_EQ(joints.position[3], 0.3);
  TFMessage transforms;
  add_transforms(hand(true), transforms);
  ASSERT_EQ(transforms.transforms.size(), 16u);
  const TransformStamped& third = transforms.transforms[3];
  EXPECT_EQ(third.header.frame_id, "camera_optical_frame");
  EXPECT_EQ(third.child_frame_id, "right_thumb_distal");
  EXPECT_DOUBLE_EQ(third.transform.translation.x, 0.03);
  EXPECT_DOUBLE_EQ(third.transform.rotation.w, 0.8);
  EXPECT_DOUBLE_EQ(third.transform.rotation.z, 0.6);
}

TEST(RosHand, WhatCannotBeObservedIsWithheld) {
  HandState state = hand(true);
  state.glove.joint_flag[3] = glove_state_t::UNOBSERVABLE;
  state.glove.joint_angle[3] = kNaN;
  const JointState joints = joint_state(state);
  EXPECT_EQ(joints.name.size(), 20u);
  for (const double angle : joints.position) EXPECT_TRUE(std::isfinite(angle));
}

TEST(RosHand, TheDrawingHasEveryJointBoneAndEllipsoid) {
  const MarkerArray drawn = markers(hand(true));
  EXPECT_EQ(drawn.markers.size(), 25u + 24u + 16u);
  const Marker& ellipsoid = drawn.markers.back();
  EXPECT_EQ(ellipsoid.ns, "right_uncertainty");
  EXPECT_NEAR(ellipsoid.scale.z, 4 * std::sqrt(3e-6), 1e-9);
  const Marker& inferred = drawn.markers[6];  // the sphere at the proximal joint of the index finger
  EXPECT_NEAR(inferred.pose.position.z, 0.57, 1e-12);
  EXPECT_LT(inferred.color.a, 1) << "translucent where it is not seen";
  const Marker& bone = drawn.markers[25];  // from the wrist to the metacarpal of the thumb
  EXPECT_EQ(bone.type, Marker::kCylinder);
  EXPECT_NEAR(bone.pose.position.z, 0.515, 1e-12);
  EXPECT_NEAR(bone.scale.z, 0.01, 1e-12);
}

TEST(RosHand, TouchesAreSpheresWhereTheSurfaceIs) {
  HandState state = hand(true);
  state.contact.emplace();
  segment_contact_t& on_object = state.contact->object[3];
  on_object.state = state.contact->own[6].state = contact_state_t::TOUCHING;
  on_object.point[2] = 0.4;
  on_object.inferred = true;
  state.contact->object[4].state = contact_state_t::NEAR;
  const MarkerArray drawn = contact_markers(state);
  ASSERT_EQ(drawn.markers.size(), 3u);
  EXPECT_EQ(drawn.markers[0].action, Marker::kDeleteAll);
  EXPECT_EQ(drawn.markers[1].pose.position.z, 0.4);
  EXPECT_LT(drawn.markers[1].color.a, 1) << "inferred";
  EXPECT_GT(drawn.markers[1].color.r, drawn.markers[2].color.r) << "objects and hands have colours of their own";
}

TEST(RosHand, TheGraspIsPartOfTheDiagnosis) {
  HandState state = hand(true);
  const auto has = [&state](const char* key, const char* text) {
    const auto values = diagnostic(state).values;
    return std::ranges::any_of(values, [&](const KeyValue& value) { return value.key == key && value.value == text; });
  };
  EXPECT_FALSE(has("grasp", "pinch"));
  state.grasp.emplace();
  state.grasp->grasp = grasp_state_t::PINCH;
  state.grasp->kind = grasp_state_t::PRECISION;
  state.grasp->aperture = 0.025;
  EXPECT_TRUE(has("grasp", "pinch"));
  EXPECT_TRUE(has("grasp kind", "precision"));
  EXPECT_TRUE(has("aperture [m]", "0.025"));
  state.grasp->grasp = grasp_state_t::UNKNOWN;
  EXPECT_FALSE(has("grasp", "unknown")) << "what is not known is left out";
  EXPECT_EQ(lcm_messages(state).back().channel, "GRASP_STATE");
}

std::vector<std::string> names_of(const std::vector<Topic>& topics) {
  std::vector<std::string> names;
  for (const Topic& topic : topics) names.push_back(topic.name);
  return names;
}

TEST(RosTopics, ALostHandIsWithheldAndItsDrawingGoes) {
  Scene scene;
  scene.hands = {hand(false)};
  const auto topics = topics_of(scene);
  EXPECT_THAT(names_of(topics), ElementsAre("/right_hand/markers", "/diagnostics"));
  const MarkerArray gone = markers(scene.hands[0]);
  ASSERT_EQ(gone.markers.size(), 1u);
  EXPECT_EQ(gone.markers[0].action, Marker::kDeleteAll);
  EXPECT_EQ(diagnostic(scene.hands[0]).level, DiagnosticStatus::kStale);
}

TEST(RosTopics, TheCameraIsWhereTheRoomHasIt) {
  auto frame = std::make_shared<RgbdFrame>(test_frame(1));
  frame->sensor = "desk";
  Scene scene;
  scene.utime = 3'000'000;
  scene.frame = frame;
  EXPECT_THAT(names_of(topics_of(scene)), testing::Not(Contains("/tf"))) << "neither room nor hand is known";

  // Turned by 90 degrees about x: the camera's z axis points along the world's -y.
  scene.T_world_camera = SE3{Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()).toRotationMatrix(), {1, 2, 3}};
  const auto topics = topics_of(scene);
  const auto tf = std::ranges::find(topics, "/tf", &Topic::name);
  ASSERT_NE(tf, topics.end());
  const auto message = decode<TFMessage>(tf->encode().value());
  ASSERT_TRUE(message) << message.error().message();
  ASSERT_EQ(message->transforms.size(), 1u);
  const TransformStamped& camera = message->transforms[0];
  EXPECT_EQ(camera.header.frame_id, "world");
  EXPECT_EQ(camera.header.stamp.sec, 3);
  EXPECT_EQ(camera.child_frame_id, camera_frame("desk"));
  EXPECT_EQ(camera.transform.translation.z, 3);
  EXPECT_NEAR(camera.transform.rotation.x, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(camera.transform.rotation.w, std::sqrt(0.5), 1e-12);
}

TEST(RosTopics, EverythingThatIsKnownHasATopic) {
  auto frame = std::make_shared<RgbdFrame>(test_frame(1));
  frame->sensor = "left cam";
  Scene scene;
  scene.frame = frame;
  scene.hands = {hand(true), hand(true, hand_state_t::LEFT)};
  scene.hands[0].contact.emplace();
  scene.objects.emplace_back().object_id = 7;
  scene.health.emplace();
  const auto topics = topics_of(scene);
  EXPECT_THAT(names_of(topics),
              ElementsAre("/left_cam/camera_info", "/left_cam/depth", "/left_cam/colour", "/left_cam/points", "/tf",
                          "/right_hand/joint_states", "/right_hand/markers", "/right_hand/contacts",
                          "/left_hand/joint_states", "/left_hand/markers", "/diagnostics"));
  EXPECT_EQ(topics[1].metadata.at(kDepthUnit), "0.0001");
  EXPECT_EQ(topics[1].metadata.at(kSensor), "left cam");
  for (const Topic& topic : topics) EXPECT_TRUE(topic.encode()) << topic.name;
  const auto tf = decode<TFMessage>(std::ranges::find(topics, "/tf", &Topic::name)->encode().value());
  EXPECT_EQ(tf->transforms.back().child_frame_id, "object_7");
  frame->colour = {};
  scene.cloud = false;
  EXPECT_THAT(names_of(topics_of(scene)), testing::Not(Contains("/left_cam/colour")));
}

}  // namespace
}  // namespace barehand::ros
