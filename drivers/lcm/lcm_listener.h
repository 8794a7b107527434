#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "drivers/lcm/wire.h"
#include "io/lcm/lcm_bus.h"

struct _lcm_recv_buf_t;
struct _lcm_subscription_t;  // liblcm's own

namespace barehand {

/// One thread that receives the messages of a bus and hands them on, undecoded, until it is destroyed. At most one
/// per bus. The handler must be quick: LCM drops the newest message when its queue is full.
class LcmListener {
 public:
  /// Called on the listener's thread; the bytes are valid during the call.
  using Handler = std::function<void(const std::string& channel, WireBytes message)>;

  /// `channels` is a glob (matches_glob) in UTF-8: "*RGBD_FRAME". A glob that liblcm refuses leaves the connection
  /// broken.
  LcmListener(std::shared_ptr<LcmBus> bus, const std::string& channels, Handler handler);
  ~LcmListener();
  LcmListener(const LcmListener&) = delete;
  LcmListener& operator=(const LcmListener&) = delete;

  /// The connection broke; nothing more will come.
  bool broken() const { return broken_; }

 private:
  void run();
  /// Subscriptions go through LCM's C interface: its C++ one crashes in builds with -fsanitize=undefined (g++ 12 gets
  /// `(subs->handler->*subs->handlerMethod)(...)` of lcm-cpp-impl.hpp wrong).
  static void hand_on(const _lcm_recv_buf_t* buffer, const char* channel, void* listener);

  std::shared_ptr<LcmBus> bus_;
  Handler handler_;
  _lcm_subscription_t* subscription_ = nullptr;
  std::atomic<bool> stop_{false}, broken_{false};
  std::thread thread_;
};

}  // namespace barehand
