// Writes parameters as the text of a configuration file.
#include "io/config/config_writer.h"

namespace barehand {

bool ConfigWriter::is_shown(const std::string& key, const std::string& value) const {
  if (keys_ == ConfigKeys::all || (keys_ == ConfigKeys::user && level() == ConfigLevel::user)) return true;
  std::string path;
  for (const Group& group : groups_) path += group.key + ".";
  const auto usual = defaults_.find(path + key);
  return usual == defaults_.end() || usual->second != value;
}

void ConfigWriter::entry(const std::string& key, const std::string& value, const std::string& range, const char* doc) {
  if (!is_shown(key, value)) return;

  // Write the groups that contain the key, unless they are there already.
  for (std::size_t depth = 0; depth < groups_.size(); ++depth) {
    Group& group = groups_[depth];
    if (group.written) continue;
    if (depth == 0 && !text_.empty()) text_ += "\n";
    if (keys_ != ConfigKeys::changed) line(depth, "# " + group.doc);
    line(depth, group.key + ":");
    group.written = true;
  }

  line(groups_.size(), "# " + std::string(doc) + (range.empty() ? "" : " " + range));
  line(groups_.size(), key + ": " + value);
}

void ConfigWriter::begin_group(const char* key, const char* doc) { groups_.push_back({key, doc}); }

}  // namespace barehand
