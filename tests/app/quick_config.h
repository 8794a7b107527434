#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "support/temp_folder.h"

namespace barehand::test {

/// `text` with `after` in place of `before`, which must be there.
inline std::string replaced(std::string text, const std::string& before, const std::string& after) {
  const auto at = text.find(before);
  if (at == std::string::npos) throw std::logic_error("nowhere: " + before);
  return text.replace(at, before.size(), after);
}

/// The shipped configuration with full searches cut down to quick ones: for tests that are about something else than
/// how a hand is found, which takes minutes under a sanitizer.
inline std::string quick_config() {
  std::string text = read_text(BAREHAND_CONFIGS "/default.yaml");
  for (const auto& [shipped, quick] : {std::pair(" search_attempts: 16\n", " search_attempts: 1\n"),
                                       {" search_refined: 12\n", " search_refined: 4\n"},
                                       {" in_plane: 16\n", " in_plane: 8\n"},
                                       {" rolls: 8\n", " rolls: 4\n"},
                                       {" first_survivors: 72\n", " first_survivors: 8\n"},
                                       {" first_evaluations: 120\n", " first_evaluations: 60\n"},
                                       {" second_survivors: 24\n", " second_survivors: 3\n"},
                                       {" second_evaluations: 400\n", " second_evaluations: 200\n"},
                                       {" elsewhere: 0.34\n", " elsewhere: 0\n"}})
    text = replaced(std::move(text), shipped, quick);
  return text;
}

}  // namespace barehand::test
