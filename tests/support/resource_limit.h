#pragma once

#include <sys/resource.h>

#include <csignal>

namespace barehand::test {

/// Lowers a resource limit of this process, such as RLIMIT_NOFILE, as long as this object exists.
class ResourceLimit {
 public:
  ResourceLimit(decltype(RLIMIT_FSIZE) resource, rlim_t most) : resource_(resource) {
    getrlimit(resource_, &before_);
    const rlimit limit{most, before_.rlim_max};
    setrlimit(resource_, &limit);
  }
  ~ResourceLimit() { setrlimit(resource_, &before_); }
  ResourceLimit(const ResourceLimit&) = delete;
  ResourceLimit& operator=(const ResourceLimit&) = delete;

 private:
  const decltype(RLIMIT_FSIZE) resource_;
  rlimit before_{};
};

/// Prevents files from growing beyond `bytes` as long as this object exists. As on a full disk, a write may succeed in
/// part.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)), limit_(RLIMIT_FSIZE, bytes) {}
  ~FileSizeLimit() { std::signal(SIGXFSZ, handler_); }

 private:
  void (*const handler_)(int);
  const ResourceLimit limit_;
};

}  // namespace barehand::test
