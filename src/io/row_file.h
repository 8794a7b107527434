#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "io/whole_file.h"

namespace barehand {

/// Writes a table of text rows, which has its name when it is finished (WholeFile). Rows that belong together leave in
/// one piece when they are written, so what was written survives a crash; when a write fails (disk full), the file is
/// cut back to what was whole before, and later writes may succeed. Where the reader of a named pipe is gone, rows are
/// lost until another one is there, who gets a table with its header.
class RowFile {
 public:
  /// Writes the header, a line without its end. An existing file is replaced only if `overwrite`; otherwise it is an
  /// error.
  static Result<RowFile> create(const std::string& path, std::string_view header, bool overwrite);
  RowFile(RowFile&&) noexcept = default;
  RowFile& operator=(RowFile&&) = delete;
  /// Finishes a file that has rows and removes one without.
  ~RowFile();

  /// Whole lines. A full disk is an error.
  Result<void> write(std::string_view rows);
  /// Gives the file its name, also one without rows. Nothing is written afterwards.
  Result<void> finish();

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  RowFile(std::string path, std::string_view header, WholeFile whole)
      : path_(std::move(path)), header_(header), whole_(std::move(whole)) {
    header_ += '\n';
  }
  bool append(std::string_view text);

  std::string path_, header_;
  WholeFile whole_;
  std::unique_ptr<std::FILE, CloseFile> file_;  ///< null: finished, or moved away
  bool has_rows_ = false;
  std::int64_t good_ = 0;  ///< size of the file up to the last whole write
  bool torn_ = false;      ///< and could not be cut back
  bool unread_ = false;    ///< the reader of the pipe was gone at the last write
};

}  // namespace barehand
