#pragma once

#include "tracking/tracker_params.h"

namespace barehand::test {

/// Parameters for fast tests: refinement without sampling, and full searches with the effort of quick ones.
inline TrackerParams quick_tracker() {
  TrackerParams params;
  params.sampling = false;
  params.search_attempts = 1;
  params.initialiser.full = params.initialiser.quick;
  return params;
}

}  // namespace barehand::test
