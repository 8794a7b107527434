#include "drivers/synthetic/hand/hand_joints.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

namespace barehand::synthetic {

// The names of a rigged hand's joints, and the recognition of the names that WebXR, OpenXR and other files use.

namespace {

constexpr std::array<std::string_view, kJointCount> kNames = {"wrist",
                                                              "thumb_metacarpal",
                                                              "thumb_proximal",
                                                              "thumb_distal",
                                                              "thumb_tip",
                                                              "index_metacarpal",
                                                              "index_proximal",
                                                              "index_intermediate",
                                                              "index_distal",
                                                              "index_tip",
                                                              "middle_metacarpal",
                                                              "middle_proximal",
                                                              "middle_intermediate",
                                                              "middle_distal",
                                                              "middle_tip",
                                                              "ring_metacarpal",
                                                              "ring_proximal",
                                                              "ring_intermediate",
                                                              "ring_distal",
                                                              "ring_tip",
                                                              "little_metacarpal",
                                                              "little_proximal",
                                                              "little_intermediate",
                                                              "little_distal",
                                                              "little_tip"};

/// The words of a name in lower case.
std::vector<std::string> words(std::string_view name) {
  std::vector<std::string> parts(1);
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      parts.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!parts.back().empty())
      parts.emplace_back();
  }
  return parts;
}

/// Whether a word of a name is ignored because it does not distinguish joints.
bool is_filler(const std::string& word) {
  constexpr std::array<std::string_view, 11> kFiller = {"",        "xr",   "hand",  "joint", "ext", "finger",
                                                        "phalanx", "left", "right", "l",     "r"};
  return std::find(kFiller.begin(), kFiller.end(), word) != kFiller.end();
}

}  // namespace

std::optional<int> joint_from_name(std::string_view name) {
  std::string plain;
  for (const std::string& word : words(name)) {
    if (is_filler(word)) continue;
    if (!plain.empty()) plain += '_';
    plain += word == "pinky" ? "little" : word;
  }
  const auto it = std::find(kNames.begin(), kNames.end(), plain);
  if (it == kNames.end()) return std::nullopt;
  return static_cast<int>(it - kNames.begin());
}

std::string_view joint_name(int joint) { return kNames[joint]; }

}  // namespace barehand::synthetic
