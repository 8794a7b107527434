#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "hand/profile.h"
#include "hand/skin.h"

namespace barehand {

class ViewSkin;
using ViewSkinPtr = std::shared_ptr<const ViewSkin>;

/// The skin of a hand profile as the page draws it. It is made by the first call of mesh() or bytes(), on the caller's
/// thread, which takes tens of milliseconds; to scale one that is made takes less than one.
class ViewSkin {
 public:
  explicit ViewSkin(std::shared_ptr<const HandProfile> profile) : profile_(std::move(profile)) {}
  /// The skin of a hand that is `size` times as large as that of `base`.
  ViewSkin(ViewSkinPtr base, double size)
      : profile_(std::make_shared<const HandProfile>(scaled(*base->profile(), size))),
        base_(std::move(base)),
        size_(size) {}
  const std::shared_ptr<const HandProfile>& profile() const { return profile_; }
  /// The skin with a mesh that is coarse enough to be sent.
  const Skin& mesh() const;
  /// The skin as a chunk 'S'.
  const std::vector<std::uint8_t>& bytes() const;

 private:
  std::shared_ptr<const HandProfile> profile_;
  ViewSkinPtr base_;  // null: it is made from the profile
  double size_ = 1;
  mutable std::once_flag meshed_, written_;
  mutable Skin mesh_;
  mutable std::vector<std::uint8_t> bytes_;
};

}  // namespace barehand
