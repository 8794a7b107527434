// Applies a changed configuration to a running pipeline.
#include "pipeline/reload.h"

#include <algorithm>
#include <iterator>

#include "io/config/config_values.h"

namespace barehand {
namespace {

/// Whether a key cannot change while the pipeline runs: sources, channels, limits of failures and couplings are set up
/// once, and a fit to the person that has begun keeps its parameters.
bool fixed(const std::string& key) {
  constexpr const char* kFixed[] = {"run.",
                                    "contact.",
                                    "grasp.",
                                    "detection.",
                                    "world.",
                                    "foreign_camera.",
                                    "openni2.",
                                    "tracker.shape_fit.",
                                    "tracker.refinement.objects.enabled"};
  return std::any_of(std::begin(kFixed), std::end(kFixed), [&](const char* group) { return key.starts_with(group); });
}

template <class Group>
void put_if_changed(Slot<Group>& slot, const Group& before, const Group& after) {
  if (before != after) slot.put(after);
}

}  // namespace

Reload::Changes Reload::apply(const Config& wanted) {
  // List the changes.
  Changes changes;
  const ConfigValues before = config_values(in_force_);
  for (const auto& [key, value] : config_values(wanted)) {
    const std::string& old = before.at(key);
    if (old == value) continue;
    (fixed(key) ? changes.for_restart : changes.made).push_back(key + ": " + old + " -> " + value);
  }

  // Merge the groups that may change into the present configuration.
  Config next = in_force_;
  next.preprocess = wanted.preprocess;
  next.tracker = wanted.tracker;
  next.tracker.shape_fit = in_force_.tracker.shape_fit;
  next.tracker.refinement.objects.enabled = in_force_.tracker.refinement.objects.enabled;
  next.publish = wanted.publish;

  // Post the changed groups to the stages and sinks that use them.
  put_if_changed(out_.preprocess, in_force_.preprocess, next.preprocess);
  put_if_changed(out_.tracker, in_force_.tracker, next.tracker);
  for (auto* slot : {&out_.bus, &out_.states_log, &out_.mcap, &out_.view, &out_.progress})
    put_if_changed(*slot, in_force_.publish, next.publish);
  in_force_ = next;
  return changes;
}

}  // namespace barehand
