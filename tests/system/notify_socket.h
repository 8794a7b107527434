#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

#include "support/temp_folder.h"

namespace barehand {

/// Replaces the socket of systemd's service notifications for this process and for programs that it starts. Like
/// systemd it reads continuously, since a program blocks when ten messages are unread.
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
    reader_ = {};
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
    close(socket_);
  }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  /// The next message if one comes within this time, else "".
  std::string next(int patience_ms = 0) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(patience_ms);
    while (true) {
      const std::string message = take();
      if (!message.empty() || std::chrono::steady_clock::now() >= deadline) return message;
      wait();
    }
  }
  /// Reads until a message contains `text`; "" if none comes.
  std::string wait_for(const std::string& text) {
    constexpr int kLongMs = 60'000;  // a timeout that is reached only by failing tests
    std::string message = next(kLongMs);
    while (!message.empty() && message.find(text) == std::string::npos) message = next(kLongMs);
    return message;
  }

 private:
  void wait() const {
    pollfd ready{socket_, POLLIN, 0};
    poll(&ready, 1, 10);
  }
  /// The oldest message that has arrived, or "".
  std::string take() {
    const std::lock_guard lock(mutex_);
    receive();
    if (messages_.empty()) return "";
    const std::string oldest = std::move(messages_.front());
    messages_.pop_front();
    return oldest;
  }
  void receive() {
    char buffer[4096];
    for (ssize_t n; (n = recv(socket_, buffer, sizeof buffer, MSG_DONTWAIT)) > 0;)
      messages_.emplace_back(buffer, static_cast<std::size_t>(n));
  }
  void read(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      wait();
      const std::lock_guard lock(mutex_);
      receive();
    }
  }

  test::TempFolder folder_;
  const int socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  std::mutex mutex_;  ///< protects the members below and the reading of the socket
  std::deque<std::string> messages_;
  std::jthread reader_{[this](const std::stop_token& stop) { read(stop); }};
};

}  // namespace barehand
