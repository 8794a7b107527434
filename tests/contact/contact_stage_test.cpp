#include "stages/contact/contact_stage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hand/skin.h"
#include "math/angles.h"
#include "support/painted_hand.h"
#include "support/solid_meshes.h"

namespace barehand {
namespace {

/// A flat hand that shows its palm to the camera, its back to a wall.
class Contacts : public testing::Test {
 protected:
  Contacts() {
    pose_ = test::facing_pose(*profile_, 0.5, 0);
    std::vector<Eigen::Vector3f> posed;
    pose_skin(skin_, pose_, posed);
    back_.fill(0);
    for (std::size_t i = 0; i < posed.size(); ++i)
      if (skin_.vertices[i].weight_b == 0)
        back_[skin_.vertices[i].a] = std::max<double>(back_[skin_.vertices[i].a], posed[i].z());
  }

  std::shared_ptr<HandEstimate> estimate() const {
    auto estimate = std::make_shared<HandEstimate>();
    estimate->status = TrackStatus::tracking;
    estimate->hand_id = 1;
    estimate->profile = profile_;
    for (int s = 0; s < kSegmentCount; ++s) {
      SegmentState& segment = estimate->segments[s];
      segment.T_camera_segment = pose_[s];
      segment.covariance = 1e-6 * Matrix6d::Identity();
      segment.visible = 1;
      segment.seen = true;
    }
    return estimate;
  }
  /// What the hand touches in front of a wall.
  HandContacts before(double wall, const std::shared_ptr<HandEstimate>& estimate) {
    auto observation = test::observe_skin(skin_, pose_, wall);
    for (std::size_t i = 0; i < observation->label.size(); ++i)
      if (observation->label[i] == PixelLabel::background) observation->label[i] = PixelLabel::object;
    ContactStage stage{{}};
    return stage.process({observation}, {estimate}).value()->hands[0];
  }

