#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/shared/source_factory.h"
#include "hand/profile.h"
#include "pipeline/config.h"

namespace barehand {

/// A path, the name of a shipped configuration, or "builtin": the values in the code, to write a new file from when
/// keys were added. Errors: everything that is wrong in the file.
Result<Config> read_configuration(const std::string& name);

struct NamedHand {
  std::shared_ptr<const HandProfile> profile;
  std::string name;  ///< where it comes from, for messages
};

/// Every `wanted`: a profile's path; right, left or both: the shipped mean adult hand. None: those that come with the
/// source, else the shipped right hand. Errors: more than a right and a left one.
Result<std::vector<NamedHand>> choose_hands(const std::vector<std::string>& wanted, const OpenSource& source);
/// Of each, in that order.
std::vector<std::shared_ptr<const HandProfile>> profiles_of(const std::vector<NamedHand>& hands);

}  // namespace barehand
