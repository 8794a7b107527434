#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

namespace barehand {

/// A row-major image with contiguous pixels. Pixel (u, v) is in column u (to the right) and row v (downwards).
template <typename T>
class Image {
 public:
  Image() = default;
  Image(int width, int height, const T& value = T{})
      : width_(width), height_(height), data_(static_cast<std::size_t>(width) * height, value) {}

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t size() const { return data_.size(); }
  bool empty() const { return data_.empty(); }
  bool contains(int u, int v) const { return u >= 0 && v >= 0 && u < width_ && v < height_; }

  T& at(int u, int v) { return assert(contains(u, v)), data_[index(u, v)]; }
  const T& at(int u, int v) const { return assert(contains(u, v)), data_[index(u, v)]; }
  T* row(int v) { return data_.data() + index(0, v); }
  const T* row(int v) const { return data_.data() + index(0, v); }
  T* data() { return data_.data(); }
  const T* data() const { return data_.data(); }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  std::size_t index(int u, int v) const { return static_cast<std::size_t>(v) * width_ + u; }

  /// Changes the size and sets all pixels to `value`; the allocation is kept if it suffices.
  void reset(int width, int height, const T& value = T{}) {
    width_ = width;
    height_ = height;
    data_.assign(static_cast<std::size_t>(width) * height, value);
  }

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<T> data_;
};

}  // namespace barehand
