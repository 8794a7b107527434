#include "observe/dense/model_comparison.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

// Compares a rendered hand with an observation cell by cell, and finds where the model should move.

using Eigen::Vector3f;
using Kind = Correspondence::Kind;

constexpr float kWristMargin = 0.010f;  // data this far behind the wrist belongs to the forearm [m]
// If the model is in front of a non-hand surface by less than this [m], it may be moved behind the surface.
constexpr float kStandsOut = 0.005f;
constexpr float kHoleReach = 0.020f;     // missing depth is evidence up to this far beside what was measured [m]
constexpr float kSameSurface = 0.020f;   // by how much the depths of model and data beside a hole may differ [m]
constexpr std::int32_t kLostPixels = 2;  // a sensor may lose this many pixels along the edge of a surface

// The part of the hand, a finger or the palm, that a segment belongs to.
int part_of(int segment) { return segment == kPalm ? -1 : finger_of(segment); }

/// Classifies every cell of the grid and collects the correspondences.
class Comparer {
 public:
  Comparer(const HandObservation& observation, const Skin& skin, const HandPose& pose, const RenderedHand& rendered,
           const ComparisonParams& params, ModelComparison& out)
      : obs_(observation), skin_(skin), rendered_(rendered), params_(params), out_(out) {
    // Compute the wrist plane in camera coordinates, and the relative area of a cell at a depth of 1 m.
    const SE3 T_palm_camera = pose[kPalm].inverse();
    wrist_axis_ = T_palm_camera.R.row(2).cast<float>();
    wrist_offset_ = static_cast<float>(T_palm_camera.t.z());
    const Intrinsics& c = obs_.frame->camera;
    const int stride = rendered.grid.stride;
    cell_area_per_z_sq_ = static_cast<float>(stride * stride / (c.fx * c.fy)) / kReferenceArea;
  }

  void run() {
    // Clear the previous results, and prepare the look-up tables.
    out_.correspondences.clear();
    out_.visible.fill(0);
    out_.matched.fill(0);
    out_.unexplained.fill(0);
    out_.rays.reset(obs_.frame->camera, obs_.u0, obs_.v0, obs_.depth.width(), obs_.depth.height());
    out_.nearest_model.index(rendered_.vertex);

    // Every cell that shows model or hand data is one piece of evidence.
    const CellGrid& g = rendered_.grid;
    for (int j = 0; j < g.height; ++j)
      for (int i = 0; i < g.width; ++i) {
        const int u = i * g.stride, v = j * g.stride;
        if (rendered_.vertex.at(i, j) >= 0)
          compare_model_pixel(i, j, u, v);
        else if (obs_.label.at(u, v) == PixelLabel::hand)
          compare_data_pixel(i, j, u, v);
      }

    // The score is the weighted mean of the capped distances.
    out_.score = total_weight_ > 0 ? total_ / total_weight_ : params_.distance_cap;
  }

 private:
  Vector3f model_point(int i, int j) const {
    return out_.rays.point(i * rendered_.grid.stride, j * rendered_.grid.stride, rendered_.depth.at(i, j));
  }
  Vector3f data_point(int u, int v) const { return out_.rays.point(u, v, obs_.depth.at(u, v)); }

  // Adds the correspondence of cell (i, j) and its contribution to the score. `cost_distance`: uncapped distance [m];
  // `share`: what this evidence counts relative to that of a measured pixel.
  void add(Kind kind, int i, int j, const Vector3f& data, float cost_distance, float share = 1) {
    const int vertex = rendered_.vertex.at(i, j);
    const float z = kind == Kind::unexplained ? data.z() : rendered_.depth.at(i, j);
    const float weight = share * cell_area_per_z_sq_ * z * z;
    const Vector3f normal = rendered_.normal.empty() ? Vector3f(Vector3f::Zero()) : rendered_.normal[vertex];
    out_.correspondences.push_back({kind, vertex, model_point(i, j), normal, data, weight});
    total_ += weight * std::min<double>(cost_distance, params_.distance_cap);
    total_weight_ += weight;
  }

  /// Adds the correspondence of a cell that shows the model, and counts whether its segment is visible and matched. The
  /// cell is pixel (u, v) of the region of interest.
  void compare_model_pixel(int i, int j, int u, int v) {
    const float z_model = rendered_.depth.at(i, j), z_data = obs_.depth.at(u, v);
    const int segment = skin_.vertices[rendered_.vertex.at(i, j)].a;
    const PixelLabel label = obs_.label.at(u, v);

    // A hole in the data does not hide the segment.
    if (label == PixelLabel::unknown || z_data <= 0) {
      ++out_.visible[segment];
      compare_hole(i, j, u, v);
      return;
    }

    // Model and data both show the hand: add a surface correspondence.
    if (label == PixelLabel::hand) {
      ++out_.visible[segment];
      if (std::abs(z_data - z_model) < params_.self_occlusion) ++out_.matched[segment];
      add(Kind::surface, i, j, data_point(u, v), std::abs(z_data - z_model));
      return;
    }

    // A surface that is not hand hides the model if it is in front of it, and contradicts the model if it is behind it.
    const float tolerance = label == PixelLabel::object ? static_cast<float>(params_.occlusion_tolerance) : 0.0f;
    if (z_data < z_model + tolerance) return;
    ++out_.visible[segment];
    const std::int32_t hand = obs_.nearest_hand.at(u, v);
    if (hand < 0) return;

    // The model is where the data shows no hand. It should move to the nearer of two places: sideways, onto the hand's
    // data (paper, Eq. 1), or back behind the measured surface, if it is only slightly in front of it.
    const Vector3f model = model_point(i, j), aside = nearest_aside(u, v, hand, model);
    const float back = z_data - tolerance - z_model, distance_aside = (aside - model).norm();
    if (back < std::min(kStandsOut, distance_aside))
      add(Kind::behind, i, j, out_.rays.point(u, v, z_model + back), back);
    else
      add(Kind::outside, i, j, aside, distance_aside);
  }

