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

/// Finds hands in a depth image of any size and focal length without prior knowledge of their positions: one network
/// finds palms in the whole frame; a second one is applied to a window around each palm and estimates the joints, the
/// side (left or right) and labels of the surface. Every frame is processed independently. Synchronous, on the calling
/// thread. Not thread-safe.
class HandDetector {
 public:
  /// Loads the networks from `folder` (docs/nets.md). Errors: files that are missing, damaged or not these networks.
  static Result<HandDetector> load(const std::string& folder, const DetectionParams& params);

  /// Finds all hands of the frame, at most kMostHands. Error: a network returns values that are not finite.
  Result<Detection> detect(const RgbdFrame& frame);

  /// A place where a hand is expected.
  struct Expected {
    Eigen::Vector3d centre;          ///< centre of the palm, camera frame [m]
    std::optional<Handedness> side;  ///< none: the hand may be of either side
  };
  /// Finds the hands at the given places without searching the rest of the frame. Places without a hand are left out.
  Result<Detection> detect_at(const RgbdFrame& frame, std::span<const Expected> places);

  const std::string& version() const { return version_; }

  static constexpr int kMostHands = 4;

 private:
  /// The result of the second network for one window.
  struct Window {
    DetectedHand hand;
    double hand_area = 0;  // area of the pixels labelled as hand, projected onto a plane facing the camera [m^2]
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

  /// A peak of the first network's heat map.
  struct Palm {
    Eigen::Vector3d centre;
    double probability;
  };
  std::vector<Palm> palms_;  // of the current frame, most probable first
  Image<float> depth_;       // scratch: the depth image, resampled for the current window
  NetworkInput input_;       // scratch: input of the network for this window
};

}  // namespace barehand
