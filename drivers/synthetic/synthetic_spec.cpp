#include "drivers/synthetic/synthetic_spec.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <sstream>

#include "core/quote.h"
#include "io/config/config_visitor.h"

namespace barehand::synthetic {

// Parses the text that selects and configures a simulation, such as "fist,noise=kinect,seed=3".

namespace {

template <typename T>
std::optional<T> number_in(const std::string& text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Splits "a=1,b=2" into a map from key to value.
Result<std::map<std::string, std::string>> split(std::istringstream& words, const std::string& where) {
  std::map<std::string, std::string> values;
  for (std::string word; std::getline(words, word, ',');) {
    const auto equals = word.find('=');
    if (equals == std::string::npos || equals == 0)
      return fail("\"" + word + "\" is not of the form key=value", where, "for example sim:fist,noise=kinect,seed=3");
    if (!values.emplace(word.substr(0, equals), word.substr(equals + 1)).second)
      return fail(word.substr(0, equals) + " is given twice", where, "give it once");
  }
  return values;
}

/// A visitor that sets the values that were given, and remembers the first error.
class SpecReader : public ConfigVisitor {
 public:
  SpecReader(std::map<std::string, std::string> values, std::string where)
      : values_(std::move(values)), where_(std::move(where)) {}

  using ConfigVisitor::operator();
  void operator()(const char* key, double& value, double lo, double hi, const char* doc) override {
    read_number(key, value, lo, hi, doc);
  }
  void operator()(const char* key, std::int64_t& value, std::int64_t lo, std::int64_t hi, const char* doc) override {
    read_number(key, value, lo, hi, doc);
  }
  void operator()(const char* key, bool& value, const char* doc) override {
    const auto text = take(key);
    if (text && *text != "true" && *text != "false") return wrong(key, *text, "true or false", doc);
    if (text) value = *text == "true";
  }
  void operator()(const char* key, std::string& value, const char*) override { value = take(key).value_or(value); }
  void operator()(const char* key, std::string& value, std::initializer_list<std::string_view> choices,
                  const char* doc) override {
    const auto text = take(key);
    if (!text) return;
    if (std::find(choices.begin(), choices.end(), *text) == choices.end())
      return wrong(key, *text, comma_list(choices), doc);
    value = *text;
  }
  void operator()(const char*, std::vector<double>&, double, double, const char*) override {}

  Result<void> finish() {
    if (!values_.empty()) return fail("unknown key \"" + values_.begin()->first + "\"", where_, "known: " + known_);
    if (error_) return tl::unexpected(*error_);
    return {};
  }

 protected:
  void begin_group(const char*, const char*) override {}
  void end_group() override {}
  void retired(const char*, const char*) override {}

 private:
  std::optional<std::string> take(const char* key) {
    known_ += (known_.empty() ? "" : ", ") + std::string(key);
    const auto it = values_.find(key);
    if (it == values_.end()) return std::nullopt;
    std::string text = it->second;
    values_.erase(it);
    return text;
  }
  template <typename T>
  void read_number(const char* key, T& value, T lo, T hi, const char* doc) {
    const auto text = take(key);
    if (!text) return;
    const auto number = number_in<T>(*text);
    std::ostringstream range;
    range << "a number from " << lo << " to " << hi;
    if (!number || !(*number >= lo && *number <= hi)) return wrong(key, *text, range.str(), doc);
    value = *number;
  }
  void wrong(const std::string& key, const std::string& text, const std::string& allowed, const char* doc) {
    if (!error_) error_ = Error{key + "=" + text + " is not " + allowed, where_, key + ": " + doc};
  }

  std::map<std::string, std::string> values_;
  std::string where_, known_;
  std::optional<Error> error_;
};

/// A visitor that lists all keys with their defaults and meanings.
class SpecLister : public ConfigVisitor {
 public:
  using ConfigVisitor::operator();
  void operator()(const char* key, double& value, double lo, double hi, const char* doc) override {
    out_ << "  " << key << "=" << value << "  " << doc << " (" << lo << " to " << hi << ")\n";
  }
  void operator()(const char* key, std::int64_t& value, std::int64_t lo, std::int64_t hi, const char* doc) override {
    out_ << "  " << key << "=" << value << "  " << doc << " (" << lo << " to " << hi << ")\n";
  }
  void operator()(const char* key, bool& value, const char* doc) override {
    out_ << "  " << key << "=" << (value ? "true" : "false") << "  " << doc << "\n";
  }
  void operator()(const char* key, std::string& value, const char* doc) override {
    out_ << "  " << key << "=" << value << "  " << doc << "\n";
  }
  void operator()(const char* key, std::string& value, std::initializer_list<std::string_view> choices,
                  const char* doc) override {
    out_ << "  " << key << "=" << value << "  " << doc << " (";
    for (const std::string_view choice : choices) out_ << (choice == *choices.begin() ? "" : ", ") << choice;
    out_ << ")\n";
  }
  void operator()(const char*, std::vector<double>&, double, double, const char*) override {}
  std::string text() const { return out_.str(); }

 protected:
  void begin_group(const char*, const char*) override {}
  void end_group() override {}
  void retired(const char*, const char*) override {}

 private:
  std::ostringstream out_;
};

Result<void> check_sequence(const std::string& name, const std::string& where) {
  auto info = sequence_info(name);
  if (info) return {};
  info.error().where = where;
  return tl::unexpected(info.error());
}

}  // namespace

Result<SyntheticSpec> parse_synthetic_spec(const std::string& text) {
  const std::string where = "sim:" + text;
  SyntheticSpec spec;
  std::istringstream words(text);
  std::getline(words, spec.simulator.sequence, ',');
  if (auto ok = check_sequence(spec.simulator.sequence, where); !ok) return tl::unexpected(ok.error());
  const auto values = split(words, where);
  if (!values) return tl::unexpected(values.error());
  SpecReader reader(*values, where);
  visit(reader, spec);
  if (auto ok = reader.finish(); !ok) return tl::unexpected(ok.error());
  return spec;
}

std::string synthetic_spec_help() {
  SpecLister lister;
  SyntheticSpec defaults;
  visit(lister, defaults);
  return lister.text();
}

}  // namespace barehand::synthetic
