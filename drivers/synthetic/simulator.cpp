// Renders the frames of a simulated sequence with their ground truth.
#include "drivers/synthetic/simulator.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "drivers/synthetic/grasps/varied_grasp.h"
#include "drivers/synthetic/hand/hand_mirror.h"

namespace barehand::synthetic {
namespace {

constexpr int kMargin = 200;  // parts of a segment up to this far outside the image count as projected, too [px]

Intrinsics camera_of(const SimulatorParams& p) {
  const double focal = p.focal > 0 ? p.focal : 525.0 * p.width / 640;
  return {p.width, p.height, focal, focal, 0.5 * (p.width - 1), 0.5 * (p.height - 1)};
}

/// The sides of the hands that a sequence shows.
Result<std::vector<Handedness>> sides_of(const SequenceInfo& info, const SimulatorParams& params) {
  const Handedness wanted = params.hand == "left" ? Handedness::left : Handedness::right;
  if (info.shows == ShownHands::one) return std::vector{wanted};
  const bool both = info.shows == ShownHands::both;
  if (wanted == Handedness::left)
    return fail(both ? "shows both hands, so that none can be chosen" : "shows no hand", info.name,
                "leave out hand=left");
  return both ? std::vector{Handedness::right, Handedness::left} : std::vector<Handedness>{};
}

/// Index of the first surface of a hand, see AnimatedHand; objects follow after all hands.
std::uint8_t first_surface(std::size_t hand) { return static_cast<std::uint8_t>(AnimatedHand::kSurfaceCount * hand); }

/// Converts depth in metres to integers in units of kDepthUnit.
Image<std::uint16_t> counts(const Image<float>& depth) {
  Image<std::uint16_t> image(depth.width(), depth.height());
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const float value = depth[i] * static_cast<float>(1 / Simulator::kDepthUnit) + 0.5f;
    image[i] = value >= 1 && value < 65536 ? static_cast<std::uint16_t>(value) : 0;  // out of range: 0, no measurement
  }
  return image;
}

}  // namespace

Simulator::Simulator(const SimulatorParams& params, const Intrinsics& camera) : params_(params), rasteriser_(camera) {}

Result<Simulator> Simulator::create(const SimulatorParams& params, const std::string& mesh_folder) {
  // Check the parameters.
  const auto info = sequence_info(params.sequence);
  if (!info) return tl::unexpected(info.error());
  constexpr double kSlowest = 0.1;
  if (params.fps > 0 && params.fps < kSlowest)
    return fail(formatted("%g frames per second", params.fps), "sim:" + params.sequence,
                formatted("give 0 for the sequence's own or %g at least", kSlowest));

  // The object and the grasp can be chosen in one sequence only.
  const bool varied = params.sequence == "grasp";
  if (!varied && !(params.object.empty() && params.grasp.empty()))
    return fail("the keys object and grasp are those of the sequence grasp", "sim:" + params.sequence,
                "leave them out, or simulate sim:grasp");
  const auto sides = sides_of(*info, params);
  if (!sides) return tl::unexpected(sides.error());

  // Load the hands.
  const auto seed = static_cast<std::uint64_t>(params.seed);
  Simulator simulator(params, camera_of(params));
  for (const Handedness side : *sides) {
    auto hand = AnimatedHand::load(side, varied ? drawn_hand(params.shape, seed) : params.shape, mesh_folder);
    if (!hand) return tl::unexpected(hand.error());
    simulator.hands_.push_back(std::move(*hand));
  }

  // Make the sequence.
  const HandRig* const rig = simulator.hands_.empty() ? nullptr : &simulator.hands_.front().rig();
  auto sequence = make_sequence(params.sequence, rig, seed, {params.object, params.grasp});
  if (!sequence) return tl::unexpected(sequence.error());
  simulator.sequence_ = std::move(*sequence);

  // Keep the meshes of the objects that are grasped, mirrored like the hand.
  for (const SceneObject& object : simulator.sequence_->objects())
    if (object.grasped)
      simulator.grasped_.emplace(object.name, simulator.mirrors() ? mirrored(object.mesh) : object.mesh);

  // Compute the number of frames at this rate and speed.
  simulator.fps_ = params.fps > 0 ? params.fps : info->fps;
  simulator.frame_count_ = std::max(1L, std::lround(info->frames / info->fps * simulator.fps_ / params.speed));
  if (params.frames > 0) simulator.frame_count_ = std::min<std::int64_t>(simulator.frame_count_, params.frames);
  return simulator;
}

std::vector<Material> Simulator::materials() const {
  std::vector<Material> list;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    list.insert(list.end(), kSegmentCount, Material{kSkinColour});
    list.push_back({params_.sleeve == "skin" ? kSkinColour : kClothColour});
  }
  for (const SceneObject& object : sequence_->objects()) list.push_back(object.material);
  return list;
}

