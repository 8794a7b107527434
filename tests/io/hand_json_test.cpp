#include "io/hand/hand_json.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "hand/skin.h"
#include "math/angles.h"
#include "support/resource_limit.h"
#include "support/small_hand.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

using nlohmann::json;
using test::small_hand;
using testing::AllOf;
using testing::HasSubstr;

class HandJson : public testing::Test {
 protected:
  HandJson() { EXPECT_TRUE(save_profile(small_hand(), path_)); }

  json saved() const { return json::parse(test::read_text(path_)); }
  /// The error after a change to a good file.
  std::string error_after(const std::function<void(json&)>& change) const {
    json changed = saved();
    change(changed);
    test::write_text(path_, changed.dump());
    const auto profile = load_profile(path_);
    return profile ? "accepted" : profile.error().message();
  }

  test::TempFolder folder_;
  std::string path_ = folder_ / "hand.json";
};

void expect_same(const HandProfile& a, const HandProfile& b) {
  EXPECT_EQ(a.handedness, b.handedness);
  for (int s = 0; s < kSegmentCount; ++s) {
    const SegmentProfile &x = a.segments[s], &y = b.segments[s];
    EXPECT_TRUE(x.T_hand_segment.matrix().isApprox(y.T_hand_segment.matrix(), 1e-8)) << kSegmentNames[s];
    EXPECT_NEAR(x.length, y.length, 1e-9);
    EXPECT_NEAR((x.distal - y.distal).norm(), 0, 1e-9);
    for (int end = 0; end < 2; ++end) {
      EXPECT_NEAR(x.radius[end], y.radius[end], 1e-9);
      EXPECT_NEAR(x.half_width[end], y.half_width[end], 1e-9);
      EXPECT_NEAR(x.half_thickness[end], y.half_thickness[end], 1e-9);
      EXPECT_NEAR(x.flesh_offset_x[end], y.flesh_offset_x[end], 1e-9);
      EXPECT_NEAR(x.flesh_offset_y[end], y.flesh_offset_y[end], 1e-9);
    }
    ASSERT_EQ(x.dofs.size(), y.dofs.size());
    for (std::size_t d = 0; d < x.dofs.size(); ++d) {
      EXPECT_EQ(x.dofs[d].name, y.dofs[d].name);
      EXPECT_NEAR((x.dofs[d].axis - y.dofs[d].axis).norm(), 0, 1e-9);
      EXPECT_NEAR(x.dofs[d].lower, y.dofs[d].lower, 1e-9);
      EXPECT_NEAR(x.dofs[d].upper, y.dofs[d].upper, 1e-9);
    }
  }
}

TEST_F(HandJson, SavedProfileComesBack) {
  const auto profile = load_profile(path_);
  ASSERT_TRUE(profile) << profile.error().message();
  expect_same(*profile, small_hand());
}

TEST_F(HandJson, UnknownKeysAreAllowedAndOrderDoesNotMatter) {
  json changed = saved();
  changed["measured_by"] = "someone";
  changed["segments"][3]["openxr_tip_length"] = 0.02;
  std::reverse(changed["segments"].begin(), changed["segments"].end());
  test::write_text(path_, changed.dump());
  const auto profile = load_profile(path_);
  ASSERT_TRUE(profile) << profile.error().message();
  expect_same(*profile, small_hand());
}

TEST_F(HandJson, SkinWithoutEllipsesIsRound) {
  json changed = saved();
  for (const char* key : {"half_width", "half_thickness", "flesh_offset_x", "flesh_offset_y"})
    changed["segments"][5].erase(key);
  test::write_text(path_, changed.dump());
  const auto profile = load_profile(path_);
  ASSERT_TRUE(profile);
  EXPECT_DOUBLE_EQ(profile->segments[5].half_width[0], 0.01);
  EXPECT_DOUBLE_EQ(profile->segments[5].half_thickness[1], 0.008);
  EXPECT_DOUBLE_EQ(profile->segments[5].flesh_offset_y[0], 0);
  EXPECT_NEAR(profile->segments[6].half_width[0], 0.011, 1e-12);
}

