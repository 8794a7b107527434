#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <string>

#include "fuzz/check.h"

namespace barehand::fuzz {

/// A file in memory, for functions that read from a path.
class MemoryFile {
 public:
  MemoryFile(const void* data, std::size_t size) : file_(memfd_create("input", 0)) {
    CHECK(file_ >= 0 && write(file_, data, size) == static_cast<ssize_t>(size));
  }
  ~MemoryFile() { close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

}  // namespace barehand::fuzz
