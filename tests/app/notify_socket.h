#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <thread>

#include "support/temp_folder.h"

namespace barehand {

/// The socket that systemd would listen on, named to programs started meanwhile (and to this one).
class NotifySocket {
 public:
  explicit NotifySocket(const std::string& watchdog_us = "") {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string path = folder_ / "notify";
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    if (bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) ADD_FAILURE() << path;
    setenv("NOTIFY_SOCKET", path.c_str(), 1);
    if (!watchdog_us.empty()) setenv("WATCHDOG_USEC", watchdog_us.c_str(), 1);
  }
  ~NotifySocket() {
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
    close(socket_);
  }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  /// The next message if it comes in time; else "".
  std::string next(int patience_ms = 0) {
    pollfd ready{socket_, POLLIN, 0};
    if (poll(&ready, 1, patience_ms) != 1) return "";
    char buffer[4096];
    const ssize_t count = recv(socket_, buffer, sizeof buffer, 0);
    return count > 0 ? std::string(buffer, static_cast<std::size_t>(count)) : "";
  }
  /// Reads until a message contains `text`; "" if none comes.
  std::string wait_for(const std::string& text) {
    constexpr int kLongMs = 60'000;  // never waited for when all is well
    std::string message = next(kLongMs);
    while (!message.empty() && message.find(text) == std::string::npos) message = next(kLongMs);
    return message;
  }
  /// Throws messages away until the thread is destroyed, as a program waits when ten are unread.
  [[nodiscard]] std::jthread discard() {
    return std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested()) next(10);
    });
  }

 private:
  test::TempFolder folder_;
  const int socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

}  // namespace barehand
