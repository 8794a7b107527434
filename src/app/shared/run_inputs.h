#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/shared/source_factory.h"
#include "hand/profile.h"
#include "pipeline/config.h"

namespace barehand {

/// Reads a configuration. `name`: a path, the name of a shipped configuration, or "builtin" for the values in the code,
/// from which a new file can be written when keys were added. The error names everything that is wrong in the file.
Result<Config> read_configuration(const std::string& name);

struct NamedHand {
  std::shared_ptr<const HandProfile> profile;
  std::string name;  ///< where the profile comes from, for messages
};

/// Loads the hand `name`: the path of a profile, or right or left for the shipped mean adult hand.
Result<NamedHand> load_hand(const std::string& name);
/// Those of the names that are paths of profiles, and not right, left or both.
std::vector<std::string> profile_paths(const std::vector<std::string>& names);

/// Loads the hands to track. An entry of `wanted` is the path of a profile, or right, left or both for the shipped mean
/// adult hand. If it is empty, these are the hands of the source (OpenSource::hands), or else the shipped right hand.
/// Errors: a profile that cannot be read, two hands of the same side.
Result<std::vector<NamedHand>> choose_hands(const std::vector<std::string>& wanted, const OpenSource& source);
/// The profiles of these hands, in the same order.
std::vector<std::shared_ptr<const HandProfile>> profiles_of(const std::vector<NamedHand>& hands);

}  // namespace barehand
