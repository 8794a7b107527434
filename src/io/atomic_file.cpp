// Writes a file as a draft that gets its name when it is complete.
#include "io/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "io/place.h"

namespace barehand {
namespace fs = std::filesystem;
namespace {

constexpr int kMostDrafts = 10'000;

tl::unexpected<Error> cannot_write(int reason, const std::string& path,
                                   const std::string& remedy = "check the folder, its permissions and the free space") {
  return fail(std::string("cannot be written: ") + std::strerror(reason), path, remedy);
}

/// Writes a file's content to the disk. Returns 0 or errno; also 0 for pipes and file systems that do not support it.
int synchronise(int file) {
  if (fsync(file) == 0 || errno == EINVAL || errno == EROFS || errno == ENOTSUP) return 0;
  return errno;
}

void synchronise_folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  const int file = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  (void)synchronise(file);
  close(file);
}

/// Renames a file unless `to` exists. Returns 0 or errno.
int rename_unless_there(const std::string& from, const std::string& to) {
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  // Check and rename in two steps if the file system does not support one.
  if (access(to.c_str(), F_OK) == 0) return EEXIST;
  return std::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

/// Writes all bytes. Returns 0 or errno.
int write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

Result<AtomicFile> AtomicFile::create(const std::string& path, bool overwrite) {
  // Find out where the path leads: to a file, or to something that is written directly.
  AtomicFile file;
  const Target target = target_of(path);
  file.path_ = path;
  file.target_ = target.path;
  file.direct_ = target.direct;
  file.descriptor_ = target.descriptor;
  file.overwrite_ = overwrite;

  // Check that a pipe, device or descriptor can be written to.
  if (target.direct) {
    if (target.descriptor >= 0) {
      const int mode = fcntl(target.descriptor, F_GETFL);
      if (mode < 0) return cannot_write(errno, path, "give a descriptor that is open");
      if ((mode & O_ACCMODE) == O_RDONLY) return fail("is open for reading only", path, "give one to write to");
    } else if (faccessat(AT_FDCWD, target.path.c_str(), W_OK, AT_EACCESS) != 0) {
      return cannot_write(errno, path, "check its permissions");
    }

    // There is no draft: the target itself is written.
    file.draft_ = path;
    return file;
  }

  // Check that an existing file may be replaced.
  struct stat there {};
  if (stat(target.path.c_str(), &there) == 0) {
    if (S_ISDIR(there.st_mode)) return fail("is a folder", path, "give a file");
    if (!overwrite) return fail("exists already", path, "choose another name, or replace it with --overwrite");
    if (faccessat(AT_FDCWD, target.path.c_str(), W_OK, AT_EACCESS) != 0)
      return cannot_write(errno, path, "choose another name");
  }

  // Create a new draft, next to those that killed programs left.
  for (int n = 1; n <= kMostDrafts; ++n) {
    const std::string draft = target.path + std::string(kUnfinished) + (n > 1 ? "-" + std::to_string(n) : "");
    file.lock_ = ::open(draft.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (file.lock_ < 0 && errno == EEXIST) continue;
    if (file.lock_ < 0) return cannot_write(errno, path);

    // Lock the draft, so that no other program takes it for one that was left behind.
    file.draft_ = draft;
    (void)flock(file.lock_, LOCK_EX | LOCK_NB);
    return file;
  }
  return cannot_write(EEXIST, path, "too many files end in " + std::string(kUnfinished) + ": remove them");
}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  if (this == &other) return *this;
  discard();
  path_ = std::move(other.path_);
  target_ = std::move(other.target_);
  draft_ = std::exchange(other.draft_, {});
  direct_ = other.direct_;
  descriptor_ = other.descriptor_;
  overwrite_ = other.overwrite_;
  lock_ = std::exchange(other.lock_, -1);
  return *this;
}

int AtomicFile::open() const {
  if (descriptor_ >= 0) return fcntl(descriptor_, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  return ::open(draft_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
}

Result<void> AtomicFile::finish() {
  const std::string draft = std::exchange(draft_, {});
  const int lock = std::exchange(lock_, -1);
  if (direct_ || draft.empty()) return {};

  // Open the draft again: the writer may have created another file of this name.
  int reason = 0;
  const int file = ::open(draft.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) reason = errno;
  struct stat replaced {};
  if (file >= 0 && overwrite_ && stat(target_.c_str(), &replaced) == 0) (void)fchmod(file, replaced.st_mode & 07777);
  if (file >= 0) reason = synchronise(file);
  if (file >= 0) close(file);

  // Rename the draft only when its content is on the disk.
  if (reason == 0 && overwrite_) reason = std::rename(draft.c_str(), target_.c_str()) == 0 ? 0 : errno;
  if (reason == 0 && !overwrite_) reason = rename_unless_there(draft, target_);
  if (lock >= 0) close(lock);
  if (reason != 0) return cannot_write(reason, path_, "what was written is in " + draft);
  synchronise_folder_of(target_);
  return {};
}

std::string AtomicFile::keep() {
  if (lock_ >= 0) close(std::exchange(lock_, -1));
  return std::exchange(draft_, {});
}

void AtomicFile::discard() {
  if (!direct_ && !draft_.empty()) (void)unlink(draft_.c_str());
  draft_.clear();
  if (lock_ >= 0) close(std::exchange(lock_, -1));
}

Result<void> write_file_atomically(const std::string& path, std::string_view bytes) {
  auto whole = AtomicFile::create(path, true);
  if (!whole) return tl::unexpected(whole.error());

  const int file = whole->open();
  if (file < 0) return cannot_write(errno, path);
  const int reason = write_all(file, bytes);
  if (close(file) != 0 || reason != 0) return cannot_write(reason != 0 ? reason : errno, path);
  return whole->finish();
}

Result<void> check_writable(const std::string& path) {
  const auto file = AtomicFile::create(path, true);
  return file ? Result<void>() : tl::unexpected(file.error());
}

std::string finished_name(const std::string& path) {
  const auto at = path.rfind(kUnfinished);
  if (at == std::string::npos || at == 0 || path[at - 1] == '/') return "";
  const std::string_view number = std::string_view(path).substr(at + kUnfinished.size());
  const bool drafts = number.empty() || (number.size() > 1 && number[0] == '-' &&
                                         number.substr(1).find_first_not_of("0123456789") == std::string::npos);
  return drafts ? path.substr(0, at) : "";
}

bool is_being_written(const std::string& draft) {
  const int file = open(draft.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool locked = flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  close(file);
  return locked;
}

bool finish_abandoned(const std::string& draft, const std::string& path) {
  const int file = open(draft.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool abandoned = flock(file, LOCK_EX | LOCK_NB) == 0;
  const bool done = abandoned && synchronise(file) == 0 && rename_unless_there(draft, path) == 0;
  close(file);
  if (done) synchronise_folder_of(path);
  return done;
}

}  // namespace barehand
