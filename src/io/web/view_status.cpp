// Encodes the status of the program for the live page.
#include "io/web/view_status.h"

#include <nlohmann/json.hpp>

namespace barehand {
namespace {

using nlohmann::json;

/// Times that are NaN become null, since JSON has no NaN.
json times_json(const TimeSummary& time) {
  return {{"count", time.count}, {"mean", time.mean}, {"p50", time.p50},
          {"p95", time.p95},     {"p99", time.p99},   {"max", time.max}};
}

json health_json(const PipelineHealth& health) {
  // List the stages and the queues.
  json stages = json::array(), queues = json::array();
  for (const StageHealth& stage : health.stages)
    stages.push_back({{"name", stage.name}, {"time", times_json(stage.time)}, {"failed", stage.failed}});
  for (const QueueHealth& queue : health.queues)
    queues.push_back({{"name", queue.name},
                      {"depth", queue.depth},
                      {"capacity", queue.capacity},
                      {"pushed", queue.pushed},
                      {"dropped", queue.dropped}});

  // Add the counts of frames and the latency.
  return {{"captured", health.captured},
          {"published", health.published},
          {"dropped", health.dropped},
          {"failed", health.failed},
          {"skipped", health.skipped},
          {"stages", stages},
          {"queues", queues},
          {"latency", times_json(health.latency)}};
}

json log_json(const PlayedLog& log) {
  json lost = json::array();
  for (const LostFrames& frames : log.lost) lost.push_back({frames.first, frames.last});
  return {{"frames", log.frames}, {"position", log.position}, {"seconds", log.seconds},
          {"at", log.at},         {"playing", log.playing},   {"speed", log.speed},
          {"lost", lost}};
}

/// The 4x4 matrix, row-major.
json transform_json(const SE3& T) {
  json numbers = json::array();
  for (const double number : T.matrix().reshaped<Eigen::RowMajor>()) numbers.push_back(number);
  return numbers;
}

json scan_json(const ViewScan& scan) {
  constexpr const char* kPhases[] = {"showing", "measuring", "done"};

  // List how far each segment was seen and bent.
  json segments = json::array();
  for (const ViewScanSegment& s : scan.segments)
    segments.push_back({{"name", s.name},
                        {"palm_side", s.palm_side},
                        {"back_side", s.back_side},
                        {"bent", s.bent},
                        {"to_bend", s.to_bend},
                        {"before", s.before},
                        {"after", s.after}});

  // Add the progress of the scan as a whole.
  return {{"phase", kPhases[static_cast<int>(scan.phase)]},
          {"how_to", scan.how_to},
          {"missing", scan.missing},
          {"progress", scan.progress},
          {"frames", scan.frames},
          {"enough_frames", scan.enough_frames},
          {"enough_bending", scan.enough_bending},
          {"segments", segments}};
}

json record_json(const RecorderState& record) {
  return {{"folder", record.folder},   {"recording", record.recording}, {"writing", record.writing},
          {"file", record.file},       {"frames", record.frames},       {"bytes", record.bytes},
          {"seconds", record.seconds}, {"dropped", record.dropped},     {"note", record.note},
          {"failed", record.failed}};
}

}  // namespace

std::string status_json(const ViewState& state) {
  json out{{"type", "status"},
           {"source", state.source},
           {"live", state.live},
           {"trouble", state.trouble},
           {"clients", state.clients},
           {"health", state.health ? health_json(*state.health) : json()},
           {"log", state.log ? log_json(*state.log) : json()},
           {"T_world_camera", state.T_world_camera ? transform_json(*state.T_world_camera) : json()},
           {"scan", state.scan ? scan_json(*state.scan) : json()},
           {"record", state.record ? record_json(*state.record) : json()},
           {"drawn", state.drawn ? json(*state.drawn) : json()}};
  return out.dump(-1, ' ', false, json::error_handler_t::replace);  // names of sources need not be UTF-8
}

}  // namespace barehand
