#pragma once

#include <memory>
#include <string>

#include "core/error.h"
#include "io/config/config_visitor.h"

namespace barehand {

/// Fills a parameter struct from a YAML file. A key that the file does not name keeps its value. An unknown or repeated
/// key and a value of a wrong type or out of range are errors; all of them are collected, with file, line and key.
class ConfigReader final : public ConfigVisitor {
 public:
  static Result<ConfigReader> open(const std::string& path);
  ConfigReader(ConfigReader&&) noexcept;
  ~ConfigReader() override;

  using ConfigVisitor::operator();
  void operator()(const char* key, double& value, double lo, double hi, const char* doc) override;
  void operator()(const char* key, std::int64_t& value, std::int64_t lo, std::int64_t hi, const char* doc) override;
  void operator()(const char* key, bool& value, const char* doc) override;
  void operator()(const char* key, std::string& value, const char* doc) override;
  void operator()(const char* key, std::string& value, std::initializer_list<std::string_view> choices,
                  const char* doc) override;
  void operator()(const char* key, std::vector<double>& values, double lo, double hi, const char* doc) override;
  /// Accepts the old key `key` if the file gives the same value to `now`, as older files do.
  void retired(const char* key, const char* now) override;
  void formerly(const char* key) override;
  void without_effect(const char* key) override;

  /// Call it after the last key. Logs a warning for each key without effect. The error lists everything that was wrong.
  Result<void> finish();

 protected:
  void begin_group(const char* key, const char* doc) override;
  void end_group() override;

 private:
  struct State;
  explicit ConfigReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Reads a configuration: the defaults, changed by the keys in a file.
template <class Config>
Result<Config> load_config(const std::string& path) {
  auto reader = ConfigReader::open(path);
  if (!reader) return tl::unexpected(reader.error());
  Config config;
  ConfigVisitor& visitor = *reader;
  visit(visitor, config);
  if (auto read = reader->finish(); !read) return tl::unexpected(read.error());
  return config;
}

}  // namespace barehand
