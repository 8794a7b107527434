#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace barehand {

/// Where an output goes.
struct Target {
  std::string path;     ///< where symbolic links lead
  bool direct = false;  ///< a pipe, a device or a descriptor (/dev/stdout, /dev/fd/3): nothing that could be renamed
  int descriptor = -1;  ///< of this process, where `path` names one
};
Target target_of(const std::string& path);

/// What a path names, told by device and inode and not by its letters: hard and symbolic links, bind mounts, "./" and
/// upper case where the disk ignores it make no difference. What is not there yet is a name in the nearest folder that
/// is.
class Place {
 public:
  explicit Place(const std::string& path);

  bool exists() const { return missing_.empty(); }
  bool operator==(const Place& other) const;
  /// Anywhere below `folder`.
  bool lies_in(const Place& folder) const;
  /// Directly in `folder`.
  bool is_entry_of(const Place& folder) const;

 private:
  struct Id {
    dev_t device;
    ino_t inode;
    bool operator==(const Id&) const = default;
  };
  std::vector<Id> there_;             ///< what is there, from the innermost outwards
  std::vector<std::string> missing_;  ///< and the names below it that are not, from the outermost inwards
};

}  // namespace barehand
