// Writes the true features of simulated grasps, without rendering and tracking, for the training of the grasp
// classifier: many more hands and objects than there is time to track.
//
//   planned_examples OUT FIRST_SEED COUNT classes      every class of each seed, open, closing and holding
//   planned_examples OUT FIRST_SEED COUNT sequences    the sequences of collect.py, 15 frames a second
//
// Each row (example_file.h) begins with the class, or the number of the sequence, and the time in the sequence [s].
// Rows of classes end with the derivatives of the values of the features by the joint angles, one column of 52 for each
// angle.
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "drivers/synthetic/grasps/varied_grasp.h"
#include "drivers/synthetic/hand/hand_mesh_file.h"
#include "drivers/synthetic/hand/measured_profile.h"
#include "hand/grasps/grasp_types.h"
#include "tools/training/grasps/example_file.h"

namespace {

using namespace barehand;
using namespace barehand::synthetic;

constexpr double kStep = 1e-3;  // step of an angle for numerical derivatives [rad]

/// The features of this shape of a hand.
GraspFeatures features_of(const std::shared_ptr<const HandProfile>& profile, const HandAngles& angles) {
  HandEstimate estimate;
  estimate.profile = profile;
  const HandPose pose = pose_segments(*profile, {SE3{}, angles});
  for (int s = 0; s < kSegmentCount; ++s) {
    estimate.segments[s].T_camera_segment = pose[s];
    estimate.segments[s].covariance.setZero();
  }
  return grasp_features(estimate, nullptr);
}

/// The derivatives of the features of this shape, in the order of GraspFeatures::deviations. The animated thumb has no
/// abduction at its second joint, whose column is zero.
void write_derivatives(std::ofstream& out, const std::shared_ptr<const HandProfile>& profile, const HandAngles& angles,
                       const GraspFeatures& features) {
  Eigen::Matrix<double, kGraspFeatureCount, kGraspAngleCount> derivatives;
  int column = 0;
  const auto differentiate = [&](auto angle_of) {
    HandAngles moved = angles;
    angle_of(moved) += kStep;
    derivatives.col(column++) = (features_of(profile, moved).values - features.values) / kStep;
  };
  for (std::size_t finger = 0; finger < angles.size(); ++finger)
    for (std::size_t k = 0; k < 3; ++k) {
      differentiate([&](HandAngles& moved) -> double& { return moved[finger].flexion[k]; });
      if (k == 0) differentiate([&](HandAngles& moved) -> double& { return moved[finger].abduction; });
      if (finger == 0 && k == 1) derivatives.col(column++).setZero();
    }
  write_floats(out, derivatives);
}

/// The rows of one sequence. `derivatives`: they have them, too.
Result<void> write_examples(const HandRig& rig, int type, std::uint64_t seed, double origin,
                            const std::vector<double>& times, bool derivatives, std::ofstream& out) {
  const auto sequence =
      make_varied_grasp(rig, {"", std::string(grasp_types()[static_cast<std::size_t>(type)].name)}, seed);
  if (!sequence) return tl::unexpected(sequence.error());
  const auto profile = std::make_shared<const HandProfile>(rig.profile);
  for (const double time : times) {
    const HandAngles angles = (*sequence)->at(time).hands[0].skeleton.angles;
    const GraspFeatures features = features_of(profile, angles);
    write_example(out, origin, time, features);
    if (derivatives) write_derivatives(out, profile, angles, features);
  }
  return {};
}

Result<void> run(char** argv) {
  const auto path = find_hand_mesh(Handedness::right, "");
  if (!path) return tl::unexpected(path.error());
  const auto mesh = load_hand_mesh(*path, Handedness::right);
  if (!mesh) return tl::unexpected(mesh.error());
  std::ofstream out(argv[1], std::ios::binary);
  const auto first = std::strtoull(argv[2], nullptr, 10), count = std::strtoull(argv[3], nullptr, 10);
  const bool sequences = std::string_view(argv[4]) == "sequences";
  std::vector<double> times = {0.3, 1.0, 1.45, 3.0};
  if (sequences) {
    times.clear();
    for (int frame = 0; frame < 80; ++frame) times.push_back(frame / 15.0);
  }
  for (auto seed = first; seed < first + count; ++seed) {
    const HandMesh own = reshaped(*mesh, drawn_hand({}, seed));
    const HandRig rig{own, measure_profile(own)};
    for (int type = 0; type < kGraspTypeCount; ++type) {
      if (sequences && type != static_cast<int>(seed % kGraspTypeCount)) continue;
      const auto origin = sequences ? static_cast<double>(seed - first) : static_cast<double>(type);
      if (const auto written = write_examples(rig, type, seed, origin, times, !sequences, out); !written)
        return written;
    }
  }
  if (!out.flush()) return fail("cannot be written", argv[1], "is the disk full?");
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: planned_examples OUT FIRST_SEED COUNT classes|sequences\n");
    return 2;
  }
  const auto done = run(argv);
  if (!done) std::fprintf(stderr, "planned_examples: %s\n", done.error().message().c_str());
  return done ? 0 : 1;
}