TEST_F(HandJson, MissingFileAndBadSyntaxAreNamed) {
  EXPECT_THAT(load_profile(folder_ / "none.json").error().message(), HasSubstr("none.json: cannot be read"));
  EXPECT_THAT(load_profile(folder_ / ".").error().message(), HasSubstr(".: is a folder"));
  test::write_text(path_, "{\n\"handedness\": right}");
  EXPECT_THAT(load_profile(path_).error().message(), HasSubstr("line 2"));
}

TEST_F(HandJson, MissingSegmentIsNamed) {
  EXPECT_THAT(error_after([](json& j) { j["segments"].erase(9); }),
              AllOf(HasSubstr("hand.json"), HasSubstr("middle_distal is missing")));
}

TEST_F(HandJson, DoubledAndUnknownSegmentsAreNamed) {
  EXPECT_THAT(error_after([](json& j) { j["segments"].push_back(j["segments"][4]); }),
              HasSubstr("index_proximal occurs twice"));
  EXPECT_THAT(error_after([](json& j) { j["segments"][4]["name"] = "sixth_proximal"; }),
              HasSubstr("\"sixth_proximal\" is not a segment"));
}

TEST_F(HandJson, WrongParentIsNamed) {
  EXPECT_THAT(error_after([](json& j) { j["segments"][6]["parent"] = "middle_intermediate"; }),
              AllOf(HasSubstr("segment index_distal"), HasSubstr("\"parent\" is \"middle_intermediate\"")));
}

TEST_F(HandJson, CycleIsSpelledOut) {
  EXPECT_THAT(error_after([](json& j) { j["segments"][4]["parent"] = "index_distal"; }),
              AllOf(HasSubstr("cycle"), HasSubstr("index_distal -> index_intermediate -> index_proximal")));
}

struct BadValue {
  const char* label;
  const char* key;
  json value;
  const char* complaint;
};

class HandJsonBadValue : public HandJson, public testing::WithParamInterface<BadValue> {};

TEST_P(HandJsonBadValue, NamesSegmentAndKey) {
  const BadValue& bad = GetParam();
  const std::string error = error_after([&](json& j) {
    if (bad.value.is_discarded())
      j["segments"][5].erase(bad.key);
    else
      j["segments"][5][bad.key] = bad.value;
  });
  EXPECT_THAT(error, AllOf(HasSubstr("segment index_intermediate"), HasSubstr("\"" + std::string(bad.key) + "\""),
                           HasSubstr(bad.complaint)));
}

const json kAbsent(json::value_t::discarded);

INSTANTIATE_TEST_SUITE_P(Values, HandJsonBadValue,
                         testing::Values(BadValue{"NegativeRadius", "proximal_radius", -0.01, "-0.01"},
                                         BadValue{"MillimetreRadius", "distal_radius", 8, "from 0.0005 to 0.1"},
                                         BadValue{"TextRadius", "distal_radius", "8 mm", "not a number"},
                                         BadValue{"NoRadius", "proximal_radius", kAbsent, "missing"},
                                         BadValue{"ZeroLength", "length", 0, "from 0.001"},
                                         BadValue{"MillimetreLength", "length", 30, "to 0.3"},
                                         BadValue{"LengthNotOfTheBone", "length", 0.05, "contradicts"},
                                         BadValue{"BoneBackwards", "distal_local", {0, 0, 0.03}, "along -z"},
                                         BadValue{"NegativeWidth", "half_width", {0.01, -0.01}, "-0.01"},
                                         BadValue{"OneThickness", "half_thickness", {0.01}, "2 numbers"},
                                         BadValue{"NoDofs", "dofs", kAbsent, "missing"},
                                         BadValue{"NoParent", "parent", kAbsent, "missing"},
                                         BadValue{"NoTransform", "rest_transform", kAbsent, "missing"},
                                         BadValue{"CentimetrePosition",
                                                  "rest_transform",
                                                  {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, -11}, {0, 0, 0, 1}},
                                                  "10.92 m from its parent's"},
                                         BadValue{"Scaled",
                                                  "rest_transform",
                                                  {{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 2, 0}, {0, 0, 0, 1}},
                                                  "not hold a right-handed rotation"},
                                         BadValue{"Mirrored",
                                                  "rest_transform",
                                                  {{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}},
                                                  "not hold a right-handed rotation"},
                                         BadValue{"ColumnMajor",
                                                  "rest_transform",
                                                  {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0.1, 0, -0.1, 1}},
                                                  "0 0 0 1"}),
                         [](const auto& info) { return info.param.label; });

