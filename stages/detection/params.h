#pragma once

#include <string>

namespace barehand {

/// Parameters of the detection of hands by networks.
struct DetectionParams {
  bool enabled = true;
  std::string networks = "nets";
  int every = 1;
  int every_tracked = 1;
  int second_look_every = 30;
  double least_palm = 0.2;
  bool operator==(const DetectionParams&) const = default;
};

template <class V>
void visit(V& v, DetectionParams& p) {
  v.user("enabled", p.enabled, "detect hands by neural networks that were trained on depth images");
  v.user("networks", p.networks,
         "folder with nets.json and the networks; a bare name is a folder of the shipped configs/");
  v("every", p.every, 1, 1000, "every n-th frame is searched as a whole while a hand is missing");
  v("every_tracked", p.every_tracked, 1, 1000,
    "every n-th frame is searched around each tracked hand where no colour tells it from other things");
  v("second_look_every", p.second_look_every, 0, 1000,
    "every n-th frame, and sooner if it is ambiguous, one tracked hand is examined again if some of it is not seen; 0: "
    "never");
  v("least_palm", p.least_palm, 0.01, 0.99, "minimum probability with which the network must report a palm");
}

}  // namespace barehand
