#pragma once

#include <stdexcept>
#include <string>

#include "pipeline/config.h"
#include "support/temp_folder.h"

namespace barehand::test {

/// `text` with `after` in place of `before`, which must be there.
inline std::string replaced(std::string text, const std::string& before, const std::string& after) {
  const auto at = text.find(before);
  if (at == std::string::npos) throw std::logic_error("nowhere: " + before);
  return text.replace(at, before.size(), after);
}

/// The default configuration, complete, with full searches cut down to quick ones: for tests that are about something
/// else than how a hand is found, which takes minutes under a sanitizer.
inline std::string quick_config() {
  Config config;
  config.tracker.search_attempts = 1;
  config.tracker.search_refined = 4;
  config.tracker.initialiser.full = config.tracker.initialiser.quick;
  return print_config(config);
}

}  // namespace barehand::test
