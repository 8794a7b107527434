// Runs the second network on a window around a palm, and reads the detected hand from its output.
#include "stages/detection/window_examiner.h"

#include <cmath>
#include <utility>

#include "stages/detection/networks.h"

namespace barehand {
namespace {

constexpr double kRecentre = 0.03;        // if the palm is off the window's centre by more, the window is moved [m]
constexpr double kSmallestHand = 0.0012;  // minimum area of a hand in its window, facing the camera [m^2]

/// Area of the pixels in a window that are labelled as hand, projected onto a plane facing the camera [m^2].
double hand_area(const LabelMap& labels, const DepthView& view, const Image<float>& depth, const Intrinsics& camera) {
  double area = 0;
  for (int v = 0; v < depth.height(); ++v)
    for (int u = 0; u < depth.width(); ++u) {
      const double z = depth.at(u, v);
      if (z <= 0) continue;
      const Eigen::Vector2d pixel = view.frame_pixel(u, v);
      if (labels.covers(pixel.x(), pixel.y()) && labels.at(pixel.x(), pixel.y()) == SurfaceLabel::hand)
        area += z * z / (camera.fx * camera.fy) * view.step_u * view.step_v;
    }
  return area;
}

/// The side as which the joints of a hand at a place are read: the known one, or that of the log odds, or, where they
/// are not sure, the one that is looked for.
Handedness side_to_read(double right_log_odds, const ExpectedHand& place) {
  if (place.side) return *place.side;
  if (place.wanted && std::abs(right_log_odds) < kToldSide) return *place.wanted;
  return right_log_odds < 0 ? Handedness::left : Handedness::right;
}

}  // namespace

/// Runs the second network on the window around `centre`, and reads the joints as those of a hand of this side. For a
/// left hand the window is mirrored, since the network was trained with right hands.
Result<WindowExaminer::Window> WindowExaminer::run_network(const RgbdFrame& frame, const Eigen::Vector3d& centre,
                                                           Handedness side, const SkinModel* skin, Workers& workers) {
  // Run the network on the window.
  const bool mirrored = side == Handedness::left;
  const DepthView view = window_around(centre, frame.camera);
  sample_depth(frame, view, depth_);
  if (skin) keep_skin(frame, view, *skin, depth_);
  fill_crop(depth_, centre.z(), mirrored, input_);
  const auto output = crop_.run(input_, workers);
  if (!output) return tl::unexpected(output.error());

  // Read the joints, the side and the labels from its output.
  Window window;
  DetectedHand& hand = window.hand;
  for (int k = 0; k < kLandmarkCount; ++k)
    hand.joints[k] = read_joint(*output, k, view, centre.z(), mirrored, frame.camera);
  hand.centre = 0.5 * (hand.joints[kWristLandmark].position + hand.joints[kMiddleKnuckleLandmark].position);
  hand.hand_log_odds = output->hand;
  hand.right_log_odds = mirrored ? -output->side : output->side;
  hand.side = side;
  read_labels(*output, view, mirrored, hand.labels);
  window.hand_area = hand_area(hand.labels, view, depth_, frame.camera);
  return window;
}

/// Runs the second network at a place, and once more if the hand is off the window's centre or is to be read as one of
/// the other side, or of either.
Result<std::optional<DetectedHand>> WindowExaminer::examine(const RgbdFrame& frame, const ExpectedHand& place,
                                                            Workers& workers) {
  auto window = run_network(frame, place.centre, side_to_read(0, place), place.skin, workers);
  if (!window) return tl::unexpected(window.error());

  // Examine a second window if the hand is off the centre, or if it is of the other side.
  Handedness side = side_to_read(window->hand.right_log_odds, place);
  const bool aside = (window->hand.centre - place.centre).norm() > kRecentre;
  if (aside || side != window->hand.side) {
    if (window->hand.centre.z() <= 0) return std::nullopt;
    window = run_network(frame, window->hand.centre, side, place.skin, workers);
    if (!window) return tl::unexpected(window.error());
    side = side_to_read(window->hand.right_log_odds, place);
  }

  // If it is of the other side again, or if the networks cannot tell which of both sides it is, read the window as the
  // other side, too. The averages of the log odds count, and the window for the side that they decide gives the joints.
  const bool either = !place.side && !place.wanted && std::abs(window->hand.right_log_odds) < kToldSide;
  if ((either || side != window->hand.side) && window->hand.centre.z() > 0) {
    auto other = run_network(frame, window->hand.centre, opposite(window->hand.side), place.skin, workers);
    if (!other) return tl::unexpected(other.error());
    const double right = 0.5 * (window->hand.right_log_odds + other->hand.right_log_odds),
                 is_hand = 0.5 * (window->hand.hand_log_odds + other->hand.hand_log_odds);
    if (side_to_read(right, place) == other->hand.side) std::swap(*window, *other);
    window->hand.right_log_odds = right;
    window->hand.hand_log_odds = is_hand;
    if (either && std::abs(right) < kToldSide) window->hand.other_joints = other->hand.joints;
  }
  if (window->hand_area < kSmallestHand) return std::nullopt;
  window->hand.skin_only = place.skin != nullptr;
  return std::move(window->hand);
}

}  // namespace barehand
