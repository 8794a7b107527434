// Writes the results of `barehand eval` as JSON for programs.
#include "app/eval/eval_report.h"
#include "io/hand/json_fields.h"
#include "math/angles.h"

namespace barehand {
namespace {

using json_fields::Json;
using json_fields::rounded;

Json to_json(const Distribution& d, double scale) {
  Json json = {{"count", d.count}};
  if (d.count == 0) return json;
  const auto put = [&](const char* key, double value) { json[key] = rounded(value * scale); };
  put("mean", d.mean);
  put("deviation", d.deviation);
  put("median", d.median);

  // Write the quantiles.
  put("min", d.min);
  put("q1", d.quartile1);
  put("q3", d.quartile3);
  put("p90", d.p90);
  put("p95", d.p95);
  put("max", d.max);
  return json;
}

Json to_json(const EvaluatedRun& run, const std::optional<double>& hand_length) {
  const Evaluation& e = run.evaluation;
  Json json = {{"label", run.label},
               {"truth", run.truth_path},
               {"result", run.result_path},
               {"truncated", run.truncated},

               // Write how many frames were tracked.
               {"frames", e.frames.size()},
               {"untracked", e.untracked},
               {"lost", e.lost.size()},
               {"lost_frames", e.lost},

               // Write the errors of all frames and segments.
               {"frame_error_mm", to_json(e.frame_error, kMillimetre)},
               {"frame_error_without_palm_mm", to_json(e.frame_error_without_palm, kMillimetre)},
               {"segment_error_mm", to_json(e.segment_error, kMillimetre)},
               {"seen_segment_error_mm", to_json(e.seen, kMillimetre)},
               {"hidden_segment_error_mm", to_json(e.hidden, kMillimetre)},
               {"joint_gap_mm", to_json(e.joint_gap, kMillimetre)}};

  // Write the errors of each segment.
  for (int s = 0; s < kSegmentCount; ++s)
    json["segments_mm"][std::string(kSegmentNames[s])] = to_json(e.per_segment[s], kMillimetre);

  // Write detections of a hand that was not there, and the time until a hand that returned was tracked.
  json["phantom_frames"] = e.false_hands;
  json["returns"] = Json::array();
  for (const Return& r : e.returns)
    json["returns"].push_back({{"frame", r.number}, {"frames_until_tracked", r.frames ? Json(*r.frames) : Json()}});

  // Relate the errors to the length of the hand.
  if (hand_length) {
    json["hand_length_mm"] = rounded(*hand_length * kMillimetre);
    if (e.frame_error.count > 0) json["mean_frame_error_over_hand_length"] = rounded(e.frame_error.mean / *hand_length);
  }
  return json;
}

Json to_json(const FingertipEvaluation& e) {
  Json json = {{"labels", e.labels}, {"missing", e.missing}, {"distance_px", to_json(e.all, 1)}};
  for (int f = 0; f < kFingerCount; ++f) json["fingers_px"][std::string(kFingerNames[f])] = to_json(e.per_finger[f], 1);
  return json;
}

Json to_json(const Coverage& c) {
  Json json = {{"intervals", c.intervals}};
  if (c.intervals == 0) return json;
  json["covered"] = rounded(c.covered);
  json["stated_mm"] = rounded(c.stated * kMillimetre);
  json["actual_mm"] = rounded(c.actual * kMillimetre);
  return json;
}

Json to_json(const std::vector<ReliabilityBin>& bins, double scale) {
  Json json = Json::array();
  for (const ReliabilityBin& bin : bins)
    json.push_back(
        {{"count", bin.count}, {"stated", rounded(bin.stated * scale)}, {"actual", rounded(bin.actual * scale)}});
  return json;
}

Json to_json(const Reliability& r) {
  return {{"frames", r.frames},
          {"intervals_90", {{"all", to_json(r.all)}, {"seen", to_json(r.seen)}, {"inferred", to_json(r.inferred)}}},
          {"errors_mm", to_json(r.errors, 1000)},
          {"within_10_mm", to_json(r.confidences, 1)}};
}

Json to_json(const TouchCounts& c) {
  return {{"right", c.right},
          {"wrong", c.wrong},
          {"missed", c.missed},
          {"unknown", c.unknown},
          {"precision", rounded(c.precision())},
          {"recall", rounded(c.recall())},
          {"f1", rounded(c.f1())}};
}

Json to_json(const ContactEvaluation& e) {
  return {{"frames", e.frames},
          {"visible_fingertips", to_json(e.visible_tips)},
          {"partly_visible_fingertips", to_json(e.partial_tips)},
          {"hidden_fingertips", to_json(e.hidden_tips)},
          {"segments", to_json(e.segments)},
          {"touching", to_json(e.probabilities, 1)}};
}

Json to_json(const GraspCounts& c) {
  return {{"frames", c.frames},
          {"unknown", c.unknown},
          {"right", rounded(c.fraction(c.right))},
          {"right_kind", rounded(c.fraction(c.right_kind))},
          {"confident_wrong", rounded(c.fraction(c.confident_wrong))}};
}

Json to_json(const GraspEvaluation& e) {
  Json json = {{"held", to_json(e.held)},
               {"held_seconds", rounded(e.held_seconds)},
               {"changes_per_second", rounded(e.changes_per_second())},
               {"probability", to_json(e.probabilities, 1)}};
  for (int k = 0; k < kGraspCount; ++k) {
    const GraspCounts& counts = e.classes[static_cast<std::size_t>(k)];
    if (counts.frames > 0) json["classes"][std::string(grasp_name(k))] = to_json(counts);
  }
  return json;
}

Json to_json(const ObjectEvaluation& e) {
  Json symmetries = Json::array();
  for (const double moved : e.symmetries) symmetries.push_back(kMillimetre * moved);
  return {{"object", e.name},
          {"frames", e.frames},
          {"stated", e.stated},
          {"lost", e.lost},
          {"turned", e.turned},
          {"symmetries_mm", std::move(symmetries)},
          {"position_mm", to_json(e.position, kMillimetre)},
          {"rotation_degrees", to_json(e.rotation, 1 / kDegree)},
          {"surface_mm", to_json(e.surface, kMillimetre)}};
}

}  // namespace

Result<void> write_json_report(const EvalReport& report, const std::string& path) {
  Json json = {{"runs", Json::array()}};
  for (const EvaluatedRun& run : report.runs) json["runs"].push_back(to_json(run, report.hand_length));
  if (report.fingertips) json["fingertips"] = to_json(*report.fingertips);
  if (report.reliability) json["reliability"] = to_json(*report.reliability);
  if (report.contacts) json["contacts"] = to_json(*report.contacts);
  if (report.grasps) json["grasps"] = to_json(*report.grasps);
  for (const ObjectEvaluation& object : report.objects) json["objects"].push_back(to_json(object));
  return json_fields::write_json(path, json);
}

}  // namespace barehand
