// Writes the figures of `barehand bench` as JSON for programs.
#include "app/bench/bench_report.h"
#include "io/hand/json_fields.h"

namespace barehand {
namespace {

using json_fields::Json;
using json_fields::rounded;

Json to_json(const TimeSummary& t) {
  if (t.count == 0) return {{"count", 0}};
  const auto ms = [](double seconds) { return rounded(seconds * 1e3); };
  return {{"count", t.count}, {"mean", ms(t.mean)}, {"p50", ms(t.p50)},
          {"p95", ms(t.p95)}, {"p99", ms(t.p99)},   {"max", ms(t.max)}};
}

Json to_json(const BenchRow& row) {
  // Write the case and its total figures.
  const BenchResult& r = row.result;
  Json json = {{"sweep", row.sweep},
               {"value", row.value},
               {"config", row.config},
               {"threads", row.threads},
               {"width", row.width},
               {"height", row.height},
               {"seconds", rounded(r.seconds)},
               {"frames_per_second", rounded(r.frames_per_second)},
               {"cpu_ms_per_frame", rounded(r.cpu_seconds_per_frame * 1e3)},
               {"tracked_share", rounded(r.tracked_fraction)},
               {"first_pose_ms", r.first_pose_seconds ? Json(rounded(*r.first_pose_seconds * 1e3)) : Json(nullptr)},

               // Write dropped frames and memory.
               {"dropped", r.health.dropped},
               {"peak_mb", rounded(static_cast<double>(r.peak_bytes) / kMegabyte)},
               {"stored_frames_mb", rounded(static_cast<double>(r.frame_bytes) / kMegabyte)},
               {"resident_mb", r.resident_mb},

               // Write the times of the whole path and of each stage and queue.
               {"capture_to_publish_ms", to_json(r.health.latency)},
               {"capture_to_reception_ms", to_json(r.received)},
               {"stages_ms", Json::object()},
               {"waits_ms", Json::object()}};
  for (const StageHealth& stage : r.health.stages) json["stages_ms"][stage.name] = to_json(stage.time);
  for (const QueueHealth& queue : r.health.queues) json["waits_ms"][queue.name] = to_json(queue.wait);
  return json;
}

Json to_json(const ObserverRow& row) {
  return {{"config", row.config},
          {"threads", row.threads},
          {"samples", row.trial.samples},
          {"cpu_ms", rounded(1e3 * row.trial.times.cpu)},
          {"device_ms", rounded(1e3 * row.trial.times.device)},
          {"device", row.device.renderer},
          {"software", row.device.software}};
}

}  // namespace

Result<void> write_bench_json(const BenchReport& report, const std::string& path) {
  const BenchConditions& c = report.conditions;
  Json json = {{"source", report.source},
               {"processor", report.processor},
               {"cores", report.cores},
               {"hands", report.hands},

               // Write the conditions of the measurement.
               {"frames", c.frames},
               {"warm_up", c.warm_up},
               {"rate", c.rate ? Json(*c.rate) : Json(nullptr)},
               {"inline", c.inline_stages},
               {"cases", Json::array()},
               {"observers", Json::array()}};

  // Write the measured cases.
  for (const BenchRow& row : report.rows) json["cases"].push_back(to_json(row));
  for (const ObserverRow& row : report.observers) json["observers"].push_back(to_json(row));
  return json_fields::write_json(path, json);
}

}  // namespace barehand
