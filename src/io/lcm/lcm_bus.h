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
  /// Connects to `url`, in LCM's form: "udpm://239.255.76.67:7667", "memq://", "file://..."; "": the environment's
  /// LCM_DEFAULT_URL, or else the first of these. A UDP URL without recv_buf_size gets one that holds depth images, one
  /// without ttl gets `ttl`, which limits how far messages are sent: 0 to this machine, 1 to the local network. Errors
  /// name the remedy, such as the command that adds a missing multicast route.
  static Result<std::unique_ptr<LcmBus>> open(const std::string& url, int ttl = 0);
  ~LcmBus() override;
  /// Whether `url` is a network (UDP), to which open() may fail now and succeed later.
  static bool is_network(const std::string& url);

  /// Sends a message. Over UDP, success only means that the message has left, not that anybody receives it.
  Result<void> send(const std::string& channel, std::span<const std::uint8_t> message, std::int64_t utime) override;

  /// Call it first in a handler of messages: waits until no send() is in progress, from which the message may have
  /// come. memq:// passes messages between threads under GLib's locks, which use futexes that the thread sanitizer does
  /// not know.
  void wait_for_sender() const { const std::lock_guard lock(sending_); }

  /// Reports if the kernel grants a smaller receive buffer than `url` asks for, and how to enlarge it; none if it
  /// grants all or does not state its limit. `rmem_max_file`: the file in which it states the limit.
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

/// Largest message that can be sent [bytes]: larger ones are unreliable over UDP, and sending one is an error.
inline constexpr std::size_t kLargestMessage = 4u << 20;

}  // namespace barehand
