// Notifies systemd of the program's state.
#include "pipeline/service_manager.h"

#include <systemd/sd-daemon.h>

#include <cstdlib>

#include "core/quote.h"

namespace barehand {
namespace {

/// The status assignment of a message to systemd. Every line of such a message is one assignment, so only the text's
/// first line can be sent.
std::string status_line(const std::string& text) {
  return "STATUS=" + as_utf8(text.substr(0, text.find('\n')));  // systemd accepts UTF-8 only
}

}  // namespace

ServiceManager::ServiceManager(const Clock& clock) : clock_(clock), present_(std::getenv("NOTIFY_SOCKET") != nullptr) {
  std::uint64_t period_us = 0;
  if (sd_watchdog_enabled(0, &period_us) > 0) watchdog_us_ = static_cast<std::int64_t>(period_us);
}

void ServiceManager::ready(const std::string& status) const {
  sd_notify(0, ("READY=1\n" + status_line(status)).c_str());
}

void ServiceManager::reloading() const {
  // The time tells systemd (253 and later) which request to reload this message answers.
  sd_notify(0, ("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(clock_.steady_us())).c_str());
}

void ServiceManager::stopping() const { sd_notify(0, "STOPPING=1\nSTATUS=stopping"); }

void ServiceManager::status(const std::string& text) const { sd_notify(0, status_line(text).c_str()); }

void ServiceManager::alive() {
  if (watchdog_us_ == 0 || clock_.steady_us() < due_us_) return;
  due_us_ = clock_.steady_us() + watchdog_us_ / 4;
  sd_notify(0, "WATCHDOG=1");
}

}  // namespace barehand
