#pragma once

#include "stages/refinement/scan_equations.h"

namespace barehand {

/// What is known of a scanned hand besides its images, as normal equations at `model`: joints lie near where they were
/// in `start`, above all across the bone, and at the same place on both of their bones; fingers are rooted in the
/// middle of their skin; the skin differs from the start's smoothly and on average not at all, segment by segment, so
/// that frames do not wander off in their skin.
/// `hold_joints`: the joints are taken as right.
void add_scan_prior(const ScanModel& model, const ScanModel& start, const ScanVariables& variables, bool hold_joints,
                    ScanEquations& equations);

}  // namespace barehand
