#pragma once

#include <memory>
#include <string>

#include "app/config.h"
#include "app/source_factory.h"
#include "hand/profile.h"

namespace barehand {

/// A path, the name of a shipped configuration, or "builtin": the values in the code, to write a new file from when
/// keys were added. Errors: everything that is wrong in the file.
Result<Config> read_configuration(const std::string& name);

struct NamedHand {
  std::shared_ptr<const HandProfile> profile;
  std::string name;  ///< where it comes from, for messages
};

/// `wanted`: a profile's path; "": the one that comes with the source, else the shipped mean adult hand.
Result<NamedHand> choose_hand(const std::string& wanted, const OpenSource& source);

}  // namespace barehand
