#include "stages/grasp/grasp_stage.h"

#include <fstream>

#include "grasp/classifier_file.h"
#include "grasp/grasp_hand.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using test::bent;
using test::grasping_hand;

/// A stage that takes a bent index finger for a wrap, unless nothing touches.
class Grasps : public testing::Test {
 protected:
  static GraspClassifier classifier() {
    constexpr int kIndexPip = 11;
    nlohmann::json file = test::classifier_file(kIndexPip, 20);
    file["bias"][0] = 5;
    file["bias"][1] = -7;
    for (int part = 0; part < kGraspPartCount; ++part) file["touches"][part * 3 + 1] = 3.0;  // none, and it is apart
    const test::TempFolder folder;
    std::ofstream(folder / "grasps.json") << file;
    return GraspClassifier::load(folder / "grasps.json").value();
  }
  HandGrasp see(HandEstimate estimate, std::int64_t utime) {
    estimate.utime = utime;
    return (*stage_.process({std::make_shared<const HandEstimate>(std::move(estimate))}, contacts_).value())[0];
  }
  /// The same hand for a number of frames at 30 Hz, from this time.
  HandGrasp hold(const HandEstimate& estimate, std::int64_t utime, int frames) {
    HandGrasp last;
    for (int n = 0; n < frames; ++n) last = see(estimate, utime + 33'333 * n);
    return last;
  }

  GraspStage stage_{classifier()};
  FrameContactsPtr contacts_;  // null: nobody looked
  HandEstimate open_ = grasping_hand(bent(0.2, 0.25, 0.15));
};

TEST_F(Grasps, NothingIsStatedOfAHandThatIsNotTracked) {
  for (const auto status : {TrackStatus::searching, TrackStatus::holding, TrackStatus::lost}) {
    open_.status = status;
    EXPECT_FALSE(see(open_, 1'000'000).known);
  }
}

TEST_F(Grasps, AnOpenHandGraspsNothing) {
  const HandGrasp grasp = hold(open_, 1'000'000, 30);
  EXPECT_TRUE(grasp.known);
  EXPECT_EQ(grasp.grasp, 0);
  EXPECT_EQ(grasp.since, 1'000'000);
  EXPECT_GT(grasp.probabilities[0], 0.5);
  EXPECT_GT(grasp.aperture, 0.03);
}

TEST_F(Grasps, AHandThatClosesGraspsSinceThatTime) {
  hold(open_, 1'000'000, 30);
  const HandEstimate closed = grasping_hand(bent(0.9, 1.0, 0.6));
  const HandGrasp grasp = hold(closed, 2'000'000, 60);
  EXPECT_EQ(grasp.grasp, 1);
  EXPECT_GE(grasp.since, 2'000'000);
  EXPECT_LT(grasp.since, 3'000'000);
  EXPECT_GT(grasp.closure, 0.4);
}

TEST_F(Grasps, AFistAroundNothingGraspsNothing) {
  const HandEstimate closed = grasping_hand(bent(0.9, 1.0, 0.6));
  EXPECT_EQ(hold(closed, 1'000'000, 30).grasp, 1) << "nobody looked";
  const auto contacts = std::make_shared<FrameContacts>();
  contacts->hands.resize(1);
  contacts_ = contacts;
  EXPECT_EQ(hold(closed, 10'000'000, 30).grasp, 1) << "nothing is known";
  for (Contact& contact : contacts->hands[0].object) contact.state = ContactState::none;
  EXPECT_EQ(hold(closed, 20'000'000, 30).grasp, 0);
}

TEST_F(Grasps, AnotherHandAndALongGapBeginAnew) {
  hold(open_, 1'000'000, 30);
  EXPECT_EQ(see(open_, 2'050'000).since, 1'000'000);
  EXPECT_EQ(see(open_, 9'000'000).since, 9'000'000) << "after a gap";
  open_.hand_id = 2;
  EXPECT_EQ(see(open_, 9'033'000).since, 9'033'000) << "another hand";
}

}  // namespace
}  // namespace barehand
