#include "hand/hand_shape.h"

#include <cmath>

#include "hand/implicit_hand.h"

namespace barehand {
namespace {

// Applies the components of a HandShape to a profile, and differentiates the skin with respect to them.

using Eigen::Vector3d;

// Index of the first component of each kind in a HandShape.
constexpr int kSize = 0, kPalmWidth = 1, kPalmLength = 2, kPalmThickness = 3, kFingerLength = 4,
              kBoneLength = kFingerLength + kFingerCount, kFingersThickness = kBoneLength + kSegmentCount - 1,
              kFlatness = kFingersThickness + 1, kFingerThickness = kFlatness + 1,
              kRootThickness = kFingerThickness + kFingerCount, kThenarThickness = kRootThickness + 1,
              kTip = kThenarThickness + 1, kFlesh = kTip + 1, kPalmFlesh = kFlesh + 1, kKnuckle = kPalmFlesh + 1;
static_assert(kKnuckle + 3 * kFingerCount == kShapeCount);

constexpr std::array<const char*, kFingerCount> kFingerNames = {"thumb", "index", "middle", "ring", "little"};

/// Names and standard deviations of all components.
std::array<ShapeParameter, kShapeCount> make_parameters() {
  std::array<ShapeParameter, kShapeCount> p;
  p[kSize] = {"size", 0.08};
  p[kPalmWidth] = {"palm_width", 0.06};
  p[kPalmLength] = {"palm_length", 0.06};
  p[kPalmThickness] = {"palm_thickness", 0.15};

  // Describe the components that exist once per finger.
  for (int f = 0; f < kFingerCount; ++f) {
    const std::string finger = kFingerNames[f];
    p[kFingerLength + f] = {finger + "_length", 0.05};
    p[kFingerThickness + f] = {finger + "_thickness", 0.06};
    for (int axis = 0; axis < 3; ++axis)
      p[kKnuckle + 3 * f + axis] = {finger + "_knuckle_" + "xyz"[axis], f == 0 ? 0.004 : 0.002};
  }

  // Describe the components that exist once per bone.
  for (int s = 1; s < kSegmentCount; ++s) p[kBoneLength + s - 1] = {std::string(kSegmentNames[s]) + "_length", 0.05};

  // Describe the components that all fingers share.
  p[kFingersThickness] = {"fingers_thickness", 0.12};
  p[kFlatness] = {"fingers_flatness", 0.08};
  p[kRootThickness] = {"knuckle_thickness", 0.2};
  p[kThenarThickness] = {"thenar_thickness", 0.15};
  p[kTip] = {"tip_length", 0.2};
  p[kFlesh] = {"finger_flesh", 0.1};
  p[kPalmFlesh] = {"palm_flesh", 0.1};
  return p;
}

/// Multiplies the values at both ends of a segment.
void scale(std::array<double, 2>& at_ends, double proximal, double distal) {
  at_ends[0] *= proximal;
  at_ends[1] *= distal;
}

// Scales the sections of a segment's skin.
void scale_section(SegmentProfile& s, double width, double thickness) {
  scale(s.half_width, width, width);
  scale(s.half_thickness, thickness, thickness);
  scale(s.radius, std::sqrt(width * thickness), std::sqrt(width * thickness));
  scale(s.flesh_offset_x, width, width);
  scale(s.flesh_offset_y, thickness, thickness);
}

void reshape_palm(SegmentProfile& palm, const HandShape& shape) {
  scale_section(palm, std::exp(shape[kSize] + shape[kPalmWidth]), std::exp(shape[kSize] + shape[kPalmThickness]));
  const double longer = std::exp(shape[kSize] + shape[kPalmLength]);
  palm.length *= longer;
  palm.distal *= longer;
  for (int end = 0; end < 2; ++end) palm.flesh_offset_y[end] += shape[kPalmFlesh] * palm.half_thickness[end];
}

void reshape_phalanx(SegmentProfile& bone, int segment, const HandShape& shape) {
  // Scale the length.
  const int finger = finger_of(segment);
  const double longer = std::exp(shape[kSize] + shape[kFingerLength + finger] + shape[kBoneLength + segment - 1]);
  bone.length *= longer;
  bone.distal *= longer;

  // Scale the cross-sections and shift the flesh in the direction of the thickness.
  const double wider = shape[kSize] + shape[kFingersThickness] + shape[kFingerThickness + finger];
  scale_section(bone, std::exp(wider), std::exp(wider + shape[kFlatness]));
  for (int end = 0; end < 2; ++end) bone.flesh_offset_y[end] += shape[kFlesh] * bone.half_thickness[end];

  // The base of the thumb and the bases of the fingers have additional components.
  if (segment == segment_of(0, 0)) {
    const double thenar = std::exp(shape[kThenarThickness]);
    scale_section(bone, thenar, thenar);
  } else if (parent_of(segment) == kPalm) {
    const double root = std::exp(shape[kRootThickness]);
    for (auto* of : {&bone.half_width, &bone.half_thickness, &bone.radius, &bone.flesh_offset_y}) scale(*of, root, 1);
  }

  if (is_tip(segment)) bone.radius[1] *= std::exp(shape[kTip]);
}

// The origin of a segment's frame in its parent's frame after the change of shape [m].
Vector3d reshaped_joint(Vector3d joint, int segment, const HandShape& shape) {
  const int parent = parent_of(segment);
  if (parent != kPalm) {
    const double longer =
        std::exp(shape[kSize] + shape[kFingerLength + finger_of(parent)] + shape[kBoneLength + parent - 1]);
    return joint * longer;
  }
  joint.x() *= std::exp(shape[kSize] + shape[kPalmWidth]);
  joint.y() *= std::exp(shape[kSize]);
  joint.z() *= std::exp(shape[kSize] + shape[kPalmLength]);
  return joint + shape.segment<3>(kKnuckle + 3 * finger_of(segment));
}

}  // namespace

const std::array<ShapeParameter, kShapeCount>& shape_parameters() {
  static const auto parameters = make_parameters();
  return parameters;
}

HandProfile reshaped(const HandProfile& mean, const HandShape& shape) {
  HandProfile hand = mean;
  hand.origin = ProfileOrigin::fitted;
  reshape_palm(hand.segments[kPalm], shape);
  for (int s = 1; s < kSegmentCount; ++s) {
    reshape_phalanx(hand.segments[s], s, shape);
    SE3 joint = mean.rest_relative(s);
    joint.t = reshaped_joint(joint.t, s, shape);
    hand.segments[s].T_hand_segment = hand.segments[parent_of(s)].T_hand_segment * joint;
  }
  return hand;
}

ShapeBasis shape_basis(const HandProfile& mean, const HandShape& shape, const Skin& skin, const std::stop_token& stop) {
  constexpr double kStep = 0.01;  // step of the finite differences, in standard deviations of a shape component
  ShapeBasis basis;
  basis.outward.resize(static_cast<Eigen::Index>(skin.vertices.size()), Eigen::NoChange);

  const HandProfile hand = reshaped(mean, shape);
  const ImplicitHand surface(hand);

  // Computes the distance of a vertex from the surface of another shape.
  const auto distance_at = [&](const ImplicitHand& other, const SkinVertex& v) {
    // Blend the vertex between its two segments as pose_skin() does.
    const Vector3d a = other.pose()[v.a] * v.in_a.cast<double>(), b = other.pose()[v.b] * v.in_b.cast<double>();
    return other.distance(a + v.weight_b * (b - a));
  };

  // For the unchanged hand, compute the distances of the vertices, and their normals in the frames of their second
  // segments.
  std::vector<double> before(skin.vertices.size());
  for (std::size_t i = 0; i < before.size(); ++i) before[i] = distance_at(surface, skin.vertices[i]);
  for (const SkinVertex& v : skin.vertices)
    basis.normal_in_b.push_back(
        (surface.pose()[v.b].R.transpose() * surface.pose()[v.a].R * v.normal_in_a.cast<double>()).cast<float>());

  // Compute finite differences, one shape component after the other.
  basis.joint[kPalm].setZero();
  for (int k = 0; k < kShapeCount && !stop.stop_requested(); ++k) {
    // Change the component slightly, and measure how far the joints move.
    const double step = kStep * shape_parameters()[k].deviation;
    HandShape changed = shape;
    changed[k] += step;
    const HandProfile other = reshaped(mean, changed);
    for (int s = 1; s < kSegmentCount; ++s)
      basis.joint[s].col(k) = (other.rest_relative(s).t - hand.rest_relative(s).t) / step;

    // Measure how far the surface moves outward at each vertex.
    const ImplicitHand grown(other);
    for (std::size_t i = 0; i < before.size(); ++i)
      basis.outward(static_cast<Eigen::Index>(i), k) =
          static_cast<float>((before[i] - distance_at(grown, skin.vertices[i])) / step);
  }
  return basis;
}

Skin morphed(const Skin& skin, const ShapeBasis& basis, const HandShape& change) {
  Skin result = skin;
  const Eigen::VectorXf outward = basis.outward * change.cast<float>();
  for (std::size_t i = 0; i < result.vertices.size(); ++i) {
    SkinVertex& v = result.vertices[i];
    v.in_a += outward[static_cast<Eigen::Index>(i)] * v.normal_in_a;
    v.in_b += outward[static_cast<Eigen::Index>(i)] * basis.normal_in_b[i];
  }
  return result;
}

}  // namespace barehand
