// Tests LCM over UDP on the loopback interface. To be started by with_multicast.sh.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <lcm/lcm-cpp.hpp>

#include "barehand/command_t.hpp"
#include "drivers/lcm/frame_codec.h"
#include "drivers/lcm/layouts.h"
#include "drivers/lcm/lcm_live_source.h"
#include "test_frames.h"

namespace barehand {
namespace {

constexpr std::chrono::milliseconds kLong(20'000);  // a timeout that is reached only by failing tests

/// Every process uses another port, so that tests that run at the same time do not receive each other's messages.
int port() { return 20'000 + ::getpid() % 40'000; }
constexpr const char* kGroup = "239.255.76.67";
std::string url() { return std::string("udpm://") + kGroup + ":" + std::to_string(port()) + "?ttl=0"; }

std::unique_ptr<LcmBus> connect() {
  auto bus = LcmBus::open(url());
  if (!bus) throw std::runtime_error(bus.error().message());
  return std::move(*bus);
}

std::vector<std::uint8_t> frame_bytes(const RgbdFrame& frame, const FrameEncoding& encoding = {}) {
  return encode_message(encode_frame(frame, encoding).value());
}

TEST(Udp, AFrameCrossesTheNetwork) {
  auto sender = connect();
  auto source = LcmLiveSource::open(url()).value();
  ASSERT_TRUE(sender->send("RGBD_FRAME", frame_bytes(test_frame(1)), 0));
  const SourceEvent event = source->next(kLong);
  ASSERT_TRUE(std::holds_alternative<FramePtr>(event));
  expect_same_frame(*std::get<FramePtr>(event), test_frame(1));
}

TEST(Udp, LargeFramesArriveInFragments) {
  auto sender = connect();
  auto source = LcmLiveSource::open(url()).value();
  for (std::int64_t number = 1; number <= 5; ++number) {
    const auto bytes = frame_bytes(test_frame(number, 640, 480));
    ASSERT_GT(bytes.size(), 100'000u);
    ASSERT_TRUE(sender->send("RGBD_FRAME", bytes, 0));
    const SourceEvent event = source->next(kLong);
    ASSERT_TRUE(std::holds_alternative<FramePtr>(event)) << number;
    EXPECT_EQ(std::get<FramePtr>(event)->number, number);
  }
  EXPECT_EQ(source->counts().lost, 0);
}

TEST(Udp, AForeignMessageIsSkippedAndTheNextFrameArrives) {
  auto sender = connect();
  auto source = LcmLiveSource::open(url()).value();
  ASSERT_TRUE(sender->send("RGBD_FRAME", encode_message(command_t{}), 0));
  EXPECT_TRUE(std::holds_alternative<SkippedFrame>(source->next(kLong)));
  ASSERT_TRUE(sender->send("RGBD_FRAME", frame_bytes(test_frame(2)), 0));
  EXPECT_TRUE(std::holds_alternative<FramePtr>(source->next(kLong)));
}

/// Sends a fragment of a message of 1000 bytes on RGBD_FRAME that claims to begin at `offset`.
void send_fragment(std::uint32_t offset) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port()));
  ASSERT_EQ(inet_pton(AF_INET, kGroup, &to.sin_addr), 1);
  std::string datagram;
  for (const std::uint32_t word : {0x4c433033u, 1u, 1000u, offset, offset == 0 ? 3u : 0x10003u})
    for (int shift = 24; shift >= 0; shift -= 8) datagram += static_cast<char>(word >> shift);
  if (offset == 0) datagram += std::string("RGBD_FRAME") + '\0';
  datagram += std::string(300, 'x');
  EXPECT_GT(sendto(socket, datagram.data(), datagram.size(), 0, reinterpret_cast<sockaddr*>(&to), sizeof(to)), 0);
  ::close(socket);
}

TEST(Udp, AFragmentFromOutsideItsMessageIsDropped) {
  auto sender = connect();
  auto source = LcmLiveSource::open(url()).value();
  send_fragment(0);
  send_fragment(0xffffff00);  // liblcm would write 256 bytes before its buffer
  ASSERT_TRUE(sender->send("RGBD_FRAME", frame_bytes(test_frame(1, 640, 480)), 0));
  EXPECT_TRUE(std::holds_alternative<FramePtr>(source->next(kLong)));
}

/// A receiver that subscribes but never handles a message, so that its queue and its socket become full.
class DeafSubscriber {
 public:
  DeafSubscriber() : bus_(connect()) { lcm_subscribe(bus_->lcm().getUnderlyingLCM(), "HAND_STATE", ignore, nullptr); }

 private:
  static void ignore(const lcm_recv_buf_t*, const char*, void*) {}
  std::unique_ptr<LcmBus> bus_;
};

TEST(Udp, ASubscriberThatNeverReadsDoesNotStallThePublisher) {
  const DeafSubscriber deaf;
  auto sender = connect();
  auto source = LcmLiveSource::open(url(), {.channel = "HAND_STATE"}).value();
  const std::vector<std::uint8_t> state(60'000, 1);
  // Send far more than all buffers of this receiver hold. A sender that waited for it would block here.
  for (int i = 0; i < 2000; ++i) ASSERT_TRUE(sender->send("HAND_STATE", state, 0));
  while (source->counts().received == 0) std::this_thread::yield();
}

}  // namespace
}  // namespace barehand
