#pragma once

#include <string>

#include "core/error.h"
#include "drivers/synthetic/simulator.h"

namespace barehand::synthetic {

/// The specification of a simulated source, given after "sim:".
struct SyntheticSpec {
  SimulatorParams simulator;
  bool live = false;
  bool loop = false;
  std::string hands;
};
template <class V>
void visit(V& v, SyntheticSpec& p) {
  visit(v, p.simulator);
  v("live", p.live, "deliver frames at their rate by the clock, as a sensor does; late frames are dropped");
  v("loop", p.loop, "start again at the end");
  v("hands", p.hands, "folder with left.glb and right.glb; empty: where deploy/fetch_hand_mesh.sh puts them");
}

/// Parses "NAME" or "NAME,key=value,key=value", for example "fist,noise=kinect,seed=3,fps=60". Errors name the key: an
/// unknown sequence or key, a missing value, a value that is not a number, out of range or not among the choices, a
/// key given twice.
Result<SyntheticSpec> parse_synthetic_spec(const std::string& text);

/// One line per key with its default, range and meaning.
std::string synthetic_spec_help();

}  // namespace barehand::synthetic
