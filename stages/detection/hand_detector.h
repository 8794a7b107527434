#pragma once

#include <optional>
#include <span>
#include <string>

#include "observe/detection.h"
#include "sensor/rgbd_frame.h"
#include "stages/detection/network.h"
#include "stages/detection/params.h"

namespace barehand {

struct DepthView;

/// Finds hands in a depth image, of any size and focal length, without knowing where they are: one network finds palms
/// in the whole frame, a second one looks at a window around each and tells joints, side and labels. It looks at one
/// frame at a time and keeps nothing of it. Synchronous, on the calling thread; the result does not depend on the
/// number of threads OpenCV is allowed. Not for two threads at once.
class HandDetector {
 public:
  /// Networks from `folder` (docs/nets.md). Errors: missing, foreign or damaged files.
  static Result<HandDetector> load(const std::string& folder, const DetectionParams& params);

  /// All hands of the frame, up to kMostHands. Error: a network gives values that are not finite.
  Result<Detection> detect(const RgbdFrame& frame);

  /// A place where a hand is expected.
  struct Expected {
    Eigen::Vector3d centre;          ///< of the palm, camera frame [m]
    std::optional<Handedness> side;  ///< none: either
  };
  /// The hands at these places, without a look at the rest of the frame; nothing where no hand is seen there.
  Result<Detection> detect_at(const RgbdFrame& frame, std::span<const Expected> places);

  const std::string& version() const { return version_; }

  static constexpr int kMostHands = 4;

 private:
  /// What one window shows.
  struct Window {
    DetectedHand hand;
    double hand_area = 0;  // m^2 facing the camera
  };
  HandDetector(Network full, Network crop, std::string version, const DetectionParams& params);
  Result<void> find_palms(const RgbdFrame& frame, Detection& out);
  void add_palms(const RgbdFrame& frame, const DepthView& view, const NetworkOutput& output);
  Result<Window> look(const RgbdFrame& frame, const Eigen::Vector3d& centre, bool mirrored);
  Result<std::optional<DetectedHand>> examine(const RgbdFrame& frame, const Expected& place);
  Result<void> add(const RgbdFrame& frame, const Expected& place, double palm, Detection& out);

  Network full_, crop_;
  std::string version_;
  DetectionParams params_;

  /// A palm that the heat map shows.
  struct Palm {
    Eigen::Vector3d centre;
    double probability;
  };
  std::vector<Palm> palms_;  // of the current frame
  Image<float> depth_;       // scratch: what a view sees
  NetworkInput input_;       // scratch
};

}  // namespace barehand
