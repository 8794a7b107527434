// Reads and writes hand poses as joint angles (pose.json).
#include "io/hand/pose_json.h"

#include "hand/joint_angles.h"
#include "io/hand/json_fields.h"
#include "math/angles.h"

namespace barehand {
namespace {

using json_fields::Json;
using json_fields::Object;

/// The segment rotated from its rest pose by the angles of a JSON object.
Result<SE3> posed_by_angles(const Object& object, const SE3& rest) {
  const auto flexion = object.number_or("flexion_deg", 0, -180, 180);
  if (!flexion) return tl::unexpected(flexion.error());
  const auto abduction = object.number_or("abduction_deg", 0, -180, 180);
  if (!abduction) return tl::unexpected(abduction.error());
  SE3 posed = rest;
  posed.R *= joint_rotation({*flexion * kDegree, *abduction * kDegree, 0});
  return posed;
}

Result<void> check_names(const Json& segments, const std::string& path) {
  for (const auto& [name, value] : segments.items()) {
    if (!segment_from_name(name))
      return fail("\"" + name + "\" is not a segment of the hand", path, "see docs/formats.md");
    if (!value.is_object()) return fail("segment " + name + " is not an object", path, "see docs/formats.md");
  }
  return {};
}

}  // namespace

Result<HandPose> load_pose(const std::string& path, const HandProfile& profile) {
  // Check the structure of the file.
  const auto json = json_fields::read_json(path);
  if (!json) return tl::unexpected(json.error());
  if (!json->is_object() || !json->contains("segments") || !json->at("segments").is_object())
    return fail("\"segments\" is missing or not an object", path, "see docs/formats.md");
  const Json& segments = json->at("segments");
  if (const auto names = check_names(segments, path); !names) return tl::unexpected(names.error());

  HandPose pose;

  // Read the segments; parents come before their children, whose poses may depend on them.
  const Json none = Json::object();
  for (int s = 0; s < kSegmentCount; ++s) {
    const std::string name(kSegmentNames[s]);
    const Object object{segments.contains(name) ? segments.at(name) : none, path + ": segment " + name};

    // Take the pose as given, or compute it from the joint angles.
    const bool given = s == kPalm || object.has("T_camera_segment");
    const auto T = given ? object.transform("T_camera_segment")
                         : posed_by_angles(object, pose[parent_of(s)] * profile.rest_relative(s));
    if (!T) return tl::unexpected(T.error());
    pose[s] = *T;
  }
  return pose;
}

Result<void> save_pose(const HandPose& pose, const std::string& path) {
  Json segments = Json::object();
  for (int s = 0; s < kSegmentCount; ++s)
    segments[std::string(kSegmentNames[s])] = {{"T_camera_segment", json_fields::to_json(pose[s])}};
  return json_fields::write_json(path, {{"segments", segments}});
}

}  // namespace barehand
