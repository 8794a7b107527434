// Tests two trackers on one network (UDP on the loopback interface). To be started by with_multicast.sh.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <mutex>
#include <set>

#include "barehand/hand_state_t.hpp"
#include "drivers/lcm/lcm_listener.h"
#include "support/barehand_program.h"
#include "support/quick_config.h"

namespace barehand {
namespace {

using ::testing::ElementsAre;

/// Every process uses another port, so that tests that run at the same time do not receive each other's messages.
int port() { return 20'000 + ::getpid() % 40'000; }
std::string url() { return "udpm://239.255.76.67:" + std::to_string(port()); }

/// The shipped configuration with this channel prefix and LCM time to live (ttl).
std::string configuration(const test::TempFolder& folder, const std::string& prefix, int ttl) {
  std::string config = test::replaced(test::quick_config(), "channel_prefix: \"\"", "channel_prefix: " + prefix);
  config = test::replaced(config, "lcm_ttl: 0", "lcm_ttl: " + std::to_string(ttl));
  const std::string path = folder / prefix + ".yaml";
  test::write_text(path, config);
  return path;
}

std::vector<std::string> track(const std::string& config, const std::string& hand) {
  return {BAREHAND_PROGRAM, "track",
          "--config",       config,
          "--lcm-url",      url(),
          "--threads",      "1",
          "--source",       "sim:fist,frames=6,width=160,height=120,hand=" + hand};
}

/// Subscribes to the channels with one prefix, i.e. of one sensor.
class Subscriber {
 public:
  explicit Subscriber(const std::string& prefix)
      : listener_(LcmBus::open(url()).value(), prefix + "*", [this](const std::string& channel, WireBytes message) {
          const std::lock_guard lock(mutex_);
          channels_.insert(channel);
          hand_state_t state;
          if (!channel.ends_with("HAND_STATE")) return;
          ASSERT_GT(state.decode(message.data(), 0, static_cast<int>(message.size())), 0);
          frames_.push_back(state.frame_number);
          hands_.insert(state.handedness);
        }) {}
  std::vector<std::int64_t> frames() const { return under_lock(frames_); }
  std::set<int> hands() const { return under_lock(hands_); }
  std::set<std::string> channels() const { return under_lock(channels_); }

 private:
  template <class T>
  T under_lock(const T& value) const {
    const std::lock_guard lock(mutex_);
    return value;
  }

  mutable std::mutex mutex_;
  std::vector<std::int64_t> frames_;
  std::set<int> hands_;
  std::set<std::string> channels_;
  LcmListener listener_;  // last member, since it must be destroyed first
};

/// Receives packets and their times to live (ttl), which limit how many routers they may pass.
class Ranges {
 public:
  Ranges() : socket_(socket(AF_INET, SOCK_DGRAM, 0)) {
    const int on = 1;
    setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
    setsockopt(socket_, IPPROTO_IP, IP_RECVTTL, &on, sizeof(on));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port()));
    if (bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0) throw std::runtime_error("bind");
    ip_mreq group{};
    group.imr_multiaddr.s_addr = inet_addr("239.255.76.67");
    if (setsockopt(socket_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof(group)) != 0)
      throw std::runtime_error("no multicast");
  }
  ~Ranges() { close(socket_); }

  /// The times to live of all received packets whose channel starts with `prefix`.
  std::set<int> of(const std::string& prefix) {
    read_all();
    std::set<int> found;
    for (const auto& [channel, ttl] : packets_)
      if (channel.starts_with(prefix)) found.insert(ttl);
    return found;
  }

 private:
  void read_all() {
    constexpr std::size_t kHeader = 8;  // bytes of an LCM short message before its channel: magic, sequence number
    std::array<char, 65536> packet{};
    alignas(cmsghdr) std::array<char, 64> extra{};
    iovec data{packet.data(), packet.size() - 1};
    for (;;) {
      msghdr message{};
      message.msg_iov = &data;
      message.msg_iovlen = 1;
      message.msg_control = extra.data();
      message.msg_controllen = extra.size();
      const auto size = recvmsg(socket_, &message, MSG_DONTWAIT);
      if (size < 0) return;
      packet[static_cast<std::size_t>(size)] = '\0';
      const cmsghdr* ttl = CMSG_FIRSTHDR(&message);
      if (static_cast<std::size_t>(size) > kHeader && ttl && ttl->cmsg_type == IP_TTL)
        packets_.insert({packet.data() + kHeader, *reinterpret_cast<const int*>(CMSG_DATA(ttl))});
    }
  }

  const int socket_;
  std::set<std::pair<std::string, int>> packets_;
};

TEST(TwoTrackers, AreHeardApart) {
  const test::TempFolder folder;
  const std::string desk = configuration(folder, "DESK_", 0), wall = configuration(folder, "WALL_", 1);
  Ranges ranges;
  Subscriber of_desk("DESK_"), of_wall("WALL_");
  ChildProcess first(track(desk, "right")), second(track(wall, "left"));
  ASSERT_EQ(first.finish(), 0) << first.output();
  ASSERT_EQ(second.finish(), 0) << second.output();
  for (int i = 0; i < 500 && (of_desk.frames().size() < 6 || of_wall.frames().size() < 6); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));

  EXPECT_THAT(of_desk.frames(), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(of_wall.frames(), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(of_desk.hands(), ElementsAre(+hand_state_t::RIGHT));
  EXPECT_THAT(of_wall.hands(), ElementsAre(+hand_state_t::LEFT));
  for (const char* name : {"HAND_STATE", "GLOVE_STATE", "HAND_JOINTS"}) {
    EXPECT_TRUE(of_desk.channels().contains(std::string("DESK_") + name)) << name;
    EXPECT_TRUE(of_wall.channels().contains(std::string("WALL_") + name)) << name;
  }
  EXPECT_THAT(ranges.of("DESK_"), ElementsAre(0));
  EXPECT_THAT(ranges.of("WALL_"), ElementsAre(1));
}

TEST(TwoTrackers, AnLcmUrlWithATtlGoesBefore) {
  Ranges ranges;
  const std::vector<std::uint8_t> message{1, 2, 3};
  ASSERT_TRUE(LcmBus::open(url(), 2).value()->send("NEAR", message, 0));
  ASSERT_TRUE(LcmBus::open(url() + "?recv_buf_size=100000&ttl=0", 2).value()->send("HERE", message, 0));
  for (int i = 0; i < 500 && (ranges.of("HERE").empty() || ranges.of("NEAR").empty()); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_THAT(ranges.of("NEAR"), ElementsAre(2));
  EXPECT_THAT(ranges.of("HERE"), ElementsAre(0));
}

}  // namespace
}  // namespace barehand
