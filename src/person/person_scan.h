#pragma once

#include <future>
#include <stop_token>

#include "person/scan_frames.h"
#include "person/shape_fit.h"
#include "stages/refinement/refinement.h"

namespace barehand {

// Scans the skin of the tracked hand in the background.

/// The parameters of the tracker that a scan uses.
struct PersonScanParams {
  RefinementParams refinement;
  ShapeFitParams shape_fit;
  double skin_cell = 0.004;  ///< m, size of the smooth skin's triangles
};

/// Scans a person's hand while it is tracked, with the method of `barehand calibrate`. The first scan starts after N =
/// ShapeFitParams::scan_after tracked frames, later ones after 2 N, 4 N and so on; each uses the frames that were kept
/// until then. If the given profile is the population mean, its bones and joints are first fitted to these frames; the
/// joints of a measured profile stay fixed. For live sources, scans run in the background (Workers::run_in_background).
class PersonScan {
 public:
  /// `given`: the hand before anything was learnt. `workers` must outlive this object.
  PersonScan(const PersonScanParams& params, std::shared_ptr<const HandProfile> given, Workers& workers);
  /// Waits until a running scan has stopped, which takes some hundredths of a second of a processor's time.
  ~PersonScan();
  PersonScan(const PersonScan&) = delete;
  PersonScan& operator=(const PersonScan&) = delete;

  /// Adds a tracked frame that the hand fits well, with its refined pose.
  void add(const HandObservation& observation, const HandPose& pose);
  /// Call when a new track begins, most likely of the same person. A hand that was scanned before is scanned once more,
  /// after as many tracked frames as the last of the regular scans needs.
  void restart();
  /// Returns the scanned hand once after a scan has ended, otherwise null. Rethrows an exception that the scan threw.
  std::shared_ptr<const HandProfile> take();
  /// Whether the scan that take() returned last began before the last restart, so that it may show another person's
  /// hand.
  bool of_hand_before() const { return of_hand_before_; }

 private:
  using Hand = std::shared_ptr<const HandProfile>;  // null: the frames did not yield a hand
  void start();

  const PersonScanParams params_;
  const Hand given_;
  Workers& workers_;
  ScanFrames frames_;
  int scans_ = 0, next_;
  bool of_hand_before_ = false;
  std::stop_source stop_;
  std::future<Hand> scan_;
};

}  // namespace barehand
