#include "person/scan_prior.h"

#include "math/square.h"
#include "person/skin_sections.h"

namespace barehand {
namespace {

// Prior knowledge about a scanned hand as terms of the normal equations.

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Standard deviations of the joints around their positions at the start of the scan: about as large as the errors of
// the fit that precedes it, which approximates the hand by elliptic sections.
constexpr double kAcrossBone = 0.002;  // position of a joint across the bone [m]
constexpr double kAlongBone = 0.003;   // position of a joint along the bone; in all directions for the thumb's root [m]
constexpr double kBetweenBones = 0.001;  // distance between the two points of a joint [m]
constexpr double kRestTurn = 0.015;      // rotation of a joint's axes [rad]
constexpr double kBesideMiddle = 0.001;  // distance of a finger's root joint from the middle of the finger's skin [m]

// Standard deviations of the skin.
constexpr double kOffset = 0.1;           // offset of a vertex [m]: weak, it only determines vertices never seen
constexpr double kSmoothOffset = 0.0025;  // difference of the offsets along an edge [m]
constexpr double kMeanOffset = 0.00012;   // mean offset of a segment's skin [m]
constexpr double kMeanLever = 0.02;       // lever arm that converts the skin's mean rotation to an offset [m]
constexpr double kMiddleWeight = 0.3;     // skinning weight in the middle of a bone
constexpr double kSmoothWeight = 0.3;     // difference of the skinning weights along an edge

// Whether the vertex follows one bone alone, away from the flesh of palm and thumb.
bool in_middle_of_bone(const SkinVertex& v) { return v.weight_b == 0 && v.a != kPalm && v.a != segment_of(0, 0); }

// Standard deviation of a vertex's skinning weight: smaller at the hinges of fingers than in the flesh of the palm.
double weight_deviation(const SkinVertex& v) {
  if (in_middle_of_bone(v)) return kMiddleWeight;
  const int thumb_root = segment_of(0, 0);
  return v.a == kPalm || v.b == kPalm || v.a == thumb_root || v.b == thumb_root ? 1.0 : 0.5;
}

/// Adds the terms of the prior, one kind per function.
class Prior {
 public:
  Prior(const ScanModel& model, const ScanModel& start, const ScanVariables& variables, ScanEquations& equations)
      : model_(model), start_(start), variables_(variables), out_(equations), offset_(model.skin.vertices.size()) {
    for (std::size_t i = 0; i < offset_.size(); ++i) {
      const SkinVertex &now = model.skin.vertices[i], &before = start.skin.vertices[i];
      offset_[i] = now.normal_in_a.dot(now.in_a - before.in_a);
    }
  }

  void add_joints(bool hold) {
    for (int s = 1; s < kSegmentCount; ++s) {
      const int first = ScanVariables::joint(s);
      // Each point of a joint stays near its starting position, most firmly across the bone.
      const Vector3d in_parent = model_.in_parent[s] - start_.in_parent[s];
      const Vector3d in_segment = model_.in_segment[s] - start_.in_segment[s];
      for (int axis = 0; axis < 3; ++axis) {
        const double deviation = s == segment_of(0, 0) || axis == 2 ? kAlongBone : kAcrossBone;
        add_one(first + axis, in_parent[axis], deviation);
        add_one(first + 3 + axis, in_segment[axis], deviation);
      }

      // The two points of a joint coincide at rest.
      Eigen::Matrix<double, 3, 6> J;
      J << Matrix3d::Identity(), -start_.rest[s];
      const Eigen::Matrix<double, 6, 1> moved = (Eigen::Matrix<double, 6, 1>() << in_parent, in_segment).finished();
      out_.add<6>(first, J.transpose() * J / square(kBetweenBones));
      out_.g.segment<6>(first) -= J.transpose() * (J * moved) / square(kBetweenBones);

      // The axes of the joint stay near their initial directions.
      const Vector3d turn = log_so3(start_.rest[s].transpose() * model_.rest[s]);
      for (int axis = 0; axis < 3; ++axis) add_one(first + 6 + axis, turn[axis], kRestTurn);
      if (hold)
        for (int k = first; k < first + ScanVariables::kJoint; ++k) out_.add(k, k, kFixedInformation);
    }
  }

  // Every vertex stays near its starting position. While the joints are held, skin in the middle of a bone stays rigid,
  // because it need not compensate for moving joints.
  void add_vertices(bool joints_held) {
    for (int i = 0; i < static_cast<int>(offset_.size()); ++i) {
      add_one(variables_.offset(i), offset_[i], kOffset);
      add_one(variables_.skin_weight(i), weight_change(i), weight_deviation(vertex(i)));
      if (joints_held && in_middle_of_bone(vertex(i)))
        out_.add(variables_.skin_weight(i), variables_.skin_weight(i), kFixedInformation);
    }
  }

  void add_smoothness() {
    for (const auto& t : model_.skin.triangles)
      for (int k = 0; k < 3; ++k) {
        const int i = t[k], j = t[(k + 1) % 3];  // each edge occurs twice, once for either triangle
        add_difference(variables_.offset(i), variables_.offset(j), offset_[i], offset_[j], 1, kSmoothOffset);
        const SkinVertex &a = vertex(i), &b = vertex(j);
        if (a.a == b.a && a.b == b.b)
          add_difference(variables_.skin_weight(i), variables_.skin_weight(j), weight_change(i), weight_change(j), 1,
                         kSmoothWeight);
        else if (a.a == b.b && a.b == b.a)  // the two weights belong to opposite segments: they add up to 1
          add_difference(variables_.skin_weight(i), variables_.skin_weight(j), weight_change(i), weight_change(j), -1,
                         kSmoothWeight);
      }
  }

