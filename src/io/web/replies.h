#pragma once

#include <string>
#include <utility>
#include <vector>

namespace barehand {

/// Answers to a client's messages that wait to be sent, oldest first. Of a client that sends without reading, only the
/// first ones are kept. Calls must be serialised by the owner.
class Replies {
 public:
  void add(std::string text) {
    if (texts_.size() < kMost) texts_.push_back(std::move(text));
  }
  bool empty() const { return texts_.empty(); }
  /// Takes all of them.
  std::vector<std::string> take() { return std::exchange(texts_, {}); }

 private:
  static constexpr std::size_t kMost = 64;
  std::vector<std::string> texts_;
};

}  // namespace barehand
