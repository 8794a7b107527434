#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

namespace barehand {

/// Whether a file of this name is an LCM log: it ends in .lcmlog, .lcm or .log, or is named as lcm-logger does by
/// itself, lcmlog-2026-11-26. A number may follow, as for the parts that lcm-logger makes: take.lcmlog.00.
bool is_log_name(const std::filesystem::path& path);

/// A time [us since the epoch] as it stands in the names of logs: 20261122T090000Z.
std::string utc_stamp(std::int64_t utime);

/// The number of a log in the set that RotatingLog makes of the name `set`: take-000007-20261122T090000Z.lcmlog is the
/// 7th of take.lcmlog. None: it is no part of it.
std::optional<std::int64_t> number_in_set(const std::filesystem::path& log, const std::filesystem::path& set);

struct FoundLogs {
  std::vector<std::string> files;  ///< in the order they were written
  std::vector<Error> left_out;     ///< drafts that are no part of it, and why
};

/// The logs that `path` stands for: the log itself; those of a folder; where there is neither, the parts of this name
/// that lcm-logger or RotatingLog made. By name, parts by number; where lcm-logger rotates (take.0, take.1 ...), 0 is
/// the newest. A log without a byte, whose writer was killed before its first event, is left out.
/// The draft that a killed recorder left (WholeFile) is a log in the place of its name. One that is still being
/// written, or whose name another log has, is left out. Errors: a folder without logs.
Result<FoundLogs> find_logs(const std::string& path);

}  // namespace barehand
