#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace barehand {

// The identity of the file at a path, and how an output to a path must be opened.

/// The destination of what is written to a path; needed to decide how to open an output.
struct Target {
  std::string path;     ///< the path after all symbolic links
  bool direct = false;  ///< whether it is a pipe, a device or a descriptor (/dev/stdout), not a file to replace
  int descriptor = -1;  ///< the descriptor of this process that `path` names; -1: none
};
Target target_of(const std::string& path);

/// The identity of the file at a path, by device and inode: needed to decide whether two paths mean the same file. Hard
/// and symbolic links, bind mounts, "./" and upper case where the disk ignores it make no difference. A file that does
/// not exist yet is identified by the nearest folder above it that does, and the missing names below that.
class Place {
 public:
  explicit Place(const std::string& path);

  bool exists() const { return missing_.empty(); }
  bool operator==(const Place& other) const;
  /// Whether the file is in `folder` or in a folder below it.
  bool lies_in(const Place& folder) const;
  /// Whether the file is directly in `folder`.
  bool is_entry_of(const Place& folder) const;

 private:
  struct Id {
    dev_t device;
    ino_t inode;
    bool operator==(const Id&) const = default;
  };
  std::vector<Id> there_;             ///< the nearest path that exists and all folders above it, innermost first
  std::vector<std::string> missing_;  ///< the names below it that do not exist, outermost first
};

}  // namespace barehand
