#pragma once

#include <stdexcept>
#include <string>

#include "pipeline/config.h"
#include "support/temp_folder.h"

namespace barehand::test {

/// `text` with its first `before` replaced by `after`. Throws if `text` does not contain `before`.
inline std::string replaced(std::string text, const std::string& before, const std::string& after) {
  const auto at = text.find(before);
  if (at == std::string::npos) throw std::logic_error("nowhere: " + before);
  return text.replace(at, before.size(), after);
}

/// The complete default configuration, but with quick instead of full searches, which take minutes under a sanitizer.
/// For tests that do not test how a hand is found.
inline std::string quick_config() {
  Config config;
  config.tracker.search_attempts = 1;
  config.tracker.search_refined = 4;
  config.tracker.initialiser.full = config.tracker.initialiser.quick;
  return print_config(config);
}

}  // namespace barehand::test
