#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace barehand {

/// Waits for readers of named pipes. Opening such a pipe for writing blocks until it has a reader, and neither a signal
/// nor a service manager could end that; this wait can be stopped.
class PipeReaders {
 public:
  PipeReaders() = default;
  ~PipeReaders();
  PipeReaders(const PipeReaders&) = delete;
  PipeReaders& operator=(const PipeReaders&) = delete;

  /// Returns the path to write to instead of `path`: for a named pipe, as soon as it has a reader, the descriptor that
  /// this object holds open (such as /dev/fd/5); otherwise `path` itself, at once. `on_wait` is called repeatedly while
  /// it waits. Returns none if `stop` was requested first.
  std::optional<std::string> wait_for(const std::string& path, const std::stop_token& stop,
                                      const std::function<void()>& on_wait);

 private:
  std::vector<int> pipes_;
};

}  // namespace barehand
