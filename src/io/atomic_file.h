#pragma once

#include <string>
#include <string_view>

#include "core/error.h"

namespace barehand {

/// Ending that is appended to a file's name for its draft.
inline constexpr std::string_view kUnfinished = ".unfinished";

/// A file that gets its name when it is complete. Until then it is a draft next to that name, NAME.unfinished
/// (NAME.unfinished-2 and so on if a killed program left one). When the process is killed, the draft stays and is
/// readable up to where it was written. If the path is a symbolic link, the file that it leads to is replaced, not the
/// link.
/// Pipes, devices and descriptors (/dev/stdout, /dev/fd/3) have no draft: they are written to directly. A descriptor is
/// duplicated, not opened again by its path, since its file would then be overwritten from the start.
class AtomicFile {
 public:
  /// Creates the empty draft. Errors: the file exists and `overwrite` is false, it is a folder or write-protected, or
  /// its folder is missing or cannot be written to.
  static Result<AtomicFile> create(const std::string& path, bool overwrite);
  AtomicFile(AtomicFile&& other) noexcept { *this = std::move(other); }
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  ~AtomicFile() { discard(); }

  /// Opens the draft, which becomes empty, for its only writer; a descriptor that `path` names is duplicated. Returns
  /// the new descriptor, or -1 with errno set. Waits until a named pipe has a reader.
  int open() const;
  /// Whether there is no draft, so that what was written cannot be undone.
  bool direct() const { return direct_; }
  /// The path to write to, for libraries that open files by their names.
  const std::string& draft() const { return draft_; }
  /// Call it after everything was handed to the operating system. On return, the file is on the disk and has its name.
  /// If that fails, the draft stays, and the error names it.
  Result<void> finish();
  /// Leaves the draft where it is, with its content, and gives it up: finish() does nothing then. Returns its path.
  std::string keep();
  /// Removes the draft; finish() does nothing then.
  void discard();

 private:
  AtomicFile() = default;

  /// The path as given, the path after all links, and the path of the draft ("" if nothing is to be finished).
  std::string path_, target_, draft_;
  bool direct_ = false, overwrite_ = false;
  int descriptor_ = -1;  ///< descriptor that the path names, not owned; -1: none
  int lock_ = -1;        ///< descriptor that holds the draft's lock, which shows that a program is writing it
};

/// Checks that `path` can be written, before there is something to save. The errors are those of AtomicFile::create,
/// but a file that exists is none.
Result<void> check_writable(const std::string& path);

/// Writes a whole file, replacing an existing one. A full disk is an error and leaves the existing file as it was.
Result<void> write_file_atomically(const std::string& path, std::string_view bytes);

/// The name that a draft will get: "take.lcmlog" for take.lcmlog.unfinished and take.lcmlog.unfinished-2; "" if `path`
/// is not the name of a draft.
std::string finished_name(const std::string& path);

/// Whether a running program is writing this draft.
bool is_being_written(const std::string& draft);

/// Gives a draft that a killed program left the name `path`. Returns false if a program is writing it, the name is
/// taken, or it cannot be renamed.
bool finish_abandoned(const std::string& draft, const std::string& path);

}  // namespace barehand
