#include "person/person_scan.h"

#include <limits>

#include "core/parallel/is_ready.h"
#include "person/person_fit.h"

namespace barehand {
namespace {

// Collects frames of a tracked hand, and scans the hand from them.

constexpr int kSettling = 8, kMost = 32;  // number of tracked frames left out at first, and of frames kept at most
constexpr int kPasses = 4;                // passes over all frames to fit a mean hand to them
constexpr int kIterations = 8;            // Gauss-Newton steps in a refinement of a pose

/// Fits the poses of frames to a hand and, with add_frame(), the hand to the frames.
class BatchFit {
 public:
  BatchFit(const PersonScanParams& params, std::shared_ptr<const HandProfile> given, Workers& workers,
           const std::stop_token& stop)
      : params_(params),
        fit_(every_frame(params.shape_fit), given,
             std::make_shared<const Skin>(make_skin(*given, params.skin_cell, stop)), params.skin_cell, workers, stop) {
    use_fit();
  }

  // Refines the pose of a frame and fits the hand to it.
  void add_frame(ScanFrame& frame) {
    refine(frame);
    const auto change = fit_.add_frame(*frame.observation, frame.pose, *refinement_);
    if (change != PersonFit::Change::none) use_fit();
  }
  void refine(ScanFrame& frame) const {
    frame.pose = refinement_->refine(*frame.observation, frame.pose, frame.pose, kIterations).pose;
  }
  const HandProfile& profile() const { return *fit_.profile(); }

 private:
  static ShapeFitParams every_frame(ShapeFitParams params) {
    params.every = 1;
    params.initial_frames = std::numeric_limits<int>::max();
    return params;
  }
  void use_fit() { refinement_ = std::make_unique<Refinement>(params_.refinement, fit_.profile(), fit_.skin()); }

  const PersonScanParams& params_;
  PersonFit fit_;
  std::unique_ptr<Refinement> refinement_;
};

/// Runs one scan: adapts the hand to the frames if it is a mean hand, refines the poses, and scans the skin. Returns
/// null if it was stopped or the frames do not yield a hand.
std::shared_ptr<const HandProfile> scanned(const PersonScanParams& params, std::shared_ptr<const HandProfile> given,
                                           std::vector<ScanFrame> frames, Workers& workers,
                                           const std::stop_token& stop) {
  // Fit the bones and the joints first if the given profile is a mean hand (the average of many people).
  BatchFit fit(params, given, workers, stop);
  const int passes = given->origin == ProfileOrigin::mean ? kPasses : 0;
  for (int pass = 0; pass < passes; ++pass)
    for (ScanFrame& frame : frames) {
      if (stop.stop_requested()) return nullptr;
      fit.add_frame(frame);
    }

  // Refine the poses with the final bones, and scan.
  workers.for_each_index(static_cast<int>(frames.size()), [&](int i) {
    if (!stop.stop_requested()) fit.refine(frames[i]);
  });
  if (stop.stop_requested()) return nullptr;
  auto hand = scan_hand(fit.profile(), params.skin_cell, std::move(frames), workers, {}, stop);
  if (!hand) return nullptr;
  if (given->origin != ProfileOrigin::measured) hand->origin = ProfileOrigin::fitted;
  return std::make_shared<const HandProfile>(*std::move(hand));
}

}  // namespace

PersonScan::PersonScan(const PersonScanParams& params, std::shared_ptr<const HandProfile> given, Workers& workers)
    : params_(params),
      given_(std::move(given)),
      workers_(workers),
      frames_(kSettling, kMost),
      next_(params.shape_fit.scan_after) {}

PersonScan::~PersonScan() { stop_.request_stop(); }  // the destructor of the future waits

void PersonScan::add(const HandObservation& observation, const HandPose& pose) {
  if (scans_ == params_.shape_fit.scans) return;
  if (frames_.wants()) frames_.keep(std::make_shared<const HandObservation>(observation), pose);
  const bool enough = static_cast<int>(frames_.frames().size()) >= ScanFrames::kFewest;
  if (enough && frames_.tracked() >= next_ && !scan_.valid()) start();
}

void PersonScan::start() {
  next_ *= 2;
  of_hand_before_ = false;
  scan_ = workers_.run_in_background(
      [params = params_, given = given_, frames = frames_.frames(), stop = stop_.get_token()](Workers& workers) {
        return scanned(params, given, frames, workers, stop);
      });
  // After the last scan, release the frames, which occupy much memory.
  if (++scans_ == params_.shape_fit.scans) frames_ = {kSettling, kMost};
}

void PersonScan::restart() {
  frames_ = {kSettling, kMost};
  of_hand_before_ = scan_.valid();
  next_ = params_.shape_fit.scan_after;
  if (scans_ == 0) return;
  scans_ = params_.shape_fit.scans - 1;
  next_ <<= scans_;
}

std::shared_ptr<const HandProfile> PersonScan::take() {
  if (!is_ready(scan_)) return nullptr;
  return scan_.get();
}

}  // namespace barehand
