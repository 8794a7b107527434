#include "stages/grasp/grasp_classifier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "grasp/classifier_file.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using Json = nlohmann::json;

/// Class 1 (wrap) scores twice the hyperbolic tangent of the first feature.
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

GraspFeatures features(double first) {
  GraspFeatures out;
  out.values.setZero();
  out.values[0] = first;
  out.deviations.setZero();
  return out;
}

TEST_F(GraspClassifiers, AreNetworks) {
  const auto classifier = load(small_file().dump());
  ASSERT_TRUE(classifier) << classifier.error().message();
  const auto log_p = classifier->classify(features(1.5));
  const double score = 2 * std::tanh(1.5);
  EXPECT_NEAR(log_p[1], score - std::log(std::exp(score) + 17), 1e-12);
  EXPECT_NEAR(log_p[0], -std::log(std::exp(score) + 17), 1e-12);
}

TEST_F(GraspClassifiers, ReadEveryLayerRowByRow) {
  Json json = small_file();
  json["mean"][2] = 0.5;
  json["deviation"][2] = 0.25;
  json["hidden_bias"] = {0.0, 0.1};  // the second unit sees the third feature
  for (int input = 0; input < test::kClassifierInputs; ++input)
    json["hidden_weights"].push_back(input == 2 ? 2.0 : 0.0);
  json["weights"] = std::vector<double>(2 * kGraspCount, 0.0);
  json["weights"][2 * 4 + 1] = 3.0;
  json["bias"][4] = -1.0;
  const auto classifier = load(json.dump());
  ASSERT_TRUE(classifier) << classifier.error().message();

  GraspFeatures seen = features(0);
  seen.values[2] = 0.6;
  const double score = 3 * std::tanh(2 * (0.6 - 0.5) / 0.25 + 0.1) - 1;
  EXPECT_NEAR(classifier->classify(seen)[4], score - std::log(std::exp(score) + 17), 1e-12);
}

TEST_F(GraspClassifiers, AJointOfWhichLittleIsKnownIsAsGoodAsUnknown) {
  const auto classifier = load(test::classifier_file(kGraspFeatureCount + 3, 10).dump());
  ASSERT_TRUE(classifier);
  const auto with = [&](double deviation) {
    GraspFeatures seen = features(0);
    seen.deviations[3] = deviation;
    return classifier->classify(seen)[1];
  };
  EXPECT_GT(with(0.2), with(0.1));
  EXPECT_DOUBLE_EQ(with(5), with(0.3));
}

TEST_F(GraspClassifiers, TouchesCountForTheClassesThatTheySpeakFor) {
  Json json = small_file();
  constexpr std::size_t kPinch = 12, kThumb = 1;
  json["touches"][(kPinch * kGraspPartCount + kThumb) * 3 + 2] = std::log(4.0);  // the thumb touches
  const auto classifier = load(json.dump());
  ASSERT_TRUE(classifier) << classifier.error().message();

  GraspFeatures seen = features(0);
  seen.touches.emplace();
  EXPECT_NEAR(std::exp(classifier->classify(seen)[kPinch]), 1.0 / 18, 1e-12) << "nothing is known";
  (*seen.touches)[kThumb] = PartTouch::apart;
  EXPECT_NEAR(std::exp(classifier->classify(seen)[kPinch]), 1.0 / 18, 1e-12);
  (*seen.touches)[kThumb] = PartTouch::touching;
  EXPECT_NEAR(std::exp(classifier->classify(seen)[kPinch]), 4.0 / 21, 1e-12);
  EXPECT_NEAR(std::exp(classifier->classify(seen)[1]), 1.0 / 21, 1e-12);
}

TEST_F(GraspClassifiers, AddUpTheRowsOfOneClass) {
  Json json = small_file();
  json["classes"].push_back("none");
  json["bias"].push_back(0.0);
  json["weights"].push_back(0.0);
  const auto classifier = load(json.dump());
  ASSERT_TRUE(classifier) << classifier.error().message();
  const auto log_p = classifier->classify(features(0));
  EXPECT_NEAR(log_p[0], std::log(2.0 / 19), 1e-12);
  EXPECT_NEAR(log_p[5], std::log(1.0 / 19), 1e-12);
}

TEST_F(GraspClassifiers, FilesThatCannotBeUsedAreRefusedWithTheReason) {
  EXPECT_EQ(refusal([](Json&) {}), "");
  using testing::HasSubstr;
  EXPECT_THAT(refusal([](Json& j) { j["interface"] = 1; }), HasSubstr("interface 1"));
  EXPECT_THAT(refusal([](Json& j) { j.erase("interface"); }), HasSubstr("interface"));
  EXPECT_THAT(refusal([](Json& j) { j["classes"][3] = "hook"; }), HasSubstr("hook"));
  EXPECT_THAT(refusal([](Json& j) { j["classes"].erase(17); }), HasSubstr("lacks writing_tripod"));
  EXPECT_THAT(refusal([](Json& j) { j.erase("classes"); }), HasSubstr("classes"));
  EXPECT_THAT(refusal([](Json& j) { j["weights"].erase(0); }), HasSubstr("weights"));
  EXPECT_THAT(refusal([](Json& j) { j["weights"][7] = nullptr; }), HasSubstr("weights"));
  EXPECT_THAT(refusal([](Json& j) { j["weights"][7] = 1e9; }), HasSubstr("weights"));
  EXPECT_THAT(refusal([](Json& j) { j["deviation"][0] = 0; }), HasSubstr("deviation"));
  EXPECT_THAT(refusal([](Json& j) { j["memory"] = 0; }), HasSubstr("memory"));
  EXPECT_THAT(refusal([](Json& j) { j["hidden_weights"].erase(0); }), HasSubstr("hidden_weights"));
  EXPECT_THAT(refusal([](Json& j) { j.erase("hidden_bias"); }), HasSubstr("hidden_bias"));
  EXPECT_THAT(refusal([](Json& j) { j["hidden_bias"] = std::vector<double>(65, 0.0); }), HasSubstr("1 to 64"));
  EXPECT_THAT(refusal([](Json& j) { j.erase("touches"); }), HasSubstr("touches"));
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