  // The offsets of a segment's skin neither shift nor rotate it on average.
  void add_mean(int segment) {
    // Collect the segment's vertices, and compute their centre.
    std::vector<int> members, unknowns;
    Vector3d centre = Vector3d::Zero();
    for (int i = 0; i < static_cast<int>(offset_.size()); ++i)
      if (vertex(i).a == segment) {
        members.push_back(i);
        unknowns.push_back(variables_.offset(i));
        centre += vertex(i).in_a.cast<double>();
      }

    if (members.empty()) return;
    const auto count = static_cast<Eigen::Index>(members.size());
    centre /= static_cast<double>(count);

    // Express the mean translation and rotation of the skin as linear functions of the offsets.
    Eigen::Matrix<double, 6, Eigen::Dynamic> J(6, count);
    Eigen::VectorXd offset(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const SkinVertex& v = vertex(members[k]);
      const Vector3d normal = v.normal_in_a.cast<double>();
      J.col(k) << normal, (v.in_a.cast<double>() - centre).cross(normal) / kMeanLever;
      offset[k] = offset_[members[k]];
    }

    // Scale the means, and add them as residuals.
    J /= static_cast<double>(count) * kMeanOffset;
    add_mean_rows(unknowns, J, J * offset);
  }

  // The root of a finger is in the middle of its skin from side to side. This must be a term of the prior, because
  // images hardly determine the root's position along the knuckle's axis.
  void add_middle(int finger) {
    const int segment = segment_of(finger, 0);
    const auto sections = SkinSections::fit(start_.skin, segment, start_.profile.segments[segment].length, true);
    if (!sections) return;

    // Express the root joint's distance from the middle of the skin as a linear function of the joint and the vertices'
    // offsets.
    double beside = sections->middle_x(0) - model_.in_segment[segment].x();
    std::vector<int> unknowns = {ScanVariables::joint(segment) + 3};
    std::vector<double> J = {-1};

    // Add the derivatives with respect to the offsets of the vertices.
    for (std::size_t k = 0; k < sections->vertices().size(); ++k) {
      const int vertex = sections->vertices()[k];
      const double change = sections->middle_x_per_offset()[static_cast<Eigen::Index>(k)];
      unknowns.push_back(variables_.offset(vertex));
      J.push_back(change);
      beside += change * offset_[vertex];
    }

    // Add this distance as one residual.
    const auto count = static_cast<Eigen::Index>(J.size());
    add_mean_rows(unknowns, Eigen::RowVectorXd::Map(J.data(), count) / kBesideMiddle,
                  Eigen::VectorXd::Constant(1, beside / kBesideMiddle));
  }

 private:
  const SkinVertex& vertex(int i) const { return start_.skin.vertices[i]; }
  double weight_change(int i) const { return model_.skin.vertices[i].weight_b - vertex(i).weight_b; }

  void add_one(int unknown, double value, double deviation) {
    out_.add(unknown, unknown, 1 / square(deviation));
    out_.g[unknown] -= value / square(deviation);
  }

  // Adds the squares of `residuals`, which depend on many unknowns; J has one column for each of `unknowns`.
  void add_mean_rows(const std::vector<int>& unknowns, const Eigen::MatrixXd& J, const Eigen::VectorXd& residuals) {
    const Eigen::VectorXd g = J.transpose() * residuals;
    const int rows = static_cast<int>(J.rows());
    for (Eigen::Index k = 0; k < g.size(); ++k) {
      out_.g[unknowns[k]] -= g[k];
      for (int row = 0; row < rows; ++row) out_.means.emplace_back(out_.mean_rows + row, unknowns[k], J(row, k));
    }
    out_.mean_rows += rows;
  }

  // Adds the square of x - sign * y, where x and y are the current values of the unknowns i and j, at half weight
  // because every edge occurs twice.
  void add_difference(int i, int j, double x, double y, double sign, double deviation) {
    const double w = 0.5 / square(deviation), difference = x - sign * y;
    out_.add(i, i, w);
    out_.add(j, j, w);
    out_.add(i, j, -sign * w);
    out_.g[i] -= w * difference;
    out_.g[j] += sign * w * difference;
  }

  const ScanModel &model_, &start_;
  const ScanVariables& variables_;
  ScanEquations& out_;
  std::vector<double> offset_;  // shift of every vertex along its normal since the start [m]
};

}  // namespace

void add_scan_prior(const ScanModel& model, const ScanModel& start, const ScanVariables& variables, bool hold_joints,
                    ScanEquations& equations) {
  Prior prior(model, start, variables, equations);
  prior.add_joints(hold_joints);
  prior.add_vertices(hold_joints);
  prior.add_smoothness();
  for (int s = 0; s < kSegmentCount; ++s) prior.add_mean(s);
  if (hold_joints) return;
  // The thumb is left out, because its root is too deep in the flesh.
  for (int finger = 1; finger < kFingerCount; ++finger) prior.add_middle(finger);
}

}  // namespace barehand
