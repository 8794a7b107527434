// Tests that a flood of commands from the network does not stop the tracking. To be started by with_multicast.sh.
#include <gmock/gmock.h>

#include <atomic>
#include <csignal>
#include <sstream>
#include <thread>

#include "drivers/lcm/layouts.h"
#include "drivers/lcm/lcm_listener.h"
#include "support/child_process.h"
#include "support/quick_config.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Sends commands of every kind until it is destroyed or kMost were sent.
class Flood {
 public:
  explicit Flood(const std::string& url) : bus_(LcmBus::open(url).value()) {
    command_t reset{}, profile{};
    reset.hand_id = profile.hand_id = command_t::ANY_HAND;
    reset.command = command_t::RESET;
    profile.command = command_t::SET_PROFILE;
    profile.profile = test::read_text(BAREHAND_CONFIGS "/hands/adult_right.json");
    messages_ = {encode_message(reset), encode_message(profile), std::vector<std::uint8_t>(100, 0x5a)};
    thread_ = std::thread([this] { send(); });
  }
  ~Flood() {
    stop_ = true;
    thread_.join();
  }
  static constexpr int kMost = 200'000;
  int sent() const { return sent_; }

 private:
  void send() {
    for (; !stop_ && sent_ < kMost; ++sent_) {
      (void)bus_->send("COMMAND", messages_[static_cast<std::size_t>(sent_) % messages_.size()], 0);
      if (sent_ % 50 == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));  // at most 2,500 commands per second
    }
  }
  std::unique_ptr<LcmBus> bus_;
  std::vector<std::vector<std::uint8_t>> messages_;
  std::atomic<bool> stop_ = false;
  std::atomic<int> sent_ = 0;
  std::thread thread_;
};

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSlow = true;  // every reset causes a search that takes ten seconds
#else
constexpr bool kSlow = false;
#endif
constexpr int kFrames = kSlow ? 1 : 45;  // number of frames that must be tracked during the flood

class CommandFlood : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    std::string text = test::quick_config();
    if (GetParam()) text = test::replaced(text, "  commands: false", "  commands: true");
    text = test::replaced(text, " sampling: true", " sampling: false");
    test::write_text(config_, text);
  }
  const std::string url_ = "udpm://239.255.76.67:" + std::to_string(20'000 + getpid() % 40'000) + "?ttl=0";
  const test::TempFolder folder_;
  const std::string config_ = folder_ / "config.yaml";
};

INSTANTIATE_TEST_SUITE_P(Commands, CommandFlood, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "followed" : "off"; });

int lines_of(const std::string& output, const std::string& word) {
  std::istringstream lines(output);
  int count = 0;
  for (std::string line; std::getline(lines, line);) count += line.find(word) != std::string::npos;
  return count;
}

TEST_P(CommandFlood, DoesNotStopTheTracking) {
  std::atomic<int> tracked = 0;
  const LcmListener listener(LcmBus::open(url_).value(), "HAND_STATE", [&](const std::string&, WireBytes bytes) {
    hand_state_t state;
    const bool whole = state.decode(bytes.data(), 0, static_cast<int>(bytes.size())) > 0;
    if (whole && state.status == hand_state_t::TRACKING) ++tracked;
  });
  ChildProcess child({BAREHAND_PROGRAM, "track", "--source", "sim:fist,live=true,loop=true,width=160,height=120",
                      "--config", config_, "--lcm-url", url_, "--health"});
  while (tracked == 0) ASSERT_TRUE(child.wait_for_more()) << child.output();
  int sent = 0;
  {
    const Flood flood(url_);
    while (flood.sent() < 1000) std::this_thread::yield();
    const int before = tracked;
    while (tracked < before + kFrames && (kSlow || flood.sent() < Flood::kMost)) ASSERT_TRUE(child.wait_for_more());
    EXPECT_GE(tracked, before + kFrames) << child.output();
    sent = flood.sent();
  }
  child.signal(SIGTERM);
  EXPECT_EQ(child.finish(), 0) << child.output();
  if (GetParam())
    EXPECT_THAT(child.output(), HasSubstr("command: use the given hand profile"));
  else
    EXPECT_THAT(child.output(), Not(HasSubstr("command: ")));
  EXPECT_LT(10 * lines_of(child.output(), "command"), sent) << "the log is flooded";
  if (!kSlow) {
    EXPECT_LT(child.peak_memory(), 512 << 20);
  }
}

}  // namespace
}  // namespace barehand
