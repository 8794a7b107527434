// Waits until the named pipes to which a run writes have readers, or until it is told to stop.
#include "app/shared/pipe_readers.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>

#include "io/place.h"

namespace barehand {

PipeReaders::~PipeReaders() {
  for (const int pipe : pipes_) close(pipe);
}

std::optional<std::string> PipeReaders::wait_for(const std::string& path, Behind behind, const std::stop_token& stop,
                                                 const std::function<void()>& on_wait) {
  // A pipe that this process got as an open descriptor has its reader already, or will never get one.
  std::error_code ignored;
  if (!std::filesystem::is_fifo(path, ignored)) return path;
  const bool named = target_of(path).descriptor < 0;
  if (!named && behind == Behind::wait) return path;

  // Try to open the pipe again and again, because a pipe without a reader cannot be opened without blocking.
  std::mutex mutex;
  std::condition_variable_any never;
  while (!stop.stop_requested()) {
    const int pipe = open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    if (pipe < 0 && (errno != ENXIO || !named)) return path;  // the error is reported when the pipe is opened later

    // A reader is there: keep the pipe open, and set what happens when the reader falls behind.
    if (pipe >= 0) {
      constexpr int kRoom = 1 << 20;  // bytes; what the kernel allows to every user
      if (behind == Behind::wait)
        fcntl(pipe, F_SETFL, fcntl(pipe, F_GETFL) & ~O_NONBLOCK);
      else
        (void)fcntl(pipe, F_SETPIPE_SZ, kRoom);  // for seconds in which the reader does something else
      return "/dev/fd/" + std::to_string(pipes_.emplace_back(pipe));
    }

    // Otherwise wait for a moment, which a request to stop ends at once.
    on_wait();
    std::unique_lock lock(mutex);
    never.wait_for(lock, stop, std::chrono::milliseconds(100), [] { return false; });
  }
  return std::nullopt;
}

}  // namespace barehand
