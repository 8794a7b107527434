#include "app/reload.h"

#include <algorithm>
#include <map>
#include <sstream>

namespace barehand {
namespace {

std::string joined(const std::vector<std::string>& groups, const std::string& key) {
  std::string path;
  for (const std::string& group : groups) path += group + ".";
  return path + key;
}

/// Every "group.key" and its value as written in the file, where two spaces of indentation are a level.
std::map<std::string, std::string> values(const Config& config) {
  std::map<std::string, std::string> values;
  std::vector<std::string> groups;
  std::istringstream text(print_config(config));
  for (std::string line; std::getline(text, line);) {
    const auto indentation = line.find_first_not_of(' ');
    const auto colon = line.find(':');
    if (indentation == std::string::npos || line[indentation] == '#' || colon == std::string::npos) continue;
    groups.resize(indentation / 2);
    const std::string key = line.substr(indentation, colon - indentation);
    if (colon + 1 == line.size())
      groups.push_back(key);
    else
      values[joined(groups, key)] = line.substr(colon + 2);
  }
  return values;
}

/// Sources, channels and the counting of failures are set up once; the fit to the person is not begun anew.
bool fixed(const std::string& key) {
  constexpr const char* kFixed[] = {"run.", "detection.", "foreign_camera.", "openni2.", "tracker.shape_fit."};
  return std::any_of(std::begin(kFixed), std::end(kFixed), [&](const char* group) { return key.starts_with(group); });
}

template <class Group>
void put_if_changed(Slot<Group>& slot, const Group& before, const Group& after) {
  if (print_config(before) != print_config(after)) slot.put(after);
}

}  // namespace

Reload::Changes Reload::apply(const Config& wanted) {
  Changes changes;
  const auto before = values(in_force_);
  for (const auto& [key, value] : values(wanted)) {
    const auto old = before.find(key);
    if (old == before.end() || old->second == value) continue;
    (fixed(key) ? changes.for_restart : changes.made).push_back(key + ": " + old->second + " -> " + value);
  }
  Config next = in_force_;
  next.preprocess = wanted.preprocess;
  next.tracker = wanted.tracker;
  next.tracker.shape_fit = in_force_.tracker.shape_fit;
  next.publish = wanted.publish;
  put_if_changed(out_.preprocess, in_force_.preprocess, next.preprocess);
  put_if_changed(out_.tracker, in_force_.tracker, next.tracker);
  put_if_changed(out_.bus, in_force_.publish, next.publish);
  put_if_changed(out_.states_log, in_force_.publish, next.publish);
  in_force_ = next;
  return changes;
}

}  // namespace barehand
