// Connects to an LCM network and sends messages.
#include "io/lcm/lcm_bus.h"

#include <cstdlib>
#include <fstream>
#include <lcm/lcm-cpp.hpp>

namespace barehand {
namespace {

constexpr const char* kDefaultUrl = "udpm://239.255.76.67:7667";
constexpr const char* kBufferOption = "recv_buf_size";
constexpr long kReceiveBuffer = 2 << 20;

bool is_udp(const std::string& url) { return url.starts_with("udpm://"); }

/// Adds an option to a URL, unless the URL already has one by that name.
std::string with_option(const std::string& url, const std::string& name, long value) {
  for (const char before : {'?', '&'})
    if (url.find(before + name + "=") != std::string::npos) return url;
  return url + (url.find('?') == std::string::npos ? "?" : "&") + name + "=" + std::to_string(value);
}

std::string chosen_url(const std::string& url) {
  const char* from_environment = std::getenv("LCM_DEFAULT_URL");
  const bool in_environment = from_environment != nullptr && *from_environment != '\0';
  return !url.empty() ? url : in_environment ? from_environment : kDefaultUrl;
}

/// Adds a hop limit and a receive buffer to the URL. With the kernel's default buffer almost every depth image is lost,
/// with 2 MiB none (if the kernel grants that much).
std::string effective_url(const std::string& url, int ttl) {
  const std::string chosen = chosen_url(url);
  return is_udp(chosen) ? with_option(with_option(chosen, "ttl", ttl), kBufferOption, kReceiveBuffer) : chosen;
}

}  // namespace

LcmBus::LcmBus(std::string url, std::unique_ptr<lcm::LCM> lcm) : url_(std::move(url)), lcm_(std::move(lcm)) {}

LcmBus::~LcmBus() = default;

bool LcmBus::is_network(const std::string& url) { return is_udp(effective_url(url, 0)); }

Result<std::unique_ptr<LcmBus>> LcmBus::open(const std::string& url, int ttl) {
  const std::string effective = effective_url(url, ttl);
  auto lcm = std::make_unique<lcm::LCM>(effective);
  // UDP sockets open lazily: asking for the descriptor runs LCM's self test, which fails without a multicast route.
  if (lcm->good() && (!is_udp(effective) || lcm->getFileno() >= 0)) {
    return std::unique_ptr<LcmBus>(new LcmBus(effective, std::move(lcm)));
  }

  // Explain the failure: a network often lacks a multicast route, and other URLs are often misspelt.
  if (is_udp(effective)) {
    return fail("cannot connect to LCM", effective,
                "if there is no multicast route, add one: sudo ip link set lo up; "
                "sudo ip route add 224.0.0.0/4 dev lo; otherwise check the address in the URL");
  }
  return fail("cannot connect to LCM", effective,
              "URLs look like udpm://239.255.76.67:7667?ttl=0, memq:// or file://PATH");
}

std::optional<Error> LcmBus::receive_buffer_shortfall(const std::string& url, const std::string& rmem_max_file) {
  const std::string effective = effective_url(url, 0);
  long granted = 0;
  if (!is_udp(effective) || !(std::ifstream(rmem_max_file) >> granted)) return std::nullopt;
  const auto option = effective.find(std::string(kBufferOption) + "=") + std::string(kBufferOption).size() + 1;
  const long wanted = std::strtol(effective.c_str() + option, nullptr, 10);
  if (granted >= wanted) return std::nullopt;
  const std::string bytes = std::to_string(wanted);
  return Error{"the kernel grants a receive buffer of " + std::to_string(granted) + " bytes instead of " + bytes +
                   ": large depth images from the network are lost",
               effective, "sudo sysctl -w net.core.rmem_max=" + bytes};
}

Result<void> LcmBus::send(const std::string& channel, std::span<const std::uint8_t> message, std::int64_t) {
  if (channel.empty() || channel.size() > kLongestChannel) {
    return fail("channel names have 1 to 63 bytes", channel, "shorten the channel prefix");
  }
  if (message.size() > kLargestMessage) {
    return fail("a message of " + std::to_string(message.size()) + " bytes is too large for LCM", channel,
                "compress it more");
  }
  const std::lock_guard lock(sending_);
  if (lcm_->publish(channel, message.data(), static_cast<unsigned int>(message.size())) != 0) {
    return fail("LCM cannot publish", url_ + " " + channel, "check the network and the multicast route");
  }
  return {};
}

}  // namespace barehand
