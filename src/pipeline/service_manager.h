#pragma once

#include <cstdint>
#include <string>

#include "core/clock.h"

namespace barehand {

/// Tells systemd how a service of Type=notify is doing (sd_notify). Elsewhere nothing happens.
class ServiceManager {
 public:
  /// `clock` outlives it.
  explicit ServiceManager(const Clock& clock);

  /// Whether there is somebody to tell.
  bool present() const { return present_; }
  /// Any thread. Started, or done with reloading. Of `status` the first line is told.
  void ready(const std::string& status) const;
  /// Any thread. `ready` follows.
  void reloading() const;
  /// Any thread.
  void stopping() const;
  /// Any thread. One line for `systemctl status`.
  void status(const std::string& text) const;
  /// One thread. Something was achieved: feeds the watchdog, no oftener than it needs.
  void alive();

 private:
  const Clock& clock_;
  const bool present_;
  std::int64_t watchdog_us_ = 0;  // 0: there is none
  std::int64_t due_us_ = 0;
};

}  // namespace barehand
