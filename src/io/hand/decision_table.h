#pragma once

#include <string>

#include "hand/hand_pose.h"
#include "io/row_file.h"

namespace barehand {

/// Writes the decisions of a tracker, one a row (docs/formats.md).
class DecisionTable {
 public:
  static Result<DecisionTable> create(const std::string& path, bool overwrite);
  /// Those of one hand in one frame, if there were any.
  Result<void> write(const HandEstimate& estimate);
  /// Gives the table its name; there may have been no decision.
  Result<void> finish() { return rows_.finish(); }

 private:
  explicit DecisionTable(RowFile rows) : rows_(std::move(rows)) {}

  RowFile rows_;
  std::string text_;  // scratch
};

}  // namespace barehand
