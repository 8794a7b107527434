#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "hand/profile.h"

namespace barehand {

/// The skin of a hand profile as the page draws it. It is made by the first call of bytes(), on the caller's thread,
/// which takes tens of milliseconds.
class ViewSkin {
 public:
  explicit ViewSkin(std::shared_ptr<const HandProfile> profile) : profile_(std::move(profile)) {}
  const std::shared_ptr<const HandProfile>& profile() const { return profile_; }
  /// The skin as a chunk 'S'.
  const std::vector<std::uint8_t>& bytes() const;

 private:
  std::shared_ptr<const HandProfile> profile_;
  mutable std::once_flag made_;
  mutable std::vector<std::uint8_t> bytes_;
};
using ViewSkinPtr = std::shared_ptr<const ViewSkin>;

}  // namespace barehand
