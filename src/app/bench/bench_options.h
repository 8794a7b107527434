#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/shared/known_objects.h"

namespace barehand {

/// The arguments of `barehand bench`.
struct BenchOptions {
  std::string source = "sim:grasp_ball";
  std::vector<std::string> configs = {"default.yaml"};
  std::vector<std::string> hands;  ///< empty: the source's own, or the shipped adult hand
  ObjectMeshes objects;
  // Numbers of frames; see `barehand bench --help`.
  std::int64_t store = 120;
  std::int64_t frames = 300;
  std::int64_t warm_up = 30;
  std::optional<double> rate;  ///< frames per second of a live sensor; none: as fast as possible
  int threads = 1;
  bool single_threaded = false;  ///< --inline
  int repeat = 1;
  std::vector<std::string> sweeps;
  std::string lcm_url = "memq://";
  std::string json, plots, draw;  ///< "": not written, nothing drawn
  bool overwrite = false;
};

}  // namespace barehand
