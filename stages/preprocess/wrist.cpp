#include "stages/preprocess/wrist.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <vector>

namespace barehand {
namespace {

// Finds the wrist from the width of hand and forearm along their axis.

constexpr float kBin = 0.005f;         // width is measured in bins of this length along the axis [m]
constexpr int kBins = 64;              // number of bins, beginning at the fingertips
constexpr float kLongestHand = 0.21f;  // distance from fingertip to wrist of the longest hand [m]

// Range of the distance from the fingertips to the widest place of the palm [m]: from a fist to an open hand.
constexpr float kPalmFrom = 0.03f, kPalmTo = 0.16f;
constexpr float kWristBehindPalm = 0.11f;  // largest distance from the widest place to the wrist [m]
constexpr float kNarrowing = 0.88f;        // a wrist is narrower than the palm by this factor or more
constexpr int kFewestContacts = 3;         // cells at the image's border that show that the arm leaves the image

struct Cell {
  Eigen::Vector3f p;
  float area;
  int gaps;      // number of neighbours outside the part
  bool contact;  // whether the cell is at the border of the image
};

std::vector<Cell> cells_of(const CoarseGrid& grid, const Components& surfaces, int part) {
  const auto& id = surfaces.id;
  std::vector<Cell> cells;
  cells.reserve(surfaces.parts[part].cells);

  // Collect the cells of the surface.
  for (int v = 0; v < id.height(); ++v)
    for (int u = 0; u < id.width(); ++u) {
      if (id.at(u, v) != part) continue;

      // Count the neighbours that do not belong to the surface.
      const bool inside = u > 0 && v > 0 && u + 1 < id.width() && v + 1 < id.height();
      int gaps = 0;
      if (inside)
        gaps = (id.at(u - 1, v) != part) + (id.at(u + 1, v) != part) + (id.at(u, v - 1) != part) +
               (id.at(u, v + 1) != part);
      cells.push_back({grid.point(u, v), grid.cell_area(grid.z.at(u, v)), gaps, !inside});
    }
  return cells;
}

/// Unit vector from the arm towards the fingertips. Sets `leaves_image` if the part extends to the border of the image.
Eigen::Vector3f hand_direction(const std::vector<Cell>& cells, const Eigen::Vector3f& centre, bool& leaves_image) {
  // Find the places where the surface touches the border of the image.
  Eigen::Vector3f contact = Eigen::Vector3f::Zero();
  int contacts = 0;
  for (const Cell& c : cells)
    if (c.contact) contact += c.p, ++contacts;
  leaves_image = contacts >= kFewestContacts;

  // If it leaves the image, the hand is at the end that is farthest from there.
  if (leaves_image) {
    contact /= static_cast<float>(contacts);
    const Cell& tip = *std::max_element(cells.begin(), cells.end(), [&](const Cell& a, const Cell& b) {
      return (a.p - contact).squaredNorm() < (b.p - contact).squaredNorm();
    });

    // The direction leads from there to the mean of the cells within a hand's length of the tip.
    Eigen::Vector3f hand = Eigen::Vector3f::Zero();
    int count = 0;
    for (const Cell& c : cells)
      if ((c.p - tip.p).norm() < kLongestHand) hand += c.p, ++count;
    return (hand / static_cast<float>(count) - contact).normalized();
  }

  // Otherwise, find the long axis of the surface.
  Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
  for (const Cell& c : cells) spread += (c.p - centre) * (c.p - centre).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver(spread);
  const Eigen::Vector3f axis = solver.eigenvectors().col(2);
  // The hand is at the end with more outline per area, because of its separate fingers.
  float gaps[2] = {}, count[2] = {};
  for (const Cell& c : cells) {
    const int end = (c.p - centre).dot(axis) > 0;
    gaps[end] += static_cast<float>(c.gaps);
    count[end] += 1;
  }
  return gaps[1] * count[0] >= gaps[0] * count[1] ? axis : Eigen::Vector3f(-axis);
}

}  // namespace

std::optional<WristPlane> find_wrist(const CoarseGrid& grid, const Components& surfaces, int part) {
  const std::vector<Cell> cells = cells_of(grid, surfaces, part);
  const Eigen::Vector3f centre = surfaces.parts[part].centre;
  bool leaves_image = false;
  const Eigen::Vector3f direction = hand_direction(cells, centre, leaves_image);

  // Measure the length along this direction.
  float tip = -INFINITY, end = INFINITY;
  for (const Cell& c : cells) {
    tip = std::max(tip, c.p.dot(direction));
    end = std::min(end, c.p.dot(direction));
  }
  if (!leaves_image && tip - end < kLongestHand) return std::nullopt;

  // Divide the length into bins, and measure the area of each.
  std::array<float, kBins> area{}, width{};
  std::array<Eigen::Vector3f, kBins> sum;
  sum.fill(Eigen::Vector3f::Zero());
  for (const Cell& c : cells) {
    const int bin = static_cast<int>((tip - c.p.dot(direction)) / kBin);
    if (bin >= kBins) continue;
    area[bin] += c.area;
    sum[bin] += c.area * c.p;
  }

  // Find the widest place of the palm, and the range behind it in which the wrist may be.
  for (int i = 1; i + 1 < kBins; ++i) width[i] = (area[i - 1] + area[i] + area[i + 1]) / (3 * kBin);
  const auto palm = std::max_element(width.begin() + static_cast<int>(kPalmFrom / kBin),
                                     width.begin() + static_cast<int>(kPalmTo / kBin));
  const auto last = std::min(palm + static_cast<int>(kWristBehindPalm / kBin),
                             width.begin() + static_cast<int>(std::min(tip - end, (kBins - 2) * kBin) / kBin) - 2);

  // Take the narrowest place in this range, or the length of the longest hand if nothing is narrow enough.
  int wrist = static_cast<int>(kLongestHand / kBin);
  if (last > palm + 1) {
    const auto narrowest = std::min_element(palm, last);
    if (*narrowest < kNarrowing * *palm) wrist = static_cast<int>(narrowest - width.begin());
  }

  // Require that the surface continues behind the wrist.
  if (wrist + 2 >= kBins || tip - end < (wrist + 3) * kBin || area[wrist] <= 0) return std::nullopt;
  return WristPlane{sum[wrist] / area[wrist], -direction};
}

}  // namespace barehand
