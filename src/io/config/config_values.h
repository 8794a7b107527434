#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/config/config_visitor.h"

namespace barehand {

/// Base of visitors that need the value of every key of a parameter struct as text, as it is written in a YAML file.
class ConfigText : public ConfigVisitor {
 public:
  using ConfigVisitor::operator();
  void operator()(const char* key, double& value, double lo, double hi, const char* doc) final;
  void operator()(const char* key, std::int64_t& value, std::int64_t lo, std::int64_t hi, const char* doc) final;
  void operator()(const char* key, bool& value, const char* doc) final;
  void operator()(const char* key, std::string& value, const char* doc) final;
  void operator()(const char* key, std::string& value, std::initializer_list<std::string_view> choices,
                  const char* doc) final;
  void operator()(const char* key, std::vector<double>& values, double lo, double hi, const char* doc) final;
  void retired(const char*, const char*) final {}

 protected:
  /// Called for every key. `value`: its value as YAML; `range`: the allowed values, such as "[0 .. 1]" or "[auto |
  /// cpu]", empty for free text.
  virtual void entry(const std::string& key, const std::string& value, const std::string& range, const char* doc) = 0;
};

/// The values of all keys as YAML; a key includes its groups, as in "tracker.fusion.levels".
using ConfigValues = std::map<std::string, std::string>;

/// Collects the values of a parameter struct in a flat map.
class ConfigCollector final : public ConfigText {
 public:
  const ConfigValues& values() const { return values_; }

 protected:
  void entry(const std::string& key, const std::string& value, const std::string& range, const char* doc) override;
  void begin_group(const char* key, const char* doc) override;
  void end_group() override { paths_.pop_back(); }

 private:
  std::vector<std::string> paths_ = {""};  // prefixes of the open groups, each with its final dot
  ConfigValues values_;
};

template <class Config>
ConfigValues config_values(Config config) {
  ConfigCollector collector;
  ConfigVisitor& visitor = collector;
  visit(visitor, config);
  return collector.values();
}

}  // namespace barehand
