#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "hand/hand_pose.h"

namespace barehand {

/// One row of a truth or result table. Camera frame, metres.
struct TableRow {
  Eigen::Vector3d proximal = Eigen::Vector3d::Zero(), distal = Eigen::Vector3d::Zero();
  double visible = 0;  ///< fraction of the segment's own projected pixels that are front-most
};
struct TableFrame {
  std::int64_t number = 0;  ///< frame number of the recording
  double timestamp = 0;     ///< seconds
  std::array<TableRow, kSegmentCount> rows;
};

/// The rows of an estimate with a pose (`has_pose()`) and a profile.
TableFrame table_frame(const HandEstimate& estimate);

struct ResultTable {
  std::vector<TableFrame> frames;  ///< in the order of the file
  bool truncated = false;          ///< the last frame was cut short (its writer was stopped) and is left out
};

/// Reads a truth or result table (docs/formats.md). An error names the line; a frame without all segments, other than
/// a cut last one, and a frame that occurs twice are errors.
Result<ResultTable> read_table(const std::string& path);

/// Writes such a table. Every frame leaves in one piece when it is written, so what is finished survives a crash.
class TableWriter {
 public:
  static Result<TableWriter> create(const std::string& path);
  /// A full disk is an error.
  Result<void> write(const TableFrame& frame);
  /// Writes nothing unless the hand is tracked: a pose that is merely held is no measurement.
  Result<void> write(const HandEstimate& estimate);

 private:
  std::string path_;
  std::ofstream file_;
};

}  // namespace barehand
