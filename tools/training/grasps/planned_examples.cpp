// Writes the features of grasps as the simulator plans them, without rendering and tracking, for the training of the
// grasp classifier: many more hands and objects than there is time to track.
//
//   planned_examples OUT FIRST_SEED COUNT
//
// For each seed and class, three rows (example_file.h) of one hand: open, closing, holding. They begin with the class
// and the fraction by which the hand is closed; the spread is that of joints that err by 1 rad each.
#include <cstdio>
#include <cstdlib>

#include "drivers/synthetic/grasps/grasp_plan.h"
#include "drivers/synthetic/grasps/varied_grasp.h"
#include "drivers/synthetic/hand/hand_mesh_file.h"
#include "drivers/synthetic/hand/measured_profile.h"
#include "hand/grasps/grasp_types.h"
#include "tools/training/grasps/example_file.h"

namespace {

using namespace barehand;
using namespace barehand::synthetic;

/// An estimate of this shape of a hand, each of whose joints has a standard deviation of 1 rad.
HandEstimate estimate_of(const std::shared_ptr<const HandProfile>& profile, const HandAngles& angles) {
  HandEstimate estimate;
  estimate.profile = profile;
  const HandPose pose = pose_segments(*profile, {SE3{}, angles});
  for (int s = 0; s < kSegmentCount; ++s) {
    estimate.segments[s].T_camera_segment = pose[s];
    const double joints = s == kPalm ? 0 : 1 + (s - 1) % 3;
    estimate.segments[s].covariance = joints * Matrix6d::Identity();
  }
  return estimate;
}

/// The angles between two shapes of a hand; 0: the first.
HandAngles between(const HandAngles& a, const HandAngles& b, double fraction) {
  HandAngles out = a;
  for (std::size_t f = 0; f < kFingerCount; ++f) {
    out[f].abduction += fraction * (b[f].abduction - a[f].abduction);
    for (std::size_t k = 0; k < 3; ++k) out[f].flexion[k] += fraction * (b[f].flexion[k] - a[f].flexion[k]);
  }
  return out;
}

Result<void> write_examples(const HandMesh& mesh, std::uint64_t seed, std::ofstream& out) {
  const HandMesh own = reshaped(mesh, drawn_hand({}, seed));
  const HandRig rig{own, measure_profile(own)};
  const auto profile = std::make_shared<const HandProfile>(rig.profile);
  for (int type = 0; type < kGraspTypeCount; ++type) {
    const std::vector<std::string> objects = objects_for(type, seed >= kFirstTestSeed);
    const auto plan = plan_grasp(rig, type, objects[(seed + static_cast<std::size_t>(type)) % objects.size()], seed);
    if (!plan) return tl::unexpected(plan.error());
    for (const double closed : {0.0, 0.3, 1.0})
      write_example(out, type, closed, grasp_features(estimate_of(profile, between(plan->open, plan->held, closed))));
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
  for (auto seed = first; seed < first + count; ++seed)
    if (const auto written = write_examples(*mesh, seed, out); !written) return written;
  if (!out.flush()) return fail("cannot be written", argv[1], "is the disk full?");
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: planned_examples OUT FIRST_SEED COUNT\n");
    return 2;
  }
  const auto done = run(argv);
  if (!done) std::fprintf(stderr, "planned_examples: %s\n", done.error().message().c_str());
  return done ? 0 : 1;
}
