#pragma once

#include <chrono>
#include <cstddef>

namespace barehand {

// Pipes whose readers must not be waited for, since tracking would wait, too. They are marked by O_NONBLOCK.

/// Whether `bytes` can be written to a descriptor at once. False only for such a pipe, if it has a reader that is
/// behind.
bool has_room(int descriptor, std::size_t bytes);
/// Waits until such a pipe takes more after write() has failed with EAGAIN. Returns false if that is not so at `end`.
bool wait_for_room(int descriptor, std::chrono::steady_clock::time_point end);

}  // namespace barehand
