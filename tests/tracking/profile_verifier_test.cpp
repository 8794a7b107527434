#include "tracking/profile_verifier.h"

#include <gtest/gtest.h>

#include <sstream>

#include "hand/skin.h"
#include "support/painted_hand.h"
#include "support/rendered_person.h"
#include "support/text_logger.h"
#include "tracking/quick_tracker.h"

namespace barehand {
namespace {

constexpr double kBad = 0.01, kGood = 1e-5;  // scores far above and far below those of a hand of the observed side [m]

/// Verifies the profile of a right hand while a left hand is observed. The tests set the score of the profile's pose.
class ProfileVerification : public ::testing::Test {
 protected:
  static TrackerParams params() {
    TrackerParams params = test::quick_tracker();
    params.choice.confident_score = 0;  // no score is confident
    return params;
  }
  HandObservationPtr seen() { return test::stamped(*left_hand_, utime_ += 33'000); }
  bool refused(double score) { return verifier_.is_other_side(*seen(), Effort::quick, 1, score); }
  /// Number of frames until the other side is recognised, if the profile's estimates have this score and status. None
  /// if it is not recognised.
  std::optional<int> verification(double score, TrackStatus status = TrackStatus::tracking,
                                  std::optional<double> right_log_odds = {}) {
    HandEstimate own;
    own.status = status;
    own.score = score;
    for (int frame = 1; verifier_.verifying(); ++frame) {
      HandObservation observation = *seen();
      if (right_log_odds) observation.detected = detected(*right_log_odds);
      verifier_.track_mirrored(observation);
      if (verifier_.turns_out_other_side(own)) return frame;
    }
    return std::nullopt;
  }

  std::shared_ptr<const DetectedHand> detected(double right_log_odds) const {
    return std::make_shared<const DetectedHand>(
        test::detected_hand(*left_, test::facing_pose(*left_, 0.5, 0.5), right_log_odds));
  }

  const std::shared_ptr<const HandProfile> right_ = test::adult_hand(), left_ = test::adult_hand(Handedness::left);
  const std::shared_ptr<const Skin> right_skin_ = std::make_shared<const Skin>(make_skin(*right_, 0.004));
  const HandObservationPtr left_hand_ =
      test::observe_skin(make_blended_skin(*left_, 0.004), test::facing_pose(*left_, 0.5, 0.5));
  Workers workers_{1};
  std::ostringstream said_;
  ProfileVerifier verifier_{params(), *right_, right_skin_, 1, workers_, test::text_logger(said_)};
  std::int64_t utime_ = 1'000'000;
};

TEST_F(ProfileVerification, AStartIsRefusedWhereTheMirroredHandIsClearlyBetter) {
  EXPECT_TRUE(refused(kBad));
  EXPECT_FALSE(verifier_.verifying());
  EXPECT_NE(said_.str().find("looks like a left hand"), std::string::npos) << said_.str();
}

TEST_F(ProfileVerification, AHandOfTheOtherSideIsFoundOutWhileItIsTracked) {
  ASSERT_FALSE(refused(kGood));  // the score at the start was good
  ASSERT_TRUE(verifier_.verifying());
  const auto frames = verification(kBad);
  ASSERT_TRUE(frames);
  EXPECT_GE(*frames, 10);
  EXPECT_LE(*frames, 40);
  EXPECT_NE(said_.str().find("looks like a left hand"), std::string::npos) << said_.str();
}

TEST_F(ProfileVerification, AHandOfItsOwnSideIsLeftAlone) {
  ASSERT_FALSE(refused(kGood));
  EXPECT_FALSE(verification(kGood));
  EXPECT_EQ(said_.str(), "");
}

TEST_F(ProfileVerification, OfAHandWhoseSideTheNetworksTellInTheNextFramesFindsNoOther) {
  ASSERT_FALSE(refused(kGood));
  EXPECT_FALSE(verification(kBad, TrackStatus::tracking, 5));
  ASSERT_FALSE(refused(kGood));
  EXPECT_TRUE(verification(kBad, TrackStatus::tracking, 1)) << "they do not tell it";
}

TEST_F(ProfileVerification, EndsWithAHandThatIsLost) {
  ASSERT_FALSE(refused(kGood));
  EXPECT_FALSE(verification(kBad, TrackStatus::lost));
}

TEST_F(ProfileVerification, GoesOnAfterAFrameWithoutTheHand) {
  ASSERT_FALSE(refused(kGood));
  HandEstimate held;
  held.status = TrackStatus::holding;
  verifier_.track_mirrored(*seen());
  EXPECT_FALSE(verifier_.turns_out_other_side(held));
  EXPECT_TRUE(verification(kBad));
}

TEST_F(ProfileVerification, WhereTheNetworksAreSureOfTheSideTheStartWaitsForNoSearch) {
  const auto detected_with = [&](double right_log_odds) {
    auto observation = test::stamped(*left_hand_, utime_ += 33'000);
    observation->detected = detected(right_log_odds);
    EXPECT_FALSE(verifier_.is_detected_as_other_side(*observation));
    return verifier_.is_other_side(*observation, Effort::quick, 1, kBad);
  };
  EXPECT_TRUE(detected_with(1)) << "the networks are not sure, so the mirrored hand is searched, and is better";
  EXPECT_FALSE(detected_with(20));

  // The networks may err, so the next frames verify the side, and then search the mirrored hand before a start.
  ASSERT_TRUE(verifier_.verifying());
  EXPECT_TRUE(verification(kBad));
  EXPECT_TRUE(detected_with(20));
}

TEST_F(ProfileVerification, OnceFoundOutTheOwnSideMustWinSeveralSearches) {
  ASSERT_FALSE(refused(kGood));
  ASSERT_TRUE(verification(kBad));
  EXPECT_TRUE(refused(kGood));
  EXPECT_TRUE(refused(kBad));  // begins another verification
  EXPECT_TRUE(refused(kGood));
  EXPECT_TRUE(refused(kGood));
  EXPECT_FALSE(refused(kGood));
}

TEST_F(ProfileVerification, AnotherSizeIsFoundOutHoweverLongNoHandWasThere) {
  const HandProfile small = scaled(*left_, 0.8);
  ProfileVerifier check(params(), small, std::make_shared<const Skin>(make_skin(small, 0.004)), 1, workers_,
                        test::text_logger(said_));
  for (int i = 0; i < 500; ++i) check.nothing_found(HandObservation{}, INFINITY);
  for (int i = 0; i < 40; ++i) check.nothing_found(*seen(), kBad);
  EXPECT_NE(said_.str().find("% larger"), std::string::npos) << said_.str();
}

TEST_F(ProfileVerification, NoneIsNeededWhereTheStartConvinces) {
  TrackerParams convinced = params();
  convinced.choice.confident_score = 1;
  ProfileVerifier check(convinced, *right_, right_skin_, 1, workers_, test::text_logger(said_));
  EXPECT_FALSE(check.is_other_side(*seen(), Effort::quick, 1, kGood));
  EXPECT_FALSE(check.verifying());
}

}  // namespace
}  // namespace barehand
