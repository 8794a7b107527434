// Scores a pose on the coarse grid.
#include "stages/search/coarse_score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace barehand {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Pixels without depth may belong to the hand if they are at most this far from it, since sensors lose depth at its
// border [m].
constexpr float kCloseToHand = 0.008f;
// Cost of a cell that the model covers at such a pixel, and of a cell without depth that the forearm covers.
constexpr float kCloseCost = 0.1f;
constexpr float kNearest = 0.02f;  // points nearer to the camera plane are not drawn [m]
constexpr int kBorder = 1;         // width of the border around the grid [cells]
constexpr std::size_t kLanes = 8;  // number of partial sums, so that the summation can be vectorised
// A splat covers 2 x 2 cells, which makes the model's silhouette about one cell too wide. The silhouette of the data is
// too wide by less, since a cell counts as hand from a third of its pixels on. Points are pulled inwards by this
// fraction of a cell to compensate for the difference.
constexpr double kShrink = 0.8;

/// Rigid transform from a segment to the camera, in single precision.
struct Transform {
  explicit Transform(const SE3& T) : R(T.R.cast<float>()), t(T.t.cast<float>()) {}
  Eigen::Matrix3f R;
  Eigen::Vector3f t;
};

// The next two functions use plain arrays, declared as not overlapping, and written-out sums, so that the compiler
// vectorises their loops.

/// Computes the depth [m] of every point, and a value that is negative if the skin there faces the camera.
void depth_and_facing(const CoarseSkin::Part& part, const Transform& T, float* __restrict depth,
                      float* __restrict facing) {
  const float *x = part.x.data(), *y = part.y.data(), *z = part.z.data();
  const float *nx = part.nx.data(), *ny = part.ny.data(), *nz = part.nz.data();
  const Eigen::Vector3f eye = T.R.transpose() * -T.t;
  const float rx = T.R(2, 0), ry = T.R(2, 1), rz = T.R(2, 2), tz = T.t.z(), ex = eye.x(), ey = eye.y(), ez = eye.z();
  const std::size_t count = part.size();
  for (std::size_t i = 0; i < count; ++i) {
    depth[i] = rx * x[i] + ry * y[i] + rz * z[i] + tz;
    facing[i] = nx[i] * (x[i] - ex) + ny[i] * (y[i] - ey) + nz[i] * (z[i] - ez);
  }
}

/// Projects the points to pixels, after pulling them inwards along their normals by `shrink` [m].
void pixels(const CoarseSkin::Part& part, const Transform& T, const Intrinsics& camera, float shrink,
            const float* __restrict depth, float* __restrict u, float* __restrict v) {
  // Load everything that does not depend on the point.
  const float *x = part.x.data(), *y = part.y.data(), *z = part.z.data();
  const float *nx = part.nx.data(), *ny = part.ny.data(), *nz = part.nz.data();
  const float ux = T.R(0, 0), uy = T.R(0, 1), uz = T.R(0, 2), tu = T.t.x();
  const float vx = T.R(1, 0), vy = T.R(1, 1), vz = T.R(1, 2), tv = T.t.y();
  const auto fx = static_cast<float>(camera.fx), fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx), cy = static_cast<float>(camera.cy);
  const std::size_t count = part.size();

  // Pull each point inwards, and project it.
  for (std::size_t i = 0; i < count; ++i) {
    const float px = x[i] - shrink * nx[i], py = y[i] - shrink * ny[i], pz = z[i] - shrink * nz[i];
    u[i] = fx * (ux * px + uy * py + uz * pz + tu) / depth[i] + cx;
    v[i] = fy * (vx * px + vy * py + vz * pz + tv) / depth[i] + cy;
  }
}

}  // namespace

CoarseScorer::CoarseScorer(const ScoreGrid& grid, const CoarseSkin& skin, const CoarseScoreParams& params)
    : skin_(skin),
      params_(params),
      camera_(grid.camera),
      shrink_(static_cast<float>(kShrink * grid.cell)),
      hand_cells_(grid.hand_cells) {
  // Surround the grid by its border.
  camera_.width += 2 * kBorder, camera_.height += 2 * kBorder;
  camera_.cx += kBorder, camera_.cy += kBorder;
  image_lo_u_ = static_cast<float>(grid.i_lo), image_hi_u_ = static_cast<float>(grid.i_hi + 2 * kBorder);
  image_lo_v_ = static_cast<float>(grid.j_lo), image_hi_v_ = static_cast<float>(grid.j_hi + 2 * kBorder);
  if (!grid.empty()) prepare(grid);

  // Reserve buffers for the largest part.
  std::size_t largest = skin.forearm.size();
  for (const CoarseSkin::Part& part : skin.parts) largest = std::max(largest, part.size());
  for (auto* buffer : {&u_, &v_, &z_, &facing_}) buffer->resize(largest);
  for (auto* buffer : {&visible_, &drawn_, &cell_}) buffer->resize(largest);
}

