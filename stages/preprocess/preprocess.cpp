#include "stages/preprocess/preprocess.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

// Runs the steps of preprocessing, and learns the skin colour from tracked hands.

constexpr float kSurelySkin = 0.004f;  // cells at most this far from the predicted skin certainly show skin [m]
// Cells farther than this from the predicted skin certainly do not show the hand [m], since no finger moves that far
// between two frames.
constexpr float kSurelyOther = 0.045f;
// Cells of the coarse depth grid farther than this from a hand's centre cannot show that hand [m].
constexpr float kSurroundings = 0.22f;
constexpr int kLeastMargin = 48;  // around a hand that is far away [px]
// A region begins at a multiple of this many pixels, since the tracker looks at every second or fourth pixel from
// there on: at the same ones, whatever the margin.
constexpr int kAligned = 8;

std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

Result<void> check(const RgbdFrame& frame) {
  const Intrinsics& c = frame.camera;
  const auto where = [&] { return "frame " + std::to_string(frame.number); };
  if (!c.valid())
    return fail("no valid camera intrinsics", where(), "give width, height, fx, fy, cx, cy of the sensor");
  if (!(frame.depth_unit > 0)) return fail("depth unit is not positive", where(), "give the metres per depth count");

  // Compare the sizes of the images with that of the camera.
  const auto sizes = [&](int width, int height) {
    return size_text(width, height) + ", the intrinsics say " + size_text(c.width, c.height);
  };

  if (frame.depth.width() != c.width || frame.depth.height() != c.height)
    return fail("depth is " + sizes(frame.depth.width(), frame.depth.height()), where(),
                "use the intrinsics of this depth image");
  if (!frame.colour.empty() && (frame.colour.width() != c.width || frame.colour.height() != c.height))
    return fail("colour is " + sizes(frame.colour.width(), frame.colour.height()), where(),
                "register colour to depth, or send no colour");
  return {};
}

/// Fills `out.cloud` with the hand points in every su-th column and sv-th row, so that about `many` points remain.
void thin_cloud(int many, HandObservation& out) {
  out.cloud.clear();
  const double share = static_cast<double>(out.hand_pixels.size()) / many;
  const int su = std::max(1, static_cast<int>(std::sqrt(share)));
  const int sv = std::max(1, static_cast<int>(std::ceil(share / su)));
  for (const std::int32_t i : out.hand_pixels) {
    const int u = i % out.depth.width(), v = i / out.depth.width();
    if ((u + out.u0) % su == 0 && (v + out.v0) % sv == 0) out.cloud.push_back(out.point(u, v));
  }
}

}  // namespace

Preprocessor::Preprocessor(const PreprocessParams& params, int hands)
    : params_(params), skin_(params.learning_rate, params.learned_share), locator_(params, hands), masker_(params) {}

Result<HandObservations> Preprocessor::process(const FramePtr& frame, std::span<const HandEstimatePtr> feedback,
                                               const DetectionPtr& detection) {
  if (const Result<void> valid = check(*frame); !valid) return tl::unexpected(valid.error());
  sample_coarsely(*frame, params_, skin_, grid_);
  const bool coloured = grid_.coloured;
  if (coloured) grid_.coloured = colour_.trusts(frame->number, grid_, feedback, detection.get());
  const double age = feedback.empty() ? 0 : std::abs(static_cast<double>(frame->utime - feedback[0]->utime)) * 1e-6;
  const std::span<const CoarseHand> hands = locator_.find(grid_, standing_, feedback, age, detection.get());
  standing_.update(grid_, hands, frame->utime);
  HandObservations result;
  if (hands.size() > 1) taken_.reset(frame->camera.width, frame->camera.height);
  for (const CoarseHand& hand : hands) result.push_back(observe(frame, hand, hands, detection));
  if (coloured) {
    colour_.learn(grid_, hands);
    learn_skin(hands, feedback, result);
  }
  return result;
}

HandObservationPtr Preprocessor::observe(const FramePtr& frame, const CoarseHand& hand,
                                         std::span<const CoarseHand> hands, const DetectionPtr& detection) {
  const std::shared_ptr<HandObservation> out = pool_.take();
  out->frame = frame;
  out->detected = hand.found && hand.detected ? std::shared_ptr<const DetectedHand>(detection, hand.detected) : nullptr;
  out->second_look =
      hand.found && hand.second_look ? std::shared_ptr<const DetectedHand>(detection, hand.second_look) : nullptr;

  // Clean the depth in the region of interest.
  const Region region = hand.found ? region_of_interest(*frame, hand) : Region{};
  out->u0 = region.u0;
  out->v0 = region.v0;
  cleaner_.clean(*frame, params_, region, out->depth, edge_);

  // Find the pixels of the hand. A pixel belongs to one hand only.
  if (hand.found)
    masker_.compute(*frame, skin_, grid_, hand, hands, region, out->depth, edge_, mask_);
  else
    mask_.reset(0, 0);
  if (hands.size() > 1) remove_taken(*out);

  // Compute the maps that the tracker uses.
  describe_hand(*out);
  out->followed = out->hand_present && hand.followed;
  return out;
}

/// Removes pixels that belong to a hand processed before in this frame. A pixel near the cells of two hands belongs to
/// the first one.
void Preprocessor::remove_taken(const HandObservation& out) {
  for (int v = 0; v < mask_.height(); ++v)
    for (int u = 0; u < mask_.width(); ++u) {
      std::uint8_t &mask = mask_.at(u, v), &taken = taken_.at(u + out.u0, v + out.v0);
      mask &= !taken;
      taken |= mask;
    }
}

