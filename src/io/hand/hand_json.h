#pragma once

#include <string>

#include "core/error.h"
#include "hand/profile.h"

namespace barehand {

/// Reads a hand profile (docs/formats.md). Unknown keys are allowed; elliptic skin that is absent is round. Errors
/// name file, segment and key: missing, doubled or unknown segments, a wrong parent, a cycle, numbers that no hand has.
Result<HandProfile> load_profile(const std::string& path);
/// The same from the text of such a file; `where` stands for its name in messages.
Result<HandProfile> parse_profile(const std::string& text, const std::string& where);
/// Whether `path` can be written, to be known before there is something to save.
Result<void> check_profile_path(const std::string& path);
/// Writes what load_profile reads, to 1e-9 m. A profile that is there already stays until the new one is whole.
Result<void> save_profile(const HandProfile& profile, const std::string& path);

}  // namespace barehand