void CoarseScorer::prepare(const ScoreGrid& grid) {
  const std::size_t cells = static_cast<std::size_t>(camera_.width) * camera_.height;
  const std::size_t padded = (cells + kLanes - 1) / kLanes * kLanes;
  for (auto* values :
       {&costs_.data, &costs_.slope, &costs_.front, &costs_.behind, &costs_.empty, &costs_.forearm, &costs_.bare})
    values->assign(padded, 0.0f);
  for (auto* z_buffer : {&hand_z_, &forearm_z_}) z_buffer->assign(before_grid() + padded, kInfinity);
  for (int j = 0; j < grid.depth.height(); ++j) {
    for (int i = 0; i < grid.depth.width(); ++i) {
      prepare_cell(grid, grid.depth.index(i, j), static_cast<std::size_t>(j + kBorder) * camera_.width + i + kBorder);
    }
  }
}

void CoarseScorer::prepare_cell(const ScoreGrid& grid, std::size_t from, std::size_t to) {
  const float cap = static_cast<float>(params_.depth_cap);
  const float distance = std::min(grid.hand_distance[from], cap) / cap;
  const float background = static_cast<float>(params_.background) * distance;
  const bool measured = grid.depth[from] > 0;
  costs_.data[to] = grid.depth[from];
  // The data at a forearm cell may be skin, a sleeve or something in front of it; a surface behind it costs no_forearm.
  costs_.bare[to] = measured ? static_cast<float>(params_.no_forearm) : 0.0f;
  costs_.forearm[to] = measured ? 0.0f : kCloseCost;
  switch (grid.label[from]) {
    // The model pays for its difference in depth from the hand, and for hand that it does not cover.
    case PixelLabel::hand:
      costs_.slope[to] = 1 / cap;
      costs_.empty[to] = static_cast<float>(params_.unexplained);
      costs_.bare[to] = 0;
      break;

    // Sensors lose depth beside the hand, so the model may continue there.
    case PixelLabel::unknown:
      costs_.front[to] = costs_.behind[to] =
          grid.hand_distance[from] < kCloseToHand ? kCloseCost : static_cast<float>(params_.unknown) * distance;
      break;

    // An object may hide the model.
    case PixelLabel::object:
      costs_.front[to] = background;
      costs_.behind[to] = measured ? static_cast<float>(params_.hidden) : background;
      break;
    case PixelLabel::background:
      costs_.front[to] = costs_.behind[to] = background;
      break;
  }
}

double CoarseScorer::operator()(const HandPose& pose) {
  const bool finite = std::all_of(pose.begin(), pose.end(), [](const SE3& T) { return T.all_finite(); });
  if (hand_cells_ == 0 || !finite) return std::numeric_limits<double>::infinity();
  for (auto* z_buffer : {&hand_z_, &forearm_z_}) std::ranges::fill(*z_buffer, kInfinity);
  double outside = 0;
  for (const CoarseSkin::Part& part : skin_.parts) {
    splat(part, pose[part.segment], hand_z_);
    outside += outside_cost(part);
  }
  splat(skin_.forearm, pose[kPalm], forearm_z_);  // no outside_cost: the forearm may leave the region of interest
  return (outside + sum_of_costs()) / hand_cells_;
}

/// Sums the costs of all cells. The order of summation is fixed (within each lane, then over the lanes), so that the
/// result does not depend on how the compiler vectorises.
double CoarseScorer::sum_of_costs() const {
  const float cap = static_cast<float>(params_.depth_cap), sleeve = static_cast<float>(params_.sleeve_depth);
  const float *hand_z = hand_z_.data() + before_grid(), *forearm_z = forearm_z_.data() + before_grid();
  // A skin point covers 2 x 2 cells, but splat() stores its depth only in the top left one. The depth of a cell is
  // therefore the smallest of its own and those of its left, upper and upper left neighbours.
  const std::size_t above = camera_.width;
  const auto covering = [above](const float* z) {
    return std::min(std::min(*z, *(z - 1)), std::min(*(z - above), *(z - above - 1)));
  };

  // Load everything that does not depend on the cell.
  const float* data = costs_.data.data();
  const float *slope = costs_.slope.data(), *front = costs_.front.data(), *behind = costs_.behind.data();
  const float *empty = costs_.empty.data(), *forearm = costs_.forearm.data(), *bare = costs_.bare.data();
  std::array<float, kLanes> sum{};

  // Add up the costs of blocks of cells.
  for (std::size_t block = 0; block < costs_.data.size(); block += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      // All values are loaded before one is selected, so that the loop has no branches.
      const std::size_t i = block + lane;
      const float z = covering(hand_z + i), f = covering(forearm_z + i), d = data[i], per_metre = slope[i];
      const float in_front = front[i], hidden = behind[i], no_model = empty[i], arm = forearm[i], no_sleeve = bare[i];
      const float side = z < d ? in_front : hidden;
      const float model = per_metre * std::min(std::abs(z - d), cap) + side;
      const float hand = z < kInfinity ? model : no_model;

      // Compute the cost of the forearm, and take the surface that is nearer.
      const float air = d > f + sleeve ? no_sleeve : 0.0f;
      const float stub = per_metre * std::min(std::abs(f - d), cap) + arm + air;
      sum[lane] += f < z ? stub : hand;
    }
  }

  double total = 0;
  for (const float s : sum) total += s;
  return total;
}

