#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "hand/hand_pose.h"
#include "io/whole_file.h"

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
/// a cut last one, a frame that occurs twice and a number beyond all measure are errors.
Result<ResultTable> read_table(const std::string& path);

/// Writes such a table, which has its name when it is finished (WholeFile); the destructor finishes one that has frames
/// and removes one without. Every frame leaves in one piece when it is written, so what is finished survives a crash;
/// when a write fails (disk full) the file is cut back to the last whole frame, and later frames may succeed. Where the
/// reader of a named pipe is gone, frames are lost until another one is there, who gets a table with its header.
class TableWriter {
 public:
  /// An existing file is replaced only if `overwrite`; otherwise it is an error.
  static Result<TableWriter> create(const std::string& path, bool overwrite = false);
  TableWriter(TableWriter&&) noexcept = default;
  TableWriter& operator=(TableWriter&&) = delete;
  ~TableWriter();

  /// A full disk is an error.
  Result<void> write(const TableFrame& frame);
  /// Writes nothing unless the hand is tracked: a pose that is merely held is no measurement.
  Result<void> write(const HandEstimate& estimate);
  /// Gives the table its name, also one without frames. Nothing is written afterwards.
  Result<void> finish();

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  TableWriter(std::string path, WholeFile whole) : path_(std::move(path)), whole_(std::move(whole)) {}
  bool append(const std::string& text);

  std::string path_;
  WholeFile whole_;
  std::unique_ptr<std::FILE, CloseFile> file_;  ///< null: finished, or moved away
  std::int64_t frames_ = 0;
  std::int64_t good_ = 0;  ///< size of the file up to the last whole frame
  bool torn_ = false;      ///< and could not be cut back
  bool unread_ = false;    ///< the reader of the pipe was gone at the last frame
};

}  // namespace barehand
