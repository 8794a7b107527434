#include "observe/nearest_cell.h"

namespace barehand {
namespace {

class Propagation {
 public:
  Propagation(int width, Image<std::int32_t>& nearest) : width_(width), nearest_(nearest) {}

  // Takes over the neighbour's answer where it is nearer.
  void relax(int u, int v, int du, int dv) {
    if (!nearest_.contains(u + du, v + dv)) return;
    const std::int32_t candidate = nearest_.at(u + du, v + dv);
    if (candidate < 0) return;
    std::int32_t& mine = nearest_.at(u, v);
    if (mine < 0 || distance_sq(u, v, candidate) < distance_sq(u, v, mine)) mine = candidate;
  }

 private:
  int distance_sq(int u, int v, std::int32_t i) const {
    const int du = i % width_ - u, dv = i / width_ - v;
    return du * du + dv * dv;
  }
  int width_;
  Image<std::int32_t>& nearest_;
};

}  // namespace

void nearest_occupied(const Image<std::int32_t>& occupied, Image<std::int32_t>& nearest) {
  const int width = occupied.width(), height = occupied.height();
  nearest.reset(width, height, -1);
  for (std::size_t i = 0; i < occupied.size(); ++i)
    if (occupied[i] >= 0) nearest[i] = static_cast<std::int32_t>(i);
  Propagation propagation(width, nearest);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u)
      for (const auto& [du, dv] : {std::pair{-1, 0}, {0, -1}, {-1, -1}, {1, -1}}) propagation.relax(u, v, du, dv);
    for (int u = width - 1; u >= 0; --u) propagation.relax(u, v, 1, 0);
  }
  for (int v = height - 1; v >= 0; --v) {
    for (int u = width - 1; u >= 0; --u)
      for (const auto& [du, dv] : {std::pair{1, 0}, {0, 1}, {1, 1}, {-1, 1}}) propagation.relax(u, v, du, dv);
    for (int u = 0; u < width; ++u) propagation.relax(u, v, -1, 0);
  }
}

}  // namespace barehand
