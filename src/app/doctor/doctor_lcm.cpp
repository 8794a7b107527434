// Checks for `barehand doctor` whether LCM messages arrive.
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <vector>

#include "app/doctor/doctor_checks.h"
#include "drivers/lcm/lcm_listener.h"
#include "io/lcm/lcm_bus.h"

namespace barehand {
namespace {

// At least kMessages are sent, one after the other: the next one when all before have been received, or after kAgain.
// All must have been received after kPatience.
constexpr int kMessages = 5;
constexpr std::chrono::milliseconds kPatience{10'000}, kAgain{500};
constexpr std::size_t kSize = 150'000;  // size of a compressed VGA depth image [bytes]

/// Counts the messages that are received.
struct Mailbox {
  std::mutex mutex;
  std::condition_variable changed;
  int received = 0;

  void put() {
    std::unique_lock lock(mutex);
    ++received;
    changed.notify_all();
  }
  /// Waits for `count` messages, but not longer than kAgain; returns how many have been received so far.
  int wait_for(int count) {
    std::unique_lock lock(mutex);
    changed.wait_for(lock, kAgain, [&] { return received >= count; });
    return received;
  }
};

}  // namespace

Finding check_lcm(const std::string& lcm_url) {
  const std::string subject = "LCM";
  auto opened = LcmBus::open(lcm_url);
  if (!opened)
    return {Finding::Level::problem, subject, opened.error().where + ": " + opened.error().what, opened.error().remedy};
  const std::shared_ptr<LcmBus> bus = std::move(*opened);

  // Listen on a channel that no other process uses.
  const std::string channel = "BAREHAND_DOCTOR_" + std::to_string(getpid());
  Mailbox mailbox;
  const LcmListener listener(bus, channel, [&](const std::string&, WireBytes message) {
    if (message.size() == kSize) mailbox.put();
  });
  const std::vector<std::uint8_t> message(kSize, 0x5a);
  // Send until all messages have been received, since some may be late on a busy machine. The deadline is for messages
  // that are lost.
  int sent = 0, received = 0;
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (sent < kMessages || (received < sent && std::chrono::steady_clock::now() < deadline)) {
    if (auto ok = bus->send(channel, message, 0); !ok)
      return {Finding::Level::problem, subject, ok.error().message(), ok.error().remedy};
    received = mailbox.wait_for(++sent);
  }

  // Judge LCM by the number of messages that came back.
  const std::string text = std::to_string(received) + " of " + std::to_string(sent) +
                           " messages of a depth image's size came back over " + bus->url();
  if (received == sent) return {Finding::Level::ok, subject, text, ""};
  if (received > 0)
    return {Finding::Level::warning, subject, text,
            "enlarge the receive buffer: sudo sysctl -w net.core.rmem_max=2097152"};
  return {Finding::Level::problem, subject, text, "check the multicast route and the firewall"};
}

}  // namespace barehand
