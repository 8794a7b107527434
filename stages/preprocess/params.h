#pragma once

namespace barehand {

/// Settings of the preprocess stage, in metres and seconds unless a name states another unit.
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
  double margin = 0.05;
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
  // Declare the keys for what is used of a frame.
  v.user("min_depth", p.min_depth, 0.01, 10.0, "m, nearer measurements are ignored");
  v.user("max_depth", p.max_depth, 0.05, 20.0, "m, farther measurements are background");
  v.user("use_colour", p.use_colour, "use colour, where there is colour, to distinguish skin from objects and sleeves");

  // Declare the keys for finding the hand.
  v("min_hand_area", p.min_hand_area, 1e-5, 0.1, "m^2 facing the camera, a smaller area of visible skin is not a hand");
  v("max_hand_area", p.max_hand_area, 1e-3, 1.0,
    "m^2 facing the camera, a larger surface is not a hand with its forearm");
  v("max_speed", p.max_speed, 0.1, 20.0,
    "m/s, maximum speed of the whole hand between the feedback's frame and this one");
  v("hand_reach", p.hand_reach, 0.01, 0.5,
    "m, skin farther than this from the predicted hand belongs to something else");
  v("wrist_margin", p.wrist_margin, 0.0, 0.1,
    "m, points farther than this behind the wrist joint belong to the forearm");

  // Declare the keys for the maps around the hand.
  v("object_reach", p.object_reach, 0.0, 0.5,
    "m, data other than the hand within this distance of it belongs to an object");
  v.retired("margin_px", "preprocess.margin");
  v("margin", p.margin, 0.0, 0.5,
    "m at the hand's distance and at least 48 px, margin around the hand within which objects are looked at");
  v("skew_px", p.skew_px, 0, 10,
    "px, distance from depth edges within which a colour may belong to the neighbouring surface");

  // Declare the keys for the colour of skin.
  v("skin_odds", p.skin_odds, 0.0, 5.0, "log odds for skin above which a pixel's own colour decides");
  v("other_odds", p.other_odds, 0.0, 5.0, "log odds against skin above which a pixel's own colour decides");
  v("learning_rate", p.learning_rate, 0.0, 1.0,
    "weight of one frame in the learned skin colour; 0: the generic skin colour is kept");
  v("learned_share", p.learned_share, 0.0, 0.99, "weight of the learned skin colour relative to the generic one");

  // Declare the keys for normals, noise and the point cloud.
  v("normal_radius", p.normal_radius, 0.001, 0.02, "m, half width of the window to which a normal is fitted");
  v("noise_floor", p.noise_floor, 1e-5, 0.01, "m, lower limit of the estimated depth noise");
  v("cloud_points", p.cloud_points, 50, 20000, "approximate number of hand points that are kept for ICP");
}

}  // namespace barehand
