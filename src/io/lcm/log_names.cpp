#include "io/lcm/log_names.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <regex>

namespace barehand {
namespace fs = std::filesystem;
namespace {

/// "take.lcmlog.01" is part 1 of "take.lcmlog"; a whole log is a base of its own.
struct LogName {
  std::string base;
  std::int64_t part = -1;  ///< -1: whole
  bool rotated = false;    ///< the number was written without a leading zero
};

LogName parse(const std::string& name) {
  static const std::regex kPart("(.+)\\.([0-9]{1,9})");
  std::smatch match;
  if (!std::regex_match(name, match, kPart)) return {name};
  return {match[1], std::stoll(match[2]), match[2].length() == 1};
}

bool begins_as_log(const fs::path& path) {
  std::array<char, 4> start{};
  return std::ifstream(path, std::ios::binary).read(start.data(), start.size()) &&
         std::string_view(start.data(), start.size()) == "\xed\xa1\xda\x01";
}

/// In the order they were written.
std::vector<std::string> sorted(const std::vector<fs::path>& paths) {
  std::map<std::string, std::vector<std::pair<std::int64_t, std::string>>> sets;
  std::map<std::string, bool> rotated;
  for (const fs::path& path : paths) {
    const LogName name = parse(path.filename().string());
    sets[name.base].emplace_back(name.part, path.string());
    rotated[name.base] |= name.rotated;
  }
  std::vector<std::string> files;
  for (auto& [base, parts] : sets) {
    std::sort(parts.begin(), parts.end());
    if (rotated[base]) std::reverse(parts.begin(), parts.end());
    for (auto& part : parts) files.push_back(std::move(part.second));
  }
  return files;
}

/// The files of a folder that have bytes and are wanted.
template <class Wanted>
std::vector<std::string> logs_in(const fs::path& folder, const Wanted& wanted) {
  std::vector<fs::path> found;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    std::error_code ignored;  // what cannot be looked at is no log
    if (entry->is_regular_file(ignored) && entry->file_size(ignored) > 0 && wanted(entry->path()))
      found.push_back(entry->path());
  }
  return sorted(found);
}

}  // namespace

bool is_log_name(const fs::path& path) {
  static const std::regex kChosen("lcmlog-[0-9]{4}-[0-9]{2}-[0-9]{2}");
  const fs::path base = parse(path.filename().string()).base;
  const fs::path ending = base.extension();
  return ending == ".lcmlog" || ending == ".lcm" || ending == ".log" || std::regex_match(base.string(), kChosen);
}

std::optional<std::int64_t> number_in_set(const fs::path& log, const fs::path& set) {
  static const std::regex kName("(.*)-([0-9]{6,18})-[0-9]{8}T[0-9]{6}Z");
  const std::string stem = log.stem().string();
  std::smatch parts;
  if (log.extension() != set.extension() || !std::regex_match(stem, parts, kName)) return std::nullopt;
  if (parts[1] != set.stem().string()) return std::nullopt;
  return std::stoll(parts[2]);
}

Result<std::vector<std::string>> find_logs(const std::string& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    auto files = logs_in(path, [](const fs::path& file) {
      return is_log_name(file) || (parse(file.filename().string()).part >= 0 && begins_as_log(file));
    });
    if (files.empty()) return fail("the folder holds no LCM logs", path, "a recording folder is played as folder:DIR");
    return files;
  }
  if (fs::exists(path, error)) return std::vector<std::string>{path};
  const fs::path set(path);
  auto files = logs_in(set.has_parent_path() ? set.parent_path() : fs::path("."), [&](const fs::path& file) {
    const LogName name = parse(file.filename().string());
    return (name.part >= 0 && name.base == set.filename()) || number_in_set(file, set).has_value();
  });
  if (files.empty()) files.push_back(path);  // opening it says what is wrong
  return files;
}

}  // namespace barehand
