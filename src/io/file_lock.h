#pragma once

#include <chrono>
#include <string>

#include "core/error.h"

namespace barehand {

/// Keeps other processes, and other locks of this one, away from something. The kernel holds it: it ends with the
/// process, however that ends. On a network file system it holds between machines where that knows locks (NFS does).
class FileLock {
 public:
  /// Makes the file `path`, which names the holder while the lock is held and goes with it; one that a killed process
  /// left is no obstacle. Waits for up to `patience` while somebody else has it. Errors: somebody still has it; the
  /// file cannot be made. Where the file system knows no locks, or has no room for the file, nothing is locked, and no
  /// error.
  static Result<FileLock> take(const std::string& path, std::chrono::milliseconds patience);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

 private:
  explicit FileLock(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

  std::string path_;
  int descriptor_ = -1;  // -1: nothing is locked
};

}  // namespace barehand
