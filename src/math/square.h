#pragma once

namespace barehand {

template <typename T>
constexpr T square(T x) {
  return x * x;
}

}  // namespace barehand
