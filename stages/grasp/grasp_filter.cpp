// Averages the probabilities of grasps over time.
#include "stages/grasp/grasp_filter.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

constexpr double kAdvantage = 1.5;  // another class must be more probable by this factor to replace the stated one

}  // namespace

void GraspFilter::reset() {
  empty_ = true;
  grasp_ = 0;
}

const GraspProbabilities& GraspFilter::add(const std::array<double, kGraspCount>& log_probabilities, double seconds) {
  // Average.
  const double weight = empty_ ? 1 : 1 - std::exp(-seconds / memory_);
  empty_ = false;
  for (int k = 0; k < kGraspCount; ++k) mean_[k] += weight * (log_probabilities[k] - mean_[k]);

  // Normalise.
  const double largest = *std::max_element(mean_.begin(), mean_.end());
  double sum = 0;
  for (int k = 0; k < kGraspCount; ++k) sum += probabilities_[k] = std::exp(mean_[k] - largest);
  for (double& p : probabilities_) p /= sum;

  // Decide whether it is a grasp, and which: with several similar ones, none of them may be as probable as no grasp.
  const double none = probabilities_[0], any = 1 - none;
  const auto best =
      static_cast<int>(std::max_element(probabilities_.begin() + 1, probabilities_.end()) - probabilities_.begin());

  // Another decision needs an advantage over the present one.
  if (grasp_ == 0) {
    if (any > none) grasp_ = best;
  } else if (none > kAdvantage * any) {
    grasp_ = 0;
  } else if (probabilities_[best] > kAdvantage * probabilities_[grasp_]) {
    grasp_ = best;
  }
  return probabilities_;
}

}  // namespace barehand
