#pragma once

#include "math/se3.h"

namespace barehand {

// Writes vectors and rotations to the fields of LCM messages.

inline void copy(const Eigen::Vector3d& v, double (&out)[3]) {
  for (int i = 0; i < 3; ++i) out[i] = v[i];
}

/// Writes a rotation as the quaternion (w, x, y, z) with w >= 0, which makes it unique.
inline void copy(const Eigen::Matrix3d& R, double (&out)[4]) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(R).normalized();
  const double sign = q.w() < 0 ? -1 : 1;
  out[0] = sign * q.w();
  out[1] = sign * q.x();
  out[2] = sign * q.y();
  out[3] = sign * q.z();
}

inline void copy(const Matrix6d& m, double (&out)[6][6]) {
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) out[i][j] = m(i, j);
}

}  // namespace barehand
