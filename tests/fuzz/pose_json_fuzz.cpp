#include "fuzz/memory_file.h"
#include "io/hand/hand_json.h"
#include "io/hand/pose_json.h"

/// Input: a file pose.json, as given to --init, for the shipped hand.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barehand;
  static const auto profile = load_profile(BAREHAND_CONFIGS "/hands/adult_right.json");
  CHECK(profile.has_value());
  const fuzz::MemoryFile file(data, size);
  const auto pose = load_pose(file.path(), *profile);
  if (!pose) return 0;
  for (int s = 0; s < kSegmentCount; ++s) {
    CHECK((*pose)[s].t.allFinite());
    CHECK(((*pose)[s].R * (*pose)[s].R.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-6);
  }
  return 0;
}
