#pragma once

#include <cstdint>
#include <string>

#include "core/clock.h"

namespace barehand {

/// Reports the state of a service of Type=notify to systemd (sd_notify). Does nothing if systemd did not start it.
class ServiceManager {
 public:
  /// `clock` must outlive this object.
  explicit ServiceManager(const Clock& clock);

  /// Whether a service manager listens.
  bool present() const { return present_; }
  /// Reports that the service has started, or has reloaded its configuration, with the first line of `status`. Any
  /// thread may call it.
  void ready(const std::string& status) const;
  /// Reports that the service reloads its configuration; call ready() when that is done. Any thread may call it.
  void reloading() const;
  /// Reports that the service shuts down. Any thread may call it.
  void stopping() const;
  /// Sends the first line of `text` for `systemctl status`. Any thread may call it.
  void status(const std::string& text) const;
  /// Feeds the watchdog, at most four times in its period. Call whenever the pipeline has made progress, from one
  /// thread only.
  void alive();

 private:
  const Clock& clock_;
  const bool present_;
  std::int64_t watchdog_us_ = 0;  // period of the watchdog; 0: there is none
  std::int64_t due_us_ = 0;       // earliest time of the next watchdog message; steady clock
};

}  // namespace barehand
