#include "person/skin_scan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/angles.h"
#include "person/scan_prior.h"
#include "person/scan_system.h"

namespace barehand {
namespace {

// Fits a personal hand (skin, joints) and all poses to the frames of a scan, in rounds of Gauss-Newton.

constexpr int kRounds = 40, kRoundsOfSkin = 16;  // number of rounds of a scan, and of a scan with fixed joints
constexpr int kSkinRounds = 2;                   // the first rounds move only the skin, which has the largest errors
// Upper limits of the total weight of all frames: more frames add no information, because their errors are correlated.
// With fixed joints the limit is lower, because skin that is seen only in part would drift.
constexpr double kFullScan = 100, kFullScanOfSkin = 46;
constexpr double kWidening = 20 * kDegree;  // widening of the joint limits

/// The state of a running scan.
class Scan {
 public:
  Scan(const HandProfile& start, double cell, std::vector<ScanFrame> frames, Workers& workers,
       const std::stop_token& stop)
      : start_(make_scan_model(start, cell, stop)),
        model_(start_),
        variables_(model_),
        limits_(widened_limits(start, kWidening)),
        frames_(std::move(frames)),
        equations_(frames_.size()),
        workers_(workers),
        stop_(stop) {}

  // Number of rounds of the whole scan.
  int rounds() const { return start_.joints_are_known() ? kRoundsOfSkin : kRounds; }
  /// One Gauss-Newton step on everything. `skin_only`: poses and joints stay as they are. Returns the root mean square
  /// mismatch before the step [m]; none if it cannot be solved or is stopped.
  std::optional<double> round(bool skin_only) {
    // Linearise all frames in parallel.
    const int frames = static_cast<int>(frames_.size());
    std::vector<char> fine(frames_.size());
    workers_.for_each_index(frames, [&](int i) {
      fine[i] = !stop_.stop_requested() && equations_[i].linearise(frames_[i], model_, variables_, limits_, skin_only);
    });
    if (std::count(fine.begin(), fine.end(), false) > 0) return std::nullopt;

    // Sum up the prior and all frames, whose total weight is bounded.
    const double weight = std::min(1.0, (start_.joints_are_known() ? kFullScanOfSkin : kFullScan) / frames);
    ScanEquations shared;
    shared.set_zero(variables_.count());
    add_scan_prior(model_, start_, variables_, skin_only || start_.joints_are_known(), shared);

    double squares = 0;
    int residuals = 0;
    for (const ScanFrameEquations& equations : equations_) {
      if (stop_.stop_requested()) return std::nullopt;
      equations.add_to(shared, weight);
      squares += equations.squares();
      residuals += equations.residuals();
    }
    if (residuals == 0) return std::nullopt;

    // Solve, and apply the step to the hand and to the poses.
    const auto step = ScanSystem(shared, equations_, weight, workers_, stop_).solve();
    if (!step) return std::nullopt;
    workers_.for_each_index(frames, [&](int i) { frames_[i].pose = equations_[i].moved(frames_[i].pose, *step); });
    variables_.apply(*step, model_);
    return std::sqrt(squares / residuals);
  }

  HandProfile hand() const { return scanned_profile(start_, model_); }

 private:
  const ScanModel start_;
  ScanModel model_;
  const ScanVariables variables_;
  const std::array<JointLimits, kSegmentCount> limits_;
  std::vector<ScanFrame> frames_;
  std::vector<ScanFrameEquations> equations_;
  Workers& workers_;
  const std::stop_token stop_;
};

}  // namespace

std::optional<HandProfile> scan_hand(const HandProfile& start, double cell, std::vector<ScanFrame> frames,
                                     Workers& workers, const std::function<void(const ScanProgress&)>& progress,
                                     const std::stop_token& stop) {
  if (frames.empty()) return std::nullopt;
  Scan scan(start, cell, std::move(frames), workers, stop);
  double first = 0, last = 0;

  // Iterate, unless the caller stops the scan or a round cannot be solved.
  for (int round = 0; round < scan.rounds(); ++round) {
    if (stop.stop_requested()) return std::nullopt;
    const auto mismatch = scan.round(round < kSkinRounds);
    if (!mismatch) return std::nullopt;
    last = *mismatch;
    if (round == 0) first = last;
    if (progress) progress({round + 1, scan.rounds(), last});
  }

  // Reject a hand that fits the frames worse than the initial hand does.
  if (last > first) return std::nullopt;
  return scan.hand();
}

}  // namespace barehand
