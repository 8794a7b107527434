#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "drivers/synthetic/simulator.h"

namespace barehand::synthetic {

/// Parameters of this sequence with images of 160x120 pixels.
inline SimulatorParams small_scene(const std::string& sequence) {
  SimulatorParams params;
  params.sequence = sequence;
  params.width = 160;
  params.height = 120;
  return params;
}

/// Creates a simulator; throws if the parameters are invalid.
inline Simulator simulator(const SimulatorParams& params) {
  auto made = Simulator::create(params);
  if (!made) throw std::runtime_error(made.error().message());
  return std::move(*made);
}

}  // namespace barehand::synthetic
