#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "core/parallel/parallel.h"
#include "observe/detection.h"
#include "sensor/rgbd_frame.h"
#include "stages/detection/network.h"
#include "stages/detection/palm_history.h"
#include "stages/detection/params.h"
#include "stages/detection/window_examiner.h"

namespace barehand {

struct DepthView;

/// Finds hands in a depth image of any size and focal length without prior knowledge of their positions: one network
/// finds palms in the whole frame; a second one is applied to a window around each palm and estimates the joints, the
/// side (left or right) and labels of the surface. Earlier frames only decide which places may wait for the next frame
/// (PalmHistory). Synchronous. Windows are spread over the workers, whose number does not change results. Not
/// thread-safe.
class HandDetector {
 public:
  /// Loads the networks from `folder` (docs/nets.md). Errors: files that are missing, damaged or not these networks.
  static Result<HandDetector> load(const std::string& folder, const DetectionParams& params);

  /// Finds all hands of the frame, at most kMostHands. What has long been unlikely to be a hand is found in every
  /// second to fifth search only (PalmHistory); the places of `tracked` hands never wait. `wanted`: the side that is
  /// looked for, if only one is: a hand of which the networks are not sure is read as one of that side. `skin`: if
  /// given, only what has the colour of skin is looked at; the frame must have colour then. Error: a network returns
  /// values that are not finite.
  Result<Detection> detect(const RgbdFrame& frame, Workers& workers, std::span<const ExpectedHand> tracked = {},
                           std::optional<Handedness> wanted = std::nullopt, const SkinModel* skin = nullptr);

  /// Looks for the tracked hands where they are expected, unless they are already in `found`, the result of detect()
  /// for this frame. Returns that with the hands that are seen there.
  Result<Detection> detect_at(const RgbdFrame& frame, std::span<const ExpectedHand> tracked, Workers& workers,
                              Detection found = {});

  /// Examines one place, with a network of its own. May run on another thread beside the other functions, but not twice
  /// at a time.
  Result<std::optional<DetectedHand>> examine_beside(const RgbdFrame& frame, const ExpectedHand& place,
                                                     Workers& workers) {
    return examiners_.back().examine(frame, place, workers);
  }

  const std::string& version() const { return version_; }

  static constexpr int kMostHands = 4;

 private:
  /// A peak of the first network's heat map.
  struct Palm {
    Eigen::Vector3d centre;
    double probability;
  };
  HandDetector(Network full, std::vector<WindowExaminer> examiners, std::string version, const DetectionParams& params);
  Result<void> find_palms(const RgbdFrame& frame, const SkinModel* skin, Workers& workers);
  void add_palms(const RgbdFrame& frame, const DepthView& view, const NetworkOutput& output);
  /// Chooses up to kAtOnce of the next palms, which are certainly not of the same hand.
  void choose_palms(const Detection& out);
  /// Examines up to kAtOnce places at the same time.
  Result<void> examine(const RgbdFrame& frame, std::span<const ExpectedHand> places, Workers& workers);
  static bool is_new(const Eigen::Vector3d& centre, const Detection& out, double apart);
  static void add(std::optional<DetectedHand> hand, double palm, double apart, Detection& out);

  static constexpr int kAtOnce = 2;  // number of windows that are examined at the same time, whatever the workers

  Network full_;
  std::vector<WindowExaminer> examiners_;  // kAtOnce, and one for examine_beside()
  std::string version_;
  DetectionParams params_;
  std::array<PalmHistory, 2> known_;  // of searches of everything, and of skin only

  // Scratch of the current frame.
  std::vector<Palm> palms_;                                         // most probable first
  std::size_t next_ = 0;                                            // index of the first palm that was not chosen yet
  std::vector<Palm> chosen_;                                        // the palms that are examined
  std::vector<ExpectedHand> places_;                                // places of these palms
  std::array<Result<std::optional<DetectedHand>>, kAtOnce> found_;  // hands found at these places
  Image<float> depth_;                                              // the depth image, resampled for the first network
  NetworkInput input_;                                              // input of the first network
};

}  // namespace barehand
