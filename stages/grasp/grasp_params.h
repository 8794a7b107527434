#pragma once

#include <string>

namespace barehand {

/// Parameters of the grasp stage.
struct GraspParams {
  bool enabled = true;
  std::string classifier = "grasps.json";
  bool operator==(const GraspParams&) const = default;
};
template <class V>
void visit(V& v, GraspParams& p) {
  v.user("enabled", p.enabled, "say how the hand grasps, on the channel GRASP_STATE");
  v("classifier", p.classifier, "file of the classifier; a bare name is a file of the shipped configs/");
}

}  // namespace barehand
