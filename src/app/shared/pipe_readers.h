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

  /// What is done when a reader does not read: the writer waits, or nothing more is written meanwhile (io/pipe_room.h).
  enum class Behind { wait, leave_out };

  /// Returns the path to write to instead of `path`: for a named pipe, as soon as it has a reader, the descriptor that
  /// this object holds open (such as /dev/fd/5); with Behind::leave_out also for any other pipe; otherwise `path`
  /// itself, at once. `on_wait` is called repeatedly while it waits. Returns none if `stop` was requested first.
  std::optional<std::string> wait_for(const std::string& path, Behind behind, const std::stop_token& stop,
                                      const std::function<void()>& on_wait);

 private:
  std::vector<int> pipes_;
};

}  // namespace barehand
