#include "stages/grasp/grasp_classifier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>

#include "grasp/classifier_file.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using Json = nlohmann::json;

/// Class 1 (wrap) scores twice the first feature.
Json small_file() { return test::classifier_file(0, 2); }

class GraspClassifiers : public testing::Test {
 protected:
  Result<GraspClassifier> load(const std::string& text) {
    const std::string path = folder_ / "grasps.json";
    std::ofstream(path) << text;
    return GraspClassifier::load(path);
  }
  /// The message of the error with which a file is refused after this change; "" if it is accepted.
  std::string refusal(const std::function<void(Json&)>& change) {
    Json json = small_file();
    change(json);
    const auto loaded = load(json.dump());
    return loaded ? "" : loaded.error().message();
  }
  test::TempFolder folder_;
};

GraspFeatures features(double first, double deviation = 0) {
  GraspFeatures out;
  out.values.setZero();
  out.values[0] = first;
  out.spread.setZero();
  out.spread(0, 3) = deviation;
  return out;
}

TEST_F(GraspClassifiers, AreLogistic) {
  const auto classifier = load(small_file().dump());
  ASSERT_TRUE(classifier) << classifier.error().message();
  const auto log_p = classifier->classify(features(1.5));
  EXPECT_NEAR(log_p[1], 3 - std::log(std::exp(3) + 17), 1e-12);
  EXPECT_NEAR(log_p[0], -std::log(std::exp(3) + 17), 1e-12);
}

TEST_F(GraspClassifiers, AddUpTheRowsOfOneClass) {
  Json json = small_file();
  json["classes"].push_back("none");
  json["bias"].push_back(0.0);
  json["weights"].insert(json["weights"].end(), kGraspFeatureCount, 0.0);
  const auto classifier = load(json.dump());
  ASSERT_TRUE(classifier) << classifier.error().message();
  const auto log_p = classifier->classify(features(0));
  EXPECT_NEAR(log_p[0], std::log(2.0 / 19), 1e-12);
  EXPECT_NEAR(log_p[5], std::log(1.0 / 19), 1e-12);
}

TEST_F(GraspClassifiers, DecideLessWhereThePoseIsUncertain) {
  const auto classifier = load(small_file().dump());
  ASSERT_TRUE(classifier);
  const double score = 3 / std::sqrt(1 + std::numbers::pi / 8 * 4 * 0.25);  // weight 2, deviation 0.5
  EXPECT_NEAR(classifier->classify(features(1.5, 0.5))[1], score - std::log(std::exp(score) + 17), 1e-12);
  EXPECT_NEAR(classifier->classify(features(1.5, 1e6))[1], std::log(1.0 / 18), 1e-4) << "nothing is known";
}

TEST_F(GraspClassifiers, FilesThatCannotBeUsedAreRefusedWithTheReason) {
  EXPECT_EQ(refusal([](Json&) {}), "");
  using testing::HasSubstr;
  EXPECT_THAT(refusal([](Json& j) { j["interface"] = 2; }), HasSubstr("interface 2"));
  EXPECT_THAT(refusal([](Json& j) { j.erase("interface"); }), HasSubstr("interface"));
  EXPECT_THAT(refusal([](Json& j) { j["classes"][3] = "hook"; }), HasSubstr("hook"));
  EXPECT_THAT(refusal([](Json& j) { j["classes"].erase(17); }), HasSubstr("lacks writing_tripod"));
  EXPECT_THAT(refusal([](Json& j) { j.erase("classes"); }), HasSubstr("classes"));
  EXPECT_THAT(refusal([](Json& j) { j["weights"].erase(0); }), HasSubstr("weights"));
  EXPECT_THAT(refusal([](Json& j) { j["weights"][7] = nullptr; }), HasSubstr("weights"));
  EXPECT_THAT(refusal([](Json& j) { j["weights"][7] = 1e9; }), HasSubstr("weights"));
  EXPECT_THAT(refusal([](Json& j) { j["deviation"][0] = 0; }), HasSubstr("deviation"));
  EXPECT_THAT(refusal([](Json& j) { j["memory"] = 0; }), HasSubstr("memory"));
  EXPECT_THAT(refusal([](Json& j) { j.erase("spread"); }), HasSubstr("spread"));
  EXPECT_FALSE(load("[1, 2]"));
  EXPECT_FALSE(load("{"));
  EXPECT_FALSE(GraspClassifier::load("no/such/file.json"));
}

TEST_F(GraspClassifiers, TheShippedOneIsGood) {
  const auto classifier = GraspClassifier::load(BAREHAND_CONFIGS "/grasps.json");
  EXPECT_TRUE(classifier) << classifier.error().message();
}

}  // namespace
}  // namespace barehand
