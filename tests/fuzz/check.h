#pragma once

#include <cstdio>
#include <cstdlib>

/// Aborts if a condition that every input must fulfil is false. Unlike assert(), it is active in release builds.
#define CHECK(condition) \
  ((condition) ? void() : (std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition), std::abort()))
