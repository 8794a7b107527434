// Reads a configuration file into parameter structs, and checks its keys and values.
#include "io/config/config_file.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "core/log.h"
#include "core/quote.h"
#include "io/file_bytes.h"

namespace barehand {
namespace {

/// Number of single-character edits between two keys (Levenshtein).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({substituted, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

std::string text_of(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// Converts a scalar. A quoted one has the tag "!" and is always text.
template <class T>
bool convert(const YAML::Node& node, T& value) {
  return node.IsScalar() && node.Tag() != "!" && YAML::convert<T>::decode(node, value);
}

template <class T>
bool within(T value, T lo, T hi) {
  return value >= lo && value <= hi;  // NaN is never within
}

}  // namespace

struct ConfigReader::State {
  struct Group {
    YAML::Node node;   ///< a map, unless the file does not name the group
    std::string path;  ///< prefix of the group's keys, such as "tracker."
    std::vector<std::string> known;
  };

  std::string file;
  std::vector<Group> groups;
  std::string former;                                       ///< older name of the key that is visited next, or ""
  std::map<std::string, YAML::Node> values;                 ///< scalars found so far, by "group.key"
  std::map<int, std::vector<std::string>> problems;         ///< texts by line number
  std::vector<std::pair<int, std::string>> without_effect;  ///< line numbers and "group.key"

  void problem(const YAML::Mark& mark, const std::string& text) { problems[mark.line + 1].push_back(text); }

  /// Reports that the file gives the old name of a key of the current group beside, or instead of, its new path.
  void renamed(const YAML::Node& node, const std::string& old, const std::string& now) {
    problem(node.Mark(), "'" + groups.back().path + old + "' is now '" + now + "', give that alone");
  }

  /// The value of a key of the current group, under its own or its older name; undefined if the file has neither.
  YAML::Node find(const std::string& key) {
    const std::string old = std::exchange(former, "");
    const YAML::Node before = old.empty() ? YAML::Node(YAML::NodeType::Undefined) : entry_of(old);
    const YAML::Node now = entry_of(key);
    if (!before.IsDefined()) return now;

    // Both names at once are an error. Messages about the value give the name that is in the file.
    if (now.IsDefined()) renamed(before, old, groups.back().path + key);
    groups.back().known.push_back(old);
    return before;
  }

  YAML::Node entry_of(const std::string& key) {
    Group& group = groups.back();
    group.known.push_back(key);
    if (!group.node.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
    for (const auto& entry : group.node) {
      if (entry.first.Scalar() != key) continue;
      if (entry.second.IsScalar()) values[group.path + key] = entry.second;
      return entry.second;
    }
    return YAML::Node(YAML::NodeType::Undefined);
  }

  void wrong(const YAML::Node& node, const std::string& expected) {
    const std::string given = node.IsScalar() ? "'" + node.Scalar() + "'" : node.IsNull() ? "empty" : "a list or a map";
    problem(node.Mark(),
            "'" + groups.back().path + groups.back().known.back() + "' is " + given + ", but must be " + expected);
  }

  void check_unknown(const Group& group) {
    std::vector<std::string> seen;
    for (const auto& entry : group.node) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
      if (std::find(seen.begin(), seen.end(), key) != seen.end())
        problem(entry.first.Mark(), "key '" + group.path + key + "' occurs twice");
      else if (std::find(group.known.begin(), group.known.end(), key) == group.known.end())
        problem(entry.first.Mark(), "unknown key '" + group.path + key + "'" + suggestion(group, key));
      seen.push_back(key);
    }
  }

