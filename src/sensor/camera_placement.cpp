// Reads and checks the camera's pose in the room, as a user gives it.
#include "sensor/camera_placement.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"

namespace barehand {
namespace {

constexpr double kTolerance = 1e-3;  // largest deviation from a unit quaternion or rotation: typed numbers are rounded
constexpr const char* kWanted =
    "give x, y, z and the quaternion x, y, z, w, with 4 decimals or more, or the 16 numbers of a 4x4 matrix row by row";

Result<SE3> from_quaternion(const std::vector<double>& numbers, const std::string& where) {
  const Eigen::Quaterniond q(numbers[6], numbers[3], numbers[4], numbers[5]);
  if (std::abs(q.norm() - 1) > kTolerance)
    return fail(formatted("the quaternion has the norm %.4g instead of 1", q.norm()), where, kWanted);
  return SE3{q.normalized().toRotationMatrix(), {numbers[0], numbers[1], numbers[2]}};
}

Result<SE3> from_matrix(const std::vector<double>& numbers, const std::string& where) {
  const Eigen::Matrix4d m = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  if ((m.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).norm() > 1e-9)
    return fail("the last row is not 0, 0, 0, 1", where, kWanted);

  // Reject a matrix that is not a rigid motion.
  const Eigen::Matrix3d R = m.topLeftCorner<3, 3>();
  if ((R * R.transpose() - Eigen::Matrix3d::Identity()).norm() > kTolerance)
    return fail("the axes do not have the length 1 or are not at right angles", where, kWanted);
  if (R.determinant() < 0)
    return fail("the axes are left-handed: the matrix mirrors", where, "turn one axis of the rotation round");
  return SE3{orthonormalised(R), m.topRightCorner<3, 1>()};
}

}  // namespace

Result<std::optional<SE3>> world_from(const CameraPlacement& placement, const std::string& where) {
  const std::vector<double>& numbers = placement.T_world_camera;
  if (!std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); }))
    return fail("a number is not finite", where, kWanted);
  if (numbers.size() != 7 && numbers.size() != 16)
    return fail(std::to_string(numbers.size()) + " numbers are given", where, kWanted);

  const auto T = numbers.size() == 7 ? from_quaternion(numbers, where) : from_matrix(numbers, where);
  if (!T) return tl::unexpected(T.error());
  if (T->matrix().isIdentity(1e-12)) return std::nullopt;
  return *T;
}

}  // namespace barehand
