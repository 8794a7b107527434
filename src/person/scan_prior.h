#pragma once

#include "person/scan_equations.h"

namespace barehand {

/// Adds what is known of a scanned hand besides its images to the normal equations at `model`. Joints lie near their
/// places in `start`, most firmly across the bone, and both points of a joint coincide at rest. Fingers are rooted in
/// the middle of their skin. The skin differs from that of `start` smoothly and, segment by segment, by zero on
/// average, so that a segment cannot drift within its skin. `hold_joints`: the joints are taken as correct.
void add_scan_prior(const ScanModel& model, const ScanModel& start, const ScanVariables& variables, bool hold_joints,
                    ScanEquations& equations);

}  // namespace barehand
