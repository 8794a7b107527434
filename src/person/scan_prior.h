#pragma once

#include "person/scan_equations.h"

namespace barehand {

/// Adds the prior knowledge about a scanned hand to the normal equations at `model`. Joints are near their positions in
/// `start`, most firmly across the bone, and both points of a joint coincide at rest. The roots of fingers are in the
/// middle of their skin. The skin differs from that of `start` smoothly and, segment by segment, by zero on average, so
/// that a segment cannot drift within its skin. `hold_joints`: the joints are taken as correct.
void add_scan_prior(const ScanModel& model, const ScanModel& start, const ScanVariables& variables, bool hold_joints,
                    ScanEquations& equations);

}  // namespace barehand
