#pragma once

#include <algorithm>
#include <fstream>

#include "stages/grasp/grasp_features.h"

namespace barehand {

/// Writes numbers as float32, column by column.
template <class Numbers>
void write_floats(std::ofstream& out, const Numbers& numbers) {
  const auto floats = numbers.template cast<float>().eval();
  out.write(reinterpret_cast<const char*>(floats.data()),
            static_cast<std::streamsize>(sizeof(float) * static_cast<std::size_t>(floats.size())));
}

/// Writes a row of examples as float32: what it belongs to, a second number, the values of the features, the deviations
/// of the joints, and what each part of the hand touches (PartTouch; -1: contacts were not looked for).
inline void write_example(std::ofstream& out, double origin, double second, const GraspFeatures& features) {
  Eigen::Matrix<double, kGraspPartCount, 1> touches = Eigen::Matrix<double, kGraspPartCount, 1>::Constant(-1);
  if (features.touches)
    std::ranges::transform(*features.touches, touches.data(),
                           [](PartTouch touch) { return static_cast<double>(touch); });
  write_floats(out, Eigen::Vector2d(origin, second));
  write_floats(out, features.values);
  write_floats(out, features.deviations);
  write_floats(out, touches);
}

}  // namespace barehand
