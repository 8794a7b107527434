#pragma once

#include <sys/resource.h>

#include <csignal>

namespace barehand::test {

/// Another limit of this process while it lives, such as RLIMIT_NOFILE.
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

/// Lets no file grow past `bytes` while it lives, as a full disk would: a write may succeed in part.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)), limit_(RLIMIT_FSIZE, bytes) {}
  ~FileSizeLimit() { std::signal(SIGXFSZ, handler_); }

 private:
  void (*const handler_)(int);
  const ResourceLimit limit_;
};

}  // namespace barehand::test