  static std::string suggestion(const Group& group, const std::string& key) {
    const std::string* best = nullptr;
    std::size_t best_distance = std::max<std::size_t>(2, key.size() / 2);
    for (const std::string& known : group.known) {
      const std::size_t distance = edit_distance(key, known);
      if (distance < best_distance || (!best && distance == best_distance)) best = &known, best_distance = distance;
    }
    return best ? ", did you mean '" + group.path + *best + "'?" : "";
  }
};

ConfigReader::ConfigReader(std::unique_ptr<State> state) : state_(std::move(state)) {}
ConfigReader::ConfigReader(ConfigReader&&) noexcept = default;
ConfigReader::~ConfigReader() = default;

Result<ConfigReader> ConfigReader::open(const std::string& path) {
  auto state = std::make_unique<State>();
  state->file = path;
  const auto text = read_text(path);
  if (!text) return tl::unexpected(text.error());

  // Parse the text, and name the line of the first mistake.
  std::vector<YAML::Node> documents;
  try {
    documents = YAML::LoadAll(*text);
  } catch (const YAML::ParserException& e) {
    return fail("not valid YAML: " + e.msg, path + ":" + std::to_string(e.mark.line + 1), "correct the line");
  }

  // Nothing of the file is left unread.
  if (documents.size() > 1)
    return fail("a second document begins", path + ":" + std::to_string(documents[1].Mark().line + 1),
                "give all keys in one, without lines of --- or ... between them");

  // Begin with the group that holds all keys.
  const YAML::Node root = documents.empty() ? YAML::Node() : documents[0];
  if (!root.IsMap()) return fail("no keys in the configuration", path, "--print-config writes one");
  state->groups.push_back({root, "", {}});
  return ConfigReader(std::move(state));
}

void ConfigReader::operator()(const char* key, double& value, double lo, double hi, const char*) {
  const YAML::Node node = state_->find(key);
  double read = 0;
  if (!node.IsDefined()) return;
  if (convert(node, read) && within(read, lo, hi)) {
    value = read;
  } else {
    state_->wrong(node, "a number from " + text_of(lo) + " to " + text_of(hi));
  }
}

void ConfigReader::operator()(const char* key, std::int64_t& value, std::int64_t lo, std::int64_t hi, const char*) {
  const YAML::Node node = state_->find(key);
  std::int64_t read = 0;
  if (!node.IsDefined()) return;
  if (convert(node, read) && within(read, lo, hi)) {
    value = read;
  } else {
    state_->wrong(node, "a whole number from " + std::to_string(lo) + " to " + std::to_string(hi));
  }
}

void ConfigReader::operator()(const char* key, bool& value, const char*) {
  const YAML::Node node = state_->find(key);
  if (node.IsDefined() && !convert(node, value)) state_->wrong(node, "true or false");
}

void ConfigReader::operator()(const char* key, std::string& value, const char*) {
  const YAML::Node node = state_->find(key);
  if (!node.IsDefined()) return;
  if (!node.IsScalar()) return state_->wrong(node, "text");
  value = node.Scalar();
}

void ConfigReader::operator()(const char* key, std::string& value, std::initializer_list<std::string_view> choices,
                              const char*) {
  const YAML::Node node = state_->find(key);
  if (!node.IsDefined()) return;
  if (node.IsScalar() && std::find(choices.begin(), choices.end(), node.Scalar()) != choices.end()) {
    value = node.Scalar();
    return;
  }
  state_->wrong(node, "one of " + comma_list(choices));
}

void ConfigReader::operator()(const char* key, std::vector<double>& values, double lo, double hi, const char*) {
  const YAML::Node node = state_->find(key);
  if (!node.IsDefined()) return;
  const std::string expected = "numbers from " + text_of(lo) + " to " + text_of(hi);
  if (!node.IsSequence()) return state_->wrong(node, "a list of " + expected);
  std::vector<double> read;
  for (const auto& item : node) {
    double number = 0;
    if (!convert(item, number) || !within(number, lo, hi)) return state_->wrong(item, "a list of " + expected);
    read.push_back(number);
  }
  values = std::move(read);
}

void ConfigReader::retired(const char* key, const char* now) {
  const YAML::Node old = state_->find(key);
  if (!old.IsDefined()) return;
  const auto current = state_->values.find(now);
  double before = 0, after = 0;
  const bool same =
      current != state_->values.end() && convert(old, before) && convert(current->second, after) && before == after;
  if (!same) state_->renamed(old, key, now);
}

void ConfigReader::formerly(const char* key) { state_->former = key; }

void ConfigReader::without_effect(const char* key) {
  const YAML::Node node = state_->find(key);
  if (node.IsDefined()) state_->without_effect.emplace_back(node.Mark().line + 1, state_->groups.back().path + key);
}

void ConfigReader::begin_group(const char* key, const char*) {
  const YAML::Node node = state_->find(key);
  if (node.IsDefined() && !node.IsMap()) state_->wrong(node, "a group of keys");
  state_->groups.push_back({node, state_->groups.back().path + key + ".", {}});
}

void ConfigReader::end_group() {
  const State::Group group = std::move(state_->groups.back());
  state_->groups.pop_back();
  if (group.node.IsMap()) state_->check_unknown(group);
}

Result<void> ConfigReader::finish() {
  state_->check_unknown(state_->groups.front());

  // Warn of keys without effect.
  if (!state_->without_effect.empty()) {
    const auto log = make_logger();
    for (const auto& [line, key] : state_->without_effect)
      log->warn("{}:{}: '{}' has no effect any more, leave it out", state_->file, line, key);
  }

  // Put all problems into one error, in the order of their lines.
  if (state_->problems.empty()) return {};
  std::string all;
  for (const auto& [line, texts] : state_->problems)
    for (const auto& text : texts)
      all += (all.empty() ? "" : "\n" + state_->file + ":" + std::to_string(line) + ": ") + text;
  return fail(all, state_->file + ":" + std::to_string(state_->problems.begin()->first));
}

}  // namespace barehand
