// Removes the small components of a mask.
#include "stages/preprocess/image/specks.h"

#include <algorithm>

namespace barehand {
namespace {

constexpr double kSpeckArea = 3e-5;  // smaller parts are removed [m^2]; less than half a fingertip

}  // namespace

void SpeckRemover::find_runs(const Image<std::uint8_t>& mask) {
  runs_.clear();
  sets_.clear();
  std::int32_t above = 0;  // first run of the row above that may touch the next one
  for (int v = 0; v < mask.height(); ++v) {
    const std::uint8_t* own = mask.row(v);
    const auto first = static_cast<std::int32_t>(runs_.size());

    // Find the next run of set pixels.
    for (int u = 0; u < mask.width();) {
      if (!own[u]) {
        ++u;
        continue;
      }
      const int begin = u;
      while (u < mask.width() && own[u]) ++u;
      runs_.push_back({v, begin, u});

      // Join it with the runs of the row above that touch it.
      const std::int32_t run = sets_.add();
      while (above < first && runs_[above].end < begin) ++above;
      for (std::int32_t i = above; i < first && runs_[i].begin <= u; ++i) sets_.join(i, run);
    }
    above = first;
  }
}

void SpeckRemover::remove(const Intrinsics& camera, const Image<float>& depth, Image<std::uint8_t>& mask) {
  find_runs(mask);
  parts_.assign(runs_.size(), {});

  // Count the pixels of each component, and compute the centre.
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(runs_.size()); ++i) {
    const Run& run = runs_[i];
    Part& part = parts_[sets_.root(i)];
    const std::int64_t pixels = run.end - run.begin;
    part.pixels += pixels;
    part.sum_u += pixels * (run.begin + run.end - 1) / 2;
    part.sum_v += pixels * run.v;
  }

  // Remove the components that are too small for the depth at their centre.
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(runs_.size()); ++i) {
    const Run& run = runs_[i];
    const Part& part = parts_[sets_.root(i)];
    const float z = depth.at(static_cast<int>(part.sum_u / part.pixels), static_cast<int>(part.sum_v / part.pixels));
    const double least = kSpeckArea * camera.fx * camera.fy / (z > 0 ? z * z : 0.25);
    if (static_cast<double>(part.pixels) < least) std::fill(mask.row(run.v) + run.begin, mask.row(run.v) + run.end, 0);
  }
}

}  // namespace barehand
