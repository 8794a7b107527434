#pragma once

#include <cstdio>
#include <cstdlib>

/// What must hold for every input; holds in release builds, too.
#define CHECK(condition) \
  ((condition) ? void() : (std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition), std::abort()))
