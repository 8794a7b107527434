// Finds the LCM logs that a path stands for: a file, a folder or a set.
#include "io/lcm/log_names.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>
#include <map>
#include <regex>

#include "io/atomic_file.h"
#include "io/mcap/mcap_reader.h"

namespace barehand {
namespace fs = std::filesystem;
namespace {

/// "take.lcmlog.01" is part 1 of "take.lcmlog"; the base of a whole log is its own name.
struct LogName {
  std::string base;
  std::int64_t part = -1;  ///< number of the part; -1: the log is not a part of a set
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

/// The name that an unfinished file (a draft of AtomicFile) gets when it is complete; `path` itself if it is not the
/// name of a draft.
fs::path final_name(const fs::path& path) {
  const std::string name = finished_name(path.string());
  return name.empty() ? path : fs::path(name);
}

/// Sorts paths into the order in which the logs were written.
std::vector<std::string> sorted(const std::vector<fs::path>& paths) {
  // Group the paths into sets, each with its numbered parts.
  std::map<std::string, std::vector<std::pair<std::int64_t, std::string>>> sets;
  std::map<std::string, bool> rotated;
  for (const fs::path& path : paths) {
    const LogName name = parse(final_name(path).filename().string());
    sets[name.base].emplace_back(name.part, path.string());
    rotated[name.base] |= name.rotated;
  }

  // List each set from its oldest part on; rotated logs have the highest number on the oldest part.
  std::vector<std::string> files;
  for (auto& [base, parts] : sets) {
    std::sort(parts.begin(), parts.end());
    if (rotated[base]) std::reverse(parts.begin(), parts.end());
    for (auto& part : parts) files.push_back(std::move(part.second));
  }
  return files;
}

/// The reason why a log that still has its temporary name is not played. None if it is played, or if `path` is not a
/// temporary name.
std::optional<Error> why_left_out(const fs::path& path) {
  const fs::path name = final_name(path);
  std::error_code ignored;
  if (name == path) return std::nullopt;
  if (is_being_written(path)) return Error{"is still being written", path, "play it when its recorder has ended"};
  if (fs::exists(name, ignored))
    return Error{"was left by a killed recorder, and its name is taken", path, "rename it to have it played"};
  return std::nullopt;
}

/// Lists the files of a folder that are not empty and whose names satisfy `wanted`. A draft counts under the name that
/// it gets when it is complete.
template <class Wanted>
FoundLogs logs_in(const fs::path& folder, const Wanted& wanted) {
  FoundLogs logs;
  std::vector<fs::path> found;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    // A file that cannot be accessed does not count as a log.
    const fs::path& path = entry->path();
    std::error_code ignored;
    if (!entry->is_regular_file(ignored) || entry->file_size(ignored) == 0 || !wanted(final_name(path))) continue;

    // Ignore drafts that are neither LCM logs nor MCAP files: another program may have written them.
    if (final_name(path) != path && !begins_as_log(path) && !mcap::is_mcap(path)) continue;
    if (auto reason = why_left_out(path))
      logs.left_out.push_back(std::move(*reason));
    else
      found.push_back(path);
  }
  logs.files = sorted(found);
  return logs;
}

}  // namespace

std::string utc_stamp(std::int64_t utime) {
  const std::time_t seconds = utime / 1'000'000;
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y%m%dT%H%M%SZ", &utc);
  return text;
}

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

std::string pattern_of_set(const fs::path& set) {
  return set.parent_path() / (set.stem().string() + "-*" + set.extension().string());
}

Result<FoundLogs> find_logs(const std::string& path) {
  // List all logs of a folder.
  std::error_code error;
  if (fs::is_directory(path, error)) {
    auto logs = logs_in(path, [](const fs::path& file) {
      return is_log_name(file) || (parse(file.filename().string()).part >= 0 && begins_as_log(file));
    });
    if (logs.files.empty() && logs.left_out.empty())
      return fail("the folder holds no LCM logs", path, "a recording folder is played as folder:DIR");
    return logs;
  }

  // Take a single log as it is.
  if (fs::exists(path, error)) return FoundLogs{{path}, {}};

  // Otherwise the path names a set of logs, whose parts lie beside it.
  const fs::path set(path);
  auto logs = logs_in(set.has_parent_path() ? set.parent_path() : fs::path("."), [&](const fs::path& file) {
    const LogName name = parse(file.filename().string());
    const bool part = name.part >= 0 && name.base == set.filename();
    return part || number_in_set(file, set).has_value() || file.filename() == set.filename();
  });
  if (logs.files.empty() && logs.left_out.empty()) logs.files.push_back(path);  // opening it reports what is wrong
  return logs;
}

}  // namespace barehand
