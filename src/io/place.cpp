#include "io/place.h"

#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace barehand {
namespace fs = std::filesystem;

// Target: where something written to a path goes. Place: the identity of the file at a path, by device and inode.

namespace {

/// The descriptor of this process that `name` in `folder` stands for; -1 if it stands for none.
int own_descriptor(const fs::path& folder, const std::string& name) {
  std::error_code error;
  const bool own =
      folder == fs::canonical("/proc/self/fd", error) || folder == fs::canonical("/proc/thread-self/fd", error);
  int number = -1;
  const auto [end, bad] = std::from_chars(name.data(), name.data() + name.size(), number);
  return own && bad == std::errc() && end == name.data() + name.size() ? number : -1;
}

}  // namespace

Target target_of(const std::string& path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  fs::path at = path;
  for (int links = 0; links < kMostLinks; ++links) {
    // Links in /proc stand for files that are open already, so they are not followed.
    const fs::path folder = fs::canonical(at.has_parent_path() ? at.parent_path() : fs::path("."), error);
    if (folder.string().starts_with("/proc/")) return {path, true, own_descriptor(folder, at.filename())};

    if (!fs::is_symlink(at, error)) break;
    const fs::path next = fs::read_symlink(at, error);
    at = next.is_absolute() ? next : at.parent_path() / next;
  }
  const fs::file_status status = fs::status(at, error);
  return {at.string(), fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)};
}

Place::Place(const std::string& path) {
  // Follow links first: the folders above a link are not those above its target.
  std::error_code error;
  const fs::path given = fs::absolute(target_of(path).path, error);
  fs::path at = fs::weakly_canonical(given, error);
  if (error) at = given.lexically_normal();
  if (!at.has_filename()) at = at.parent_path();  // removes the slash at the end of a path like "folder/"

  // Go up to the first path that exists, and collect the names that do not.
  for (; !fs::exists(at, error) && at.has_relative_path(); at = at.parent_path())
    missing_.insert(missing_.begin(), at.filename().string());

  // Identify that path and all folders above it.
  for (;; at = at.parent_path()) {
    struct stat status {};
    if (stat(at.c_str(), &status) == 0) there_.push_back({status.st_dev, status.st_ino});
    if (!at.has_relative_path()) break;
  }
}

bool Place::operator==(const Place& other) const {
  return !there_.empty() && !other.there_.empty() && there_.front() == other.there_.front() &&
         missing_ == other.missing_;
}

bool Place::lies_in(const Place& folder) const {
  if (folder.there_.empty()) return false;
  const auto at = std::find(there_.begin(), there_.end(), folder.there_.front());
  if (at == there_.end()) return false;
  if (folder.exists()) return !exists() || at != there_.begin();
  return at == there_.begin() && missing_.size() > folder.missing_.size() &&
         std::equal(folder.missing_.begin(), folder.missing_.end(), missing_.begin());
}

bool Place::is_entry_of(const Place& folder) const {
  if (!lies_in(folder)) return false;
  if (!exists()) return missing_.size() == folder.missing_.size() + 1 && there_.front() == folder.there_.front();
  return there_.size() > 1 && there_[1] == folder.there_.front();
}

}  // namespace barehand