TEST_F(HandJson, BadDofIsNamed) {
  const auto with = [this](const char* key, json value) {
    EXPECT_TRUE(save_profile(small_hand(), path_));
    return error_after([&](json& j) { j["segments"][4]["dofs"][1][key] = value; });
  };
  EXPECT_THAT(with("axis", {0, 0.5, 0}), AllOf(HasSubstr("index_proximal: dof flex"), HasSubstr("unit vector")));
  EXPECT_THAT(with("axis", {0, 0, 1}), HasSubstr("along the bone"));
  EXPECT_THAT(with("limits_deg", {90, -20}), HasSubstr("lower limit above"));
  EXPECT_THAT(with("limits_deg", {-20, 900}), HasSubstr("900"));
}

TEST_F(HandJson, HandednessMustBeKnown) {
  EXPECT_THAT(error_after([](json& j) { j["handedness"] = "both"; }), HasSubstr("\"both\""));
  EXPECT_THAT(error_after([](json& j) { j.erase("handedness"); }), HasSubstr("\"handedness\" is missing"));
}

TEST_F(HandJson, FullDiskIsReported) {
  const auto saved = save_profile(small_hand(), "/dev/full");
  ASSERT_FALSE(saved);
  EXPECT_THAT(saved.error().message(), HasSubstr("/dev/full: cannot be written"));
}

TEST_F(HandJson, ADiskThatFillsUpKeepsTheProfileBefore) {
  {
    const test::FileSizeLimit full(100);
    EXPECT_FALSE(save_profile(scaled(small_hand(), 1.1), path_));
  }
  const auto kept = load_profile(path_);
  ASSERT_TRUE(kept) << kept.error().message();
  EXPECT_NEAR(kept->hand_length(), small_hand().hand_length(), 1e-6);
  EXPECT_FALSE(std::filesystem::exists(path_ + ".unfinished"));
}

/// A triangle across the index finger's knuckle.
HandProfile with_skin(HandProfile hand) {
  const auto palm = static_cast<std::int16_t>(kPalm), finger = static_cast<std::int16_t>(segment_of(1, 0));
  Skin skin;
  skin.vertices = {{palm, palm, 0, {0.01f, 0, -0.08f}, {0.01f, 0, -0.08f}, {0, 1, 0}},
                   {palm, finger, 0.25f, {0, 0.002f, -0.09f}, {0, 0.001f, 0.005f}, {0, 1, 0}},
                   {finger, finger, 0, {-0.004f, 0, -0.01f}, {-0.004f, 0, -0.01f}, {0, 1, 0}}};
  skin.triangles = {{0, 1, 2}};
  hand.scanned_skin = std::make_shared<const Skin>(skin);
  return hand;
}

TEST_F(HandJson, KeepsAScannedSkin) {
  const HandProfile hand = with_skin(small_hand());
  ASSERT_TRUE(save_profile(hand, path_));
  const auto loaded = load_profile(path_);
  ASSERT_TRUE(loaded) << loaded.error().message();
  ASSERT_TRUE(loaded->scanned_skin);
  const Skin &saved = *hand.scanned_skin, &skin = *loaded->scanned_skin;
  EXPECT_EQ(skin.triangles, saved.triangles);
  ASSERT_EQ(skin.vertices.size(), saved.vertices.size());
  for (std::size_t i = 0; i < skin.vertices.size(); ++i) {
    EXPECT_EQ(skin.vertices[i].a, saved.vertices[i].a);
    EXPECT_EQ(skin.vertices[i].b, saved.vertices[i].b);
    EXPECT_FLOAT_EQ(skin.vertices[i].weight_b, saved.vertices[i].weight_b);
    EXPECT_LT((skin.vertices[i].in_a - saved.vertices[i].in_a).norm(), 1e-6f);
    EXPECT_LT((skin.vertices[i].in_b - saved.vertices[i].in_b).norm(), 1e-6f);
    EXPECT_NEAR(skin.vertices[i].normal_in_a.norm(), 1, 1e-5);
  }
}

