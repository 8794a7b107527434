#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "io/atomic_file.h"

namespace barehand {

/// Writes a table of text rows, which gets its name when it is finished (AtomicFile). The rows of one call are written
/// in one piece, and survive a crash. If a write fails (disk full), the file is cut back to the end of the last
/// complete write, and later writes may succeed. If the reader of a named pipe has gone, rows are lost until there is
/// another one, which gets the header first.
class RowFile {
 public:
  /// Creates the file and writes the header, which is given without a line end. An existing file is replaced only if
  /// `overwrite`; otherwise it is an error. On a full disk the header is written with the first rows.
  static Result<RowFile> create(const std::string& path, std::string_view header, bool overwrite);
  RowFile(RowFile&&) noexcept = default;
  RowFile& operator=(RowFile&&) = delete;
  /// Finishes a file that has rows and removes one without.
  ~RowFile();

  /// Writes complete lines. A full disk is an error.
  Result<void> write(std::string_view rows);
  /// Gives the file its name, even if it has no rows. Nothing can be written afterwards.
  Result<void> finish();

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  RowFile(std::string path, std::string_view header, AtomicFile whole)
      : path_(std::move(path)), header_(header), whole_(std::move(whole)) {
    header_ += '\n';
  }
  bool append(std::string_view text);
  bool cut_back();

  std::string path_, header_;
  AtomicFile whole_;
  std::unique_ptr<std::FILE, CloseFile> file_;  ///< the open file; null when it is finished or was moved from
  bool has_rows_ = false;
  std::int64_t good_ = 0;  ///< size of the file up to the last complete write
  bool torn_ = false;      ///< whether the file could not be cut back after a failed write
  bool headless_ = false;  ///< whether the header is to be written before the next rows: the pipe has lost its reader,
                           ///< or the disk was full
};

}  // namespace barehand
