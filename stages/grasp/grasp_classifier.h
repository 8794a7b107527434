#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "hand/grasps/frame_grasps.h"
#include "stages/grasp/grasp_features.h"

namespace barehand {

/// A classifier of grasps: a network with one hidden layer looks at the pose, and a table at the touches. Each row of
/// the network stands for a shape of the hand: a class may have several, and no grasp has one for each shape in which
/// hands reach for things. The probability of row k is proportional to
///
///   exp(a_k),   a = V tanh(W z + b) + c,
///
/// where z are the values of the features and the standard deviations of the joints, minus their mean and divided by
/// their deviation in the training. From the deviations the network knows which fingers it cannot rely on. The
/// probability of a class is that of its rows times exp(T_p) for every part p of the hand, where T_p depends on the
/// class and on whether the part touches something.
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

  static constexpr int kMaxRows = 64, kInputs = kGraspFeatureCount + kGraspAngleCount;
  template <int kColumns>
  using Weights = Eigen::Matrix<double, Eigen::Dynamic, kColumns, Eigen::ColMajor, kMaxRows,
                                kColumns == Eigen::Dynamic ? kMaxRows : kColumns>;
  using Column = Weights<1>;
  using Inputs = Eigen::Matrix<double, kInputs, 1>;

  Inputs mean_, scale_;             // scale: one over the deviation
  Weights<kInputs> hidden_;         // W
  Column hidden_bias_;              // b
  Weights<Eigen::Dynamic> output_;  // V
  Column output_bias_;              // c
  std::vector<int> classes_;        // class of each row of V
  // T: what a touch of each part says about each class.
  std::array<std::array<std::array<double, 3>, kGraspPartCount>, kGraspCount> touches_{};
  double memory_ = 0;
};

}  // namespace barehand
