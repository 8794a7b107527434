#pragma once

#include "tracking/tracker_params.h"

namespace barehand::test {

/// Refinement alone, and full searches cut down to quick ones.
inline TrackerParams quick_tracker() {
  TrackerParams params;
  params.sampling = false;
  params.search_attempts = 1;
  params.initialiser.full = params.initialiser.quick;
  return params;
}

}  // namespace barehand::test
