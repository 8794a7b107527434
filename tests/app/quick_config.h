#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "support/temp_folder.h"

namespace barehand::test {

/// The shipped configuration with full searches cut down to quick ones: for tests that are about something else than
/// how a hand is found, which takes minutes under a sanitizer.
inline std::string quick_config() {
  std::string text = read_text(BAREHAND_CONFIGS "/default.yaml");
  for (const auto& [key, value] : {std::pair("search_attempts: 4", "1"),
                                   {"search_refined: 12", "4"},
                                   {"in_plane: 16", "8"},
                                   {"rolls: 8", "4"},
                                   {"first_survivors: 72", "8"},
                                   {"first_evaluations: 120", "60"},
                                   {"second_survivors: 24", "3"},
                                   {"second_evaluations: 400", "200"}}) {
    const std::string shipped = key;
    const auto at = text.find(" " + shipped + "\n");
    if (at == std::string::npos) throw std::logic_error("default.yaml no longer says " + shipped);
    text.replace(at + 1, shipped.size(), shipped.substr(0, shipped.find(' ') + 1) + value);
  }
  return text;
}

}  // namespace barehand::test
