#pragma once

#include <chrono>
#include <future>

namespace barehand {

/// Whether there is a work to wait for (Workers::run_in_background) and it is done.
template <typename T>
bool is_ready(const std::future<T>& result) {
  return result.valid() && result.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace barehand
