#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "hand/profile.h"
#include "hand/skin.h"

namespace barehand {

/// Sizes of the segments relative to a profile. A column for each: along x (width), y (thickness) and z (length) at the
/// proximal end, and the same at the distal end.
using SegmentSizes = Eigen::Matrix<float, 6, kSegmentCount>;

class ViewSkin;
using ViewSkinPtr = std::shared_ptr<const ViewSkin>;

/// The skin of a hand profile as the page draws it. It is made by the first call of mesh() or bytes(), on the caller's
/// thread, which takes tens of milliseconds; to change the sizes of one that is made takes less than one.
class ViewSkin {
 public:
  explicit ViewSkin(std::shared_ptr<const HandProfile> profile) : profile_(std::move(profile)) {}
  /// The skin of `base` with segments of other sizes. Its profile has the size of the bones on average.
  ViewSkin(ViewSkinPtr base, const SegmentSizes& sizes)
      : profile_(std::make_shared<const HandProfile>(scaled(*base->profile(), sizes.row(2).mean()))),
        base_(std::move(base)),
        sizes_(sizes) {}
  const std::shared_ptr<const HandProfile>& profile() const { return profile_; }
  /// The skin with a mesh that is coarse enough to be sent.
  const Skin& mesh() const;
  /// The skin as a chunk 'S'.
  const std::vector<std::uint8_t>& bytes() const;

 private:
  std::shared_ptr<const HandProfile> profile_;
  ViewSkinPtr base_;  // null: it is made from the profile
  SegmentSizes sizes_ = SegmentSizes::Ones();
  mutable std::once_flag meshed_, written_;
  mutable Skin mesh_;
  mutable std::vector<std::uint8_t> bytes_;
};

}  // namespace barehand