SceneGeometry Simulator::object_geometry(const SceneState& state) const {
  SceneGeometry geometry;
  const auto& objects = sequence_->objects();
  for (std::size_t i = 0; i < objects.size(); ++i)
    geometry.add(objects[i].mesh, state.T_camera_object[i],
                 static_cast<std::uint8_t>(first_surface(hands_.size()) + i));
  if (mirrors()) geometry.mirror();
  return geometry;
}

std::optional<ObjectTruth> Simulator::object_of(const SceneState& state) const {
  const auto& objects = sequence_->objects();
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (objects[i].grasped)
      return ObjectTruth{mirrors() ? mirrored(state.T_camera_object[i]) : state.T_camera_object[i], state.held};
  return std::nullopt;
}

Image<float> Simulator::add_noise(const RenderedView& view, std::int64_t number) const {
  const auto seed = static_cast<std::uint64_t>(params_.seed);
  const auto frame = static_cast<std::uint32_t>(number);
  if (params_.noise == "kinect") return noise_.kinect(camera(), view, materials(), {}, seed, frame);
  if (params_.noise == "tof") return noise_.tof(view, {}, seed, frame);
  return view.depth;
}

std::optional<TableFrame> Simulator::table_of(std::size_t hand, const RenderedView& view, const SceneGeometry& geometry,
                                              const HandPose& pose) const {
  // Count the pixels in which each segment is front-most.
  std::array<int, kSegmentCount> front{};
  for (std::size_t i = 0; i < view.surface.size(); ++i) {
    const int segment = view.surface[i] - first_surface(hand);
    if (segment >= 0 && segment < kSegmentCount) ++front[segment];
  }
  if (std::all_of(front.begin(), front.end(), [](int n) { return n == 0; })) return std::nullopt;

  // Count the pixels that each segment would cover without occlusion.
  const auto& segments = hands_[hand].triangle_segments();
  const auto covered = covered_pixels(camera(), kMargin, geometry.vertices,
                                      std::span(geometry.triangles).first(segments.size()), segments);

  // Compute the visible fractions as the ratios of both counts.
  TableFrame table;
  for (int s = 0; s < kSegmentCount; ++s) {
    table.rows[s] = {proximal_end(pose, s), distal_end(hands_[hand].profile(), pose, s),
                     covered[s] > 0 ? static_cast<double>(front[s]) / covered[s] : 0.0};
  }
  return table;
}

SimulatedFrame Simulator::render(std::int64_t number) {
  // Build the scene at this time.
  const double time = static_cast<double>(number) / fps_ * params_.speed;
  const SceneState state = sequence_->at(std::min(time, sequence_->duration()));
  std::vector<SceneGeometry> hands;
  SceneGeometry scene;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    hands.push_back(hands_[i].geometry(state.hands[i], params_.sleeve, first_surface(i)));
    scene.add(hands.back());
  }
  scene.add(object_geometry(state));

  // Render it, and add the sensor's noise.
  rasteriser_.clear();
  rasteriser_.draw(scene.vertices, scene.triangles, 0);
  RenderedView view = shade(camera(), rasteriser_.buffer(), scene, materials(),
                            static_cast<std::uint64_t>(params_.seed), static_cast<std::uint32_t>(number));

  // Describe the frame as a sensor would.
  auto frame = std::make_shared<RgbdFrame>();
  frame->utime = kFirstUtime + std::llround(1e6 * static_cast<double>(number) / fps_);
  frame->number = number;
  frame->camera = camera();
  frame->depth_unit = kDepthUnit;
  frame->depth = counts(add_noise(view, number));

  // Add the truth about the object and each hand.
  SimulatedFrame result;
  result.object = object_of(state);
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    HandTruth truth{hands_[i].pose(state.hands[i].skeleton), {}, {}};
    truth.table = table_of(i, view, hands[i], truth.pose);

    // The table of the truth carries the number and the time of the frame.
    if (truth.table) {
      truth.table->number = number;
      truth.table->timestamp = 1e-6 * static_cast<double>(frame->utime);
    }
    truth.skin = std::move(hands[i].vertices);
    truth.skin.resize(hands_[i].vertex_segments().size());  // the vertices of the sleeve come after those of the skin
    result.hands.push_back(std::move(truth));
  }

  frame->colour = std::move(view.colour);
  result.frame = std::move(frame);
  return result;
}

std::optional<HandContacts> Simulator::contacts(const SimulatedFrame& frame, std::size_t hand) const {
  if (!frame.object) return std::nullopt;
  return grasped_->contacts(frame.hands[hand].skin, hands_[hand].vertex_segments(), frame.object->T_camera_object);
}

}  // namespace barehand::synthetic
