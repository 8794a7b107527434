#include "evaluation/fingertips.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "io/file_bytes.h"
#include "io/hand/table_fields.h"

namespace barehand {
namespace {

// Compares the fingertips of results with fingertips that were labelled in images.

/// Parses one line of the table. Returns false if it is malformed.
bool parse_label(const std::string& text, FingertipLabel& label, bool& visible) {
  const auto field = split_fields(text);
  if (field.size() < 5) return false;

  // Read the finger by its name; the other fields are numbers.
  const auto finger = std::find(kFingerNames.begin(), kFingerNames.end(), field[1]);
  if (finger == kFingerNames.end()) return false;
  label.finger = static_cast<int>(finger - kFingerNames.begin());

  // Reject numbers that are malformed or outside any image.
  int shown = 0;
  const bool good = parse_number(field[0], label.frame) && parse_number(field[2], label.pixel.x()) &&
                    parse_number(field[3], label.pixel.y()) && parse_number(field[4], shown);
  visible = shown != 0;
  constexpr double kFarthest = 1e6;  // largest coordinate [px]; the comparison is false for NaN, too
  return good && (label.pixel.array().abs() <= kFarthest).all();
}

}  // namespace

Result<std::vector<FingertipLabel>> read_fingertip_labels(const std::string& path) {
  auto content = read_text(path);
  if (!content) return tl::unexpected(content.error());
  std::istringstream file(std::move(*content));
  std::string text;
  std::getline(file, text);
  if (text.rfind("frame,finger,u,v,visible", 0) != 0)
    return fail("line 1 is not the header of a fingertip table", path, "it must be \"frame,finger,u,v,visible\"");

  // Read line by line.
  std::vector<FingertipLabel> labels;
  for (int number = 2; std::getline(file, text); ++number) {
    if (text.empty()) continue;
    // Parse the line; a malformed one is an error.
    FingertipLabel label;
    bool visible = false;
    if (!parse_label(text, label, visible))
      return fail("line " + std::to_string(number) + ": is \"" + text + "\"", path,
                  "a line holds frame,finger,u,v,visible; a finger is thumb, index, middle, ring or little");
    if (visible) labels.push_back(label);
  }
  return labels;
}

Eigen::Vector3d fingertip(const TableFrame& frame, const HandProfile& profile, int finger) {
  const int s = segment_of(finger, 2);
  const TableRow& row = frame.rows[s];
  return row.distal + profile.segments[s].radius[1] * (row.distal - row.proximal).normalized();
}

FingertipEvaluation evaluate_fingertips(const std::vector<FingertipLabel>& labels,
                                        const std::vector<ResultTable>& results, const HandProfile& profile,
                                        const Intrinsics& camera) {
  // Collect the tracked frames; if several runs tracked a frame, the first run counts.
  std::map<std::int64_t, const TableFrame*> tracked;
  for (const ResultTable& result : results)
    for (const TableFrame& frame : result.frames) tracked.try_emplace(frame.number, &frame);

  // Compare every label with the projected fingertip.
  FingertipEvaluation evaluation;
  evaluation.labels = labels.size();
  std::vector<double> all;
  std::array<std::vector<double>, kFingerCount> fingers;
  for (const FingertipLabel& label : labels) {
    // Find the fingertip in the image that the label belongs to.
    const auto found = tracked.find(label.frame);
    const Eigen::Vector3d tip =
        found == tracked.end() ? Eigen::Vector3d::Zero() : fingertip(*found->second, profile, label.finger);

    if (tip.z() <= 0) {  // no hand was tracked, or the fingertip is behind the camera and has no image
      ++evaluation.missing;
      continue;
    }
    const double distance = (camera.project(tip) - label.pixel).norm();
    all.push_back(distance);
    fingers[label.finger].push_back(distance);
  }

  // Summarise the distances.
  evaluation.all = summarise(all);
  for (int f = 0; f < kFingerCount; ++f) evaluation.per_finger[f] = summarise(fingers[f]);
  return evaluation;
}

}  // namespace barehand
