#pragma once

#include <memory>
#include <mutex>
#include <vector>

namespace barehand {

/// Lends scratch objects with arbitrary content to any number of threads. It allocates a new object only when all
/// existing ones are in use. It must outlive its leases.
template <typename T>
class Pool {
 public:
  // Deleter that returns the object to the pool.
  struct Return {
    Pool* pool;
    void operator()(T* used) const { pool->give_back(std::unique_ptr<T>(used)); }
  };
  using Lease = std::unique_ptr<T, Return>;

  /// Returns an object with arbitrary content. Any thread may call it.
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