  /// Adds the correspondence of a cell that shows the model where nothing was measured. A sensor that measures a finger
  /// seldom misses its next millimetres, so the finger most probably ends beside the hole. There is no such evidence at
  /// the edge of what was measured, in the shadow of a nearer object, and where a whole finger is missing, so that
  /// another part of the hand lies beside the hole.
  void compare_hole(int i, int j, int u, int v) {
    const std::int32_t hand = obs_.nearest_hand.at(u, v);
    if (hand < 0 || params_.missing_depth <= 0) return;
    const int row = out_.rays.row_of(hand), column = hand - row * obs_.depth.width();
    if (std::max(std::abs(column - u), std::abs(row - v)) <= kLostPixels) return;

    // The same part of the model must cover the nearest data, which must be near.
    const int stride = rendered_.grid.stride;
    const std::int32_t there = rendered_.vertex.at(column / stride, row / stride), here = rendered_.vertex.at(i, j);
    if (there < 0 || part_of(skin_.vertices[there].a) != part_of(skin_.vertices[here].a)) return;
    const Vector3f model = model_point(i, j), data = out_.rays.point(hand, obs_.depth);
    const float distance_aside = (data - model).head<2>().norm();
    if (distance_aside > kHoleReach || std::abs(data.z() - model.z()) > kSameSurface) return;

    const std::int32_t object = object_in_front(u, v, model);
    if (object >= 0 && (at_depth(object, model.z()) - model).norm() < kHoleReach) return;
    add(Kind::outside, i, j, data, distance_aside, static_cast<float>(params_.missing_depth));
  }

  // The nearest point to which the model can move sideways in the image: the hand data at the pixel `hand`. If the hand
  // data there or the nearest object is in front of the model, the model can also move behind it at its own depth.
  Vector3f nearest_aside(int u, int v, std::int32_t hand, const Vector3f& model) const {
    const bool hand_hides = obs_.depth[hand] < model.z() - static_cast<float>(params_.self_occlusion);
    const Vector3f at_hand = hand_hides ? at_depth(hand, model.z()) : out_.rays.point(hand, obs_.depth);
    const std::int32_t object = object_in_front(u, v, model);
    if (object < 0) return at_hand;
    const Vector3f at_object = at_depth(object, model.z());
    return (at_object - model).squaredNorm() < (at_hand - model).squaredNorm() ? at_object : at_hand;
  }

  // The object pixel nearest to pixel (u, v), if the object lies in front of this point of the model; else -1.
  std::int32_t object_in_front(int u, int v, const Vector3f& model) const {
    const std::int32_t object = obs_.nearest_object.empty() ? -1 : obs_.nearest_object.at(u, v);
    const bool in_front =
        object >= 0 && obs_.depth[object] <= model.z() + static_cast<float>(params_.occlusion_tolerance);
    return in_front ? object : -1;
  }

  // The point at depth z [m] on the line of sight of the pixel with this index.
  Vector3f at_depth(std::int32_t pixel, float z) const {
    const int row = out_.rays.row_of(pixel);
    return out_.rays.point(pixel - row * obs_.depth.width(), row, z);
  }

  /// Adds a correspondence of the kind `unexplained` for a cell that shows hand data but no model, unless the cell
  /// shows the forearm. The cell is pixel (u, v) of the region of interest.
  void compare_data_pixel(int i, int j, int u, int v) {
    const Vector3f data = data_point(u, v);
    if (wrist_axis_.dot(data) + wrist_offset_ > kWristMargin) return;  // the forearm is not part of the model
    const std::int32_t nearest = out_.nearest_model.find(i, j);
    if (nearest < 0) return;
    const int mi = nearest % rendered_.grid.width, mj = nearest / rendered_.grid.width;
    ++out_.unexplained[skin_.vertices[rendered_.vertex.at(mi, mj)].a];
    add(Kind::unexplained, mi, mj, data, (data - model_point(mi, mj)).norm());
  }

  const HandObservation& obs_;
  const Skin& skin_;
  const RenderedHand& rendered_;
  const ComparisonParams& params_;
  ModelComparison& out_;
  Vector3f wrist_axis_;
  float wrist_offset_ = 0, cell_area_per_z_sq_ = 0;
  double total_ = 0, total_weight_ = 0;
};

}  // namespace

CellGrid grid_of(const HandObservation& observation, int stride) {
  return {observation.u0, observation.v0, stride, (observation.depth.width() + stride - 1) / stride,
          (observation.depth.height() + stride - 1) / stride};
}

void compare(const HandObservation& observation, const Skin& skin, const HandPose& pose, const RenderedHand& rendered,
             const ComparisonParams& params, ModelComparison& out) {
  Comparer(observation, skin, pose, rendered, params, out).run();
}

}  // namespace barehand