double CoarseScorer::outside_cost(const CoarseSkin::Part& part) const {
  if (!leaves_grid_) return 0;  // usually, no point leaves the grid
  const float w = static_cast<float>(camera_.width - 1), h = static_cast<float>(camera_.height - 1);
  double beyond_region = 0;
  int beyond_image = 0;

  // Find the points that face the camera and are not on the grid.
  for (std::size_t i = 0; i < part.size(); ++i) {
    const bool off_grid = (u_[i] < 0.5f) | (v_[i] < 0.5f) | (u_[i] > w - 0.5f) | (v_[i] > h - 0.5f);
    if (!(off_grid & (facing_[i] < 0))) continue;
    const bool off_image =
        (u_[i] < image_lo_u_) | (v_[i] < image_lo_v_) | (u_[i] > image_hi_u_) | (v_[i] > image_hi_v_);
    beyond_image += off_image;
    if (!off_image) beyond_region += border_cost(u_[i], v_[i], z_[i]);
  }

  return beyond_region + params_.outside * beyond_image;
}

/// Cost of a point inside the image but outside the region of interest, where no hand was found. The background or
/// object at the nearest cell of the region's border is assumed to continue there.
double CoarseScorer::border_cost(float u, float v, float z) const {
  const int i = std::clamp(static_cast<int>(std::lround(u)), kBorder, camera_.width - 1 - kBorder);
  const int j = std::clamp(static_cast<int>(std::lround(v)), kBorder, camera_.height - 1 - kBorder);
  const std::size_t cell = static_cast<std::size_t>(j) * camera_.width + i;
  return z < costs_.data[cell] ? costs_.front[cell] : costs_.behind[cell];
}

/// Marks the points to draw and computes their cells; returns whether a point that faces the camera leaves the grid. It
/// is a separate function so that the compiler vectorises it.
bool CoarseScorer::find_cells(std::size_t count) {
  const float w = static_cast<float>(camera_.width - 1), h = static_cast<float>(camera_.height - 1);
  const std::int32_t stride = camera_.width, start = static_cast<std::int32_t>(before_grid());
  const float *u = u_.data(), *v = v_.data(), *z = z_.data(), *facing = facing_.data();
  std::int32_t *drawn = drawn_.data(), *cell = cell_.data();
  std::int32_t off_grid = 0;

  // Test all points without branches.
  for (std::size_t i = 0; i < count; ++i) {
    const bool front = facing[i] < 0;
    const bool within = front & (z[i] > kNearest) & (u[i] >= 0) & (v[i] >= 0) & (u[i] < w) & (v[i] < h);
    drawn[i] = within;
    cell[i] = start + static_cast<std::int32_t>(within ? v[i] : 0.0f) * stride +
              static_cast<std::int32_t>(within ? u[i] : 0.0f);

    off_grid |= front & ((u[i] < 0.5f) | (v[i] < 0.5f) | (u[i] > w - 0.5f) | (v[i] > h - 0.5f));
  }
  return off_grid != 0;
}

void CoarseScorer::splat(const CoarseSkin::Part& part, const SE3& T, std::vector<float>& z_buffer) {
  const Transform to_camera(T);
  depth_and_facing(part, to_camera, z_.data(), facing_.data());
  pixels(part, to_camera, camera_, shrink_, z_.data(), u_.data(), v_.data());
  leaves_grid_ = find_cells(part.size());

  // Collect the points to draw without branches.
  float* nearest = z_buffer.data();
  int visible = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    visible_[visible] = static_cast<std::int32_t>(i);
    visible += drawn_[i];
  }

  // Keep the smallest depth of each cell.
  for (int k = 0; k < visible; ++k) {
    float& z = nearest[cell_[visible_[k]]];
    z = std::min(z, z_[visible_[k]]);
  }
}

}  // namespace barehand
