#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace barehand {

/// Readers of named pipes. Opening such a pipe for writing waits for one, and neither a signal nor a service manager
/// could end that; here they can.
class PipeReaders {
 public:
  PipeReaders() = default;
  ~PipeReaders();
  PipeReaders(const PipeReaders&) = delete;
  PipeReaders& operator=(const PipeReaders&) = delete;

  /// Where to write what is to go to `path`: of a named pipe, once it has a reader, the descriptor that this object
  /// holds open (/dev/fd/5); else `path` itself, at once. `on_wait` is called now and then. None: `stop` came first.
  std::optional<std::string> wait_for(const std::string& path, const std::stop_token& stop,
                                      const std::function<void()>& on_wait);

 private:
  std::vector<int> pipes_;
};

}  // namespace barehand
