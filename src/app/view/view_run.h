#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace barehand {

/// The arguments of `barehand view`.
struct ViewOptions {
  std::vector<std::string> logs;  ///< none: live from LCM
  bool lcm = false;
  std::string lcm_url, prefix;
  std::string port = "8765";         ///< PORT or ADDRESS:PORT
  std::vector<std::string> origins;  ///< foreign origins whose pages may connect
  std::vector<std::string> hands;    ///< profiles whose skin is shown; none: the mean adult hand
  std::string record;                ///< folder for recordings made with the page's button; "": it records nothing
  std::string config;                ///< configuration from which the camera's pose is taken; "": none
};

/// Runs `barehand view` until it is stopped, and returns its exit code (exit_code.h).
int run_view(const ViewOptions& options);

}  // namespace barehand
