#pragma once

namespace barehand {

/// Tunables of the preprocess stage. Metres and seconds unless a name says otherwise.
struct PreprocessParams {
  double min_depth = 0.12;
  double max_depth = 1.5;
  bool use_colour = true;
  double min_hand_area = 0.0012;
  double max_hand_area = 0.055;
  double max_speed = 3.0;
  double hand_reach = 0.08;
  double wrist_margin = 0.015;
  double object_reach = 0.05;
  int margin_px = 48;
  int skew_px = 2;
  double skin_odds = 0.4;
  double other_odds = 1.4;
  double learning_rate = 0.08;
  double learned_share = 0.85;
  double normal_radius = 0.004;
  double noise_floor = 0.0003;
  int cloud_points = 800;
  bool operator==(const PreprocessParams&) const = default;
};

template <class V>
void visit(V& v, PreprocessParams& p) {
  v.user("min_depth", p.min_depth, 0.01, 10.0, "m, nearer measurements are ignored");
  v.user("max_depth", p.max_depth, 0.05, 20.0, "m, farther measurements are background");
  v.user("use_colour", p.use_colour, "tell skin from objects and sleeve by colour where there is colour");
  v("min_hand_area", p.min_hand_area, 1e-5, 0.1, "m^2 facing the camera, less visible skin is no hand");
  v("max_hand_area", p.max_hand_area, 1e-3, 1.0, "m^2 facing the camera, a larger surface is no hand with its forearm");
  v("max_speed", p.max_speed, 0.1, 20.0, "m/s, how fast the whole hand may move between the hint and this frame");
  v("hand_reach", p.hand_reach, 0.01, 0.5,
    "m, skin farther than this from the predicted hand belongs to something else");
  v("wrist_margin", p.wrist_margin, 0.0, 0.1, "m, what lies farther behind the wrist joint is forearm");
  v("object_reach", p.object_reach, 0.0, 0.5, "m, data that is no hand is object within this distance of the hand");
  v("margin_px", p.margin_px, 40, 400, "pixels around the hand in which the maps are computed");
  v("skew_px", p.skew_px, 0, 10, "pixels beside depth edges whose colour may belong to the neighbouring surface");
  v("skin_odds", p.skin_odds, 0.0, 5.0, "log odds of skin colour beyond which a pixel's own colour decides");
  v("other_odds", p.other_odds, 0.0, 5.0, "log odds against skin beyond which a pixel's own colour decides");
  v("learning_rate", p.learning_rate, 0.0, 1.0,
    "share of one frame in the learned skin colour; 0 keeps the generic one");
  v("learned_share", p.learned_share, 0.0, 0.99, "weight of the learned against the generic skin colour");
  v("normal_radius", p.normal_radius, 0.001, 0.02, "m, half width of the window a normal is fitted in");
  v("noise_floor", p.noise_floor, 1e-5, 0.01, "m, smallest depth noise ever reported");
  v("cloud_points", p.cloud_points, 50, 20000, "about how many hand points are kept for ICP");
}

}  // namespace barehand