void Preprocessor::describe_hand(HandObservation& out) {
  const Intrinsics& camera = out.frame->camera;

  // List the pixels of the hand, and measure their area.
  out.hand_pixels.clear();
  double area = 0;
  for (std::size_t i = 0; i < mask_.size(); ++i) {
    if (!mask_[i]) continue;
    out.hand_pixels.push_back(static_cast<std::int32_t>(i));
    area += out.depth[i] * out.depth[i] / (camera.fx * camera.fy);
  }

  // Treat a hand that is too small as no hand.
  out.hand_present = area >= params_.min_hand_area;
  if (!out.hand_present) {
    out.hand_pixels.clear();
    out.depth.reset(0, 0);
    mask_.reset(0, 0);
  }

  // Compute the labels and the distance transforms.
  transform_.compute(mask_, out.nearest_hand);
  label_pixels(camera, mask_, params_.object_reach, rays_, out);
  object_.reset(mask_.width(), mask_.height());
  for (std::size_t i = 0; i < object_.size(); ++i) object_[i] = out.label[i] == PixelLabel::object;
  transform_.compute(object_, out.nearest_object);

  // Compute the normals, the noise and the point cloud.
  normals_.fit(mask_, params_.normal_radius, out);
  out.noise = noise_.measure(mask_, out.depth, params_.noise_floor);
  thin_cloud(params_.cloud_points, out);
}

Region Preprocessor::region_of_interest(const RgbdFrame& frame, const CoarseHand& hand) const {
  const Intrinsics& camera = frame.camera;
  double u0 = camera.width, v0 = camera.height, u1 = 0, v1 = 0;
  float nearest = static_cast<float>(params_.max_depth);
  const auto include = [&](double u, double v) {
    u0 = std::min(u0, u), u1 = std::max(u1, u);
    v0 = std::min(v0, v), v1 = std::max(v1, v);
  };

  // Include the cells of the hand.
  const int step = grid_.step;
  for (int r = 0; r < grid_.z.height(); ++r)
    for (int c = 0; c < grid_.z.width(); ++c)
      if (hand.cells.at(c, r)) {
        include(c * step, r * step);
        include((c + 1) * step, (r + 1) * step);
        if (grid_.z.at(c, r) > 0) nearest = std::min(nearest, grid_.z.at(c, r));
      }

  // Include the predicted hand, since the maps must also cover occluded fingers.
  if (hand.prediction)
    for (const Capsule& capsule : hand.prediction->capsules())
      for (const Eigen::Vector3f& p : {capsule.a, capsule.b})
        if (p.z() > params_.min_depth) {
          const Eigen::Vector2d pixel = camera.project(p.cast<double>());
          include(std::clamp(pixel.x(), 0.0, camera.width - 1.0), std::clamp(pixel.y(), 0.0, camera.height - 1.0));
          nearest = std::min(nearest, p.z());
        }

  // Add the margin, align the beginning, and stay inside the image.
  const int margin = std::max(kLeastMargin, static_cast<int>(params_.margin * camera.fx / nearest));
  Region region;
  const auto begin = [&](double lowest) {
    return std::max(0, static_cast<int>(lowest) - margin) / kAligned * kAligned;
  };
  region.u0 = begin(u0);
  region.v0 = begin(v0);
  region.width = std::min(camera.width, static_cast<int>(u1) + margin) - region.u0;
  region.height = std::min(camera.height, static_cast<int>(v1) + margin) - region.v0;
  return region;
}

void Preprocessor::learn_skin(std::span<const CoarseHand> hands, std::span<const HandEstimatePtr> feedback,
                              const HandObservations& seen) {
  // Learn only from hands that are tracked.
  training_hands_.clear();
  for (std::size_t k = 0; k < feedback.size(); ++k)
    if (seen[k]->followed && feedback[k]->status == TrackStatus::tracking) training_hands_.push_back(&hands[k]);
  if (training_hands_.empty()) return;

  // Collect the colours of cells with depth and colour.
  skin_colours_.clear();
  other_colours_.clear();
  for (int r = 0; r < grid_.z.height(); ++r)
    for (int c = 0; c < grid_.z.width(); ++c) {
      const Rgb colour = grid_.colour.at(c, r);
      if (grid_.z.at(c, r) <= 0 || colour == Rgb{}) continue;
      const Eigen::Vector3f p = grid_.point(c, r);

      const auto near = [&](const CoarseHand* hand) {
        return (p - hand->prediction->centre()).squaredNorm() < kSurroundings * kSurroundings;
      };
      const auto is_hand = [&](const CoarseHand& hand) { return hand.found && hand.cells.at(c, r); };

      // Take the cells close to the predicted surface as skin.
      if (std::ranges::any_of(hands, is_hand)) {
        const auto surely = [&](const CoarseHand* h) { return is_hand(*h) && h->distance.at(c, r) < kSurelySkin; };
        if (std::ranges::any_of(training_hands_, surely)) skin_colours_.push_back(colour);
      } else if (grid_.odds.at(c, r) > 0 && (std::ranges::none_of(training_hands_, near) ||
                                             std::ranges::any_of(training_hands_, [&](const CoarseHand* hand) {
                                               return hand->prediction->behind_wrist(p) > 0;
                                             }))) {
        // Other skin, such as a face, another person's hand or the forearm, is not evidence against skin.
        continue;
      } else if ((c + r) % 2 == 0 && std::ranges::all_of(training_hands_, [&](const CoarseHand* hand) {
                   return !near(hand) || hand->prediction->distance(p) > kSurelyOther;
                 })) {
        // What is far enough from the hand is something else; every second cell suffices.
        other_colours_.push_back(colour);
      }
    }

  skin_.learn(skin_colours_, other_colours_);
}

}  // namespace barehand
