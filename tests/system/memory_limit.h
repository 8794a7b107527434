#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace barehand {

/// A limit on the memory of child processes, as systemd's MemoryMax sets it: a control group, in which the kernel kills
/// a process that needs more.
class MemoryLimit {
 public:
  /// None if this process may not create a control group for memory.
  static std::optional<MemoryLimit> make(long bytes) {
    for (const Version& version : {kVersion2, kVersion1}) {
      MemoryLimit limit(version);
      if (!limit.folder_.empty() && limit.write(version.limit, bytes)) return limit;
    }
    return std::nullopt;
  }
  MemoryLimit(MemoryLimit&& other) noexcept : version_(other.version_), folder_(std::exchange(other.folder_, {})) {}
  ~MemoryLimit() {
    if (!folder_.empty()) rmdir(folder_.c_str());
  }

  /// The arguments that run a program within the limit.
  std::vector<std::string> command(const std::vector<std::string>& program) const {
    std::vector<std::string> all = {"sh", "-c", "echo $$ > " + folder_ + "/cgroup.procs && exec \"$@\"", "sh"};
    all.insert(all.end(), program.begin(), program.end());
    return all;
  }
  /// Largest amount of memory that was used at once, including cached files and the kernel's memory for the programs
  /// [bytes].
  long peak() const {
    long bytes = 0;
    std::ifstream(folder_ + "/" + version_.peak) >> bytes;
    return bytes;
  }

 private:
  struct Version {
    const char *root, *controller, *limit, *peak;
  };
  static constexpr Version kVersion2{"/sys/fs/cgroup", "", "memory.max", "memory.peak"};
  static constexpr Version kVersion1{"/sys/fs/cgroup/memory", "memory", "memory.limit_in_bytes",
                                     "memory.max_usage_in_bytes"};

  explicit MemoryLimit(const Version& version) : version_(version) {
    std::string folder = version.root + own_group(version.controller) + "/barehand_test_" + std::to_string(getpid());
    std::error_code error;
    if (std::filesystem::create_directory(folder, error) && !error) folder_ = std::move(folder);
  }
  /// The control group of this process in version 1, given as "4:memory:/group" in /proc. "" in version 2, where a
  /// group that contains processes cannot contain groups.
  static std::string own_group(const std::string& controller) {
    if (controller.empty()) return "";
    std::ifstream groups("/proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
      const auto name = line.find(':') + 1, path = line.find(':', name) + 1;
      if (line.substr(name, path - name - 1) == controller) return line.substr(path);
    }
    return "/no group";
  }
  bool write(const char* file, long bytes) const {
    const std::string path = folder_ + "/" + file;
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return false;
    std::ofstream out(path);
    out << bytes << std::flush;
    return out.good();
  }

  Version version_;
  std::string folder_;  ///< folder of the control group; "" if none was created or this object was moved from
};

}  // namespace barehand
