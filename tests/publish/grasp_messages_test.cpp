#include "stages/publish/grasp_messages.h"

#include <cmath>

#include "published_hand.h"

namespace barehand {
namespace {

HandEstimate estimate() { return estimate_of(*test::adult_hand(Handedness::left), {}, 7'000'000); }

TEST(GraspMessages, SumOverTheClassesThatShareAProperty) {
  HandGrasp grasp;
  grasp.known = true;
  grasp.grasp = grasp_state_t::WRAP;
  grasp.since = 5'000'000;
  grasp.aperture = 0.04;
  grasp.closure = 0.6;
  grasp.probabilities[grasp_state_t::NONE] = 0.05;
  grasp.probabilities[grasp_state_t::WRAP] = 0.35;    // power, palm, abducted, 2-5
  grasp.probabilities[grasp_state_t::PINCH] = 0.3;    // precision, pad, abducted, 2
  grasp.probabilities[grasp_state_t::LATERAL] = 0.1;  // intermediate, side, adducted, 2
  grasp.probabilities[grasp_state_t::TRIPOD] = 0.2;   // precision, pad, abducted, 2-3
  const grasp_state_t m = grasp_message(estimate(), TrackStatus::tracking, grasp);
  EXPECT_EQ(m.utime, 7'000'000);
  EXPECT_EQ(m.sensor, "test");
  EXPECT_EQ(m.hand_id, 5);
  EXPECT_EQ(m.handedness, 0);
  EXPECT_EQ(m.grasp, grasp_state_t::WRAP);
  EXPECT_EQ(m.probability, 0.35);
  EXPECT_EQ(m.probabilities[grasp_state_t::TRIPOD], 0.2);
  EXPECT_EQ(m.since, 5'000'000);
  EXPECT_EQ(m.kind, grasp_state_t::PRECISION);
  EXPECT_NEAR(m.kind_probability, 0.5, 1e-12);
  EXPECT_EQ(m.opposition, grasp_state_t::PAD);
  EXPECT_NEAR(m.opposition_probability, 0.5, 1e-12);
  EXPECT_EQ(m.thumb, grasp_state_t::ABDUCTED);
  EXPECT_NEAR(m.thumb_probability, 0.85, 1e-12);
  EXPECT_EQ(m.first_finger, 2);
  EXPECT_EQ(m.last_finger, 2);
  EXPECT_NEAR(m.finger_probability, 0.4, 1e-12);
  EXPECT_EQ(m.aperture, 0.04);
  EXPECT_EQ(m.closure, 0.6);
}

TEST(GraspMessages, WithoutAGraspNothingOpposesTheThumb) {
  HandGrasp grasp;
  grasp.known = true;
  grasp.probabilities[0] = 0.9;
  grasp.probabilities[grasp_state_t::PINCH] = 0.1;
  const grasp_state_t m = grasp_message(estimate(), TrackStatus::tracking, grasp);
  EXPECT_EQ(m.grasp, grasp_state_t::NONE);
  for (const std::int8_t state : {m.kind, m.opposition, m.thumb, m.first_finger, m.last_finger}) EXPECT_EQ(state, 0);
  EXPECT_EQ(m.kind_probability, 0.9);
}

TEST(GraspMessages, OfAHandThatIsNotTrackedEverythingIsUnknown) {
  const grasp_state_t m = grasp_message(estimate(), TrackStatus::tracking, {});
  for (const std::int8_t state : {m.grasp, m.kind, m.opposition, m.thumb, m.first_finger, m.last_finger})
    EXPECT_EQ(state, grasp_state_t::UNKNOWN);
  for (const double number :
       {m.probability, m.probabilities[0], m.probabilities[17], m.kind_probability, m.opposition_probability,
        m.thumb_probability, m.finger_probability, m.aperture, m.closure})
    EXPECT_TRUE(std::isnan(number));
  EXPECT_EQ(m.since, 0);
}

TEST(GraspMessages, ConstantsAreTheClassesOfTheTable) {
  EXPECT_EQ(grasp_type_from_name("wrap"), grasp_state_t::WRAP - 1);
  EXPECT_EQ(grasp_type_from_name("lateral"), grasp_state_t::LATERAL - 1);
  EXPECT_EQ(grasp_type_from_name("writing_tripod"), grasp_state_t::WRITING_TRIPOD - 1);
  EXPECT_EQ(static_cast<int>(GraspKind::precision), grasp_state_t::PRECISION);
  EXPECT_EQ(static_cast<int>(Opposition::side), grasp_state_t::SIDE);
  EXPECT_EQ(static_cast<int>(ThumbPosition::adducted), grasp_state_t::ADDUCTED);
}

}  // namespace
}  // namespace barehand
