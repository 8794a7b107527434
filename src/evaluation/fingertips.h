#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "evaluation/distribution.h"
#include "hand/profile.h"
#include "io/hand/result_table.h"
#include "math/camera.h"

namespace barehand {

// Comparison of tracked fingertips with fingertips labelled in images.

inline constexpr std::array<std::string_view, kFingerCount> kFingerNames = {"thumb", "index", "middle", "ring",
                                                                            "little"};

/// The end of a fingertip's skin in an image, labelled by a person.
struct FingertipLabel {
  std::int64_t frame = 0;
  int finger = 0;  ///< 0 = thumb
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};
/// Reads a table with the columns `frame,finger,u,v,visible`; labels that are not visible are left out. An error names
/// the line.
Result<std::vector<FingertipLabel>> read_fingertip_labels(const std::string& path);

/// Distances [px] between labels and projected fingertips. A fingertip is the distal end plus the distal radius along
/// the bone.
struct FingertipEvaluation {
  std::size_t labels = 0;
  std::size_t missing = 0;  ///< labels in frames without a tracked hand, or with the fingertip behind the camera
  Distribution all;
  std::array<Distribution, kFingerCount> per_finger;
};
/// Compares labels with results. `results` may be several runs over the same recording; if several tracked a frame, the
/// first one counts.
FingertipEvaluation evaluate_fingertips(const std::vector<FingertipLabel>& labels,
                                        const std::vector<ResultTable>& results, const HandProfile& profile,
                                        const Intrinsics& camera);

/// The end of a finger's skin in the camera frame [m].
Eigen::Vector3d fingertip(const TableFrame& frame, const HandProfile& profile, int finger);

}  // namespace barehand
