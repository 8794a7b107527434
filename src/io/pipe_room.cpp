// Finds out whether a pipe takes more data.
#include "io/pipe_room.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

namespace barehand {

bool has_room(int descriptor, std::size_t bytes) {
  const int flags = fcntl(descriptor, F_GETFL);
  if (flags < 0 || (flags & O_NONBLOCK) == 0) return true;
  const int capacity = fcntl(descriptor, F_GETPIPE_SZ);
  int waiting = 0;
  if (capacity < 0 || ioctl(descriptor, FIONREAD, &waiting) != 0) return true;

  // Without a reader, writing fails at once, and the error says so.
  pollfd one{descriptor, POLLOUT, 0};
  if (poll(&one, 1, 0) > 0 && (one.revents & POLLERR) != 0) return true;

  // The kernel keeps data in pages. They are at least half full, but for the first and the last one.
  const auto ends = 2 * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return 2 * (static_cast<std::size_t>(waiting) + bytes) + ends <= static_cast<std::size_t>(capacity);
}

bool wait_for_room(int descriptor, std::chrono::steady_clock::time_point end) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
  pollfd one{descriptor, POLLOUT, 0};
  return poll(&one, 1, static_cast<int>(std::max<std::int64_t>(0, left.count()))) > 0;
}

}  // namespace barehand
