// Reads and writes tables of hand poses: results and ground truth.
#include "io/hand/result_table.h"

#include <cassert>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "core/format.h"
#include "hand/joint_angles.h"
#include "io/file_bytes.h"
#include "io/hand/table_fields.h"
#include "sensor/frame_order.h"

namespace barehand {
namespace {

constexpr std::string_view kHeader = "frame,timestamp,segment,px,py,pz,dx,dy,dz,visible";
constexpr std::size_t kColumns = 10;
// Limits that no real table exceeds; sums and differences of numbers within them are finite.
constexpr std::int64_t kLargestNumber = 1'000'000'000'000'000;
constexpr double kLargestTime = 1e-6 * static_cast<double>(kLatestUtime);  // latest time of a frame [s]
constexpr double kFarthest = 1e6;                                          // largest coordinate [m]

struct ParsedLine {
  std::int64_t number = 0;
  double timestamp = 0;
  int segment = 0;
  TableRow row;
};

/// Whether the absolute value is at most `largest`; false for NaN.
bool within(double value, double largest) { return std::abs(value) <= largest; }

std::optional<ParsedLine> parse_line(std::string_view text) {
  // Read the number of the frame, which must be plausible, and its time.
  const auto fields = split_fields(text);
  ParsedLine line;
  if (fields.size() != kColumns || !parse_number(fields[0], line.number) || !parse_number(fields[1], line.timestamp))
    return {};
  if (line.number < -kLargestNumber || line.number > kLargestNumber || !std::isfinite(line.timestamp)) return {};

  // Read the segment by its name.
  const auto segment = segment_from_name(fields[2]);
  if (!segment) return {};
  line.segment = *segment;

  // Read the positions of both ends and the visible fraction.
  std::array<double, 7> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!parse_number(fields[3 + i], numbers[i]) || !within(numbers[i], kFarthest)) return {};
  line.row = {{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}, numbers[6]};
  return line;
}

/// Collects rows into frames.
class TableBuilder {
 public:
  /// Adds a line; returns what is wrong with it, or "".
  std::string add(const ParsedLine& line) {
    if (!open() || line.number != table_.frames.back().number) {
      if (open()) return "frame " + std::to_string(table_.frames.back().number) + " ended before all its segments";
      if (!numbers_.insert(line.number).second) return "frame " + std::to_string(line.number) + " occurs twice";
      table_.frames.push_back({line.number, line.timestamp, {}});
      seen_ = {};
      missing_ = kSegmentCount;
    }
    if (seen_[line.segment]) return "segment " + std::string(kSegmentNames[line.segment]) + " occurs twice in a frame";
    seen_[line.segment] = true;
    --missing_;
    table_.frames.back().rows[line.segment] = line.row;
    return {};
  }
  ResultTable finish(bool cut_line) {
    table_.truncated = cut_line || open();
    if (open()) table_.frames.pop_back();
    return std::move(table_);
  }

 private:
  bool open() const { return missing_ > 0; }

  ResultTable table_;
  std::set<std::int64_t> numbers_;
  std::array<bool, kSegmentCount> seen_{};
  int missing_ = 0;
};

std::string format_row(const TableFrame& frame, int segment) {
  const TableRow& row = frame.rows[segment];
  return formatted("%lld,%.6f,%s,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f\n", static_cast<long long>(frame.number),
                   frame.timestamp, kSegmentNames[segment].data(), row.proximal.x(), row.proximal.y(), row.proximal.z(),
                   row.distal.x(), row.distal.y(), row.distal.z(), row.visible);
}

}  // namespace

TableFrame table_frame(const HandEstimate& estimate) {
  assert(estimate.has_pose() && estimate.profile);
  TableFrame frame{estimate.number, static_cast<double>(estimate.utime) * 1e-6, {}};
  for (int s = 0; s < kSegmentCount; ++s) {
    const SegmentState& state = estimate.segments[s];
    frame.rows[s] = {state.T_camera_segment.t, state.T_camera_segment * estimate.profile->segments[s].distal,
                     state.visible};
  }
  return frame;
}

Result<ResultTable> read_table(const std::string& path) {
  // Read the file, and check that it is a truth or result table.
  auto content = read_text(path);
  if (!content) return tl::unexpected(content.error());
  std::istringstream file(std::move(*content));
  std::string text;
  std::getline(file, text);
  if (text != kHeader)
    return fail("line 1 is not the header of a truth or result table", path,
                "it must be \"" + std::string(kHeader) + "\"");

  // Read line by line.
  TableBuilder builder;
  for (int number = 2; std::getline(file, text); ++number) {
    const bool ended = !file.eof();  // whether the line ends with a line feed; a last line without one was cut short
    if (text.empty()) continue;

    // Add the line to its frame; a malformed last line was cut short and is left out.
    const auto line = parse_line(text);
    if (!line && !ended) return builder.finish(true);
    if (line && !within(line->timestamp, kLargestTime))
      return fail(formatted("line %d has the time stamp %.6g", number, line->timestamp), path,
                  too_late(line->timestamp, StampUnit::seconds));
    const std::string complaint = line ? builder.add(*line) : "is \"" + text + "\"";
    if (!complaint.empty())
      return fail("line " + std::to_string(number) + ": " + complaint, path, "see docs/formats.md for the columns");
  }
  return builder.finish(false);
}

Result<TableWriter> TableWriter::create(const std::string& path, bool overwrite) {
  auto rows = RowFile::create(path, kHeader, overwrite);
  if (!rows) return tl::unexpected(rows.error());
  return TableWriter(std::move(*rows));
}

Result<void> TableWriter::write(const TableFrame& frame) {
  std::string text;
  for (int s = 0; s < kSegmentCount; ++s) text += format_row(frame, s);
  return rows_.write(text);
}

Result<void> TableWriter::write(const HandEstimate& estimate) {
  if (estimate.status != TrackStatus::tracking) return {};
  return write(table_frame(estimate));
}

}  // namespace barehand
