// Draws the results of `barehand eval`.
#include <cmath>
#include <filesystem>

#include "app/eval/eval_report.h"
#include "evaluation/chart.h"

namespace barehand {
namespace {

/// Boxes of the segment error, one per run.
BoxChart runs_chart(const std::vector<EvaluatedRun>& runs) {
  BoxChart chart;
  chart.text = {"Error over all hand segments (median, quartiles, range)", "", "segment error [mm]"};
  chart.series.push_back({"", {}});
  for (const EvaluatedRun& run : runs) {
    chart.categories.push_back(run.label);
    chart.series[0].boxes.push_back(scaled(run.evaluation.segment_error, kMillimetre));
  }
  return chart;
}

/// Boxes of the error by segment, one series per run.
BoxChart segments_chart(const std::vector<EvaluatedRun>& runs) {
  BoxChart chart;
  chart.text = {"Error by segment (median, quartiles, range)", "", "segment error [mm]"};
  for (std::string_view name : kSegmentNames) chart.categories.emplace_back(name);
  for (const EvaluatedRun& run : runs) {
    chart.series.push_back({run.label, {}});
    for (const Distribution& d : run.evaluation.per_segment)
      chart.series.back().boxes.push_back(scaled(d, kMillimetre));
  }
  return chart;
}

/// The frame error over the sequence, one line per run.
LineChart time_chart(const std::vector<EvaluatedRun>& runs) {
  LineChart chart;
  chart.text = {"Frame error over the sequence", "frame", "frame error [mm]"};
  for (const EvaluatedRun& run : runs) {
    chart.series.push_back({run.label, {}, {}});
    for (const FrameErrors& frame : run.evaluation.frames) {
      chart.series.back().x.push_back(static_cast<double>(frame.number));
      chart.series.back().y.push_back(frame.tracked ? frame.mean * kMillimetre : NAN);
    }
  }
  return chart;
}

/// Boxes of the distance between projected and labelled fingertips.
BoxChart fingertips_chart(const FingertipEvaluation& fingertips) {
  BoxChart chart;
  chart.text = {"Projected fingertips against labels (median, quartiles, range)", "", "distance [px]"};
  chart.categories = {"all"};
  chart.categories.insert(chart.categories.end(), kFingerNames.begin(), kFingerNames.end());
  chart.series.push_back({"", {fingertips.all}});
  for (const Distribution& d : fingertips.per_finger) chart.series[0].boxes.push_back(d);
  return chart;
}

/// A chart of the actual over the stated values. If they agreed perfectly, all points would be on its diagonal.
LineChart reliability_chart(const std::vector<ReliabilityBin>& bins, ChartText text, double scale) {
  LineChart chart;
  chart.text = std::move(text);
  chart.series = {{"found", {}, {}}, {"as stated", {}, {}}};
  for (const ReliabilityBin& bin : bins) {
    for (auto& series : chart.series) series.x.push_back(bin.stated * scale);
    chart.series[0].y.push_back(bin.actual * scale);
    chart.series[1].y.push_back(bin.stated * scale);
  }
  return chart;
}

}  // namespace

Result<void> write_plots(const EvalReport& report, const std::string& directory) {
  // Create the folder if it is missing.
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) return fail("cannot be created: " + error.message(), directory, "check the path and its permissions");

  // Draw the errors of the runs.
  Result<void> done;
  if (!report.runs.empty())
    done = write_chart(runs_chart(report.runs), directory + "/runs.png")
               .and_then([&] { return write_chart(segments_chart(report.runs), directory + "/segments.png"); })
               .and_then([&] { return write_chart(time_chart(report.runs), directory + "/time.png"); });

  // Draw the fingertips, if there are labels.
  if (done && report.fingertips)
    done = write_chart(fingertips_chart(*report.fingertips), directory + "/fingertips.png");

  // Draw the stated uncertainty, if the result has it.
  if (done && report.reliability) {
    const Reliability& r = *report.reliability;
    const ChartText errors{"Error of segment ends (root mean square)", "stated [mm]", "actual [mm]"};
    const ChartText confidences{"Segments within 10 mm of the truth", "confidence [%]", "found [%]"};

    done = write_chart(reliability_chart(r.errors, errors, kMillimetre), directory + "/reliability.png").and_then([&] {
      return write_chart(reliability_chart(r.confidences, confidences, 100), directory + "/confidence.png");
    });
  }
  return done;
}

}  // namespace barehand
