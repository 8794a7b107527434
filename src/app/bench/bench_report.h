#pragma once

#include <string>
#include <vector>

#include "app/bench/bench_case.h"
#include "core/error.h"
#include "observe/egl/graphics_device.h"
#include "pipeline/trial_level.h"

namespace barehand {

/// One measured case with its conditions, as it is written to a file and drawn.
struct BenchRow {
  std::string sweep;  ///< parameter that is varied; "": none
  double value = 0;
  std::string config;
  int threads = 1;
  int width = 0, height = 0;  ///< size of the frames [px]
  BenchResult result;
};

/// Times of one call that compares samples with the depth image, on the CPU and on a graphics device.
struct ObserverRow {
  std::string config;
  int threads = 1;  ///< number of threads on the CPU
  GraphicsDevice device;
  TrialTimes trial;
};

/// A whole run of `barehand bench`.
struct BenchReport {
  std::string source, processor;
  int cores = 0;
  int hands = 0;  ///< number of hands that are tracked at once
  BenchConditions conditions;
  std::vector<BenchRow> rows;
  std::vector<ObserverRow> observers;
};

/// A case as text of several lines.
std::string bench_text(const BenchRow& row);
/// A comparison of CPU and graphics device as one line of text.
std::string bench_text(const ObserverRow& row);

/// Writes the report as JSON, with durations in ms and memory in MB.
Result<void> write_bench_json(const BenchReport& report, const std::string& path);

/// Draws a file that write_bench_json wrote as PNG images into a folder: the times of the stages; CPU time per frame
/// against every swept parameter, with a straight line for linear growth; memory over the run.
Result<void> draw_bench(const std::string& json_path, const std::string& directory);

}  // namespace barehand
