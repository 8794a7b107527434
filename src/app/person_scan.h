#pragma once

#include <future>
#include <stop_token>

#include "app/scan_frames.h"
#include "app/tracker_params.h"

namespace barehand {

/// Scans a person's hand while it is tracked, as `barehand calibrate` does: after some frames, and again after twice
/// and four times as many, its skin is scanned from those that were kept. A mean hand is fitted to them before; the
/// joints of a measured one stay. Workers::aside says when that is done.
class PersonScan {
 public:
  /// `workers` outlives it.
  PersonScan(const TrackerParams& params, std::shared_ptr<const HandProfile> given, Workers& workers);
  /// Waits for a scan under way to stop: half a second.
  ~PersonScan();
  PersonScan(const PersonScan&) = delete;
  PersonScan& operator=(const PersonScan&) = delete;

  /// A frame that is explained well, at its refined pose.
  void add(const HandObservation& observation, const HandPose& pose);
  /// Another hand comes into view, most likely the same person's: it is scanned once more when as much was seen of it
  /// as for the last scan.
  void restart();
  /// The hand of a scan that has ended, once; throws what the scan threw.
  std::shared_ptr<const HandProfile> take();
  /// Whether the scan taken last began before the last restart: it may show another person's hand.
  bool of_hand_before() const { return of_hand_before_; }

 private:
  using Hand = std::shared_ptr<const HandProfile>;  // null: the frames tell none
  void start();

  const TrackerParams params_;
  const Hand given_;
  Workers& workers_;
  ScanFrames frames_;
  int scans_ = 0, next_;
  bool of_hand_before_ = false;
  std::stop_source stop_;
  std::future<Hand> scan_;
};

}  // namespace barehand
