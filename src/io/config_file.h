#pragma once

#include <memory>
#include <string>

#include "core/error.h"
#include "io/config_visitor.h"

namespace barehand {

/// Fills a parameter struct from a YAML file. Strict: an unknown, missing, doubled, mistyped or out-of-range key is an
/// error; all of them are collected, with file, line and key.
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

  /// After the last key: everything that was wrong, or nothing.
  Result<void> finish();

 protected:
  void begin_group(const char* key, const char* doc) override;
  void end_group() override;

 private:
  struct State;
  explicit ConfigReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Writes a parameter struct as YAML that ConfigReader accepts; meaning and range stand above each key.
class ConfigWriter final : public ConfigVisitor {
 public:
  using ConfigVisitor::operator();
  void operator()(const char* key, double& value, double lo, double hi, const char* doc) override;
  void operator()(const char* key, std::int64_t& value, std::int64_t lo, std::int64_t hi, const char* doc) override;
  void operator()(const char* key, bool& value, const char* doc) override;
  void operator()(const char* key, std::string& value, const char* doc) override;
  void operator()(const char* key, std::string& value, std::initializer_list<std::string_view> choices,
                  const char* doc) override;
  void operator()(const char* key, std::vector<double>& values, double lo, double hi, const char* doc) override;
  const std::string& text() const { return text_; }

 protected:
  void begin_group(const char* key, const char* doc) override;
  void end_group() override { --depth_; }

 private:
  void comment(const std::string& text);
  void entry(const std::string& key, const std::string& value);
  std::string text_;
  int depth_ = 0;
};

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

template <class Config>
std::string print_config(Config config) {
  ConfigWriter writer;
  ConfigVisitor& visitor = writer;
  visit(visitor, config);
  return writer.text();
}

}  // namespace barehand
