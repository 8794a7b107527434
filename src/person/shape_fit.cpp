// A running Gaussian estimate of the person's hand shape.
#include "person/shape_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace barehand {

ShapeFit::ShapeFit(const ShapeFitParams& params) : params_(params) {}

bool ShapeFit::add(const ShapeEquations& equations, const HandShape& at) {
  Matrix information;
  HandShape g;
  if (!equations.without_pose(information, g)) return false;
  // Reduce the weight of older looks exponentially.
  const double memory = std::clamp(params_.memory * frames_, 4.0, params_.memory_frames);
  const double keep = std::exp(-1 / memory);
  information_ = keep * information_ + params_.weight * information;
  weighted_ = keep * weighted_ + params_.weight * (information * at + g);
  ++frames_;
  return true;
}

ShapeFit::Matrix ShapeFit::posterior() const {
  Matrix sum = information_;
  for (int k = 0; k < kShapeCount; ++k) sum(k, k) += std::pow(shape_parameters()[k].deviation, -2);
  return sum;
}

HandShape ShapeFit::estimate() const { return posterior().llt().solve(weighted_); }

HandShape ShapeFit::deviation() const {
  return posterior().llt().solve(Matrix::Identity()).diagonal().cwiseMax(0).cwiseSqrt();
}

}  // namespace barehand
