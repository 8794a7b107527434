#include "tracking/profile_check.h"

#include <gtest/gtest.h>

#include <sstream>

#include "hand/skin.h"
#include "support/painted_hand.h"
#include "support/text_logger.h"
#include "tracking/quick_tracker.h"

namespace barehand {
namespace {

constexpr double kBad = 0.01, kGood = 1e-5;  // scores far above and far below those of a hand of the observed side [m]

/// The observed hand is a left hand, and the profile is that of a right hand; the test says how well the profile
/// explains it.
class ProfileOnTrial : public ::testing::Test {
 protected:
  static TrackerParams params() {
    TrackerParams params = test::quick_tracker();
    params.choice.search_convincing = 0;  // no score is convincing
    return params;
  }
  HandObservationPtr seen() { return test::stamped(*left_hand_, utime_ += 33'000); }
  bool refused(double score) { return check_.is_other_side(*seen(), Effort::quick, 1, score); }
  /// Number of frames until the other side is recognised, for the profile's own `score` and status; none if it is not.
  std::optional<int> trial(double score, TrackStatus status = TrackStatus::tracking) {
    HandEstimate own;
    own.status = status;
    own.score = score;
    for (int frame = 1; check_.on_trial(); ++frame) {
      check_.track_mirrored(*seen());
      if (check_.turns_out_other_side(own)) return frame;
    }
    return std::nullopt;
  }

  const std::shared_ptr<const HandProfile> right_ = test::adult_hand(), left_ = test::adult_hand(Handedness::left);
  const HandObservationPtr left_hand_ =
      test::observe_skin(make_blended_skin(*left_, 0.004), test::facing_pose(*left_, 0.5, 0.5));
  Workers workers_{1};
  std::ostringstream said_;
  ProfileCheck check_{params(), *right_, 1, workers_, test::text_logger(said_)};
  std::int64_t utime_ = 1'000'000;
};

TEST_F(ProfileOnTrial, AStartIsRefusedWhereTheMirroredHandIsClearlyBetter) {
  EXPECT_TRUE(refused(kBad));
  EXPECT_FALSE(check_.on_trial());
  EXPECT_NE(said_.str().find("looks like a left hand"), std::string::npos) << said_.str();
}

TEST_F(ProfileOnTrial, AHandOfTheOtherSideIsFoundOutWhileItIsTracked) {
  ASSERT_FALSE(refused(kGood));  // the start looked good
  ASSERT_TRUE(check_.on_trial());
  const auto frames = trial(kBad);
  ASSERT_TRUE(frames);
  EXPECT_GE(*frames, 10);
  EXPECT_LE(*frames, 40);
  EXPECT_NE(said_.str().find("looks like a left hand"), std::string::npos) << said_.str();
}

TEST_F(ProfileOnTrial, AHandOfItsOwnSideIsLeftAlone) {
  ASSERT_FALSE(refused(kGood));
  EXPECT_FALSE(trial(kGood));
  EXPECT_EQ(said_.str(), "");
}

TEST_F(ProfileOnTrial, EndsWithAHandThatIsLost) {
  ASSERT_FALSE(refused(kGood));
  EXPECT_FALSE(trial(kBad, TrackStatus::lost));
}

TEST_F(ProfileOnTrial, GoesOnAfterAFrameWithoutTheHand) {
  ASSERT_FALSE(refused(kGood));
  HandEstimate held;
  held.status = TrackStatus::holding;
  check_.track_mirrored(*seen());
  EXPECT_FALSE(check_.turns_out_other_side(held));
  EXPECT_TRUE(trial(kBad));
}

TEST_F(ProfileOnTrial, OnceFoundOutTheOwnSideMustWinSeveralSearches) {
  ASSERT_FALSE(refused(kGood));
  ASSERT_TRUE(trial(kBad));
  EXPECT_TRUE(refused(kGood));
  EXPECT_TRUE(refused(kBad));  // begins another trial
  EXPECT_TRUE(refused(kGood));
  EXPECT_TRUE(refused(kGood));
  EXPECT_FALSE(refused(kGood));
}

TEST_F(ProfileOnTrial, AnotherSizeIsFoundOutHoweverLongNoHandWasThere) {
  ProfileCheck check(params(), scaled(*left_, 0.8), 1, workers_, test::text_logger(said_));
  for (int i = 0; i < 500; ++i) check.nothing_found(HandObservation{}, INFINITY);
  for (int i = 0; i < 40; ++i) check.nothing_found(*seen(), kBad);
  EXPECT_NE(said_.str().find("% larger"), std::string::npos) << said_.str();
}

TEST_F(ProfileOnTrial, NoneIsNeededWhereTheStartConvinces) {
  TrackerParams convinced = params();
  convinced.choice.search_convincing = 1;
  ProfileCheck check(convinced, *right_, 1, workers_, test::text_logger(said_));
  EXPECT_FALSE(check.is_other_side(*seen(), Effort::quick, 1, kGood));
  EXPECT_FALSE(check.on_trial());
}

}  // namespace
}  // namespace barehand
