// Locks a file, so that only one process writes to a set of logs.
#include "io/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>
#include <utility>

namespace barehand {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// Opens or creates the file. If another user's process left it, it may be only readable, which is enough to lock it.
int open_file(const std::string& path) {
  const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor >= 0 || errno != EACCES) return descriptor;
  const int readable = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (readable < 0) errno = EACCES;  // the reason why it could not be created
  return readable;
}

/// Whether the path still names the opened file, which the previous holder may have removed before it was locked here.
bool is_still_there(const std::string& path, int descriptor) {
  struct stat opened {
  }, named{};
  return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

std::string this_process() {
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  return "process " + std::to_string(getpid()) + " on " + host;
}

std::string holder(int descriptor) {
  char text[512];
  const ssize_t count = pread(descriptor, text, sizeof text, 0);
  return count > 0 ? std::string(text, static_cast<std::size_t>(count)) : "another process";
}

bool knows_no_locks(int error) { return error == ENOLCK || error == EOPNOTSUPP || error == ENOSYS; }

}  // namespace

Result<FileLock> FileLock::take(const std::string& path, std::chrono::milliseconds patience) {
  for (const auto end = SteadyClock::now() + patience;;) {
    // Open the file of the lock; a full disk must not keep the program from running.
    const int descriptor = open_file(path);
    if (descriptor < 0 && (errno == ENOSPC || errno == EDQUOT)) return FileLock(path, -1);
    if (descriptor < 0)
      return fail(std::string("cannot be created: ") + std::strerror(errno), path,
                  "check the folder and its permissions");

    FileLock lock(path, descriptor);
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
      if (!is_still_there(path, descriptor)) {
        lock.path_.clear();  // the file that has this name now belongs to another process
        continue;
      }

      // Write down who holds the lock, for the message to those who wait.
      const std::string text = this_process();
      // If there is no room for the name, the lock is held nevertheless.
      if (ftruncate(descriptor, 0) == 0) std::ignore = pwrite(descriptor, text.data(), text.size(), 0);
      return lock;
    }

    // Try again later unless the file system has no locks or the time is over.
    const int reason = errno;
    lock.path_.clear();
    if (knows_no_locks(reason)) return FileLock(path, -1);
    if (reason != EWOULDBLOCK) return fail(std::string("cannot be locked: ") + std::strerror(reason), path);
    if (SteadyClock::now() >= end) return fail("is held by " + holder(descriptor), path, "stop that process first");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

FileLock::FileLock(FileLock&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

FileLock::~FileLock() {
  if (descriptor_ < 0) return;
  if (!path_.empty()) unlink(path_.c_str());  // still locked here, so no other process can have replaced the file
  close(descriptor_);
}

}  // namespace barehand
