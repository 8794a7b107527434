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

}  // namespace
}  // namespace barehand
