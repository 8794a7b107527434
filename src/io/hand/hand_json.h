#pragma once

#include <string>

#include "core/error.h"
#include "hand/profile.h"

namespace barehand {

/// Reads a hand profile (docs/formats.md). Unknown keys are allowed; without half_width and half_thickness the skin is
/// round. Errors name file, segment and key: missing, repeated or unknown segments, a wrong parent, a cycle, numbers
/// that no hand has.
Result<HandProfile> load_profile(const std::string& path);
/// Reads a profile from the text of such a file; `where` stands for the file's name in messages.
Result<HandProfile> parse_profile(const std::string& text, const std::string& where);
/// Writes a file that load_profile reads, rounded to 1e-9 m. An existing profile stays until the new one is complete.
Result<void> save_profile(const HandProfile& profile, const std::string& path);

}  // namespace barehand
