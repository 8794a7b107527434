#pragma once

#include <fstream>

#include "stages/grasp/grasp_features.h"

namespace barehand {

/// Writes a row of examples as float32: what it belongs to, a second number, the features, and their spread, column by
/// column.
inline void write_example(std::ofstream& out, double origin, double second, const GraspFeatures& features) {
  const auto write = [&out](const auto& values) {
    const auto floats = values.template cast<float>().eval();
    out.write(reinterpret_cast<const char*>(floats.data()),
              static_cast<std::streamsize>(sizeof(float) * static_cast<std::size_t>(floats.size())));
  };
  write(Eigen::Vector2d(origin, second));
  write(features.values);
  write(features.spread);
}

}  // namespace barehand