  std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  Skin skin_ = make_blended_skin(*profile_, 0.004);
  HandPose pose_;
  std::array<double, kSegmentCount> back_{};  // farthest skin of each segment [m]
};

TEST_F(Contacts, DistancesToAWallAreThoseOfTheSkin) {
  const int tip = segment_of(2, 2);
  for (const double gap : {0.0, 0.01, 0.02}) {
    const HandContacts contacts = before(back_[tip] + gap, estimate());
    for (int finger = 1; finger < kFingerCount; ++finger) {
      const int s = segment_of(finger, 2);
      const double truth = back_[tip] + gap - back_[s];
      EXPECT_NEAR(contacts.object[s].distance, truth, 0.004) << gap << " m, " << kSegmentNames[s];
      EXPECT_LT(contacts.object[s].normal.z(), -0.9);
    }
  }
}

TEST_F(Contacts, StatesFollowTheDistance) {
  const int tip = segment_of(2, 2);
  const auto state = [&](double gap) { return before(back_[tip] + gap, estimate()).object[tip].state; };
  EXPECT_EQ(state(0), ContactState::touching);
  EXPECT_EQ(state(0.014), ContactState::near);
  EXPECT_EQ(state(0.1), ContactState::none);
}

TEST_F(Contacts, AnUncertainPoseTempersTheProbability) {
  const int tip = segment_of(2, 2);
  const auto sure = estimate(), unsure = estimate();
  unsure->segments[tip].covariance *= 100;
  const Contact a = before(back_[tip], sure).object[tip], b = before(back_[tip], unsure).object[tip];
  EXPECT_EQ(a.distance, b.distance);
  EXPECT_GT(b.deviation, a.deviation + 0.005);
  EXPECT_GT(a.probability, b.probability + 0.1);
}

TEST_F(Contacts, ProbabilitiesAreThoseOfTheMethod) {
  const auto seen = estimate(), hidden = estimate();
  for (const auto& hand : {seen, hidden})
    for (SegmentState& segment : hand->segments) segment.covariance *= 10;
  for (SegmentState& segment : hidden->segments) segment.seen = false, segment.visible = 0;

  // docs/method.md, "What the hand touches".
  const auto normal = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
  const auto check = [&](const Contact& contact, auto phi) {
    EXPECT_NEAR(contact.probability, 0.03 + 0.94 * phi((0.005 - contact.distance) / contact.deviation), 1e-6);
  };
  const int tip = segment_of(2, 2), middle = segment_of(2, 1);
  check(before(back_[tip] + 0.003, seen).object[tip], [&](double z) { return normal(2 * z - 0.15); });
  check(before(back_[middle] + 0.003, seen).object[middle], [&](double z) { return normal(z - 0.15); });
  check(before(back_[middle], hidden).object[middle], [&](double z) { return normal(z); });
  check(before(back_[tip], hidden).object[tip], [&](double z) { return 2 * normal(z) / (1 + normal(z)); });
}

TEST_F(Contacts, NothingIsSaidOfSegmentsThatAreNotSeen) {
  const int tip = segment_of(2, 2);
  const auto hidden = estimate();
  hidden->segments[tip].seen = false;
  hidden->segments[tip].visible = 0;
  EXPECT_EQ(before(back_[tip] + 0.1, hidden).object[tip].state, ContactState::unknown);
  const Contact touching = before(back_[tip], hidden).object[tip];
  EXPECT_EQ(touching.state, ContactState::touching);
  EXPECT_TRUE(touching.inferred);
}

TEST_F(Contacts, AHandThatIsNotTrackedHasNone) {
  const auto lost = estimate();
  lost->status = TrackStatus::holding;
  for (const Contact& contact : before(back_[kPalm], lost).object) {
    EXPECT_EQ(contact.state, ContactState::unknown);
    EXPECT_TRUE(std::isnan(contact.probability));
  }
}

TEST_F(Contacts, ThumbAndIndexOfAFlatHandDoNotTouchButAFistTouchesItself) {
  EXPECT_EQ(before(1.2, estimate()).own[segment_of(0, 2)].state, ContactState::none);
  pose_ = test::facing_pose(*profile_, 0.5, 85 * kDegree);
  const Contact middle = before(1.2, estimate()).own[segment_of(2, 2)];
  EXPECT_GE(middle.state, ContactState::near);
  EXPECT_GE(middle.segment, 0);
}

TEST_F(Contacts, TwoHandsThatMeetTouchEachOther) {
  const auto right = estimate();
  const auto left = std::make_shared<HandEstimate>(*right);
  left->hand_id = 2;
  for (SegmentState& segment : left->segments) segment.T_camera_segment.t.z() += 0.02;
  const auto observation = test::observe_skin(skin_, pose_);
  ContactStage stage{{}};
  const FrameContactsPtr contacts = stage.process({observation, observation}, {right, left}).value();
  const Contact& tip = contacts->hands[0].other_hand[segment_of(2, 2)];
  EXPECT_NE(tip.state, ContactState::none);
  EXPECT_EQ(tip.partner, 2);
  EXPECT_EQ(contacts->hands[1].other_hand[segment_of(2, 2)].partner, 1);
  EXPECT_EQ(before(1.2, right).other_hand[segment_of(2, 2)].state, ContactState::unknown) << "there is no other hand";
}

/// A known wall before which the hand is, whether or not it is seen.
class KnownWall : public Contacts {
 protected:
  Contact touch(double gap, const std::shared_ptr<HandEstimate>& estimate, std::int32_t holder) {
    const int tip = segment_of(2, 2);
    ObjectMesh mesh = test::box_mesh({0.6f, 0.6f, 0.05f});
    const SE3 T{Eigen::Matrix3d::Identity(), {0, 0, back_[tip] + gap + 0.025}};
    const PosedObject wall{make_known_object(mesh, 1), T, 1e-8 * Matrix6d::Identity(), holder};
    ContactStage stage({}, [&](const auto&, const auto&, auto&, auto&) { return std::vector<PosedObject>{wall}; });
    return stage.process({test::observe_skin(skin_, pose_, 2)}, {estimate}).value()->hands[0].object[tip];
  }
};

TEST_F(KnownWall, TheDistanceFromAMeshIsStatedForHiddenSegmentsToo) {
  const auto hidden = estimate();
  for (SegmentState& segment : hidden->segments) segment.seen = false, segment.visible = 0;
  for (const auto& hand : {estimate(), hidden})
    for (const double gap : {-0.002, 0.0, 0.01}) {
      const Contact contact = touch(gap, hand, -1);
      EXPECT_NEAR(contact.distance, gap, 0.002) << gap;
      EXPECT_LT(contact.normal.z(), -0.9);
      EXPECT_EQ(contact.partner, 1);
      EXPECT_EQ(contact.inferred, hand == hidden);
    }
}

TEST_F(KnownWall, AHiddenSegmentRatherTouchesWhatItsHandHolds) {
  const auto hidden = estimate();
  for (SegmentState& segment : hidden->segments) segment.seen = false, segment.covariance *= 100;
  const Contact other = touch(0.01, hidden, 2), own = touch(0.01, hidden, 1), seen = touch(0.01, estimate(), 1);
  EXPECT_GT(own.probability, other.probability + 0.1);
  EXPECT_LT(seen.probability, other.probability);
}

/// A ball beside the hand, which nobody knows.
class UnknownBall : public Contacts {
 protected:
  UnknownBall() {
    ball_ = test::observe_skin(skin_, pose_, 2);
    const Intrinsics& camera = ball_->frame->camera;
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u) {
        if (ball_->label.at(u, v) == PixelLabel::hand) continue;
        const Eigen::Vector3d ray = camera.unproject(u, v, 1).normalized();
        const double along = ray.dot(kMiddle), aside = (along * ray - kMiddle).squaredNorm();
        if (aside >= kRadius * kRadius) continue;
        ball_->depth.at(u, v) = static_cast<float>((along - std::sqrt(kRadius * kRadius - aside)) * ray.z());
        ball_->label.at(u, v) = PixelLabel::object;
      }
  }
  void look(ContactStage& stage) {
    for (int k = 0; k < 10; ++k)
      ASSERT_TRUE(stage.process({test::stamped(*ball_, 1'000'000 + 33'000 * k)}, {estimate()}));
  }

  static constexpr double kRadius = 0.036;
  const Eigen::Vector3d kMiddle{0.13, 0, 0.5};
  std::shared_ptr<HandObservation> ball_;
};

TEST_F(UnknownBall, ARoundObjectHasAShape) {
  ContactStage stage{{}};
  look(stage);
  ASSERT_EQ(stage.shaped_objects().size(), 1u);
  const PosedObject& ball = stage.shaped_objects()[0];
  EXPECT_GE(ball.object->id, kFirstUnknownObject);
  EXPECT_NEAR(ball.object->extent.x(), 2 * kRadius, 0.003);
  EXPECT_LT((ball.T_camera_object * ball.object->centre - kMiddle).norm(), 0.002);
}

TEST_F(UnknownBall, AnObjectThatIsAKnownOneIsNotGuessedAsWell) {
  ContactStage stage({}, [&](const auto&, const auto&, auto&, FrameVector<ObjectEstimate>& objects) {
    objects.clear();
    const KnownObjectPtr known = make_known_object(test::ball_mesh(kRadius), 1);
    return std::vector<PosedObject>{{known, {Eigen::Matrix3d::Identity(), kMiddle}, 1e-8 * Matrix6d::Identity(), -1}};
  });
  look(stage);
  ASSERT_EQ(stage.shaped_objects().size(), 1u);
  EXPECT_EQ(stage.shaped_objects()[0].object->id, 1);
}

}  // namespace
}  // namespace barehand
