// Receives the messages of an LCM bus on a thread of its own.
#include "drivers/lcm/lcm_listener.h"

#include <lcm/lcm-cpp.hpp>

#include "core/glob.h"
#include "drivers/lcm/fragment_filter.h"

namespace barehand {

void LcmListener::hand_on(const lcm_recv_buf_t* buffer, const char* channel, void* listener) {
  auto& self = *static_cast<LcmListener*>(listener);
  self.bus_->wait_for_sender();
  self.handler_(channel, {static_cast<const std::uint8_t*>(buffer->data), buffer->data_size});
}

LcmListener::LcmListener(std::shared_ptr<LcmBus> bus, const std::string& channels, Handler handler)
    : bus_(std::move(bus)), handler_(std::move(handler)) {
  subscription_ = lcm_subscribe(bus_->lcm().getUnderlyingLCM(), glob_to_regex(channels).c_str(), &hand_on, this);
  broken_ = subscription_ == nullptr;  // it is null if liblcm rejected the pattern
  drop_damaged_fragments();
  thread_ = std::thread([this] { run(); });
}

LcmListener::~LcmListener() {
  stop_ = true;
  thread_.join();
  if (subscription_ != nullptr) lcm_unsubscribe(bus_->lcm().getUnderlyingLCM(), subscription_);
}

void LcmListener::run() {
  constexpr int kWait_ms = 20;  // longest wait for a message, which limits the time that stopping takes
  while (!stop_) {
    if (bus_->lcm().handleTimeout(kWait_ms) < 0) {
      broken_ = true;
      return;
    }
  }
}

}  // namespace barehand
