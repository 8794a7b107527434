#pragma once

#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace barehand::test {

/// While it exists, the process runs as an ordinary user if it was root, for whom file permissions have no effect.
class OrdinaryUser {
 public:
  OrdinaryUser() {
    if (was_ == 0 && seteuid(65534) != 0) throw std::runtime_error("cannot become an ordinary user");
  }
  ~OrdinaryUser() {
    if (was_ == 0 && seteuid(0) != 0) std::abort();
  }

 private:
  const uid_t was_ = geteuid();
};

}  // namespace barehand::test
