#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "hand/grasps/frame_grasps.h"
#include "stages/grasp/grasp_features.h"

namespace barehand {

/// A multinomial logistic classifier of grasps. Each row stands for a shape of the hand: a class may have several, and
/// no grasp has one for each shape in which hands reach for things. The probability of row k is proportional to
///
///   exp(a_k / sqrt(1 + pi / 8 s_k^2)),   a = W z + b,   s_k^2 = spread^2 |W_k S|^2,
///
/// where z are the features, minus their mean and divided by their deviation in the training, and S the columns of
/// their spread divided by the same deviation. The root is MacKay's approximation of the mean over uncertain features:
/// the less is known about the pose, the less certain is the class.
class GraspClassifier {
 public:
  /// Reads a file of tools/training/grasps/train.py. Errors: it cannot be read, is of another interface, lacks a class,
  /// has one that this program does not know, or numbers that are missing, not finite or out of range.
  static Result<GraspClassifier> load(const std::string& path);

  /// Logarithms of the probabilities, in the order of GraspProbabilities.
  std::array<double, kGraspCount> classify(const GraspFeatures& features) const;

  /// Time constant with which the probabilities should be averaged (GraspFilter) [s].
  double memory() const { return memory_; }

 private:
  GraspClassifier() = default;

  static constexpr int kMaxRows = 64;

  Eigen::Matrix<double, kGraspFeatureCount, 1> mean_, scale_;  // scale: one over the deviation
  std::vector<int> classes_;                                   // class of each row
  Eigen::Matrix<double, Eigen::Dynamic, kGraspFeatureCount, Eigen::ColMajor, kMaxRows> weights_;
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxRows> bias_;
  double spread_ = 1;
  double memory_ = 0;
};

}  // namespace barehand
