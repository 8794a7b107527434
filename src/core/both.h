#pragma once

#include "core/error.h"

namespace barehand {

/// The result of two steps that were both taken: the error of the one that failed, or one with the messages of both.
inline Result<void> both(Result<void> first, Result<void> second) {
  if (first) return second;
  if (second) return first;
  return fail(first.error().message() + "; " + second.error().message());
}

}  // namespace barehand
