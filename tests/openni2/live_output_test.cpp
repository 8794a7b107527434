#include "drivers/openni2/live_output.h"

#include <gmock/gmock.h>

namespace barehand {
namespace {

TEST(LiveOutput, SaysEachTimeThatATroubleIsOver) {
  ManualClock clock;
  LiveOutput output("openni2", 1, clock);
  for (int i = 0; i < 2; ++i) {
    output.notice("colour stopped", "colour stopped");
    output.notice("colour is back", "colour is back", "", false);
  }
  std::vector<std::string> said;
  while (const auto event = output.box().take(std::chrono::milliseconds(0)))
    said.push_back(std::get<SourceNotice>(*event).error.what);
  EXPECT_THAT(said, ::testing::ElementsAre("colour stopped", "colour is back", "colour is back"));
}

TEST(LiveOutput, SaysLessAndLessOftenWhatItWaitsFor) {
  ManualClock clock;
  LiveOutput output("openni2", 1, clock);
  const auto said_in = [&](int seconds) {
    int said = 0;
    for (int s = 0; s < seconds; ++s, clock.advance(1'000'000)) {
      output.await("absent", "no sensor yet", "plug it in");
      while (output.box().take(std::chrono::milliseconds(0))) ++said;
    }
    return said;
  };
  EXPECT_EQ(said_in(3600), 6) << "at 0, 3, 15, 63, 255 and 1023 s";
  output.end_waiting();
  EXPECT_EQ(said_in(4), 2) << "another wait begins anew";
}

}  // namespace
}  // namespace barehand
