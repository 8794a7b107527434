#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace barehand {

// The interface of visitors of parameter structs, to which every key is presented.

/// For whom a key is meant. Users set the keys that fit a sensor, a network or a machine; the others belong to the
/// method and are for experts. The level only decides which keys are shown: files may contain every key.
enum class ConfigLevel { user, expert };

/// Visits the keys of a parameter struct: `template <class V> void visit(V& v, FooParams& p)` calls v once per key with
/// the field, its range and its meaning. Files are read, written and checked only by visitors, so a key is declared in
/// one place; its default is the field's initial value. Ranges are inclusive.
class ConfigVisitor {
 public:
  virtual ~ConfigVisitor() = default;
  virtual void operator()(const char* key, double& value, double lo, double hi, const char* doc) = 0;
  virtual void operator()(const char* key, std::int64_t& value, std::int64_t lo, std::int64_t hi, const char* doc) = 0;
  virtual void operator()(const char* key, bool& value, const char* doc) = 0;
  virtual void operator()(const char* key, std::string& value, const char* doc) = 0;
  /// Visits a key whose value must be one of `choices`.
  virtual void operator()(const char* key, std::string& value, std::initializer_list<std::string_view> choices,
                          const char* doc) = 0;
  /// Visits a key with any number of values, each within the range.
  virtual void operator()(const char* key, std::vector<double>& values, double lo, double hi, const char* doc) = 0;

  /// Visits a key that is meant for users.
  template <class... Arguments>
  void user(const char* key, Arguments&&... arguments) {
    level_ = ConfigLevel::user;
    (*this)(key, std::forward<Arguments>(arguments)...);
    level_ = ConfigLevel::expert;
  }
  void user(const char* key, std::string& value, std::initializer_list<std::string_view> choices, const char* doc) {
    user<>(key, value, choices, doc);
  }
  /// Visits a key of older files that `now` ("group.key") has replaced.
  virtual void retired(const char* key, const char* now) = 0;
  /// Names the key that is visited next as older files do, which are still read.
  virtual void formerly(const char* /*key*/) {}
  /// Visits a key of older files that nothing has replaced, and whose value has no effect any more.
  virtual void without_effect(const char* /*key*/) {}

  void operator()(const char* key, int& value, int lo, int hi, const char* doc) {
    std::int64_t wide = value;
    (*this)(key, wide, lo, hi, doc);
    value = static_cast<int>(wide);
  }
  /// Visits a group of keys: a struct that has a visit() of its own.
  template <class Group>
  void operator()(const char* key, Group& group, const char* doc) {
    begin_group(key, doc);
    visit(*this, group);
    end_group();
  }

 protected:
  virtual void begin_group(const char* key, const char* doc) = 0;
  virtual void end_group() = 0;
  /// The level of the key that is being visited.
  ConfigLevel level() const { return level_; }

 private:
  ConfigLevel level_ = ConfigLevel::expert;
};

}  // namespace barehand
