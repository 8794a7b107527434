#pragma once

namespace barehand {

/// Parameters of the contact stage.
struct ContactParams {
  bool enabled = true;
  double touch_distance = 0.005;
  double near_distance = 0.02;
  bool operator==(const ContactParams&) const = default;
};
template <class V>
void visit(V& v, ContactParams& p) {
  v.user("enabled", p.enabled, "say what the hand touches, on the channels CONTACT_STATE and OBJECT_STATE");
  v("touch_distance", p.touch_distance, 0.0, 0.02,
    "m, largest distance between skin and surface that counts as a touch");
  v("near_distance", p.near_distance, 0.0, 0.03, "m, largest distance at which a surface counts as near");
}

}  // namespace barehand
