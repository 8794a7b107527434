#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace barehand {

/// The arguments of `barehand view`.
struct ViewOptions {
  std::vector<std::string> logs;  ///< logs to play; none: show what is sent over LCM
  bool lcm = false;
  std::string lcm_url, prefix;
  std::string port = "8765";         ///< where the page is served: PORT or ADDRESS:PORT
  std::vector<std::string> origins;  ///< foreign origins whose pages may connect
  std::vector<std::string> hands;    ///< profiles whose skin is shown; none: the mean adult hand
  std::string record;                ///< folder for recordings started on the page; "": nothing can be recorded
  std::string config;                ///< configuration from which the camera's pose is taken; "": none
};

/// Runs `barehand view` until it is stopped, and returns its exit code (exit_code.h).
int run_view(const ViewOptions& options);

}  // namespace barehand
