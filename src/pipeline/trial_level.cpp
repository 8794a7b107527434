// Measures on a synthetic frame how fast the CPU and a GPU compare the samples of one level.
#include "pipeline/trial_level.h"

#include "io/data_files.h"
#include "io/hand/hand_json.h"
#include "stages/preprocess/preprocess.h"
#include "stages/search/start_templates.h"
#include "stages/segment_tracker/cpu_observer.h"
#include "tracking/hand_model.h"

namespace barehand {
namespace {

constexpr double kDistance = 0.5, kWall = 1.0;  // distances of the hand and of the wall behind it from the camera [m]
constexpr double kDepthUnit = 1e-4;             // length of one unit of the depth image [m]
const Intrinsics kCamera{640, 480, 525, 525, 319.5, 239.5};

/// Renders a depth image of the hand in front of a wall.
FramePtr render_frame(const Skin& skin, const HandPose& pose) {
  auto frame = std::make_shared<RgbdFrame>();
  frame->camera = kCamera;
  frame->depth_unit = kDepthUnit;
  frame->depth.reset(kCamera.width, kCamera.height, static_cast<std::uint16_t>(kWall / kDepthUnit));
  RenderedHand rendered;
  render_hand(skin, pose, kCamera, {0, 0, 1, kCamera.width, kCamera.height}, rendered, Normals::left_out);
  for (std::size_t i = 0; i < rendered.depth.size(); ++i)
    if (rendered.depth[i] > 0) frame->depth[i] = static_cast<std::uint16_t>(rendered.depth[i] / kDepthUnit);
  return frame;
}

/// The estimate from which the preprocessor knows where to look for the hand.
HandEstimates feedback_of(const HandPose& pose, const std::shared_ptr<const HandProfile>& profile) {
  auto estimate = std::make_shared<HandEstimate>();
  estimate->status = TrackStatus::tracking;
  estimate->profile = profile;
  for (int s = 0; s < kSegmentCount; ++s) estimate->segments[s].T_camera_segment = pose[s];
  return {estimate};
}

}  // namespace

Result<TrialTimes> time_trial_level(const Config& config, int per_segment, DeviceObserver& device, Workers& workers) {
  // Load the shipped hand and build its model.
  const auto path = find_data_file("configs/hands/adult_right.json");
  if (!path) return tl::unexpected(path.error());
  const auto loaded = load_profile(*path);
  if (!loaded) return tl::unexpected(loaded.error());
  const auto profile = std::make_shared<const HandProfile>(*loaded);
  HandModel model(config.tracker, profile, workers, nullptr);

  // Render the hand with the middle of the palm on the optical axis, and preprocess the frame.
  const SE3 T_camera_palm{palm_orientation(0, 0, 0), {0, 0.5 * profile->hand_length(), kDistance}};
  const HandPose pose = forward_kinematics(*profile, T_camera_palm, {});
  const auto seen =
      Preprocessor(config.preprocess).process(render_frame(*model.skin, pose), feedback_of(pose, profile));
  if (!seen) return tl::unexpected(seen.error());
  if (!seen->front()->hand_present)
    return fail("the test hand is not found with these values", "preprocess", "see barehand track --print-config");

  // Make the batch that the tracker would compare; its poses stay valid until the model draws new ones.
  const PreparedObservation& prepared = model.segment_tracker.prepare(*seen->front(), pose);
  const SegmentSamples& samples =
      model.segment_tracker.sample(prepared, model.fusion.first_proposals(pose), {1, 1, 0, 1}, per_segment);
  const SegmentTrackerParams& params = config.tracker.segment_tracker;
  const SampleBatch batch{model.surface, prepared.map, prepared.id, samples.poses, first_compared(params)};

  // Measure how long both observers take to compare the batch.
  CpuObserver cpu(distance_cap(params), workers);
  PatchDistances distances;
  const auto times = time_comparison(batch, cpu, device, SystemClock(), distances);
  if (!times) return tl::unexpected(times.error());
  return TrialTimes{batch.sample_count(), *times};
}

}  // namespace barehand
