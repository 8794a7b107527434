#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "hand/hand_pose.h"
#include "io/row_file.h"

namespace barehand {

// Tables of hand poses, such as results and ground truth, in CSV files.

/// One row of a truth or result table. Camera frame, metres.
struct TableRow {
  Eigen::Vector3d proximal = Eigen::Vector3d::Zero(), distal = Eigen::Vector3d::Zero();
  double visible = 0;  ///< fraction of the segment's own projected pixels that are front-most
};
struct TableFrame {
  std::int64_t number = 0;  ///< frame number of the recording
  double timestamp = 0;     ///< time stamp of the frame [s]
  std::array<TableRow, kSegmentCount> rows;
};

/// Whether two time stamps [s] are those of one frame: tables and messages round them differently.
inline bool same_time(double a, double b) { return std::abs(a - b) <= 0.001; }

/// The table's rows of an estimate, which must have a pose (`has_pose()`) and a profile.
TableFrame table_frame(const HandEstimate& estimate);

struct ResultTable {
  std::vector<TableFrame> frames;  ///< in the order of the file
  bool truncated = false;          ///< whether the last frame was cut short (its writer was killed) and is left out
};

/// Reads a truth or result table (docs/formats.md). Errors name the line: a frame without all segments (except a last
/// one that was cut short), a frame that occurs twice, an implausibly large number.
Result<ResultTable> read_table(const std::string& path);

/// Writes a result table, every frame in one piece (RowFile).
class TableWriter {
 public:
  /// An existing file is replaced only if `overwrite`; otherwise it is an error.
  static Result<TableWriter> create(const std::string& path, bool overwrite = false);

  /// Writes a frame. A full disk is an error.
  Result<void> write(const TableFrame& frame);
  /// Writes an estimate if the hand is tracked; otherwise nothing, since a pose that is only held is not a measurement.
  Result<void> write(const HandEstimate& estimate);
  /// Gives the table its name, even if it has no frames. Nothing can be written afterwards. If it is not called, the
  /// destructor finishes a table that has frames and removes one that has none.
  Result<void> finish() { return rows_.finish(); }

 private:
  explicit TableWriter(RowFile rows) : rows_(std::move(rows)) {}
  RowFile rows_;
};

}  // namespace barehand
