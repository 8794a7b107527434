#pragma once

#include <chrono>
#include <future>

namespace barehand {

/// Whether there is a work to wait for (Workers::run_in_background) and it is done. `Future`: std::future or
/// std::shared_future.
template <typename Future>
bool is_ready(const Future& result) {
  return result.valid() && result.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace barehand
