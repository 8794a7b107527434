// Draws the figures of `barehand bench` from its JSON file.
#include <algorithm>
#include <filesystem>
#include <map>

#include "app/bench/bench_report.h"
#include "core/format.h"
#include "evaluation/chart.h"
#include "io/hand/json_fields.h"

namespace barehand {
namespace {

using json_fields::Json;

/// A box from the stored percentiles: the box reaches from the median to p95, its whisker to p99.
Distribution box_of(const Json& time) {
  Distribution d;
  d.count = time.at("count");
  if (d.count == 0) return d;
  d.median = d.min = d.quartile1 = time.at("p50");
  d.quartile3 = time.at("p95");
  d.max = time.at("p99");
  return d;
}

/// The legend's text for a case.
std::string label_of(const Json& row) {
  std::string label = row.at("config");
  if (row.at("sweep") != "")
    label += formatted(" %s=%d", row.at("sweep").get<std::string>().c_str(), row.at("value").get<int>());
  return label + ", " + std::to_string(row.at("threads").get<int>()) + " threads";
}

/// Boxes of the time per frame: one category per stage and queue, one series per case.
BoxChart stages_chart(const std::vector<Json>& rows) {
  BoxChart chart;
  chart.text = {"Time per frame (median, p95, p99)", "", "time [ms]"};

  // The categories are those of the first case.
  for (const auto& [name, time] : rows[0].at("stages_ms").items()) chart.categories.push_back(name);
  for (const auto& [name, time] : rows[0].at("waits_ms").items()) chart.categories.push_back("wait " + name);
  chart.categories.push_back("latency");

  // Add one series per case.
  for (const Json& row : rows) {
    chart.series.push_back({label_of(row), {}});
    auto& boxes = chart.series.back().boxes;
    for (const Json& time : row.at("stages_ms")) boxes.push_back(box_of(time));
    for (const Json& time : row.at("waits_ms")) boxes.push_back(box_of(time));
    boxes.push_back(box_of(row.at("capture_to_publish_ms")));
  }
  return chart;
}

/// CPU time per frame against one parameter, and the straight line through the first and the last point.
LineChart sweep_chart(const std::string& parameter, const std::vector<Json>& rows) {
  LineChart chart;
  chart.text = {"CPU time per frame against " + parameter, parameter, "CPU [ms per frame]"};
  LineChart::Series measured{"measured", {}, {}};
  for (const Json& row : rows) {
    measured.x.push_back(row.at("value"));
    measured.y.push_back(row.at("cpu_ms_per_frame"));
  }
  if (measured.x.size() > 2)
    chart.series.push_back(
        {"linear", {measured.x.front(), measured.x.back()}, {measured.y.front(), measured.y.back()}});
  chart.series.push_back(std::move(measured));
  return chart;
}

/// Resident memory over the run, one line per case.
LineChart memory_chart(const std::vector<Json>& rows, std::int64_t frames) {
  LineChart chart;
  chart.text = {"Resident memory over the run, without the stored frames", "frame", "resident [MB]"};
  for (const Json& row : rows) {
    const std::vector<double> resident = row.at("resident_mb");
    chart.series.push_back({label_of(row), {}, resident});
    for (std::size_t i = 0; i < resident.size(); ++i)
      chart.series.back().x.push_back(static_cast<double>((i + 1) * frames) / static_cast<double>(resident.size()));
  }
  return chart;
}

Result<void> draw(const Json& report, const std::string& directory) {
  // Sort the cases by the parameter that they vary.
  std::map<std::string, std::vector<Json>> by_sweep;
  for (const Json& row : report.at("cases")) by_sweep[row.at("sweep")].push_back(row);

  // Draw one chart per parameter.
  for (auto& [parameter, rows] : by_sweep) {
    if (parameter.empty()) continue;
    std::sort(rows.begin(), rows.end(), [](const Json& a, const Json& b) { return a.at("value") < b.at("value"); });
    if (auto done = write_chart(sweep_chart(parameter, rows), directory + "/" + parameter + ".png"); !done) return done;
  }

  // Draw the charts of the configurations in which no parameter was varied.
  if (by_sweep[""].empty()) return {};
  return write_chart(stages_chart(by_sweep[""]), directory + "/stages.png").and_then([&] {
    return write_chart(memory_chart(by_sweep[""], report.at("frames")), directory + "/memory.png");
  });
}

}  // namespace

Result<void> draw_bench(const std::string& json_path, const std::string& directory) {
  const auto report = json_fields::read_json(json_path);
  if (!report) return tl::unexpected(report.error());
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) return fail("cannot be created: " + error.message(), directory, "check the path and its permissions");
  try {
    return draw(*report, directory);
  } catch (const Json::exception&) {  // a part is missing, or has another type
    return fail("is not a report of barehand bench, or not a whole one", json_path, "write it with --json");
  }
}

}  // namespace barehand
