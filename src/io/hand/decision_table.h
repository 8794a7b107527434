#pragma once

#include <string>

#include "hand/hand_pose.h"
#include "io/row_file.h"

namespace barehand {

/// Writes the decisions of a tracker to a table, one per row (docs/formats.md).
class DecisionTable {
 public:
  static Result<DecisionTable> create(const std::string& path, bool overwrite);
  /// Writes the decisions about one hand in one frame, if there are any.
  Result<void> write(const HandEstimate& estimate);
  /// Gives the table its name, even if there was no decision.
  Result<void> finish() { return rows_.finish(); }

 private:
  explicit DecisionTable(RowFile rows) : rows_(std::move(rows)) {}

  RowFile rows_;
  std::string text_;  // the rows of one call, kept to reuse its memory
};

}  // namespace barehand
