// The connected Foxglove viewers.
#include "io/foxglove/foxglove_clients.h"

#include <algorithm>

#include "io/ros/urdf.h"

namespace barehand {

std::unique_ptr<WebPeer> FoxgloveClients::connect(WebSocket socket) {
  auto client = std::make_unique<FoxgloveClient>(socket, [this](FrameClient& gone) { clients_.forget(gone); });
  clients_.add(*client);
  return client;
}

void FoxgloveClients::show(const ViewFramePtr& frame) {
  for (const ViewSkinPtr& skin : frame->content().skins)
    if (skin) set_profile(skin->profile());
  if (count() > 0) clients_.show(frame);
}

void FoxgloveClients::set_profile(std::shared_ptr<const HandProfile> profile) {
  const std::lock_guard lock(mutex_);
  profiles_[static_cast<std::size_t>(profile->handedness)] = std::move(profile);
}

Result<WebFile> FoxgloveClients::urdf(const std::string& path, const std::string& base) const {
  constexpr std::array<const char*, 2> kPaths = {"/left_hand.urdf", "/right_hand.urdf"};  // by Handedness
  const auto wanted = std::ranges::find(kPaths, path);
  if (wanted == kPaths.end()) return fail("There is no such file.");
  const auto side = static_cast<std::size_t>(wanted - kPaths.begin());

  // Describe the hand, or say which hands are tracked.
  auto profiles = [&] {
    const std::lock_guard lock(mutex_);
    return profiles_;
  }();
  if (profiles[side]) return WebFile{"application/xml", ros::urdf(*profiles[side])};
  const std::string what = "The " + std::string(to_string(static_cast<Handedness>(side))) + " hand is not tracked.";
  const std::size_t other = 1 - side;
  if (!profiles[other]) return fail(what + " No hand is known yet; ask again when one was seen.");
  return fail(what + " Only the " + std::string(to_string(static_cast<Handedness>(other))) + " hand is: " + base +
              kPaths[other]);
}

}  // namespace barehand
