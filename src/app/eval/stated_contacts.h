#pragma once

#include <string>

#include "core/error.h"
#include "evaluation/contact_evaluation.h"

namespace barehand {

/// The contacts with objects of all contact_state_t in an LCM log or MCAP file, as `track --states-log` and `--mcap`
/// write them. Errors: the log cannot be read, holds no such state, or holds states of two hands.
Result<StatedContacts> read_stated_contacts(const std::string& log_path);

}  // namespace barehand
