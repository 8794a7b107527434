// Writes the true features of simulated grasps, without rendering and tracking, for the training of the grasp
// classifier: many more hands and objects than there is time to track.
//
//   planned_examples OUT FIRST_SEED COUNT classes      every class of each seed, open, closing and holding
//   planned_examples OUT FIRST_SEED COUNT sequences    the sequences of collect.py, 15 frames a second
//
// Each row (example_file.h) begins with the class, or the number of the sequence, and the time in the sequence [s]; the
// spread is that of joints that err by 1 rad each.
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

/// The rows of one sequence.
Result<void> write_examples(const HandRig& rig, int type, std::uint64_t seed, double origin,
                            const std::vector<double>& times, std::ofstream& out) {
  const auto sequence =
      make_varied_grasp(rig, {"", std::string(grasp_types()[static_cast<std::size_t>(type)].name)}, seed);
  if (!sequence) return tl::unexpected(sequence.error());
  const auto profile = std::make_shared<const HandProfile>(rig.profile);
  for (const double time : times)
    write_example(out, origin, time,
                  grasp_features(estimate_of(profile, (*sequence)->at(time).hands[0].skeleton.angles)));
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
      if (const auto written = write_examples(rig, type, seed, origin, times, out); !written) return written;
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
