#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "io/lcm/message_sink.h"

namespace lcm {
class LCM;
}

namespace barehand {

/// A connection to an LCM network. Publishing is allowed from any thread; only one thread may receive.
class LcmBus : public MessageSink {
 public:
  /// `url` as LCM takes it: "udpm://239.255.76.67:7667", "memq://", "file://..."; "": LCM_DEFAULT_URL, then the first
  /// of these. A UDP URL without recv_buf_size gets one that holds depth images, one without ttl gets `ttl`: how
  /// far what is sent goes, 0 this machine, 1 the local network. Errors name the remedy, such as the command that adds
  /// a missing multicast route.
  static Result<std::unique_ptr<LcmBus>> open(const std::string& url, int ttl = 0);
  ~LcmBus() override;
  /// Whether it is a network that open() fails for (UDP): it may come later.
  static bool is_network(const std::string& url);

  /// Over UDP success only means that the message left: whether anybody receives it is not known.
  Result<void> send(const std::string& channel, std::span<const std::uint8_t> message, std::int64_t utime) override;

  /// First thing in a handler of messages: returns when no send() is under way that the message may come from. memq://
  /// hands messages from thread to thread under locks of GLib, bare futexes that the thread sanitizer does not know.
  void wait_for_sender() const { const std::lock_guard lock(sending_); }

  /// What the kernel does not grant of the receive buffer that `url` asks for, and how it would; none: it grants all,
  /// or does not tell. `rmem_max_file`: where it says the most that it grants.
  static std::optional<Error> receive_buffer_shortfall(
      const std::string& url, const std::string& rmem_max_file = "/proc/sys/net/core/rmem_max");

  lcm::LCM& lcm() { return *lcm_; }
  const std::string& url() const { return url_; }

 private:
  LcmBus(std::string url, std::unique_ptr<lcm::LCM> lcm);

  std::string url_;
  std::unique_ptr<lcm::LCM> lcm_;
  mutable std::mutex sending_;
};

/// Larger messages are unreliable over UDP (about 4 MiB); sending one is an error.
inline constexpr std::size_t kLargestMessage = 4u << 20;

}  // namespace barehand
