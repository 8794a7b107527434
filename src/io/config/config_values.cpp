#include "io/config/config_values.h"

#include <charconv>

namespace barehand {

// Parameter structs to YAML text: ConfigText formats each key, ConfigCollector gathers them in a flat map (reload
// compares two of them).

namespace {

/// The shortest text that reads back as the same number.
std::string number(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return std::string(buffer, end);
}

std::string yaml_string(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::string range(const std::string& lo, const std::string& hi) { return "[" + lo + " .. " + hi + "]"; }

}  // namespace

void ConfigText::operator()(const char* key, double& value, double lo, double hi, const char* doc) {
  entry(key, number(value), range(number(lo), number(hi)), doc);
}

void ConfigText::operator()(const char* key, std::int64_t& value, std::int64_t lo, std::int64_t hi, const char* doc) {
  entry(key, std::to_string(value), range(std::to_string(lo), std::to_string(hi)), doc);
}

void ConfigText::operator()(const char* key, bool& value, const char* doc) {
  entry(key, value ? "true" : "false", "[true | false]", doc);
}

void ConfigText::operator()(const char* key, std::string& value, const char* doc) {
  entry(key, yaml_string(value), "", doc);
}

void ConfigText::operator()(const char* key, std::string& value, std::initializer_list<std::string_view> choices,
                            const char* doc) {
  std::string list;
  for (const auto choice : choices) list += (list.empty() ? "" : " | ") + std::string(choice);
  entry(key, yaml_string(value), "[" + list + "]", doc);
}

void ConfigText::operator()(const char* key, std::vector<double>& values, double lo, double hi, const char* doc) {
  std::string list;
  for (const double value : values) list += (list.empty() ? "" : ", ") + number(value);
  entry(key, "[" + list + "]", range(number(lo), number(hi)), doc);
}

void ConfigCollector::entry(const std::string& key, const std::string& value, const std::string&, const char*) {
  values_[paths_.back() + key] = value;
}

void ConfigCollector::begin_group(const char* key, const char*) { paths_.push_back(paths_.back() + key + "."); }

}  // namespace barehand
