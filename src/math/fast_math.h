#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace barehand {

// Branch-free single-precision functions that compilers vectorise in loops; calls of the std:: functions stay scalar.

/// exp(x) for x <= 0 with a relative error below 3e-7; exactly 0 below -87, where single precision underflows.
inline float fast_exp(float x) {
  // Split x into n ln 2 + r.
  const float n = std::floor(x * std::numbers::log2e_v<float> + 0.5f);
  const float clamped = n < -126.0f ? -126.0f : n;

  // Subtracting n ln 2 in two steps (Cody and Waite) keeps the remainder exact.
  const float r = (x - clamped * 0.693359375f) + clamped * 2.12194440e-4f;

  // Evaluate the polynomial for exp(r) and scale it by 2^n.
  float p = 1.9875691500e-4f;
  p = p * r + 1.3981999507e-3f;
  p = p * r + 8.3334519073e-3f;
  p = p * r + 4.1665795894e-2f;
  p = p * r + 1.6666665459e-1f;
  p = p * r + 5.0000001201e-1f;

  // Scale the result by the power of two, and return zero for very small ones.
  const float mantissa = p * r * r + r + 1.0f;
  const float scale = std::bit_cast<float>((static_cast<std::int32_t>(clamped) + 127) << 23);
  return x < -87.0f ? 0.0f : mantissa * scale;
}

/// atan2(y, x) with an absolute error below 4e-7 rad; 0 at the origin.
inline float fast_atan2(float y, float x) {
  // Reduce to the first octant.
  const float ax = std::fabs(x), ay = std::fabs(y);
  const float larger = ax > ay ? ax : ay, smaller = ax > ay ? ay : ax;
  const float t = smaller / (larger > 1e-30f ? larger : 1e-30f);
  const float s = t * t;

  // Evaluate the polynomial for the arctangent.
  float p = 2.90188402868807315826416015625e-3f;
  p = p * s - 1.62907354533672332763671875e-2f;
  p = p * s + 4.3082617223262786865234375e-2f;
  p = p * s - 7.5408883392810821533203125e-2f;
  p = p * s + 0.1066047251224517822265625f;
  p = p * s - 0.14209578931331634521484375f;
  p = p * s + 0.19993579387664794921875f;
  p = p * s - 0.3333314359188079833984375f;

  // Restore the octant.
  float a = t + t * s * p;
  a = ay > ax ? std::numbers::pi_v<float> / 2 - a : a;
  a = x < 0.0f ? std::numbers::pi_v<float> - a : a;
  return y < 0.0f ? -a : a;
}

}  // namespace barehand
