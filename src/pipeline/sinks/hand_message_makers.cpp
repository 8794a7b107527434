#include "pipeline/sinks/hand_message_makers.h"

namespace barehand {

std::span<const HandMessages> HandMessageMakers::process(const HandEstimates& estimates) {
  if (const auto params = pending_ ? pending_->take() : std::nullopt) {
    params_ = *params;
    makers_.clear();
  }
  while (makers_.size() < estimates.size()) makers_.emplace_back(params_);
  messages_.resize(estimates.size());
  for (std::size_t k = 0; k < estimates.size(); ++k) messages_[k] = makers_[k].process(*estimates[k]);
  return messages_;
}

}  // namespace barehand
