// Writes the results of an experiment as a text table, CSV, JSON and a chart.
#include "app/experiment/experiment_report.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "evaluation/chart.h"
#include "io/atomic_file.h"
#include "io/hand/json_fields.h"

namespace barehand {
namespace {

using json_fields::Json;

/// One column of the report.
struct Figure {
  const char* name;
  double value;  // NaN: there is no value
  int decimals;
};

/// The columns of a row.
std::vector<Figure> figures_of(const ExperimentRow& row) {
  const Evaluation& e = row.run.evaluation;
  return {{"frames", static_cast<double>(e.frames.size()), 0},
          {"lost", static_cast<double>(e.lost.size()), 0},
          {"mean_mm", e.frame_error.mean * kMillimetre, 2},
          {"median_mm", e.frame_error.median * kMillimetre, 2},
          {"p90_mm", e.frame_error.p90 * kMillimetre, 2},
          {"max_mm", e.frame_error.max * kMillimetre, 2},
          {"seen_mm", e.seen.mean * kMillimetre, 2},
          {"hidden_mm", e.hidden.mean * kMillimetre, 2},
          {"preprocess_ms", row.preprocess_ms, 1},
          {"track_ms", row.track_ms, 1}};
}

/// The value as text; `none` if there is no value.
std::string decimal(const Figure& figure, const char* none) {
  if (!std::isfinite(figure.value)) return none;
  return formatted("%.*f", figure.decimals, figure.value);
}

/// The text, right-aligned in `width` characters.
std::string padded(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, text.size()), ' ') + text;
}

std::string csv_of(const ExperimentReport& report) {
  std::string text = "sequence,variant";
  for (const Figure& figure : figures_of(report.rows.front())) text += std::string(",") + figure.name;
  for (const ExperimentRow& row : report.rows) {
    text += "\n" + row.sequence + "," + row.run.label;
    for (const Figure& figure : figures_of(row)) text.append(",").append(decimal(figure, ""));
  }
  return text + "\n";
}

Json json_of(const ExperimentReport& report) {
  Json json = {{"experiment", report.name}, {"rows", Json::array()}};
  for (const ExperimentRow& row : report.rows) {
    Json entry = {{"sequence", row.sequence}, {"variant", row.run.label}};
    for (const Figure& figure : figures_of(row))
      entry[figure.name] = std::isfinite(figure.value) ? Json(json_fields::rounded(figure.value)) : Json();
    json["rows"].push_back(std::move(entry));
  }
  return json;
}

/// Index of `name` in `names`, to which it is appended if it is new.
std::size_t place(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  const auto index = static_cast<std::size_t>(found - names.begin());
  if (found == names.end()) names.push_back(name);
  return index;
}

BoxChart chart_of(const ExperimentReport& report) {
  BoxChart chart;
  chart.text = {report.name + ": error over all hand segments (median, quartiles, range)", "", "segment error [mm]"};
  std::vector<std::string> variants;
  for (const ExperimentRow& row : report.rows) {
    const std::size_t category = place(chart.categories, row.sequence), series = place(variants, row.run.label);
    if (series == chart.series.size()) chart.series.push_back({row.run.label, {}});
    chart.series[series].boxes.resize(category + 1);
    chart.series[series].boxes[category] = scaled(row.run.evaluation.segment_error, kMillimetre);
  }
  return chart;
}

}  // namespace

std::string experiment_table(const ExperimentReport& report) {
  // The columns of names are as wide as their longest name.
  std::size_t sequence = 8, variant = 7;  // widths of the headings
  for (const ExperimentRow& row : report.rows) {
    sequence = std::max(sequence, row.sequence.size());
    variant = std::max(variant, row.run.label.size());
  }

  // Write the heading.
  std::string text = padded("sequence", sequence) + "  " + padded("variant", variant);
  for (const Figure& figure : figures_of(report.rows.front())) text += "  " + std::string(figure.name);

  // Write one line per row.
  for (const ExperimentRow& row : report.rows) {
    text.append("\n").append(padded(row.sequence, sequence)).append("  ").append(padded(row.run.label, variant));
    for (const Figure& figure : figures_of(row))
      text += "  " + padded(decimal(figure, "-"), std::string(figure.name).size());
  }
  return text + "\n";
}

Result<void> write_experiment(const ExperimentReport& report, const std::string& directory) {
  const std::string path = directory + "/" + report.name;
  return write_file_atomically(path + ".txt", experiment_table(report))
      .and_then([&] { return write_file_atomically(path + ".csv", csv_of(report)); })
      .and_then([&] { return json_fields::write_json(path + ".json", json_of(report)); })
      .and_then([&] { return write_chart(chart_of(report), path + ".png"); });
}

}  // namespace barehand
