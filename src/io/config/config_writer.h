#pragma once

#include <string>
#include <vector>

#include "io/config/config_values.h"

namespace barehand {

/// Which keys are written: all; those for users and others that differ from the defaults; or only those that differ
/// from the defaults, without comments on their groups. Reading any of these files gives the same configuration.
enum class ConfigKeys { all, user, changed };

/// Writes a parameter struct as YAML that ConfigReader accepts, with the meaning and range of each key in a comment
/// above it.
class ConfigWriter final : public ConfigText {
 public:
  ConfigWriter(ConfigKeys keys, ConfigValues defaults) : keys_(keys), defaults_(std::move(defaults)) {}
  const std::string& text() const { return text_; }

 protected:
  void entry(const std::string& key, const std::string& value, const std::string& range, const char* doc) override;
  void begin_group(const char* key, const char* doc) override;
  void end_group() override { groups_.pop_back(); }

 private:
  struct Group {
    std::string key, doc;
    bool written = false;  ///< whether the group has been written, which happens with its first key
  };
  bool is_shown(const std::string& key, const std::string& value) const;
  void line(std::size_t depth, const std::string& text) { text_ += std::string(2 * depth, ' ') + text + "\n"; }

  const ConfigKeys keys_;
  const ConfigValues defaults_;
  std::vector<Group> groups_;
  std::string text_;
};

/// The configuration as the text of a file. The defaults are the initial values of the struct.
template <class Config>
std::string print_config(Config config, ConfigKeys keys = ConfigKeys::all) {
  ConfigWriter writer(keys, config_values(Config{}));
  ConfigVisitor& visitor = writer;
  visit(visitor, config);
  return writer.text();
}

}  // namespace barehand
