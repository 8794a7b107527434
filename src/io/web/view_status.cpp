#include "io/web/view_status.h"

#include <nlohmann/json.hpp>

namespace barehand {
namespace {

using nlohmann::json;

/// JSON has no NaN: nlohmann writes null.
json times_json(const TimeSummary& time) {
  return {{"count", time.count}, {"mean", time.mean}, {"p50", time.p50},
          {"p95", time.p95},     {"p99", time.p99},   {"max", time.max}};
}

json health_json(const PipelineHealth& health) {
  json stages = json::array(), queues = json::array();
  for (const StageHealth& stage : health.stages)
    stages.push_back({{"name", stage.name}, {"time", times_json(stage.time)}, {"failed", stage.failed}});
  for (const QueueHealth& queue : health.queues)
    queues.push_back({{"name", queue.name},
                      {"depth", queue.depth},
                      {"capacity", queue.capacity},
                      {"pushed", queue.pushed},
                      {"dropped", queue.dropped}});
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

}  // namespace

std::string status_json(const ViewState& state) {
  json out{{"type", "status"},
           {"source", state.source},
           {"live", state.live},
           {"trouble", state.trouble},
           {"clients", state.clients},
           {"health", state.health ? health_json(*state.health) : json()},
           {"log", state.log ? log_json(*state.log) : json()}};
  return out.dump(-1, ' ', false, json::error_handler_t::replace);  // names of sources need not be UTF-8
}

}  // namespace barehand