TEST_F(HandJson, BadSkinIsNamed) {
  const auto with = [this](const std::function<void(json&)>& change) {
    EXPECT_TRUE(save_profile(with_skin(small_hand()), path_));
    return error_after(change);
  };
  const auto vertex = [&](const json& row) { return with([&](json& j) { j["skin"]["vertices"][1] = row; }); };
  const auto bad_vertex = AllOf(HasSubstr("skin"), HasSubstr("\"vertices\" 1 must be a place"));
  EXPECT_THAT(vertex({0, 0.1, 0.1}), bad_vertex);
  EXPECT_THAT(vertex({16, 0, 0, 0}), bad_vertex);
  EXPECT_THAT(vertex({0.5, 0, 0, 0}), bad_vertex);
  EXPECT_THAT(vertex({0, 0, 0, 80}), bad_vertex);                  // millimetres
  EXPECT_THAT(vertex({0, 0, 0, 0, 5, 0.2, 0, 0, 0}), bad_vertex);  // segment 5 is no neighbour of segment 0
  EXPECT_THAT(vertex({0, 0, 0, 0, 4, 0.7, 0, 0, 0}), bad_vertex);  // the second segment's weight exceeds 0.5
  EXPECT_THAT(vertex({0, 0, 0, nullptr}), bad_vertex);
  for (const json& row : {json{0, 1, 3}, json{0, 1, -1}, json{0, 1}, json{0, 1, 1.5}})
    EXPECT_THAT(with([&](json& j) { j["skin"]["triangles"][0] = row; }), HasSubstr("\"triangles\" 0 must be three"))
        << row;
  EXPECT_THAT(with([](json& j) { j["skin"].erase("vertices"); }), HasSubstr("\"vertices\" is missing"));
  EXPECT_THAT(with([](json& j) { j["skin"] = 3; }), HasSubstr("\"vertices\" is missing"));
  EXPECT_THAT(with([](json& j) { j["mean_hand"] = true; }), HasSubstr("beside \"mean_hand\""));
}

TEST_F(HandJson, LimitsInRadiansAreRefusedAndAFewStiffJointsAreNot) {
  const auto limits_times = [&](double factor, int joints) {
    EXPECT_TRUE(save_profile(small_hand(), path_));
    return error_after([&](json& hand) {
      for (json& segment : hand["segments"])
        for (json& dof : segment["dofs"])
          if (joints-- > 0)
            for (json& limit : dof["limits_deg"]) limit = factor * limit.get<double>();
    });
  };
  EXPECT_THAT(limits_times(kDegree, 100), AllOf(HasSubstr("look like radians"), HasSubstr("180 / pi")));
  EXPECT_THAT(limits_times(kDegree, 15), HasSubstr("look like radians"));
  EXPECT_EQ(limits_times(kDegree, 6), "accepted") << "a splint";
  EXPECT_EQ(limits_times(0, 100), "accepted") << "fixed on purpose";
}

TEST_F(HandJson, ARotationWithRoundedNumbersIsNamedAsSuch) {
  const auto rounded_to = [&](double unit) {
    EXPECT_TRUE(save_profile(small_hand(), path_));
    return error_after([&](json& hand) {
      for (json& segment : hand["segments"])
        for (json& row : segment["rest_transform"])
          for (json& number : row) number = std::round(number.get<double>() / unit) * unit;
    });
  };
  EXPECT_THAT(rounded_to(0.01), HasSubstr("perhaps its numbers are rounded"));
  EXPECT_EQ(rounded_to(1e-5), "accepted");
}

}  // namespace
}  // namespace barehand
