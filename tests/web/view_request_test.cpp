#include "io/web/view_request.h"

#include <gtest/gtest.h>

namespace barehand {
namespace {

TEST(ViewRequest, SaysWhatIsWantedOfEveryFrame) {
  const auto request = parse_view_request(
      R"({"type": "want", "cloud": "hand", "picture": "depth", "large": true, "rate": 15.5, "window": 2})");
  ASSERT_TRUE(request) << request.error().message();
  const auto& settings = std::get<ViewSettings>(*request);
  EXPECT_EQ(settings.cloud, ViewCloud::hand);
  EXPECT_EQ(settings.picture, ViewPicture::depth);
  EXPECT_TRUE(settings.large);
  EXPECT_EQ(settings.rate, 15.5);
  EXPECT_EQ(settings.window, 2);
}

TEST(ViewRequest, WantsStatesAloneUnlessItSaysMore) {
  const auto request = parse_view_request(R"({"type": "want"})");
  ASSERT_TRUE(request);
  const auto& settings = std::get<ViewSettings>(*request);
  EXPECT_EQ(settings.cloud, ViewCloud::none);
  EXPECT_EQ(settings.picture, ViewPicture::none);
  EXPECT_EQ(settings.window, 0);
}

TEST(ViewRequest, CommandsThePlayer) {
  const auto request = parse_view_request(R"({"type": "step", "value": -3})");
  ASSERT_TRUE(request);
  const auto& command = std::get<PlayerCommand>(*request);
  EXPECT_EQ(command.kind, PlayerCommand::Kind::step);
  EXPECT_EQ(command.value, -3);
  EXPECT_TRUE(std::holds_alternative<ViewAcknowledge>(parse_view_request(R"({"type": "ack"})").value()));
}

TEST(ViewRequest, StartsAndStopsARecording) {
  for (const bool on : {true, false}) {
    const auto request = parse_view_request(std::string(R"({"type": "record", "on": )") + (on ? "true}" : "false}"));
    ASSERT_TRUE(request) << request.error().message();
    EXPECT_EQ(std::get<RecordCommand>(*request).on, on);
  }
}

TEST(ViewRequest, ARecordingGoesWhereTheProgramSays) {
  for (const char* text :
       {R"({"type": "record"})", R"({"type": "record", "on": 1})", R"({"type": "record", "on": null})",
        R"({"type": "record", "value": true})", R"({"type": "record", "on": "true"})",
        R"({"type": "record", "on": true, "folder": "/etc"})", R"({"type": "record", "on": true, "name": "../../a"})"})
    EXPECT_FALSE(parse_view_request(text)) << text;
}

TEST(ViewRequest, RefusesWhatItDoesNotKnow) {
  for (const char* text : {"",
                           "{",
                           "[]",
                           "7",
                           "null",
                           "\"want\"",
                           "{}",
                           R"({"type": 7})",
                           R"({"type": "fly"})",
                           "\xff\xfe",
                           R"({"type": "want", "cloud": true})",
                           R"({"type": "want", "picture": "infrared"})",
                           R"({"type": "want", "rate": 0})",
                           R"({"type": "want", "rate": 1e400})",
                           R"({"type": "want", "rate": "fast"})",
                           R"({"type": "want", "window": -1})",
                           R"({"type": "want", "window": 101})",
                           R"({"type": "want", "window": 0.5})",
                           R"({"type": "seek", "value": 1e30})",
                           R"({"type": "seek"})",
                           R"({"type": "seek", "value": -1})",
                           R"({"type": "step"})",
                           R"({"type": "speed"})",
                           R"({"type": "speed", "value": 0})",
                           R"({"type": "speed", "value": 1000})",
                           R"({"type": "lost", "value": 7})",
                           R"({"type": "play", "value": 1})"})
    EXPECT_FALSE(parse_view_request(text)) << text;
}

TEST(ViewRequest, NamesAKeyThatItDoesNotKnowAndThoseThatItKnows) {
  EXPECT_EQ(parse_view_request(R"({"type": "want", "clowd": "hand"})").error().message(),
            "message of a client: unknown key \"clowd\" (besides the type there may be cloud, picture, large, rate, "
            "window)");
  for (const char* text : {R"({"type": "ack", "frame": 7})", R"({"type": "seek", "frame": 7})",
                           R"({"type": "record", "on": true, "value": 1})"})
    EXPECT_FALSE(parse_view_request(text)) << text;
}

TEST(ViewRequest, SurvivesDeepNesting) { EXPECT_FALSE(parse_view_request(std::string(60000, '['))); }

}  // namespace
}  // namespace barehand
