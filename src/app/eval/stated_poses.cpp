// Reads poses and their covariances from a log of hand states.
#include "app/eval/stated_poses.h"

#include <algorithm>
#include <optional>

#include "barehand/hand_state_t.hpp"
#include "drivers/lcm/logged_messages.h"
#include "hand/hand_pose.h"

namespace barehand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kFarthest = 1e6;          // largest coordinate of a valid state [m]
constexpr double kLargestVariance = 1e12;  // largest variance of a valid state [m^2]

StatedSegment stated(const segment_state_t& state) {
  StatedSegment out;
  out.proximal = Eigen::Map<const Vector3d>(state.position);
  out.distal = Eigen::Map<const Vector3d>(state.distal);
  const Matrix6d covariance = Eigen::Map<const Matrix6d>(state.covariance[0]);  // symmetric, so either order is right
  const auto J_distal = point_jacobian(out.distal - out.proximal);
  out.proximal_covariance = covariance.topLeftCorner<3, 3>();
  out.distal_covariance = J_distal * covariance * J_distal.transpose();
  out.confidence = state.confidence;
  out.seen = state.seen;
  return out;
}

/// Whether the numbers are finite and plausible: the log may be of any origin.
bool sensible(const StatedSegment& segment) {
  const auto near = [](const Vector3d& point) { return (point.array().abs() <= kFarthest).all(); };
  const auto variance = [](const Matrix3d& covariance) {
    const auto diagonal = covariance.diagonal().array();
    return (diagonal >= 0).all() && (diagonal <= kLargestVariance).all();
  };
  return near(segment.proximal) && near(segment.distal) && variance(segment.proximal_covariance) &&
         variance(segment.distal_covariance) && segment.confidence >= 0 && segment.confidence <= 1;
}

}  // namespace

Result<StatedPoses> read_stated_poses(const std::string& log_path) {
  auto log = MessageLog::open(log_path);
  if (!log) return tl::unexpected(log.error());
  StatedPoses poses;
  std::optional<std::int8_t> side;

  // Read every message that states a pose.
  const auto read = visit_messages<hand_state_t>(*log, [&](const hand_state_t& state) -> Result<void> {
    if (!state.has_pose) return {};

    // A truth is that of one hand.
    if (state.handedness != side.value_or(state.handedness))
      return fail("holds the states of two hands, and a truth is one hand's", log_path,
                  "track the hand alone: --hand right or --hand left");
    side = state.handedness;

    // Accept each frame once, since a truth is that of one run.
    const auto [frame, is_new] = poses.try_emplace(state.frame_number);
    if (!is_new)
      return fail("frame " + std::to_string(state.frame_number) + " occurs twice", log_path,
                  "give the log of a single run on a single recording");

    // Read the segments, and refuse numbers that do not form a pose.
    frame->second.utime = state.utime;
    auto& segments = frame->second.segments;
    for (int s = 0; s < kSegmentCount; ++s) segments[s] = stated(state.segments[s]);
    if (!std::all_of(segments.begin(), segments.end(), sensible))
      return fail("frame " + std::to_string(state.frame_number) + " has a pose with invalid numbers", log_path,
                  "give a log written by barehand track --states-log");
    return {};
  });
  if (!read) return tl::unexpected(read.error());

  // Refuse a log without any pose.
  if (poses.empty())
    return fail("holds no hand state with a pose", log_path,
                "give a log written by barehand track --states-log or --mcap");
  return poses;
}

}  // namespace barehand
