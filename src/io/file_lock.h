#pragma once

#include <chrono>
#include <string>

#include "core/error.h"

namespace barehand {

/// An exclusive lock, against other processes and other locks in this process. The kernel releases it when the process
/// ends, even if it is killed. On a network file system that supports locks (as NFS does), it works between machines.
class FileLock {
 public:
  /// Creates the file `path`, which names the holder while the lock is held and is then removed; a file that a killed
  /// process left does not prevent locking. Waits for up to `patience` while another one holds the lock. Errors:
  /// another one still holds it; the file cannot be created. If the file system does not support locks or has no room
  /// for the file, nothing is locked, which is not an error.
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
