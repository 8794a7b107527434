#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "drivers/synthetic/simulator.h"

namespace barehand::synthetic {

/// A sequence at 160x120.
inline SimulatorParams small_scene(const std::string& sequence) {
  SimulatorParams params;
  params.sequence = sequence;
  params.width = 160;
  params.height = 120;
  return params;
}

/// Throws where the parameters make none.
inline Simulator simulator(const SimulatorParams& params) {
  auto made = Simulator::create(params);
  if (!made) throw std::runtime_error(made.error().message());
  return std::move(*made);
}

}  // namespace barehand::synthetic
