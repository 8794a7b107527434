// Names of the origins of hypotheses, and a measure of their joints' gaps.
#include "tracking/hypotheses/hypothesis.h"

#include "hand/joint_angles.h"

namespace barehand {

std::string_view to_string(Origin origin) {
  switch (origin) {
    case Origin::followed:
      return "followed";
    case Origin::sampled:
      return "sampled";
    case Origin::uncrossed:
      return "uncrossed";
    case Origin::detected:
      return "detected";
    case Origin::searched:
      return "searched";
    case Origin::near:
      return "near";
  }
  return "";
}

double joint_gap(const HandProfile& profile, const HandPose& pose) {
  double sum = 0;
  for (int s = 1; s < kSegmentCount; ++s) sum += (joint_in_parent(profile, pose, s) - pose[s].t).norm();
  return sum / (kSegmentCount - 1);
}

}  // namespace barehand
