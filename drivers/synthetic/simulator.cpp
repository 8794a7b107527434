#include "drivers/synthetic/simulator.h"

#include <algorithm>
#include <cmath>

#include "drivers/synthetic/hand_mesh_file.h"
#include "drivers/synthetic/hand_mirror.h"
#include "drivers/synthetic/measured_profile.h"
#include "drivers/synthetic/sleeve.h"

namespace barehand::synthetic {
namespace {

constexpr std::uint8_t kSleeve = kSegmentCount;  // surfaces 0..15: the hand's segments
constexpr std::uint8_t kFirstObject = kSegmentCount + 1;
constexpr Rgb kSkin = {214, 162, 134}, kCloth = {42, 66, 138};
constexpr int kMargin = 200;  // [px] around the image in which a segment still counts as projected

Intrinsics camera_of(const SimulatorParams& p) {
  const double focal = p.focal > 0 ? p.focal : 525.0 * p.width / 640;
  return {p.width, p.height, focal, focal, 0.5 * (p.width - 1), 0.5 * (p.height - 1)};
}

Result<HandMesh> load_shaped_mesh(const SimulatorParams& params, const std::string& folder) {
  const Handedness side = params.hand == "left" ? Handedness::left : Handedness::right;
  const auto path = find_hand_mesh(side, folder);
  if (!path) return tl::unexpected(path.error());
  const auto mesh = load_hand_mesh(*path, side);
  if (!mesh) return mesh;
  return reshaped(*mesh, params.shape);
}

const SequenceInfo& info_of(const std::string& name) {
  const auto& list = sequence_list();
  return *std::find_if(list.begin(), list.end(), [&](const SequenceInfo& info) { return info.name == name; });
}

Image<std::uint16_t> counts(const Image<float>& depth) {
  Image<std::uint16_t> image(depth.width(), depth.height());
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const float value = depth[i] * static_cast<float>(1 / Simulator::kDepthUnit) + 0.5f;
    image[i] = value >= 1 && value < 65536 ? static_cast<std::uint16_t>(value) : 0;  // out of range: no measurement
  }
  return image;
}

}  // namespace

Simulator::Simulator(const SimulatorParams& params, const Intrinsics& camera) : params_(params), rasteriser_(camera) {}

Result<Simulator> Simulator::create(const SimulatorParams& params, const std::string& mesh_folder) {
  auto mesh = load_shaped_mesh(params, mesh_folder);
  if (!mesh) return tl::unexpected(mesh.error());
  Simulator simulator(params, camera_of(params));
  simulator.profile_ = measure_profile(*mesh);
  HandMesh right = mesh->handedness == Handedness::right ? *mesh : mirrored(*mesh);
  simulator.skinner_ = std::make_unique<Skinner>(right);
  simulator.rig_ = std::make_unique<HandRig>(HandRig{right, measure_profile(right)});
  auto sequence = make_sequence(params.sequence, *simulator.rig_, static_cast<std::uint64_t>(params.seed));
  if (!sequence) return tl::unexpected(sequence.error());
  simulator.sequence_ = std::move(*sequence);
  const SequenceInfo& info = info_of(params.sequence);
  simulator.fps_ = params.fps > 0 ? params.fps : info.fps;
  simulator.frame_count_ = std::lround(info.frames / info.fps * simulator.fps_ / params.speed);
  if (params.frames > 0) simulator.frame_count_ = std::min<std::int64_t>(simulator.frame_count_, params.frames);
  return simulator;
}

std::vector<Material> Simulator::materials() const {
  std::vector<Material> list(kSegmentCount, Material{kSkin});
  list.push_back({params_.sleeve == "skin" ? kSkin : kCloth});
  for (const SceneObject& object : sequence_->objects()) list.push_back(object.material);
  return list;
}

void Simulator::build_scene(const SceneState& state, const HandPose& pose) {
  scene_.clear();
  skin_.triangles = rig_->mesh.triangles;
  skinner_->deform(pose, skin_.vertices);
  vertex_normals(skin_.vertices, skin_.triangles, skin_.normals);
  scene_.add(skin_, SE3{}, 0);
  std::copy(skinner_->triangle_segments().begin(), skinner_->triangle_segments().end(), scene_.surface.begin());
  if (params_.sleeve != "none")
    scene_.add(make_sleeve(pose[kPalm], state.elbow, params_.shape.scale, params_.sleeve == "skin"), SE3{}, kSleeve);
  const auto& objects = sequence_->objects();
  for (std::size_t i = 0; i < objects.size(); ++i)
    scene_.add(objects[i].mesh, state.T_camera_object[i], static_cast<std::uint8_t>(kFirstObject + i));
}

Image<float> Simulator::spoil(const RenderedView& view, std::int64_t number) const {
  const auto seed = static_cast<std::uint64_t>(params_.seed);
  const auto frame = static_cast<std::uint32_t>(number);
  if (params_.noise == "kinect") return noise_.kinect(camera(), view, materials(), {}, seed, frame);
  if (params_.noise == "tof") return noise_.tof(view, {}, seed, frame);
  return view.depth;
}

std::optional<TableFrame> Simulator::truth_of(const RenderedView& view, const HandPose& pose,
                                              std::int64_t number) const {
  std::array<int, kSegmentCount> front{};
  for (std::size_t i = 0; i < view.surface.size(); ++i)
    if (view.surface[i] < kSegmentCount) ++front[view.surface[i]];
  if (std::all_of(front.begin(), front.end(), [](int n) { return n == 0; })) return std::nullopt;
  const auto& segments = skinner_->triangle_segments();
  const auto covered =
      covered_pixels(camera(), kMargin, scene_.vertices, std::span(scene_.triangles).first(segments.size()), segments);
  TableFrame truth;
  truth.number = number;
  for (int s = 0; s < kSegmentCount; ++s) {
    truth.rows[s] = {proximal_end(pose, s), distal_end(profile_, pose, s),
                     covered[s] > 0 ? static_cast<double>(front[s]) / covered[s] : 0.0};
  }
  return truth;
}

SimulatedFrame Simulator::render(std::int64_t number) {
  const double time = static_cast<double>(number) / fps_ * params_.speed;
  const SceneState state = sequence_->at(std::min(time, sequence_->duration()));
  SimulatedFrame result;
  result.pose = pose_segments(rig_->profile, state.hand);
  build_scene(state, result.pose);
  if (profile_.handedness == Handedness::left) {
    scene_.mirror();
    for (SE3& T : result.pose) T = mirrored(T);
  }
  rasteriser_.clear();
  rasteriser_.draw(scene_.vertices, scene_.triangles, 0);
  RenderedView view = shade(camera(), rasteriser_.buffer(), scene_, materials(),
                            static_cast<std::uint64_t>(params_.seed), static_cast<std::uint32_t>(number));
  auto frame = std::make_shared<RgbdFrame>();
  frame->utime = kFirstUtime + std::llround(1e6 * static_cast<double>(number) / fps_);
  frame->number = number;
  frame->camera = camera();
  frame->depth_unit = kDepthUnit;
  frame->depth = counts(spoil(view, number));
  result.truth = truth_of(view, result.pose, number);
  if (result.truth) result.truth->timestamp = 1e-6 * static_cast<double>(frame->utime);
  frame->colour = std::move(view.colour);
  result.frame = std::move(frame);
  return result;
}

}  // namespace barehand::synthetic
