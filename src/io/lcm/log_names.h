#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

/// Whether a file of this name is an LCM log: it ends in .lcmlog, .lcm or .log, or has lcm-logger's default name, such
/// as lcmlog-2026-11-26. A number may follow, as for the parts that lcm-logger makes: take.lcmlog.00.
bool is_log_name(const std::filesystem::path& path);

/// A time [us since the epoch] in the form that the names of logs contain: 20261122T090000Z.
std::string utc_stamp(std::int64_t utime);

/// The number of a log in the set that RotatingLog makes of the name `set`: take-000007-20261122T090000Z.lcmlog is the
/// 7th of take.lcmlog. None if it does not belong to the set.
std::optional<std::int64_t> number_in_set(const std::filesystem::path& log, const std::filesystem::path& set);

/// What the names of all logs of such a set have in common, for messages: take-*.lcmlog.
std::string pattern_of_set(const std::filesystem::path& set);

struct FoundLogs {
  std::vector<std::string> files;  ///< in the order they were written
  std::vector<Error> left_out;     ///< drafts that are not used, and why
};

/// The logs that `path` stands for: the log itself; those of a folder; or, if neither exists, the parts of this name
/// that lcm-logger or RotatingLog made. They are sorted by name, and parts by number; if lcm-logger rotates (take.0,
/// take.1, ...), 0 is the newest. An empty log, whose writer was killed before its first event, is left out. A draft
/// that a killed recorder left (AtomicFile) counts as a log of its final name. It is left out if it is still being
/// written, or if another log has that name. Error: a folder without logs.
Result<FoundLogs> find_logs(const std::string& path);

}  // namespace barehand
