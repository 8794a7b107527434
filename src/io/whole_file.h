#pragma once

#include <string>
#include <string_view>

#include "core/error.h"

namespace barehand {

/// What the draft of a file adds to its name.
inline constexpr std::string_view kUnfinished = ".unfinished";

/// A file that appears under its name when it is whole. Until then it is a draft beside it, NAME.unfinished
/// (NAME.unfinished-2 and so on where a killed program left one). The draft stays, readable as far as it got, when the
/// process is killed. Through a symbolic link the file that it leads to is replaced, not the link.
/// Pipes, devices and descriptors (/dev/stdout, /dev/fd/3) have no draft: they are written to at once. A descriptor is
/// shared with whoever else writes to it: opened anew by its path, the file behind it would be written from its start.
class WholeFile {
 public:
  /// Makes the empty draft. Errors: the file exists and `overwrite` is false, it is a folder or write-protected, or its
  /// folder is missing or cannot be written to.
  static Result<WholeFile> create(const std::string& path, bool overwrite);
  WholeFile(WholeFile&& other) noexcept { *this = std::move(other); }
  WholeFile& operator=(WholeFile&& other) noexcept;
  ~WholeFile() { discard(); }

  /// A new descriptor of the draft, which is empty, for its one writer; of the shared one where `path` named one. -1:
  /// errno says why. Waits until somebody reads a named pipe.
  int open() const;
  /// There is no draft: what was written cannot be taken back.
  bool direct() const { return direct_; }
  /// The path to write to, for what opens files by their names.
  const std::string& draft() const { return draft_; }
  /// After everything is handed to the operating system: the file is on the disk and has its name when this returns. An
  /// error leaves the draft where it is and names it.
  Result<void> finish();
  /// Leaves the draft where it is, with what it holds; nothing remains to be finished. Returns its path.
  std::string keep();
  /// Removes the draft; nothing remains to be finished.
  void discard();

 private:
  WholeFile() = default;

  std::string path_, target_, draft_;  ///< as given; where links lead; "": nothing to finish
  bool direct_ = false, overwrite_ = false;
  int descriptor_ = -1;  ///< what the path names, not owned; -1: a file
  int lock_ = -1;        ///< a descriptor that holds the draft's lock: it is not abandoned
};

/// Writes all of it, replacing a file that is there. A full disk is an error and leaves that file as it was.
Result<void> write_whole_file(const std::string& path, std::string_view bytes);

/// The name that a draft is to get: "take.lcmlog" for take.lcmlog.unfinished and take.lcmlog.unfinished-2. "": `path`
/// is no draft's name.
std::string finished_name(const std::string& path);

/// Whether a living program writes this draft.
bool is_being_written(const std::string& draft);

/// Gives a draft that a killed program left its final name. False: somebody is writing it, the name is taken, or it
/// cannot be done.
bool finish_abandoned(const std::string& draft, const std::string& path);

}  // namespace barehand
