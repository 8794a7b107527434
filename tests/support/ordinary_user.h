#pragma once

#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace barehand::test {

/// As long as this object exists, a process of root runs as an ordinary user, since file permissions do not affect
/// root.
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
