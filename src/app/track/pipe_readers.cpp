// Waits until the named pipes to which a run writes have readers, or until it is told to stop.
#include "app/track/pipe_readers.h"

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

std::optional<std::string> PipeReaders::wait_for(const std::string& path, const std::stop_token& stop,
                                                 const std::function<void()>& on_wait) {
  // A pipe that this process got as an open descriptor has its reader already, or will never get one.
  std::error_code ignored;
  if (!std::filesystem::is_fifo(path, ignored) || target_of(path).descriptor >= 0) return path;

  std::mutex mutex;
  std::condition_variable_any never;
  while (!stop.stop_requested()) {
    const int pipe = open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    if (pipe < 0 && errno != ENXIO) return path;  // the error is reported when the pipe is opened later
    if (pipe >= 0) {
      fcntl(pipe, F_SETFL, fcntl(pipe, F_GETFL) & ~O_NONBLOCK);
      return "/dev/fd/" + std::to_string(pipes_.emplace_back(pipe));
    }
    on_wait();
    std::unique_lock lock(mutex);
    never.wait_for(lock, stop, std::chrono::milliseconds(100), [] { return false; });
  }
  return std::nullopt;
}

}  // namespace barehand
