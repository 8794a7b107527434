#pragma once

#include <memory>
#include <mutex>
#include <vector>

namespace barehand {

/// Lends objects whose content is scratch, so that several threads may work at once and nothing is allocated once as
/// many exist as are used at the same time. Outlives what it lends.
template <typename T>
class Pool {
 public:
  struct Return {
    Pool* pool;
    void operator()(T* used) const { pool->give_back(std::unique_ptr<T>(used)); }
  };
  using Lease = std::unique_ptr<T, Return>;

  /// An object with arbitrary content; any thread.
  Lease take() {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        Lease lease(idle_.back().release(), Return{this});
        idle_.pop_back();
        return lease;
      }
    }
    return Lease(new T(), Return{this});
  }

 private:
  void give_back(std::unique_ptr<T> used) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(used));
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> idle_;
};

}  // namespace barehand
