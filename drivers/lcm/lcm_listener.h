#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "drivers/lcm/wire.h"
#include "io/lcm/lcm_bus.h"

struct _lcm_recv_buf_t;
struct _lcm_subscription_t;  // types of liblcm

namespace barehand {

/// A thread that receives the messages of a bus and passes them on, undecoded, until it is destroyed. A bus may have at
/// most one listener. The handler must be quick: LCM drops the newest message when its queue is full.
class LcmListener {
 public:
  /// Called on the listener's thread; the bytes are valid during the call.
  using Handler = std::function<void(const std::string& channel, WireBytes message)>;

  /// `channels` is a glob (matches_glob) in UTF-8: "*RGBD_FRAME". If liblcm rejects it, broken() is true.
  LcmListener(std::shared_ptr<LcmBus> bus, const std::string& channels, Handler handler);
  ~LcmListener();
  LcmListener(const LcmListener&) = delete;
  LcmListener& operator=(const LcmListener&) = delete;

  /// Whether the connection is broken, so that no more messages arrive.
  bool broken() const { return broken_; }

 private:
  void run();
  /// Called by liblcm for each message. Subscriptions use LCM's C interface, because its C++ interface crashes in
  /// builds with -fsanitize=undefined (g++ 12 miscompiles `(subs->handler->*subs->handlerMethod)(...)` of
  /// lcm-cpp-impl.hpp).
  static void hand_on(const _lcm_recv_buf_t* buffer, const char* channel, void* listener);

  std::shared_ptr<LcmBus> bus_;
  Handler handler_;
  _lcm_subscription_t* subscription_ = nullptr;
  std::atomic<bool> stop_{false}, broken_{false};
  std::thread thread_;
};

}  // namespace barehand
