// Reads and writes hand profiles (hand.json), and checks them.
#include "io/hand/hand_json.h"

#include <cmath>
#include <map>
#include <set>

#include "core/format.h"
#include "hand/profile_warnings.h"
#include "io/atomic_file.h"
#include "io/hand/json_fields.h"
#include "io/hand/skin_json.h"
#include "math/angles.h"

namespace barehand {
namespace {

using json_fields::Json;
using json_fields::Object;
using json_fields::rounded;

constexpr double kLongest = 0.3;      // longest bone [m]; a larger value was probably given in millimetres
constexpr double kThinnest = 0.0005;  // smallest radius of the skin [m]
constexpr double kThickest = 0.1;     // largest radius of the skin [m]

using ParentNames = std::map<std::string, std::string>;

/// Returns a cycle of parents as "a -> b -> a"; "" if there is none.
std::string find_cycle(const ParentNames& parents) {
  for (const auto& [start, ignored] : parents) {
    std::string way = start;
    std::set<std::string> passed = {start};
    for (auto at = parents.find(start); at != parents.end() && !at->second.empty();) {
      way += " -> " + at->second;
      if (!passed.insert(at->second).second) return way;
      at = parents.find(at->second);
    }
  }
  return {};
}

Result<void> check_parents(const ParentNames& parents, const std::string& path) {
  if (const std::string cycle = find_cycle(parents); !cycle.empty())
    return fail("\"parent\" forms a cycle: " + cycle, path, "the palm is the root, its parent is null");
  for (int s = 0; s < kSegmentCount; ++s) {
    const std::string name(kSegmentNames[s]);
    const std::string wanted = s == kPalm ? "" : std::string(kSegmentNames[parent_of(s)]);
    const std::string& found = parents.at(name);
    if (found != wanted)
      return fail("\"parent\" is " + (found.empty() ? "null" : "\"" + found + "\""), path + ": segment " + name,
                  "it must be " + (wanted.empty() ? "null" : "\"" + wanted + "\""));
  }
  return {};
}

/// Checks that no joint is too far from its parent's: the skin is computed on a grid around all joints, which would
/// then need more memory than there is.
Result<void> check_joints(const HandProfile& profile, const std::string& path) {
  for (int s = 0; s < kSegmentCount; ++s) {
    if (s == kPalm) continue;
    const double distance =
        (profile.segments[s].T_hand_segment.t - profile.segments[parent_of(s)].T_hand_segment.t).norm();
    if (distance > kLongest)
      return fail(formatted("\"rest_transform\" puts the joint %.4g m from its parent's", distance),
                  path + ": segment " + std::string(kSegmentNames[s]),
                  formatted("at most %g m; perhaps these are centimetres or millimetres", kLongest));
  }
  return {};
}

Result<std::string> parent_name(const Object& object) {
  if (!object.has("parent")) return fail("\"parent\" is missing", object.where, "name it; null for the palm");
  if (object.json.at("parent").is_null()) return std::string();
  return object.text("parent");
}

Result<JointDof> parse_dof(const Json& json, const std::string& where) {
  if (!json.is_object()) return fail("\"dofs\" holds " + json_fields::shown(json), where, "it must hold objects");
  Object object{json, where};
  const auto name = object.text("name");
  if (!name) return tl::unexpected(name.error());
  object.where += ": dof " + *name;

  // Read the axis and the limits.
  const auto axis = object.numbers("axis", 3, -1.01, 1.01);
  if (!axis) return tl::unexpected(axis.error());
  const auto limits = object.numbers("limits_deg", 2, -180, 180);
  if (!limits) return tl::unexpected(limits.error());
  JointDof dof{*name, {(*axis)[0], (*axis)[1], (*axis)[2]}, (*limits)[0] * kDegree, (*limits)[1] * kDegree};

  // Reject an axis or limits that no joint of a hand has.
  if (std::abs(dof.axis.norm() - 1) > 0.01) return fail("\"axis\" is not a unit vector", object.where, "normalise it");
  if (std::abs(dof.axis.z()) > 0.5)
    return fail("\"axis\" points along the bone", object.where, "joints flex about x and abduct about y only");
  if (dof.lower > dof.upper)
    return fail("\"limits_deg\" has its lower limit above its upper one", object.where, "swap them");
  dof.axis.normalize();
  return dof;
}

Result<void> parse_dofs(const Object& object, SegmentProfile& segment) {
  if (!object.has("dofs") || !object.json.at("dofs").is_array())
    return fail("\"dofs\" is missing or not a list", object.where,
                "list the joint's degrees of freedom; [] for the palm");
  for (const Json& entry : object.json.at("dofs")) {
    const auto dof = parse_dof(entry, object.where);
    if (!dof) return tl::unexpected(dof.error());
    segment.dofs.push_back(*dof);
  }
  return {};
}

Result<void> parse_pair(const Object& object, const char* key, double lo, double hi, std::array<double, 2>& pair) {
  if (!object.has(key)) return {};
  const auto values = object.numbers(key, 2, lo, hi);
  if (!values) return tl::unexpected(values.error());
  pair = {(*values)[0], (*values)[1]};
  return {};
}

Result<void> parse_skin(const Object& object, SegmentProfile& segment) {
  const char* radius_keys[2] = {"proximal_radius", "distal_radius"};
  for (int end = 0; end < 2; ++end) {
    const auto radius = object.number(radius_keys[end], kThinnest, kThickest);
    if (!radius) return tl::unexpected(radius.error());
    segment.radius[end] = *radius;
  }
  segment.half_width = segment.half_thickness = segment.radius;
  return parse_pair(object, "half_width", kThinnest, kThickest, segment.half_width)
      .and_then([&] { return parse_pair(object, "half_thickness", kThinnest, kThickest, segment.half_thickness); })
      .and_then([&] { return parse_pair(object, "flesh_offset_x", -kThickest, kThickest, segment.flesh_offset_x); })
      .and_then([&] { return parse_pair(object, "flesh_offset_y", -kThickest, kThickest, segment.flesh_offset_y); });
}

Result<SegmentProfile> parse_segment(const Object& object) {
  SegmentProfile segment;

  // Read the rest pose and the length of the bone.
  const auto rest = object.transform("rest_transform");
  if (!rest) return tl::unexpected(rest.error());
  segment.T_hand_segment = *rest;
  const auto length = object.number("length", 0.001, kLongest);
  if (!length) return tl::unexpected(length.error());
  segment.length = *length;

  // Read the distal end, which must agree with the length and the frame of the segment.
  const auto distal = object.numbers("distal_local", 3, -kLongest, kLongest);
  if (!distal) return tl::unexpected(distal.error());
  segment.distal = {(*distal)[0], (*distal)[1], (*distal)[2]};
  if (std::abs(segment.distal.norm() - segment.length) > 0.001)
    return fail("\"length\" contradicts \"distal_local\"", object.where, "length is the distance to the distal end");
  if (segment.distal.z() > -0.5 * segment.length)
    return fail("\"distal_local\" does not lie along -z", object.where, "the bone runs along -z of its segment frame");

  // Read the shape of the skin and the degrees of freedom of the joint.
  const auto skin = parse_skin(object, segment);
  if (!skin) return tl::unexpected(skin.error());
  const auto dofs = parse_dofs(object, segment);
  if (!dofs) return tl::unexpected(dofs.error());
  return segment;
}

Result<Handedness> parse_handedness(const Object& object) {
  const auto side = object.text("handedness");
  if (!side) return tl::unexpected(side.error());
  if (*side == "right") return Handedness::right;
  if (*side == "left") return Handedness::left;
  return fail("\"handedness\" is \"" + *side + "\"", object.where, "it must be \"right\" or \"left\"");
}

Result<ProfileOrigin> parse_origin(const Object& object) {
  const auto found = object.json.find("mean_hand");
  if (found == object.json.end() || *found == false) return ProfileOrigin::measured;
  if (*found == true) return ProfileOrigin::mean;
  if (*found == "fitted") return ProfileOrigin::fitted;
  return fail("\"mean_hand\" is " + json_fields::shown(*found), object.where, "it must be true, false or \"fitted\"");
}

Result<int> parse_index(const Object& object, const ParentNames& known) {
  const auto name = object.text("name");
  if (!name) return tl::unexpected(name.error());
  const auto index = segment_from_name(*name);
  if (!index) return fail("\"" + *name + "\" is not a segment of the hand", object.where, "see docs/formats.md");
  if (known.contains(*name)) return fail("segment " + *name + " occurs twice", object.where, "remove one");
  return *index;
}

Json to_json(const std::array<double, 2>& pair) { return {rounded(pair[0]), rounded(pair[1])}; }

Json to_json(const Eigen::Vector3d& v) { return {rounded(v.x()), rounded(v.y()), rounded(v.z())}; }

Json to_json(const SegmentProfile& segment, int s) {
  // Collect the degrees of freedom of the joint, with limits in degrees.
  Json dofs = Json::array();
  for (const JointDof& dof : segment.dofs)
    dofs.push_back({{"name", dof.name},
                    {"axis", to_json(dof.axis)},
                    {"limits_deg", {rounded(dof.lower / kDegree), rounded(dof.upper / kDegree)}}});

  // List the properties of the segment; lengths are in metres.
  return {{"name", kSegmentNames[s]},
          {"parent", s == kPalm ? Json() : Json(kSegmentNames[parent_of(s)])},
          {"rest_transform", json_fields::to_json(segment.T_hand_segment)},
          {"length", rounded(segment.length)},
          {"distal_local", to_json(segment.distal)},
          {"proximal_radius", rounded(segment.radius[0])},
          {"distal_radius", rounded(segment.radius[1])},
          {"half_width", to_json(segment.half_width)},
          {"half_thickness", to_json(segment.half_thickness)},
          {"flesh_offset_x", to_json(segment.flesh_offset_x)},
          {"flesh_offset_y", to_json(segment.flesh_offset_y)},
          {"dofs", dofs}};
}

Result<HandProfile> profile_from(const Json& json, const std::string& path) {
  // Check the structure of the file.
  if (!json.is_object() || !json.contains("segments") || !json.at("segments").is_array())
    return fail("\"segments\" is missing or not a list", path, "see docs/formats.md");

  // Read what is known of the hand as a whole.
  HandProfile profile;
  const auto side = parse_handedness({json, path});
  if (!side) return tl::unexpected(side.error());
  profile.handedness = *side;
  const auto origin = parse_origin({json, path});
  if (!origin) return tl::unexpected(origin.error());
  profile.origin = *origin;

  // Read the segments, which may be in any order.
  ParentNames parents;
  for (const Json& entry : json.at("segments")) {
    if (!entry.is_object())
      return fail("\"segments\" holds " + json_fields::shown(entry), path, "it must hold objects");
    const auto index = parse_index({entry, path}, parents);
    if (!index) return tl::unexpected(index.error());
    const Object object{entry, path + ": segment " + std::string(kSegmentNames[*index])};

    // Read the parent and the segment, and store them under the index.
    const auto parent = parent_name(object);
    if (!parent) return tl::unexpected(parent.error());
    const auto segment = parse_segment(object);
    if (!segment) return tl::unexpected(segment.error());
    parents[std::string(kSegmentNames[*index])] = *parent;
    profile.segments[*index] = *segment;
  }

  // Check that every segment is given, and that parents and joints fit together.
  for (std::string_view name : kSegmentNames)
    if (!parents.contains(std::string(name)))
      return fail("segment " + std::string(name) + " is missing", path, "a hand has 16 segments, see docs/formats.md");
  const auto tree = check_parents(parents, path).and_then([&] { return check_joints(profile, path); });
  if (!tree) return tl::unexpected(tree.error());

  // Reject limits that were not converted to degrees.
  if (limits_look_like_radians(profile))
    return fail("\"limits_deg\": most joints may bend by less than 3.2 degrees, which look like radians", path,
                "multiply them by 180 / pi");

  // Read the scanned skin, if there is one.
  if (json.contains("skin")) {
    if (profile.origin == ProfileOrigin::mean)
      return fail("\"skin\" stands beside \"mean_hand\"", path,
                  "a scanned skin belongs to one person, a mean hand to nobody: remove one");
    auto skin = skin_from_json(json.at("skin"), path + ": skin");
    if (!skin) return tl::unexpected(skin.error());

    // Compute the normals, which the file does not hold.
    compute_normals(profile, *skin);
    profile.scanned_skin = std::make_shared<const Skin>(*std::move(skin));
  }
  return profile;
}

}  // namespace

Result<HandProfile> load_profile(const std::string& path) {
  const auto json = json_fields::read_json(path);
  if (!json) return tl::unexpected(json.error());
  return profile_from(*json, path);
}

Result<HandProfile> parse_profile(const std::string& text, const std::string& where) {
  const auto json = json_fields::parse_json(text, where);
  if (!json) return tl::unexpected(json.error());
  return profile_from(*json, where);
}

Result<void> save_profile(const HandProfile& profile, const std::string& path) {
  Json json = {{"handedness", to_string(profile.handedness)}, {"segments", Json::array()}};
  if (profile.origin == ProfileOrigin::mean) json["mean_hand"] = true;
  if (profile.origin == ProfileOrigin::fitted) json["mean_hand"] = "fitted";
  for (int s = 0; s < kSegmentCount; ++s) json["segments"].push_back(to_json(profile.segments[s], s));
  if (profile.scanned_skin) json["skin"] = skin_to_json(*profile.scanned_skin);
  return json_fields::write_json(path, json);
}

}  // namespace barehand
