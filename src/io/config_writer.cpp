#include <charconv>

#include "io/config_file.h"

namespace barehand {
namespace {

/// The shortest text that reads back as the same number.
std::string number(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return std::string(buffer, end);
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::string with_range(const char* doc, const std::string& lo, const std::string& hi) {
  return std::string(doc) + " [" + lo + " .. " + hi + "]";
}

}  // namespace

void ConfigWriter::comment(const std::string& text) { text_ += std::string(2 * depth_, ' ') + "# " + text + "\n"; }

void ConfigWriter::entry(const std::string& key, const std::string& value) {
  text_ += std::string(2 * depth_, ' ') + key + ":" + (value.empty() ? "" : " " + value) + "\n";
}

void ConfigWriter::operator()(const char* key, double& value, double lo, double hi, const char* doc) {
  comment(with_range(doc, number(lo), number(hi)));
  entry(key, number(value));
}

void ConfigWriter::operator()(const char* key, std::int64_t& value, std::int64_t lo, std::int64_t hi, const char* doc) {
  comment(with_range(doc, std::to_string(lo), std::to_string(hi)));
  entry(key, std::to_string(value));
}

void ConfigWriter::operator()(const char* key, bool& value, const char* doc) {
  comment(std::string(doc) + " [true | false]");
  entry(key, value ? "true" : "false");
}

void ConfigWriter::operator()(const char* key, std::string& value, const char* doc) {
  comment(doc);
  entry(key, quoted(value));
}

void ConfigWriter::operator()(const char* key, std::string& value, std::initializer_list<std::string_view> choices,
                              const char* doc) {
  std::string list;
  for (const auto choice : choices) list += (list.empty() ? "" : " | ") + std::string(choice);
  comment(std::string(doc) + " [" + list + "]");
  entry(key, quoted(value));
}

void ConfigWriter::operator()(const char* key, std::vector<double>& values, double lo, double hi, const char* doc) {
  comment(with_range(doc, number(lo), number(hi)));
  std::string list;
  for (const double value : values) list += (list.empty() ? "" : ", ") + number(value);
  entry(key, "[" + list + "]");
}

void ConfigWriter::begin_group(const char* key, const char* doc) {
  if (!text_.empty()) text_ += "\n";
  comment(doc);
  entry(key, "");
  ++depth_;
}

}  // namespace barehand
