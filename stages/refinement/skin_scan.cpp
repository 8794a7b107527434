#include "stages/refinement/skin_scan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/angles.h"
#include "stages/refinement/scan_prior.h"

namespace barehand {
namespace {

constexpr int kRounds = 8;
constexpr int kSkinRounds = 2;              // first ones, in which the skin alone settles: it is farthest off
constexpr double kFullScan = 46;            // frames: more or fewer of them say as much, as all err alike
constexpr int kBatch = 8;                   // frames at a time: what one says of all unknowns is megabytes
constexpr double kDamping = 1e-3;           // relative, Levenberg
constexpr double kWidening = 20 * kDegree;  // of joint limits

class Scan {
 public:
  Scan(const HandProfile& start, double cell, std::vector<ScanFrame> frames, Workers& workers)
      : start_(make_scan_model(start, cell)),
        model_(start_),
        variables_(model_),
        limits_(widened_limits(start, kWidening)),
        joints_are_known_(start.origin == ProfileOrigin::measured),
        frames_(std::move(frames)),
        equations_(frames_.size()),
        workers_(workers) {}

  /// Root mean square mismatch before the round; none: it cannot be solved.
  std::optional<double> round(bool skin_only) {
    shared_.set_zero(variables_.count());
    add_scan_prior(model_, start_, variables_, skin_only || joints_are_known_, shared_);
    const int frames = static_cast<int>(frames_.size());
    std::array<bool, kBatch> fine{};
    double squares = 0;
    int residuals = 0;
    for (int first = 0; first < frames; first += kBatch) {
      const int batch = std::min(kBatch, frames - first);
      workers_.for_each_index(batch, [&](int i) {
        fine[i] = equations_[first + i].linearise(frames_[first + i], model_, variables_, limits_, skin_only);
      });
      for (int i = 0; i < batch; ++i) {
        if (!fine[i]) return std::nullopt;
        ScanFrameEquations& equations = equations_[first + i];
        equations.add_to(shared_, kFullScan / frames);
        squares += equations.squares();
        residuals += equations.residuals();
      }
    }
    if (residuals == 0) return std::nullopt;
    shared_.H.diagonal() *= 1 + kDamping;
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> solver(shared_.H);  // in place: it is large
    if (solver.info() != Eigen::Success) return std::nullopt;
    const Eigen::VectorXd step = solver.solve(shared_.g);
    if (!step.allFinite()) return std::nullopt;
    workers_.for_each_index(static_cast<int>(frames_.size()),
                            [&](int i) { frames_[i].pose = equations_[i].moved(frames_[i].pose, step); });
    variables_.apply(step, model_);
    return std::sqrt(squares / residuals);
  }

  HandProfile hand() const { return scanned_profile(start_, model_); }

 private:
  const ScanModel start_;
  ScanModel model_;
  const ScanVariables variables_;
  const std::array<JointLimits, kSegmentCount> limits_;
  const bool joints_are_known_;
  std::vector<ScanFrame> frames_;
  std::vector<ScanFrameEquations> equations_;
  ScanEquations shared_;
  Workers& workers_;
};

}  // namespace

std::optional<HandProfile> scan_hand(const HandProfile& start, double cell, std::vector<ScanFrame> frames,
                                     Workers& workers, const std::function<void(const ScanProgress&)>& progress) {
  if (frames.empty()) return std::nullopt;
  Scan scan(start, cell, std::move(frames), workers);
  double first = 0, last = 0;
  for (int round = 0; round < kRounds; ++round) {
    const auto mismatch = scan.round(round < kSkinRounds);
    if (!mismatch) return std::nullopt;
    last = *mismatch;
    if (round == 0) first = last;
    if (progress) progress({round + 1, kRounds, last});
  }
  if (last > first) return std::nullopt;
  return scan.hand();
}

}  // namespace barehand
