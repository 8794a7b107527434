#include "drivers/lcm/lcm_listener.h"

#include <lcm/lcm-cpp.hpp>

namespace barehand {

void LcmListener::hand_on(const lcm_recv_buf_t* buffer, const char* channel, void* listener) {
  auto& self = *static_cast<LcmListener*>(listener);
  self.bus_->wait_for_sender();
  self.handler_(channel, {static_cast<const std::uint8_t*>(buffer->data), buffer->data_size});
}

std::string glob_to_regex(const std::string& glob) {
  std::string regex;
  for (const char c : glob) {
    if (c == '*') {
      regex += ".*";
    } else if (c == '?') {
      regex += '.';
    } else {
      if (std::string_view(".^$|()[]{}+\\").find(c) != std::string_view::npos) regex += '\\';
      regex += c;
    }
  }
  return regex;
}

LcmListener::LcmListener(std::shared_ptr<LcmBus> bus, const std::string& channels, Handler handler)
    : bus_(std::move(bus)), handler_(std::move(handler)) {
  subscription_ = lcm_subscribe(bus_->lcm().getUnderlyingLCM(), glob_to_regex(channels).c_str(), &hand_on, this);
  thread_ = std::thread([this] { run(); });
}

LcmListener::~LcmListener() {
  stop_ = true;
  thread_.join();
  lcm_unsubscribe(bus_->lcm().getUnderlyingLCM(), subscription_);
}

void LcmListener::run() {
  constexpr int kWait_ms = 20;  // how long a stop may take
  while (!stop_) {
    if (bus_->lcm().handleTimeout(kWait_ms) < 0) {
      broken_ = true;
      return;
    }
  }
}

}  // namespace barehand
